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
    private val site = settings.area?.let { Site(it, settings.grid, settings.plannerSettings.polygonRrt) }
    private val fleets = FleetBuilder(settings, site)

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
            combinations().mapIndexed { index, (planner, boats, filter) ->
                Curve(
                    name,
                    filter,
                    planner,
                    settings.checkpoints,
                    pieces.map { it.errors[index] },
                    boats,
                    pieces.mapNotNull { it.budgets[index] },
                )
            }
        }
        val counted = site?.water?.count { it } ?: settings.grid.size
        val cells = settings.environments.toDouble() * counted
        ExperimentResult(
            settings,
            curves,
            environments.mapValues { (_, pieces) ->
                pieces.sumOf { it.extremes } / cells
            },
            environments.values.flatMap { pieces -> pieces.first().voyages },
        )
    }

    /** What came of all combinations in one environment, one row each, and how many of its cells are local extremes. */
    private class Environment(
        val errors: List<TrialErrors>,
        val budgets: List<BudgetUse?>,
        val extremes: Int,
        val voyages: List<Voyage>,
    )

    private fun combinations() = settings.planners.flatMap { planner ->
        settings.boats.flatMap { boats -> settings.filters.map { Triple(planner, boats, it) } }
    }

    private fun environment(name: String, kind: RandomField, environment: Int): Environment {
        val field = kind.draw(settings.grid, seeds.random("field $name", environment))
        val extremes = LocalExtremes.of(field)
        val errors = ArrayList<TrialErrors>()
        val budgets = ArrayList<BudgetUse?>()
        val voyages = ArrayList<Voyage>()
        for (planner in settings.planners) {
            for (boats in settings.boats) {
                val ofFilter = HashMap<FilterKind, Pair<TrialErrors, BudgetUse?>>()
                for (group in PathGroup.of(planner, settings.filters)) {
                    val order = FleetBuilder.Order(name, environment, planner, group.leader, group.filters, boats)
                    val outcome = fleets.run(order, field, extremes)
                    group.filters.zip(outcome.errors) { filter, error -> ofFilter[filter] = error to outcome.budget }
                    outcome.voyage?.let { voyages += it }
                }
                errors += settings.filters.map { ofFilter.getValue(it).first }
                budgets += settings.filters.map { ofFilter.getValue(it).second }
            }
        }
        val counted = site?.water
        return Environment(
            errors,
            budgets,
            extremes.indices.count { extremes[it] && (counted == null || counted[it]) },
            voyages,
        )
    }
}
