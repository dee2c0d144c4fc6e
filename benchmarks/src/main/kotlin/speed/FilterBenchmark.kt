package stillwater.speed

import org.openjdk.jmh.annotations.Benchmark
import org.openjdk.jmh.annotations.BenchmarkMode
import org.openjdk.jmh.annotations.Mode
import org.openjdk.jmh.annotations.OperationsPerInvocation
import org.openjdk.jmh.annotations.OutputTimeUnit
import org.openjdk.jmh.annotations.Param
import org.openjdk.jmh.annotations.Scope
import org.openjdk.jmh.annotations.State
import stillwater.estimate.FieldEstimator
import stillwater.model.Grid
import java.util.concurrent.TimeUnit

/** A reading into a filter: surveys of 2000 moves over 10 x 10 cells, the filter's making included in every survey. */
@State(Scope.Thread)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
open class FilterBenchmark {
    private val survey = Survey(Grid.unit(10, 10), MOVES)

    /** Label of the filter. */
    @Param("averaging", "bounded", "interval", "bounded-extended", "self-calibrating")
    var filter: String = ""

    @Benchmark
    @OperationsPerInvocation(MOVES * Survey.SAMPLES)
    fun update(): FieldEstimator = survey.estimator(filter).also { survey.read(it) }

    /** The same readings, those of a move together, as an experiment hands them over. */
    @Benchmark
    @OperationsPerInvocation(MOVES * Survey.SAMPLES)
    fun updateAll(): FieldEstimator = survey.estimator(filter).also { survey.readMoves(it) }

    private companion object {
        const val MOVES = 2000
    }
}
