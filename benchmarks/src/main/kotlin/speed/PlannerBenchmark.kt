package stillwater.speed

import org.openjdk.jmh.annotations.Benchmark
import org.openjdk.jmh.annotations.BenchmarkMode
import org.openjdk.jmh.annotations.Mode
import org.openjdk.jmh.annotations.OperationsPerInvocation
import org.openjdk.jmh.annotations.OutputTimeUnit
import org.openjdk.jmh.annotations.Param
import org.openjdk.jmh.annotations.Scope
import org.openjdk.jmh.annotations.Setup
import org.openjdk.jmh.annotations.State
import stillwater.estimate.BoundedFilter
import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Plan
import stillwater.plan.BoundedPlanner
import stillwater.plan.BoundedPlannerSettings
import stillwater.plan.PlanOutcome
import stillwater.plan.StopCondition
import stillwater.run.Preset
import java.util.concurrent.TimeUnit
import kotlin.random.Random

/** A decision of the bounded planner on 10 x 10 cells, on maps as they are after 20 to 320 moves of a survey. */
@State(Scope.Thread)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.MICROSECONDS)
open class PlannerBenchmark {
    /** Nodes polled for one plan. */
    @Param("200", "10000")
    var expansions: Int = 0
    private val grid = Grid.unit(10, 10)
    private val maps = ArrayList<FieldMap>()
    private val centers = List(grid.size) { grid.center(it) }
    private val plan = Plan()
    private lateinit var planner: BoundedPlanner

    @Setup
    fun build() {
        for (moves in listOf(20, 40, 80, 160, 320)) {
            val filter = BoundedFilter(grid, Interval.UNIT, Preset.NOISY.settings().boundedFilter)
            Survey(grid, moves).read(filter)
            maps += filter.map
        }
        planner = BoundedPlanner(Random(Survey.SEED), BoundedPlannerSettings(expansions = expansions))
    }

    @Benchmark
    @OperationsPerInvocation(DECISIONS)
    fun decide(): Int {
        var planned = 0
        for (decision in 0 until DECISIONS) {
            val from = centers[decision * STRIDE % centers.size]
            val outcome = planner.plan(maps[decision % maps.size], from, 0.5, StopCondition.NEVER, plan)
            if (outcome == PlanOutcome.Planned) planned++
        }
        return planned
    }

    private companion object {
        const val DECISIONS = 100
        const val STRIDE = 37
    }
}
