package stillwater.speed

import org.openjdk.jmh.annotations.Benchmark
import org.openjdk.jmh.annotations.BenchmarkMode
import org.openjdk.jmh.annotations.Fork
import org.openjdk.jmh.annotations.Measurement
import org.openjdk.jmh.annotations.Mode
import org.openjdk.jmh.annotations.OutputTimeUnit
import org.openjdk.jmh.annotations.Scope
import org.openjdk.jmh.annotations.Setup
import org.openjdk.jmh.annotations.State
import org.openjdk.jmh.annotations.TearDown
import org.openjdk.jmh.annotations.Warmup
import stillwater.cli.main
import java.nio.file.Files
import java.nio.file.Path
import java.util.concurrent.TimeUnit
import kotlin.io.path.ExperimentalPathApi
import kotlin.io.path.deleteRecursively

/** `stillwater map` of 1 million rows, figures and report included, in a warm machine; `measure.py` has it cold. */
@State(Scope.Thread)
@BenchmarkMode(Mode.SingleShotTime)
@OutputTimeUnit(TimeUnit.MILLISECONDS)
@Fork(1)
@Warmup(iterations = 1)
@Measurement(iterations = 3)
open class MapBenchmark {
    private lateinit var directory: Path
    private lateinit var log: Path

    @Setup
    fun write() {
        directory = Files.createTempDirectory("stillwater-speed")
        log = directory.resolve("long.csv")
        val script = ProcessBuilder("python3", "benchmarks/long_survey.py", "$ROWS", "$log").inheritIO().start()
        check(script.waitFor() == 0) { "benchmarks/long_survey.py failed; run this from the repository's root" }
    }

    @Benchmark
    fun millionRows() {
        val out = directory.resolve("map").toString()
        main(arrayOf("map", log.toString(), "--value", "do_mg_l", "--out", out, "--quiet"))
    }

    @OptIn(ExperimentalPathApi::class)
    @TearDown
    fun remove() {
        directory.deleteRecursively()
    }

    private companion object {
        const val ROWS = 1_000_000
    }
}
