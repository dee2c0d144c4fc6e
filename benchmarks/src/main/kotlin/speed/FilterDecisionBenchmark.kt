package stillwater.speed

import org.openjdk.jmh.annotations.Benchmark
import org.openjdk.jmh.annotations.BenchmarkMode
import org.openjdk.jmh.annotations.Mode
import org.openjdk.jmh.annotations.OperationsPerInvocation
import org.openjdk.jmh.annotations.OutputTimeUnit
import org.openjdk.jmh.annotations.Param
import org.openjdk.jmh.annotations.Scope
import org.openjdk.jmh.annotations.State
import stillwater.model.Grid
import java.util.concurrent.TimeUnit

/**
 * As [FilterBenchmark], for a boat that decides after each move: the map is asked for after every tenth reading. Of the
 * filters that put work off until then.
 */
@State(Scope.Thread)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
open class FilterDecisionBenchmark {
    private val survey = Survey(Grid.unit(10, 10), MOVES)

    /** Label of the filter. */
    @Param("bounded-extended", "self-calibrating")
    var filter: String = ""

    /** What a reading costs, its share of a decision's map included. */
    @Benchmark
    @OperationsPerInvocation(MOVES * Survey.SAMPLES)
    fun updateAndAsk(): Double {
        var widths = 0.0
        survey.read(survey.estimator(filter)) { map, cell -> widths += map.upper(cell) - map.lower(cell) }
        return widths
    }

    private companion object {
        const val MOVES = 2000
    }
}
