package stillwater.run

import stillwater.estimate.MapFusion
import stillwater.field.CellField
import stillwater.field.FieldMap
import stillwater.model.Position
import stillwater.plan.RegionPlanner

/**
 * Any number of boats in one field that share one map: they all make a move, then the next.
 *
 * Each has estimators of its own, one of every kind under comparison; what they know is fused into one map a kind, which
 * is what is planned on and judged. A single boat's map is taken as it is.
 *
 * @property field the truth.
 * @property boats at least one; all with as many estimators, of the same kinds in the same order.
 * @property fusions how maps are fused, for each kind of estimator.
 * @property score how maps are judged.
 * @property sharing how the area is divided; null where every boat has all of it.
 */
class Fleet(
    private val field: CellField,
    private val boats: List<Boat>,
    private val fusions: List<MapFusion>,
    private val score: MapScore,
    private val sharing: RegionSharing? = null,
) {
    private val kinds = boats.first().estimators.indices
    private val maps = kinds.map { kind -> Array(boats.size) { boats[it].estimators[kind].map } }
    private val shared = kinds.map { kind ->
        val first = maps[kind][0]
        if (boats.size == 1) first else FieldMap(first.grid, first.prior)
    }

    /**
     * Runs the boats. The planners plan on the shared map of the first kind of estimator.
     *
     * @param checkpoints moves after which the error is taken, ascending, each at least 1; the run ends with the last.
     * @return the errors of each kind of estimator, in their order.
     */
    fun run(checkpoints: IntArray): List<TrialErrors> {
        val errors = kinds.map { TrialErrors(checkpoints.size) }
        val map = { map(0) }
        var checkpoint = 0
        for (move in 1..checkpoints.last()) {
            sharing?.onMove(move, boats, map)
            for (boat in boats) if (!boat.isDone) boat.move(field, map)
            if (move == checkpoints[checkpoint]) {
                for (kind in kinds) score.take(map(kind), field, errors[kind], checkpoint)
                checkpoint++
            }
        }
        return errors
    }

    private fun map(kind: Int): FieldMap {
        if (boats.size > 1) fusions[kind].fuse(maps[kind], shared[kind])
        return shared[kind]
    }
}

/**
 * Divides the map among boats afresh each time they could have been through their regions once: by then what is left to
 * learn lies elsewhere.
 *
 * @property planners one for each boat, in their order. Their regions are set here.
 * @property water for each cell whether there is anything to do; null for all. Not modified.
 */
class RegionSharing(private val planners: List<RegionPlanner>, private val water: BooleanArray?) {
    /** Divides the map before [move] where it is due. */
    fun onMove(move: Int, boats: List<Boat>, map: () -> FieldMap) {
        val now = if (move == 1) map() else null
        val grid = now?.grid
        if (grid != null) round = maxOf(1, grid.size / boats.size)
        if ((move - 1) % round == 0) divide(now ?: map(), boats)
    }

    private var round = 1

    private fun divide(map: FieldMap, boats: List<Boat>) {
        val weights = DoubleArray(map.grid.size) { cell ->
            if (water == null || water[cell]) worth(map, cell) else 0.0
        }
        val regions = stillwater.plan.GridPartition.split(map.grid, boats.size, weights).toMutableList()
        val waiting = boats.indices.toMutableList()
        // The nearest pair of boat and region first.
        while (waiting.isNotEmpty()) {
            val (boat, region) = waiting.flatMap { boat -> regions.map { boat to it } }.minBy { (boat, region) ->
                val middle = region.gridOf(map.grid).let { it.corners(0)[0] to it.corners(it.size - 1)[2] }
                val centre = Position(
                    (middle.first.x + middle.second.x) / 2,
                    (middle.first.y + middle.second.y) / 2,
                )
                centre.distanceTo(Position(boats[boat].x, boats[boat].y))
            }
            planners[boat].region = region
            waiting -= boat
            regions -= region
        }
    }

    /** Width of the bounds, and a share of the prior's that every cell keeps: it has to be passed all the same. */
    private fun worth(map: FieldMap, cell: Int): Double {
        val width = map.upper(cell) - map.lower(cell)
        val known = if (width > 0 && width.isFinite()) minOf(width, map.prior.width) else 0.0
        return known / (1 + map.visits(cell)) + LEAST * map.prior.width
    }

    private companion object {
        const val LEAST = 0.05
    }
}
