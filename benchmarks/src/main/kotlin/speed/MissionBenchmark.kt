package stillwater.speed

import org.openjdk.jmh.annotations.Benchmark
import org.openjdk.jmh.annotations.BenchmarkMode
import org.openjdk.jmh.annotations.Mode
import org.openjdk.jmh.annotations.OutputTimeUnit
import org.openjdk.jmh.annotations.Param
import org.openjdk.jmh.annotations.Scope
import org.openjdk.jmh.annotations.Setup
import org.openjdk.jmh.annotations.State
import stillwater.field.Field
import stillwater.mission.LogStart
import stillwater.mission.Mission
import stillwater.mission.MissionLog
import stillwater.mission.MissionSpec
import stillwater.mission.MissionState
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import stillwater.virtual.VirtualBoat
import stillwater.virtual.VirtualBoatSpec
import java.util.concurrent.TimeUnit
import kotlin.math.cos
import kotlin.math.sin

/**
 * A step of a mission over 50 x 50 cells, from the board's bytes to the motors' command and the log's line.
 *
 * Measured with the virtual boat it sails, five ticks of 0.02 s a step; [boatOnly] is the boat's part of that.
 */
@State(Scope.Thread)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.MICROSECONDS)
open class MissionBenchmark {
    /** The estimator of the mission. */
    @Param("bounded-extended", "self-calibrating")
    var estimator: String = ""
    private val spec by lazy { MissionSpec.fromJson(SPEC.replace("ESTIMATOR", estimator)) }
    private lateinit var boat: VirtualBoat
    private lateinit var alone: VirtualBoat
    private lateinit var mission: Mission
    private var written = 0L

    @Setup
    fun launch() {
        boat = boat()
        alone = boat()
        val log = MissionLog({ written += it.length }, LogStart(1_700_000_000_000, "2023-11-14 22:13:20"), spec)
        mission = Mission(spec, boat.phone, log)
        mission.start()
        while (mission.state != MissionState.Surveying) step()
    }

    private fun boat() = VirtualBoat(
        VirtualBoatSpec(Survey.SENSOR, start = Position(spec.home.x, spec.home.y), restsAt = 7.0),
        Field { x, y, _ -> 7.5 + 1.5 * sin(x / 15) * cos(y / 20) },
        LocalFrame(LatLon(spec.origin.latitude, spec.origin.longitude)),
        Survey.SEED.toLong(),
    )

    @Benchmark
    fun step(): MissionState {
        boat.advance(STEP)
        boat.takeFix()?.let { mission.fix(it.time, it.place) }
        mission.compass(boat.time, boat.heading(), boat.yawRate)
        val state = mission.step(boat.time)
        // Where the budget is spent another mission begins.
        if (state is MissionState.Stopped) launch()
        return state
    }

    @Benchmark
    fun boatOnly(): Double {
        alone.advance(STEP)
        alone.takeFix()
        return alone.heading()
    }

    private companion object {
        const val STEP = 0.1
        const val SPEC = """{"name":"lake","origin":{"lat_deg":45.5,"lon_deg":-73.6},
            "area":{"south_west":{"x_m":-20,"y_m":-20},"north_east":{"x_m":520,"y_m":520}},
            "grid":{"south_west":{"x_m":0,"y_m":0},"columns":50,"rows":50,"cell_m":10},
            "probe":{"quantity":"dissolved-oxygen","port":1,"lowest":0,"highest":15},
            "estimator":"ESTIMATOR","planner":"lawnmower","budget":{"seconds":36000},
            "home":{"x_m":5,"y_m":5}}"""
    }
}
