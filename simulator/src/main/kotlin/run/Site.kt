package stillwater.run

import stillwater.model.Grid
import stillwater.model.Position
import stillwater.model.WaterArea
import stillwater.plan.PolygonRrtSettings
import stillwater.plan.WaterRoutes
import kotlin.math.sqrt

/**
 * The water of a real place with a grid laid over it.
 *
 * @property area the water.
 * @property grid the cells.
 * @property settings margin and resolution of the ways through the water.
 * @throws IllegalArgumentException if no cell's centre is on the water, or no way leads anywhere.
 */
class Site(val area: WaterArea, val grid: Grid, private val settings: PolygonRrtSettings) {
    /** For each cell whether its centre is on the water: the others do not count. */
    val water: BooleanArray = BooleanArray(grid.size) { area.contains(grid.centerX(it), grid.centerY(it)) }

    /** Places where a boat may start: lattice points of the largest water that hangs together. */
    val starts: List<Position>

    init {
        require(
            water.any {
                it
            },
        ) { "no centre of the ${grid.columns} x ${grid.rows} cells is on the water; take more cells" }
        starts = largestWater(routes())
        require(starts.isNotEmpty()) {
            "no water is left ${settings.margin} m away from land; take a smaller margin or a finer resolution"
        }
    }

    /** Ways through the water, to be started anywhere. */
    fun routes(): WaterRoutes =
        WaterRoutes(area, settings.margin, settings.resolution ?: (sqrt(grid.cellWidth * grid.cellHeight) / 2))

    private fun largestWater(routes: WaterRoutes): List<Position> {
        val labels = IntArray(routes.points)
        val sizes = ArrayList<Int>()
        for (point in 0 until routes.points) {
            val isNew = labels[point] == 0 && area.isClear(routes.x(point), routes.y(point), settings.margin)
            if (!isNew || !routes.start(routes.x(point), routes.y(point))) continue
            val reached = (0 until routes.points).filter { routes.distance(it).isFinite() }
            sizes += reached.size
            for (other in reached) labels[other] = sizes.size
        }
        if (sizes.isEmpty()) return emptyList()
        val largest = 1 + sizes.indices.maxBy { sizes[it] }
        return (0 until routes.points).filter { labels[it] == largest }.map { Position(routes.x(it), routes.y(it)) }
            .filter { grid.cellAt(it) != Grid.OUTSIDE }
    }
}
