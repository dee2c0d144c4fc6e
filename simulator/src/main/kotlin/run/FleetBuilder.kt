package stillwater.run

import stillwater.field.CellField
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Position
import stillwater.plan.BudgetedPlanner
import stillwater.plan.CellsHome
import stillwater.plan.Lawnmower
import stillwater.plan.Planner
import stillwater.plan.PolygonRrt
import stillwater.plan.RegionPlanner
import stillwater.plan.StraightHome
import stillwater.plan.WaterHome
import stillwater.plan.WaterPlanner
import stillwater.plan.WayHome
import stillwater.world.Seeds
import kotlin.math.sqrt

/**
 * Builds the boats of each trial of an experiment.
 *
 * The first boat draws from the same streams however many there are; each has a sensor, noise and chance of its own.
 *
 * @param settings what is compared.
 * @param site the water; null where all of the map is.
 */
internal class FleetBuilder(private val settings: ExperimentSettings, private val site: Site?) {
    private val seeds = Seeds(settings.seed)
    private val grid = settings.grid

    /** Which trial is run: [count] boats with [planner] on the map of the first of [filters]. */
    class Order(
        val field: String,
        val environment: Int,
        val planner: PlannerKind,
        val leader: FilterKind,
        val filters: List<FilterKind>,
        val count: Int,
    )

    /** What came of a trial. */
    class Outcome(val errors: List<TrialErrors>, val budget: BudgetUse?, val voyage: Voyage?)

    /** Builds the boats of [order], runs them in [field] and says what came of it. */
    fun run(order: Order, field: CellField, extremes: BooleanArray): Outcome {
        // Round land a move may take longer than from cell to cell: with an area all boats go at a speed.
        val inPlane = order.planner.inPlane || site != null
        val travel = Travel(settings.samplesPerMove, settings.period, if (inPlane) speed() else null)
        val regions = ArrayList<RegionPlanner>()
        val isRecorded = inPlane && order.environment == 0
        val starts = List(order.count) { start(order, it) }
        val odometers = List(order.count) { Odometer() }
        var keeper: TreeKeeper? = null
        val boats = List(order.count) { index ->
            val stream = "${order.field} ${order.planner.label} ${order.leader.label}" + suffix(index)
            var planner = order.planner.planner(
                seeds.random("planner $stream", order.environment),
                settings.plannerSettings,
                settings.area,
                if (inPlane) settings.samplesPerMove else 1,
            )
            if (isRecorded && index == 0 && planner is PolygonRrt) planner = TreeKeeper(planner).also { keeper = it }
            // Boats that mow follow each other round the same tour: none has an area of its own.
            if (order.count > 1 && order.planner != PlannerKind.LAWNMOWER) {
                planner = RegionPlanner(planner, order.planner.inPlane).also { regions += it }
            }
            if (site != null && !order.planner.inPlane) planner = WaterPlanner(planner, site.routes())
            planner = budgeted(planner, starts[index], travel, odometers[index], order.planner)
            val truth = field.truth(grid.cellAt(starts[index]))
            Boat(
                starts[index],
                settings.sensor.build(truth, seeds.random("noise $stream", order.environment)),
                planner,
                order.filters.map {
                    it.estimator(grid, settings.prior, settings.boundedFilter, settings.lagFilters)
                },
                travel,
                odometers[index],
                tellsSpeed = Conditions.SPEED in settings.sensor.conditions,
            )
        }
        val tracks = List(order.count) { ArrayList<Position>() }
        if (isRecorded) boats.forEachIndexed { i, boat -> boat.onSample = { x, y -> tracks[i] += Position(x, y) } }
        val sharing = if (regions.isEmpty()) null else RegionSharing(regions, grid, site?.water)
        val score = MapScore(extremes, site?.water)
        val errors = Fleet(field, boats, order.filters.map { it.fusion }, score, sharing, order.planner.usesMap)
            .run(settings.checkpoints.toIntArray())
        return Outcome(
            errors,
            settings.budget?.let { budget ->
                BudgetUse(
                    odometers.maxOf { budget.kind.used(it) },
                    boats.zip(starts).count { (boat, start) -> boat.x == start.x && boat.y == start.y },
                )
            },
            if (isRecorded) Voyage(order.field, order.planner, tracks, keeper?.tree.orEmpty()) else null,
        )
    }

    /** A cell's length in the time of a move, unless said otherwise. */
    private fun speed() = settings.speed ?: (cellSize() / (settings.samplesPerMove * settings.period))

    private fun cellSize() = sqrt(grid.cellWidth * grid.cellHeight)

    private fun suffix(boat: Int) = if (boat == 0) "" else " boat $boat"

    private fun start(order: Order, boat: Int): Position {
        if (order.planner.startsAtFirstCell) return onWater(grid.center(mowingStart(order.count, boat)))
        val random = seeds.random("start ${order.field}" + suffix(boat), order.environment)
        return if (site == null) grid.center(random.nextInt(grid.size)) else site.starts.random(random)
    }

    /** [place], or where a boat may start that is nearest to it. */
    private fun onWater(place: Position): Position = site?.starts?.minBy { it.distanceTo(place) } ?: place

    /** Evenly spaced among the cells in the order in which the pattern first comes to them. */
    private fun mowingStart(count: Int, boat: Int): Int {
        if (boat == 0) return 0
        val firstVisits = Lawnmower.tour(grid, settings.plannerSettings.pattern).distinct()
        return firstVisits[(boat.toLong() * firstVisits.size / count).toInt()]
    }

    private fun budgeted(
        planner: Planner,
        start: Position,
        travel: Travel,
        odometer: Odometer,
        kind: PlannerKind,
    ): Planner {
        val budget = settings.budget ?: return planner
        return BudgetedPlanner(
            planner,
            budget.limit,
            budget.kind.cost(travel),
            { budget.kind.used(odometer) },
            wayHome(start, kind),
            start,
        )
    }

    private fun wayHome(start: Position, kind: PlannerKind): WayHome = when {
        !kind.inPlane && site == null -> CellsHome(
            grid,
            grid.cellAt(start).also {
                check(it != Grid.OUTSIDE) { "$start off the grid" }
            },
        )
        site == null -> StraightHome(start)
        else -> WaterHome(site.routes(), start)
    }
}
