package stillwater.speed

import kotlinx.coroutines.runBlocking
import org.openjdk.jmh.annotations.Benchmark
import org.openjdk.jmh.annotations.BenchmarkMode
import org.openjdk.jmh.annotations.Fork
import org.openjdk.jmh.annotations.Measurement
import org.openjdk.jmh.annotations.Mode
import org.openjdk.jmh.annotations.OutputTimeUnit
import org.openjdk.jmh.annotations.Param
import org.openjdk.jmh.annotations.Scope
import org.openjdk.jmh.annotations.State
import org.openjdk.jmh.annotations.Warmup
import stillwater.run.Experiment
import stillwater.run.ExperimentResult
import stillwater.run.Preset
import java.util.concurrent.TimeUnit

/**
 * What `benchmark` computes for one field: 100 environments, 6 combinations, 2000 moves; nothing is written.
 *
 * Java still compiles in the 28th round; with two workers that takes a core from one of them.
 */
@State(Scope.Thread)
@BenchmarkMode(Mode.SingleShotTime)
@OutputTimeUnit(TimeUnit.MILLISECONDS)
@Fork(1)
@Warmup(iterations = 32)
@Measurement(iterations = 8)
open class ExperimentBenchmark {
    /** Environments at once. */
    @Param("1", "2")
    var workers: Int = 0

    /** Kind of field. */
    @Param(Preset.UNIFORM, Preset.GAUSSIAN)
    var field: String = ""

    @Benchmark
    fun oneField(): ExperimentResult = runBlocking {
        val settings = Preset.REPORT.settings()
        Experiment(settings.copy(fields = settings.fields.filterKeys { it == field })).run(workers)
    }
}
