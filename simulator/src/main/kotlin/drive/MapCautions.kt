package stillwater.drive

import stillwater.estimate.SensorBelief
import stillwater.field.FieldMap
import stillwater.mission.EstimatorName
import stillwater.mission.Mission
import stillwater.mission.MissionState
import stillwater.mission.StopReason
import stillwater.report.SignificantDigits
import stillwater.report.counted

/**
 * What to beware of in a mission's map, as far as the mission itself can tell: the same words for a simulated, a real and
 * a replayed one.
 */
internal object MapCautions {
    /** Estimators whose cells all get bounds once there are readings enough in them. */
    private val BOUNDING = setOf(
        EstimatorName.BOUNDED,
        EstimatorName.BOUNDED_EXTENDED,
        EstimatorName.INTERVAL,
        EstimatorName.SELF_CALIBRATING,
    )
    /** A mission that was over before it was under way. */
    const val NOTHING = "nothing was surveyed: the budget was spent before the boat could set out; give it more"
    private val THREE = SignificantDigits(3)

    /** One line each; of [mission]'s map as it is now, and of the mission itself where it [isEmpty]. */
    fun of(mission: Mission, isEmpty: Boolean = false): List<String> = listOfNotNull(
        NOTHING.takeIf { isEmpty && mission.state == MissionState.Stopped(StopReason.COMPLETED) },
        unexplained(mission.spec.estimator, mission.sensor),
        fewBounds(mission.spec.estimator, mission.map),
        "no cell has a reading".takeIf { (0 until mission.map.grid.size).none { mission.map.readings(it) > 0 } },
    )

    /** Where no model of a sensor fits; [where] says why that may be, after a comma. */
    fun unexplained(estimator: EstimatorName, belief: SensorBelief?, where: String = ""): String? {
        if (belief?.isExplained != false) return null
        val then = if (estimator == EstimatorName.BAYESIAN) {
            "the map has no bounds"
        } else {
            "bounds, and values where the nearest model's ran away, are those of bounded-extended"
        }
        return "no sensor model explains the readings$where: $then"
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
