package stillwater.simulation

import stillwater.drive.MapCautions
import stillwater.report.SignificantDigits
import stillwater.report.counted
import stillwater.survey.SensorWording
import stillwater.world.SimulatedConditions

/**
 * A [SimulationResult] in words: facts, and what to beware of.
 *
 * @param result to tell. @property unit of the quantity; empty where it has none.
 */
class SimulationSummary(private val result: SimulationResult, val unit: String) {
    private val run = result.run
    private val three = SignificantDigits(3)

    /** Names and sentences, the most important first. */
    val facts: List<Pair<String, String>> = buildList {
        add("mission" to "${run.spec.name}: ${end()}")
        add("map error" to mapError())
        add("in process" to inProcess())
        add("way" to way())
        add("readings" to readings())
        bounds()?.let { add("bounds" to it) }
        add("energy" to "${number(run.world.battery.used)} W h; battery at ${number(run.world.battery.volts)} V")
        add("link" to link())
        add("refused" to refused())
        belief()?.let { add("sensor" to it) }
    }

    /** The few numbers that stand at the top of a page. */
    val headline: List<Pair<String, String>> = listOf(
        "End" to run.history.spans.last().label.let { if (result.isOver) it else "not over, $it" },
        "Map error" to "${number(result.atCentres.mean)} $unit".trim(),
        "The same readings in process" to "${number(result.inProcessError.mean)} $unit".trim(),
        "Cells with readings" to "${result.atCentres.cells} of ${run.world.site.grid.size}",
        "Way" to "${number(run.track.distanceUnderWay)} m",
        "Off the legs" to "${number(run.track.crossTrack)} m RMS",
    )

    /** What to beware of, one line each. */
    val warnings: List<String> = buildList {
        if (!result.isOver) {
            add("the mission was not over after ${clock(result.longest)}; --longest gives it more time")
        }
        run.world.emptySince?.let {
            add("the battery was empty after ${clock(it.seconds)}: from then on the boat had no thrust and drifted")
        }
        SimulatedConditions.missing(run.world.sensor)?.let { add(it) }
        MapCautions.nothing(run.mission)?.let { add(it) }
        if (!result.readings.isComplete) add("the readings do not add up: ${result.readings}")
        val where = if (run.world.settings.water.isEvenInCells) "" else ", as where the water changes within a cell"
        MapCautions.unexplained(result.belief, where)?.let { add(it) }
        MapCautions.fewBounds(run.spec.estimator, result.map)?.let { add(it) }
        if (result.againstMeans.mean > result.averagesError.mean) {
            add(
                "the map is no better than the mean of each cell's readings: off the cells' means by " +
                    "${number(result.againstMeans.mean)} against ${number(result.averagesError.mean)}$space$unit",
            )
        }
        val holding = result.boundsAtCentres
        if (holding.cells > 0 && holding.holding < CREDIBLE) {
            add(
                "the bounds hold the water at the cells' centres in only ${percent(holding.holding)} of " +
                    counted(holding.cells, "cell"),
            )
        }
        if (result.atCentres.cells == 0) add("no cell has a reading")
        MapCautions.givenUp(run.mission)?.let { add(it) }
        MapCautions.doubted(run.mission)?.let { add(it) }
    }

    private val space get() = if (unit.isEmpty()) "" else " "

    /** How the mission ended, or how far it is. */
    private fun end(): String {
        val last = run.history.spans.last()
        if (!result.isOver) return "not over after ${clock(run.time.seconds)}: ${last.label} since ${clock(last.from)}"
        val nothing = if (MapCautions.hasSurveyedNothing(run.mission)) ", nothing surveyed" else ""
        return "${last.label} after ${clock(last.from)}$nothing"
    }

    private fun mapError(): String {
        val centres = result.atCentres
        return "${number(centres.mean)}$space$unit mean, ${number(centres.rootMeanSquare)} RMS over " +
            "${centres.cells} of ${run.world.site.grid.size} cells at their centres; " +
            "${number(result.againstMeans.mean)} against their means"
    }

    private fun inProcess(): String {
        val own = result.comparedError
        val ratio = own.mean / result.inProcessError.mean
        val times = if (ratio.isFinite()) ", ${number(ratio)} times as much" else ""
        return "${number(result.inProcessError.mean)}$space$unit with the same readings at the true places; the " +
            "mission ${number(own.mean)} over the same ${counted(own.cells, "cell")}$times"
    }

    private fun way() = "${number(run.track.distanceUnderWay)} m in ${clock(result.timeUnderWay)}; " +
        "${number(run.track.crossTrack)} m RMS off its legs (largest ${number(run.track.largestCrossTrack)} m), " +
        "believed place off by ${number(run.track.poseError)} m RMS"

    private fun readings(): String {
        val account = result.readings
        val why = account.refused.entries.joinToString("") { ", ${it.value} refused (${it.key})" }
        val outside = if (account.outside > 0) ", ${account.outside} of them off the map" else ""
        val borders = run.mission.unplaced
        val unplaced =
            if (borders > 0) ", $borders of them at borders, which told of the probe but of no cell" else ""
        val waiting = if (account.waiting > 0) ", ${account.waiting} waiting" else ""
        val received = "${account.received} of ${account.sent} sent were received"
        return "$received: ${account.taken} taken$outside$unplaced$why$waiting"
    }

    private fun bounds(): String? {
        val centres = result.boundsAtCentres
        if (centres.cells == 0) return null
        val wide = "${number(centres.meanWidth)}$space$unit wide in ${counted(centres.cells, "cell")}"
        val means = percent(result.boundsAroundMeans.holding)
        return "$wide; they hold the water at the centre in ${percent(centres.holding)}, the cell's mean in $means"
    }

    private fun link(): String {
        val board = run.mission.board
        val kinds = result.unreadable.entries.joinToString { "${it.key} ${it.value}" }
        val bad = "${counted(board.unreadable, "line")} could not be read ($kinds)"
        val lines = if (kinds.isEmpty()) "all lines could be read" else bad
        return "$lines; the board could not use ${counted(board.refusals, "command")}"
    }

    private fun refused(): String {
        val mission = run.mission
        val givenUp = if (mission.givenUp > 0) ", ${counted(mission.givenUp, "waypoint")} given up" else ""
        return "${counted(mission.refusedFixes, "fix", "fixes")}, ${counted(mission.refusedSteps, "step")}, " +
            counted(mission.readings.leftOut, "reading") + givenUp
    }

    private fun belief(): String? {
        val belief = result.belief ?: return null
        val chosen = belief.chosen
        val numbers = chosen.parameters.joinToString { "${it.name} ${number(it.value)} ${it.unit}" }
        val verdict = when {
            belief.isExplained -> ""
            SensorWording.unlikeItsCells(belief) == null -> "none explains the readings; the nearest is "
            else -> "none can be learned in these cells; the nearest is "
        }
        return "$verdict${chosen.kind.label}" + if (numbers.isEmpty()) "" else ", $numbers"
    }

    private fun number(value: Double) = three.format(value)

    private fun percent(share: Double) = "${three.format(PERCENT * share)} %"

    companion object {
        private const val CREDIBLE = 0.95
        private const val PERCENT = 100

        /** [seconds] as minutes and seconds. */
        fun clock(seconds: Double): String {
            val whole = Math.round(seconds)
            return "${whole / 60}:${(whole % 60).toString().padStart(2, '0')} min"
        }
    }
}
