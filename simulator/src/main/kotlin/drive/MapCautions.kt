package stillwater.drive

import stillwater.estimate.SensorBelief
import stillwater.field.FieldMap
import stillwater.mission.EstimatorName
import stillwater.mission.Mission
import stillwater.mission.MissionState
import stillwater.mission.StopReason
import stillwater.model.Position
import stillwater.report.SignificantDigits
import stillwater.report.counted
import stillwater.survey.SensorWording

/**
 * What to beware of in a mission's map, as far as the mission itself can tell: the same words for a simulated, a real
 * and a replayed one.
 */
internal object MapCautions {
    /** Estimators whose cells all get bounds once there are readings enough in them. */
    private val BOUNDING = setOf(
        EstimatorName.BOUNDED,
        EstimatorName.BOUNDED_EXTENDED,
        EstimatorName.INTERVAL,
        EstimatorName.SELF_CALIBRATING,
    )
    private val THREE = SignificantDigits(3)
    private const val MOST_NAMED = 5
    private const val MANY_DOUBTED = 0.1

    /** One line each; of [mission]'s map as it is now. */
    fun of(mission: Mission): List<String> = listOfNotNull(
        nothing(mission),
        doubted(mission),
        unexplained(mission.sensor),
        fewBounds(mission.spec.estimator, mission.map),
        "no cell has a reading".takeIf { visited(mission) == 0 },
        givenUp(mission),
    )

    /** As below, of [mission]'s readings. */
    fun doubted(mission: Mission): String? = doubted(mission.doubtedReadings, mission.readings.passed)

    /** That the map has [doubted] of [taken] readings from places that the mission did not sail by; null for few. */
    fun doubted(doubted: Long, taken: Long): String? {
        if (doubted == 0L || doubted < MANY_DOUBTED * taken) return null
        return "$doubted of ${counted(taken, "reading")} were taken while the boat's place was in doubt, because " +
            "fixes were too old or did not agree: they may be in other cells than they are of"
    }

    /** Whether [mission] did all it was to do, by its own word, and knows of no cell but that where the boat lay. */
    fun hasSurveyedNothing(mission: Mission): Boolean {
        val isCompleted = mission.state == MissionState.Stopped(StopReason.COMPLETED)
        return isCompleted && mission.map.grid.size > 1 && visited(mission) <= 1
    }

    /** What to say of a [mission] that [hasSurveyedNothing]; null for others. */
    fun nothing(mission: Mission): String? {
        if (!hasSurveyedNothing(mission)) return null
        val readings = mission.readings
        if (readings.passed == 0L && readings.leftOut > 0) return "nothing was surveyed: ${allRefused(mission)}"
        if (readings.passed + readings.leftOut > 0) {
            return "nothing was surveyed: the budget was spent before the boat came to a second cell; give it more"
        }
        val isNamed = mission.spec.probe.port != null
        val advice = if (isNamed) "" else "; name its port in the mission's probe: \"port\":1 to 3"
        return "nothing was surveyed: the probe was never heard$advice"
    }

    /** That all readings of [mission], of which none passed, were refused, and why. */
    private fun allRefused(mission: Mission): String {
        val readings = mission.readings
        val probe = mission.spec.probe
        val space = if (probe.quantity.unit.isEmpty()) "" else " "
        val range = "${number(probe.lowest)} to ${number(probe.highest)}$space${probe.quantity.unit}"
        val why = listOf(
            "outside of the probe's range, $range" to readings.outOfRange,
            "alone in what they said" to readings.lone,
            "of a probe that was stuck" to readings.stuck,
            "without a value or a place" to readings.withoutValueOrPlace,
        ).filter { it.second > 0 }
        val count = readings.leftOut
        val all = if (count == 1L) "the only reading was refused" else "all $count readings were refused"
        val words = why.singleOrNull()?.first ?: why.joinToString { (reason, number) -> "$number $reason" }
        return "$all: $words"
    }

    /** [value] as the mission has it. */
    private fun number(value: Double) = value.toBigDecimal().stripTrailingZeros().toPlainString()

    /** Which cells [mission] gave up, the first [MOST_NAMED] by their centres; null where there are none. */
    fun givenUp(mission: Mission): String? {
        val grid = mission.map.grid
        val cells = mission.givenUpCells.map { Position(grid.centerX(it), grid.centerY(it)) } + mission.givenUpOffMap
        if (cells.isEmpty()) return null
        val places = cells.take(MOST_NAMED).joinToString { "(${THREE.format(it.x)}, ${THREE.format(it.y)})" }
        val more = if (cells.size > MOST_NAMED) " and ${cells.size - MOST_NAMED} more" else ""
        return "${counted(cells.size, "cell")} given up, because the boat came no nearer: $places m$more"
    }

    private fun visited(mission: Mission) = (0 until mission.map.grid.size).count { mission.map.readings(it) > 0 }

    /** Where no model of a sensor fits; [where] says why that may be, after a comma, unless the readings do. */
    fun unexplained(belief: SensorBelief?, where: String = ""): String? {
        if (belief?.isExplained != false) return null
        val values = "values where the nearest model's ran away"
        val unlike = SensorWording.unlikeItsCells(belief)
        if (unlike == null) {
            return "no sensor model explains the readings$where: bounds, and $values, are those of bounded-extended"
        }
        return "no sensor model can be learned in these cells, $unlike: bounds are those of bounded-extended and of " +
            "the readings' spread, $values bounded-extended's"
    }

    /** Where a filter that gives bounds gave few. */
    fun fewBounds(estimator: EstimatorName, map: FieldMap): String? {
        val known = (0 until map.grid.size).filter { map.readings(it) > 0 }
        val bounded = known.count { map.upper(it) - map.lower(it) < map.prior.width }
        if (estimator !in BOUNDING || 2 * bounded >= known.size) return null
        val each = THREE.format(known.sumOf { map.readings(it).toLong() }.toDouble() / known.size)
        return "only $bounded of ${counted(known.size, "cell")} with readings " +
            "${if (bounded == 1) "has" else "have"} bounds, after $each readings a cell; larger cells, a slower boat " +
            "or a faster probe give more"
    }
}
