package stillwater.plan

import stillwater.model.Plan
import stillwater.model.Position
import stillwater.model.WaterArea

/**
 * Ways through the water that lead round land and round [closed] cells: home, and from any place.
 *
 * Where nothing is in the way, home is gone to straight. The way home does not rely on cells that are open again only
 * because time has passed; where they cut home off, it leads through them. Confined to one thread.
 *
 * @param area the water.
 * @param margin smallest distance of a way from land, m, where there is any.
 * @param resolution of the lattice that finds ways, m; see [WaterRoutes].
 * @property isOpen whether no land lies between any two places, so that a lattice is laid only when a cell is closed.
 * @param closed cells. Retained.
 * @throws IllegalArgumentException if no way leads away from [home] and the water is not open.
 */
internal class DetourWays(
    private val area: WaterArea,
    private val margin: Double,
    private val resolution: Double,
    val isOpen: Boolean,
    private val closed: ClosedCells,
    private val home: Position,
) : WayHome {
    private val straight = StraightHome(home)
    private var laid: WaterRoutes? = null

    /** Where the ways start, what they lead round, and whether any leads away from there. */
    private var start: Position? = null
    private var round: Obstacle? = null
    private var version = NONE
    private var leads = false

    init {
        if (!isOpen) {
            require(begin(home, closed.known)) {
                "home (${home.x} m, ${home.y} m) must lie on the water, with some of it within reach"
            }
        }
    }

    override fun fill(x: Double, y: Double, plan: Plan) {
        if (isOpen && !closed.known.blocks(x, y, home.x, home.y)) return straight.fill(x, y, plan)
        begin(home, closed.known)
        val routes = routes()
        routes.wayBack(x, y, plan)
        if (plan.size > 0 || closed.knowns == 0) return
        if (isOpen) return straight.fill(x, y, plan)
        if (begin(home, NOTHING)) routes.wayBack(x, y, plan)
    }

    /** The ways from [place]; null where none leads away from it. */
    fun from(place: Position): WaterRoutes? = routes().takeIf { begin(place, closed) }

    /** Whether no land is on the straight leg, m. */
    fun isFree(fromX: Double, fromY: Double, toX: Double, toY: Double): Boolean =
        area.isClear(fromX, fromY, toX, toY, 0.0)

    private fun begin(place: Position, obstacle: Obstacle): Boolean {
        if (place == start && obstacle === round && version == closed.version) return leads
        val routes = routes()
        routes.avoided = obstacle
        start = place
        round = obstacle
        version = closed.version
        leads = routes.start(place.x, place.y)
        return leads
    }

    private fun routes() = laid ?: WaterRoutes(area, margin, resolution).also { laid = it }

    private companion object {
        const val NONE = -1
        val NOTHING = Obstacle { _, _, _, _ -> false }
    }
}
