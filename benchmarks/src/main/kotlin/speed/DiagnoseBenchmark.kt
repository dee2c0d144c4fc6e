package stillwater.speed

import org.openjdk.jmh.annotations.Benchmark
import org.openjdk.jmh.annotations.BenchmarkMode
import org.openjdk.jmh.annotations.Fork
import org.openjdk.jmh.annotations.Measurement
import org.openjdk.jmh.annotations.Mode
import org.openjdk.jmh.annotations.OutputTimeUnit
import org.openjdk.jmh.annotations.Scope
import org.openjdk.jmh.annotations.State
import org.openjdk.jmh.annotations.Warmup
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.MeasuredSeries
import stillwater.model.Conditions
import java.util.concurrent.TimeUnit
import kotlin.math.sin
import kotlin.random.Random

/** A diagnosis of 5000 rows with a reference, drawing and writing left out. */
@State(Scope.Thread)
@BenchmarkMode(Mode.SingleShotTime)
@OutputTimeUnit(TimeUnit.MILLISECONDS)
@Fork(1)
@Warmup(iterations = 1)
@Measurement(iterations = 3)
open class DiagnoseBenchmark {
    private val series = series()

    @Benchmark
    fun rows5000(): DiagnosisResult = Diagnosis(series).run()

    private fun series(): MeasuredSeries {
        val random = Random(Survey.SEED)
        val sensor = Survey.SENSOR.build(0.5, random)
        val truth = DoubleArray(ROWS) { 0.5 + 0.3 * sin(it * 0.011) + 0.1 * sin(it * 0.047) }
        return MeasuredSeries(
            times = DoubleArray(ROWS) { it.toDouble() },
            x = DoubleArray(ROWS) { it % LEG * 1.0 },
            y = DoubleArray(ROWS) { it / LEG * 10.0 },
            values = DoubleArray(ROWS) { sensor.step(truth[it], 1.0, Conditions.NONE) },
            reference = truth,
        )
    }

    private companion object {
        const val ROWS = 5000
        const val LEG = 250
    }
}
