package stillwater.run

import kotlinx.coroutines.Dispatchers
import kotlinx.coroutines.ExperimentalCoroutinesApi
import kotlinx.coroutines.async
import kotlinx.coroutines.awaitAll
import kotlinx.coroutines.coroutineScope
import stillwater.estimate.FieldEstimator
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.plan.Planner
import stillwater.sensor.SensorSpec
import stillwater.world.RandomField
import stillwater.world.Seeds
import kotlin.random.Random

/**
 * A way to estimate the field, by name.
 *
 * @property name what the command line and results call it.
 * @property givesBounds whether its map has bounds that a planner can plan on.
 * @property create a fresh estimator over a grid with a prior.
 */
class FilterKind(
    val name: String,
    val givesBounds: Boolean,
    val create: (Grid, Interval) -> FieldEstimator,
)

/**
 * A way to choose where to go, by name.
 *
 * @property name what the command line and results call it.
 * @property usesMap whether what it plans depends on the map, so that every filter with bounds has a path of its own.
 * @property startsAtFirstCell whether it starts in cell 0 instead of a random one.
 * @property create a fresh planner that draws from the random stream.
 */
class PlannerKind(
    val name: String,
    val usesMap: Boolean,
    val startsAtFirstCell: Boolean,
    val create: (Random) -> Planner,
)

/**
 * A comparison of filters and planners in many random fields.
 *
 * @property fields kinds of field by name, in the order of the results.
 * @property filters estimators under comparison.
 * @property planners planners under comparison.
 * @property planningFilter what a planner that uses the map plans on when the filter under comparison gives no bounds.
 * @property sensor the boat's sensor.
 * @property grid cells of every field.
 * @property prior range of a cell before it is measured, sensor units.
 * @property environments number of fields of each kind, at least 1.
 * @property checkpoints moves at which the error is taken, ascending.
 * @property samplesPerMove readings in a cell, at least 1.
 * @property period time between readings, s.
 * @property seed where all chance comes from.
 */
class Experiment(
    val fields: Map<String, RandomField>,
    val filters: List<FilterKind>,
    val planners: List<PlannerKind>,
    private val planningFilter: FilterKind,
    val sensor: SensorSpec,
    val grid: Grid,
    val prior: Interval,
    val environments: Int,
    val checkpoints: IntArray,
    val samplesPerMove: Int,
    val period: Double,
    val seed: Long,
) {
    init {
        require(environments >= 1) { "environments ($environments) must be at least 1" }
        require(samplesPerMove >= 1) { "samplesPerMove ($samplesPerMove) must be at least 1" }
        require(period > 0 && period.isFinite()) { "period ($period s) must be above 0 and finite" }
        require(checkpoints.isNotEmpty() && checkpoints.first() >= 1) { "checkpoints must start at move 1 or later" }
        require(checkpoints.toList().zipWithNext().all { (a, b) -> a < b }) { "checkpoints must ascend" }
    }

    private val seeds = Seeds(seed)

    /** Pieces of work that [run] does and reports: fields of every kind. */
    val size: Int get() = fields.size * environments

    /**
     * Runs every combination in every environment. All combinations meet the same fields, so their errors are paired.
     *
     * @param threads environments that run at once, at least 1. The result does not depend on it.
     * @param onDone called from any thread after each of the [size] pieces of work.
     */
    @OptIn(ExperimentalCoroutinesApi::class)
    suspend fun run(threads: Int, onDone: () -> Unit = {}): ExperimentResult = coroutineScope {
        val dispatcher = Dispatchers.Default.limitedParallelism(threads)
        val curves = fields.flatMap { (fieldName, field) ->
            val errors = List(environments) { environment ->
                async(dispatcher) { environment(fieldName, field, environment).also { onDone() } }
            }.awaitAll()
            combinations().mapIndexed { index, (planner, filter) ->
                Curve(fieldName, filter.name, planner.name, List(environments) { errors[it][index] })
            }
        }
        ExperimentResult(curves, sensor.name, checkpoints.toList(), environments)
    }

    private fun combinations() = planners.flatMap { planner -> filters.map { planner to it } }

    /** Errors of all [combinations] in one environment, one row each. */
    private fun environment(fieldName: String, kind: RandomField, environment: Int): List<DoubleArray> {
        val field = kind.draw(grid, seeds.random("field-$fieldName", environment))
        return planners.flatMap { planner ->
            val errors = HashMap<FilterKind, DoubleArray>()
            for (group in pathGroups(planner)) {
                val start = if (planner.startsAtFirstCell) 0 else startCell(fieldName, environment)
                val noise = seeds.random("noise-$fieldName-${planner.name}", environment)
                val estimators = group.map { it.create(grid, prior) }
                val trial = Trial(
                    field = field,
                    sensor = sensor.build(field.truth(start), noise),
                    planner = planner.create(seeds.random("planner-$fieldName-${planner.name}", environment)),
                    estimators = estimators,
                    samplesPerMove = samplesPerMove,
                    period = period,
                )
                val rows = trial.run(start, checkpoints)
                group.forEachIndexed { i, filter -> errors[filter] = rows[i] }
            }
            filters.map { errors.getValue(it) }
        }
    }

    private fun startCell(fieldName: String, environment: Int) =
        seeds.random("start-$fieldName", environment).nextInt(grid.size)

    /** Filters that can share a path of [planner], the one whose map is planned on first. */
    private fun pathGroups(planner: PlannerKind): List<List<FilterKind>> {
        if (!planner.usesMap) return listOf(filters)
        val (bounding, others) = filters.partition { it.givesBounds }
        val own = bounding.filter { it.name != planningFilter.name }.map { listOf(it) }
        val shared = filters.filter { it.name == planningFilter.name } + others
        if (shared.isEmpty()) return own
        val planned = if (shared.first().name == planningFilter.name) shared else listOf(planningFilter) + shared
        return own + listOf(planned)
    }
}
