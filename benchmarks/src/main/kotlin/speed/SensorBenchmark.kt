package stillwater.speed

import org.openjdk.jmh.annotations.Benchmark
import org.openjdk.jmh.annotations.BenchmarkMode
import org.openjdk.jmh.annotations.Mode
import org.openjdk.jmh.annotations.OutputTimeUnit
import org.openjdk.jmh.annotations.Param
import org.openjdk.jmh.annotations.Scope
import org.openjdk.jmh.annotations.Setup
import org.openjdk.jmh.annotations.State
import stillwater.model.Conditions
import stillwater.run.Preset
import stillwater.sensor.SensorModel
import java.util.concurrent.TimeUnit
import kotlin.random.Random

/** One step of a simulated sensor. */
@State(Scope.Thread)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
open class SensorBenchmark {
    /** The preset whose sensor it is: a lag, a lag with noise and resolution, a slew limit. */
    @Param("report", "noisy", "original")
    var preset: String = ""
    private lateinit var sensor: SensorModel
    private var input = 0.0

    @Setup
    fun build() {
        val settings = Preset.entries.first { it.label == preset }.settings()
        sensor = settings.sensor.build(0.5, Random(Survey.SEED))
    }

    @Benchmark
    fun step(): Double {
        input = if (input > 1) 0.0 else input + 1e-3
        return sensor.step(input, 1.0, Conditions.NONE)
    }
}
