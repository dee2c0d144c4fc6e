package stillwater.run

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Position
import stillwater.plan.GridPartition
import stillwater.plan.GridRegion
import stillwater.plan.RegionPlanner

/**
 * Divides the map among boats, afresh each time they could have been through their regions once: by then what is left to
 * learn lies elsewhere, and a cell at a border gets other neighbours to be entered from.
 *
 * Regions go to the boats nearest to them. See core/docs/SeveralBoats.md.
 *
 * @property planners one for each boat, in their order. Their regions are set here.
 * @property grid the map's cells.
 * @property water for each cell whether there is anything to do; null for all. Not modified.
 */
class RegionSharing(
    private val planners: List<RegionPlanner>,
    private val grid: Grid,
    private val water: BooleanArray?,
) {
    private val round = maxOf(1, grid.size / planners.size)

    /** Divides the map before [move], the first being 1, where it is due. */
    fun onMove(move: Int, boats: List<Boat>, map: () -> FieldMap) {
        if ((move - 1) % round == 0) divide(map(), boats)
    }

    private fun divide(map: FieldMap, boats: List<Boat>) {
        val weights = DoubleArray(grid.size) { if (water == null || water[it]) worth(map, it) else 0.0 }
        val regions = GridPartition.split(grid, boats.size, weights)
        val pairs = boats.indices.flatMap { boat -> regions.indices.map { boat to it } }
        val taken = HashSet<Int>()
        val served = HashSet<Int>()
        for ((boat, region) in pairs.sortedBy { (boat, region) -> distance(boats[boat], regions[region]) }) {
            if (boat in served || region in taken) continue
            served += boat
            taken += region
            planners[boat].region = regions[region]
        }
    }

    private fun distance(boat: Boat, region: GridRegion): Double {
        val own = region.gridOf(grid)
        val one = own.center(0)
        val other = own.center(own.size - 1)
        return Position((one.x + other.x) / 2, (one.y + other.y) / 2).distanceTo(Position(boat.x, boat.y))
    }

    /** Width of the bounds, less with each visit, and a share of the prior's that every cell keeps: it lies on the way. */
    private fun worth(map: FieldMap, cell: Int): Double {
        val width = map.upper(cell) - map.lower(cell)
        val known = if (width > 0 && width.isFinite()) minOf(width, map.prior.width) else 0.0
        return known / (1 + map.visits(cell)) + LEAST * map.prior.width
    }

    private companion object {
        const val LEAST = 0.05
    }
}
