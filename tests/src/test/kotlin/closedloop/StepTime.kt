package stillwater.closedloop

import stillwater.field.Field
import stillwater.mission.EstimatorName
import stillwater.mission.LogStart
import stillwater.mission.Mission
import stillwater.mission.MissionLog
import stillwater.mission.MissionSpec
import stillwater.mission.PlannerName
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import stillwater.sensor.SensorSpec
import stillwater.virtual.BoardSpec
import stillwater.virtual.VirtualBoat
import stillwater.virtual.VirtualBoatSpec
import java.lang.management.ManagementFactory
import java.util.Locale
import kotlin.math.cos
import kotlin.math.sin

/**
 * How long Mission.step takes on a grid of 50 by 50 cells, planner, estimator and log included.
 *
 * @param stages of the probe, as in a sensor's file.
 * @param period from one reading to the next, s.
 * @param reef whether there is water, from shore to shore but for its ends, that the boat does not get into, so that
 *   cells are closed and ways lead round them.
 */
internal class StepTime(
    private val planner: PlannerName,
    private val estimator: EstimatorName,
    private val stages: String,
    private val period: Double,
    private val seed: Long,
    private val reef: Boolean = false,
) {
    private val spec = MissionSpec.fromJson(
        """{"name":"large","origin":{"lat_deg":45.5,"lon_deg":-73.6},
            "area":{"south_west":{"x_m":-20,"y_m":-20},"north_east":{"x_m":270,"y_m":270}},
            "grid":{"south_west":{"x_m":0,"y_m":0},"columns":50,"rows":50,"cell_m":5},
            "probe":{"quantity":"dissolved-oxygen","port":1,"lowest":4,"highest":12},
            "estimator":"${word(estimator)}","planner":"${word(planner)}","budget":{"seconds":100000},
            "home":{"x_m":2.5,"y_m":2.5}}""",
    )
    private val boat = VirtualBoat(
        VirtualBoatSpec(
            SensorSpec.fromJson("""{"name":"probe","stages":[$stages,{"type":"noise","standard_deviation":0.02}]}"""),
            board = BoardSpec(oxygenPeriod = period),
            start = Position(2.5, 2.5),
        ),
        Field { x, y, _ -> 8 + sin(x / 40) + cos(y / 30) },
        LocalFrame(LatLon(spec.origin.latitude, spec.origin.longitude)),
        seed,
    )
    private var characters = 0L
    private val log = MissionLog({ characters += it.length }, LogStart(0, "step time"), spec)
    private val mission = Mission(spec, boat.phone, log)
    private val clock = ManagementFactory.getThreadMXBean()

    /** Cells that the boat did not get into. */
    val givenUp: Int get() = mission.givenUpCells.size + mission.givenUpOffMap.size

    /** Processor times of the mission's first [steps] steps, ns, sorted. */
    fun run(steps: Int): LongArray {
        mission.start()
        val times = LongArray(steps)
        for (step in 0 until steps) {
            boat.advance(0.1)
            if (reef) keepOut()
            boat.takeFix()?.let { mission.fix(it.time, it.place) }
            mission.compass(boat.time, boat.heading(), boat.yawRate)
            val begun = clock.currentThreadCpuTime
            mission.step(boat.time)
            times[step] = clock.currentThreadCpuTime - begun
        }
        return times.also { it.sort() }
    }

    /** Pushes the boat out of the reef as fast as it drives in, and a little faster. */
    private fun keepOut() {
        val at = boat.dynamics
        val isIn = at.x in REEF_WEST..REEF_EAST && at.y in REEF_SOUTH..REEF_NORTH
        val side = if (at.y < (REEF_SOUTH + REEF_NORTH) / 2) -1.0 else 1.0
        at.currentY = if (isIn) side * (maxOf(0.0, -side * at.surge * sin(at.heading)) + 0.2) else 0.0
    }

    companion object {
        private const val REEF_WEST = 0.0
        private const val REEF_EAST = 240.0
        private const val REEF_SOUTH = 20.0
        private const val REEF_NORTH = 26.0

        /** Steps of another mission before, until the code is compiled. */
        const val WARM = 10_000
        const val SEED = 20_261_121L

        /** Median, 99th percentile and longest, ms. */
        fun text(times: LongArray): String = listOf(times[times.size / 2], times[times.size * 99 / 100], times.last())
            .joinToString(", ") { "%.3f".format(Locale.ROOT, it / NANOS) }

        private const val NANOS = 1e6
    }
}

private const val LAG = """{"type":"first-order-lag","time_constant_s":6.0}"""

/**
 * `STEPS [PLANNER ESTIMATOR [PERIOD [STAGES [reef]]]]`: prints a table of the times of a mission's first so many steps,
 * ms of processor time: median, 99th percentile, longest; of all planners and estimators, or of the two that are named
 * (`all` for each), with a probe that reads each PERIOD seconds (1) and has the STAGES of a sensor's file (a lag of 6
 * s, as with `-`); with `reef` on water part of which the boat does not get into, and behind the times how many cells
 * it gave up.
 */
fun main(arguments: Array<String>) {
    val steps = arguments[0].toInt()
    val planners = PlannerName.entries.filter { arguments.getOrElse(1) { "all" } in listOf(word(it), "all") }
    val estimators = EstimatorName.entries.filter { arguments.getOrElse(2) { "all" } in listOf(word(it), "all") }
    val period = arguments.getOrNull(3)?.toDouble() ?: 1.0
    val stages = arguments.getOrNull(4)?.takeIf { it != "-" } ?: LAG
    val reef = arguments.getOrNull(5) == "reef"
    println("| |" + planners.joinToString("") { " ${word(it)} |" })
    println("|---|" + "---|".repeat(planners.size))
    for (estimator in estimators) {
        print("| ${word(estimator)} |")
        for (planner in planners) {
            StepTime(planner, estimator, stages, period, StepTime.SEED + 1).run(StepTime.WARM)
            val measured = StepTime(planner, estimator, stages, period, StepTime.SEED, reef)
            val times = StepTime.text(measured.run(steps))
            print(" $times${if (reef) " (${measured.givenUp})" else ""} |")
        }
        println()
    }
}

private fun word(name: Enum<*>) = name.name.lowercase().replace('_', '-')
