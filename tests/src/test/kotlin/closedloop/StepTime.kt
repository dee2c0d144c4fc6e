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

/** How long Mission.step takes on a grid of 50 by 50 cells, planner, estimator and log included. */
internal class StepTime(private val planner: PlannerName, private val estimator: EstimatorName) {
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
            SensorSpec.fromJson(
                """{"name":"probe","stages":[{"type":"first-order-lag","time_constant_s":6.0},""" +
                    """{"type":"noise","standard_deviation":0.02}]}""",
            ),
            board = BoardSpec(oxygenPeriod = 1.0),
            start = Position(2.5, 2.5),
        ),
        Field { x, y, _ -> 8 + sin(x / 40) + cos(y / 30) },
        LocalFrame(LatLon(spec.origin.latitude, spec.origin.longitude)),
        SEED,
    )
    private var characters = 0L
    private val log = MissionLog({ characters += it.length }, LogStart(0, "step time"), spec)
    private val mission = Mission(spec, boat.phone, log)
    private val clock = ManagementFactory.getThreadMXBean()

    /** Processor times of [steps] steps, ns, sorted; the first [WARM] are not among them. */
    fun run(steps: Int): LongArray {
        mission.start()
        val times = LongArray(steps)
        for (step in -WARM until steps) {
            boat.advance(0.1)
            boat.takeFix()?.let { mission.fix(it.time, it.place) }
            mission.compass(boat.time, boat.heading(), boat.yawRate)
            val begun = clock.currentThreadCpuTime
            mission.step(boat.time)
            if (step >= 0) times[step] = clock.currentThreadCpuTime - begun
        }
        return times.also { it.sort() }
    }

    private fun word(name: Enum<*>) = name.name.lowercase().replace('_', '-')

    companion object {
        /** Steps until the code is compiled and the boat has been on its way for a while. */
        const val WARM = 5000
        private const val SEED = 20_261_121L

        fun text(times: LongArray): String = listOf(times.size / 2, times.size * 99 / 100, times.size * 999 / 1000)
            .map { times[it] }
            .plus(times.last())
            .joinToString(" | ") { "%.3f".format(Locale.ROOT, it / NANOS) }

        private const val NANOS = 1e6
    }
}

/**
 * `STEPS [PLANNER ESTIMATOR]`: prints a table of the times of so many steps, ms of processor time: of the two that are
 * named, or of each planner with one estimator and each estimator with one planner.
 */
fun main(arguments: Array<String>) {
    val steps = arguments[0].toInt()
    val named = arguments.drop(1).map { it.uppercase().replace('-', '_') }
    println("| planner | estimator | median | 99 % | 99.9 % | longest |\n|---|---|---|---|---|---|")
    for (estimator in EstimatorName.entries) {
        for (planner in PlannerName.entries) {
            val isAsked = if (named.isEmpty()) {
                estimator == EstimatorName.BOUNDED_EXTENDED || planner == PlannerName.BOUNDED_EXTENDED
            } else {
                named == listOf(planner.name, estimator.name)
            }
            if (!isAsked) continue
            println("| $planner | $estimator | ${StepTime.text(StepTime(planner, estimator).run(steps))} |")
        }
    }
}
