package stillwater.run

import kotlinx.coroutines.Dispatchers
import kotlinx.coroutines.ExperimentalCoroutinesApi
import kotlinx.coroutines.async
import kotlinx.coroutines.awaitAll
import kotlinx.coroutines.coroutineScope
import stillwater.world.RandomField
import stillwater.world.Seeds

/**
 * Runs a comparison of filters and planners in many random fields.
 *
 * All combinations meet the same fields, so their errors are paired. A planner that plans on a map plans on the bounds
 * of the filter under comparison, and on a bounded filter's where that gives none.
 *
 * @property settings what is compared.
 */
class Experiment(val settings: ExperimentSettings) {
    private val seeds = Seeds(settings.seed)

    /** Pieces of work that [run] does and reports: environments of every field. */
    val size: Int get() = settings.fields.size * settings.environments

    /**
     * Runs every combination in every environment.
     *
     * @param threads environments that run at once, at least 1. The result does not depend on it.
     * @param onDone called from any thread after each of the [size] pieces of work.
     */
    @OptIn(ExperimentalCoroutinesApi::class)
    suspend fun run(threads: Int, onDone: () -> Unit = {}): ExperimentResult = coroutineScope {
        val dispatcher = Dispatchers.Default.limitedParallelism(threads)
        val work = settings.fields.map { (name, field) ->
            name to List(settings.environments) { environment ->
                async(dispatcher) { environment(name, field, environment).also { onDone() } }
            }
        }
        val environments = work.associate { (name, pieces) -> name to pieces.awaitAll() }
        val curves = environments.flatMap { (name, pieces) ->
            combinations().mapIndexed { index, (planner, filter) ->
                Curve(name, filter, planner, settings.checkpoints, pieces.map { it.errors[index] })
            }
        }
        val cells = settings.environments.toDouble() * settings.grid.size
        ExperimentResult(
            settings,
            curves,
            environments.mapValues { (_, pieces) ->
                pieces.sumOf { it.extremes } / cells
            },
        )
    }

    /** Errors of all combinations in one environment, one row each, and how many of its cells are local extremes. */
    private class Environment(val errors: List<TrialErrors>, val extremes: Int)

    private fun combinations() = settings.planners.flatMap { planner -> settings.filters.map { planner to it } }

    private fun environment(name: String, kind: RandomField, environment: Int): Environment {
        val field = kind.draw(settings.grid, seeds.random("field $name", environment))
        val extremes = LocalExtremes.of(field)
        val checkpoints = settings.checkpoints.toIntArray()
        val rows = settings.planners.flatMap { planner ->
            val start = if (planner.startsAtFirstCell) 0 else startCell(name, environment)
            val errors = HashMap<FilterKind, TrialErrors>()
            for (group in pathGroups(planner)) {
                val stream = "$name ${planner.label} ${group.leader.label}"
                val trial = Trial(
                    field = field,
                    sensor = settings.sensor.build(field.truth(start), seeds.random("noise $stream", environment)),
                    planner = planner.planner(seeds.random("planner $stream", environment), settings.plannerSettings),
                    estimators = group.filters.map {
                        it.estimator(settings.grid, settings.prior, settings.boundedFilter, settings.lagFilters)
                    },
                    samplesPerMove = settings.samplesPerMove,
                    period = settings.period,
                    extremes = extremes,
                )
                group.filters.zip(trial.run(start, checkpoints)).toMap(errors)
            }
            settings.filters.map { errors.getValue(it) }
        }
        return Environment(rows, extremes.count { it })
    }

    private fun startCell(name: String, environment: Int) =
        seeds.random("start $name", environment).nextInt(settings.grid.size)

    /** Filters that share a path, drawn from the stream of [leader]; a planner plans on the map of the first. */
    private class PathGroup(val leader: FilterKind, val filters: List<FilterKind>)

    private fun pathGroups(planner: PlannerKind): List<PathGroup> {
        if (!planner.usesMap) return listOf(PathGroup(FilterKind.BOUNDED, settings.filters))
        val (bounding, others) = settings.filters.partition { it.givesBounds }
        val alone = (bounding - FilterKind.BOUNDED).map { PathGroup(it, listOf(it)) }
        if (others.isEmpty() && FilterKind.BOUNDED !in bounding) return alone
        return listOf(PathGroup(FilterKind.BOUNDED, listOf(FilterKind.BOUNDED) + others)) + alone
    }
}
