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
 */
internal class StepTime(
    private val planner: PlannerName,
    private val estimator: EstimatorName,
    private val stages: String,
    private val period: Double,
    private val seed: Long,
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

    /** Cells with a reading. */
    val visited: Int get() = (0 until mission.map.grid.size).count { mission.map.readings(it) > 0 }

    /** Processor times of the mission's first [steps] steps, ns, sorted. */
    fun run(steps: Int): LongArray {
        mission.start()
        val times = LongArray(steps)
        for (step in 0 until steps) {
            boat.advance(0.1)
            boat.takeFix()?.let { mission.fix(it.time, it.place) }
            mission.compass(boat.time, boat.heading(), boat.yawRate)
            val begun = clock.currentThreadCpuTime
            mission.step(boat.time)
            times[step] = clock.currentThreadCpuTime - begun
        }
        return times.also { it.sort() }
    }

    companion object {
        /** Steps of another mission before, until the code is compiled. */
        const val WARM = 10_000
        const val SEED = 20_261_121L

        fun text(times: LongArray): String = listOf(times.size / 2, times.size * 99 / 100, times.size * 999 / 1000)
            .map { times[it] }
            .plus(times.last())
            .joinToString(" | ") { "%.3f".format(Locale.ROOT, it / NANOS) }

        private const val NANOS = 1e6
    }
}

private const val LAG = """{"type":"first-order-lag","time_constant_s":6.0}"""

/**
 * `STEPS [PLANNER ESTIMATOR [PERIOD [STAGES]]]`: prints a table of the times of a mission's first so many steps, ms of
 * processor time: of all planners and estimators, or of the two that are named (`all` for each), with a probe that reads
 * each PERIOD seconds (1) and has the STAGES of a sensor's file (a lag of 6 s).
 */
fun main(arguments: Array<String>) {
    val steps = arguments[0].toInt()
    val named = arguments.drop(1).map { it.uppercase().replace('-', '_') }
    val period = arguments.getOrNull(3)?.toDouble() ?: 1.0
    val stages = arguments.getOrNull(4) ?: LAG
    println("| estimator | planner | cells read | median | 99 % | 99.9 % | longest |\n|---|---|---|---|---|---|---|")
    for (estimator in EstimatorName.entries.filter { named.getOrElse(1) { "ALL" } in listOf(it.name, "ALL") }) {
        for (planner in PlannerName.entries.filter { named.getOrElse(0) { "ALL" } in listOf(it.name, "ALL") }) {
            StepTime(planner, estimator, stages, period, StepTime.SEED + 1).run(StepTime.WARM)
            val timed = StepTime(planner, estimator, stages, period, StepTime.SEED)
            val times = StepTime.text(timed.run(steps))
            println("| ${word(estimator)} | ${word(planner)} | ${timed.visited} | $times |")
        }
    }
}

private fun word(name: Enum<*>) = name.name.lowercase().replace('_', '-')
