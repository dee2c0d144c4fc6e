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
import stillwater.model.Interval
import stillwater.run.FilterKind
import stillwater.run.Preset
import java.util.concurrent.TimeUnit

/**
 * As [FilterBenchmark], for a boat that decides after each move: the map is asked for after every tenth reading. Of the
 * filters that put work off until then.
 */
@State(Scope.Thread)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
open class FilterDecisionBenchmark {
    private val grid = Grid.unit(10, 10)
    private val survey = Survey(grid, MOVES)

    /** Label of the filter. */
    @Param("bounded-extended", "self-calibrating")
    var filter: String = ""

    /** What a reading costs, its share of a decision's map included. */
    @Benchmark
    @OperationsPerInvocation(MOVES * Survey.SAMPLES)
    fun updateAndAsk(): Double {
        val kind = FilterKind.entries.first { it.label == filter }
        val estimator = kind.estimator(grid, Interval.UNIT, Preset.NOISY.settings().boundedFilter)
        var widths = 0.0
        survey.read(estimator) { map, cell -> widths += map.upper(cell) - map.lower(cell) }
        return widths
    }

    private companion object {
        const val MOVES = 2000
    }
}
