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
 * @property isOpen whether no land lies between any two places.
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
    private val homeward = Tree(WaterRoutes(area, margin, resolution), closed.known)
    private val around = Tree(homeward.routes.others(), closed)
    private val regardless by lazy(LazyThreadSafetyMode.NONE) { Tree(homeward.routes.others(), NOTHING) }

    init {
        if (!isOpen) {
            require(homeward.complete(home)) {
                "home (${home.x} m, ${home.y} m) must lie on the water, with some of it within reach"
            }
        }
    }

    override fun fill(x: Double, y: Double, plan: Plan) {
        if (isStraight(x, y)) return straight.fill(x, y, plan)
        homeward.complete(home)
        homeward.routes.wayBack(x, y, plan)
        if (plan.size > 0 || closed.knowns == 0) return
        if (isOpen) return straight.fill(x, y, plan)
        if (regardless.complete(home)) regardless.routes.wayBack(x, y, plan)
    }

    /** The ways from [place]; null where none leads away from it. */
    fun from(place: Position): WaterRoutes? = around.routes.takeIf { around.complete(place) }

    /**
     * Works on the ways home and from [place], on those to [most] points: enough of it in a step, and [fill] and [from]
     * find nothing left to do. Answers whether there is none.
     */
    fun prepare(place: Position, most: Int): Boolean {
        val left = homeward.advance(home, most)
        return left > 0 && around.advance(place, left) > 0
    }

    /** The same for the way home from ([x], [y]), m, alone. */
    fun prepareHome(x: Double, y: Double, most: Int): Boolean = isStraight(x, y) || homeward.advance(home, most) > 0

    /** Whether no land is on the straight leg, m. */
    fun isFree(fromX: Double, fromY: Double, toX: Double, toY: Double): Boolean =
        area.isClear(fromX, fromY, toX, toY, 0.0)

    private fun isStraight(x: Double, y: Double) = isOpen && !closed.known.blocks(x, y, home.x, home.y)

    /** Ways from one place, led round [obstacle] as it was when they were begun. */
    private inner class Tree(val routes: WaterRoutes, private val obstacle: Obstacle) {
        private var start: Position? = null
        private var version = NONE
        private var leads = false
        private var isFound = true

        init {
            routes.avoided = obstacle
        }

        /** Finds the ways from [place]. Answers whether any leads away from there. */
        fun complete(place: Position): Boolean {
            advance(place, Int.MAX_VALUE)
            return leads
        }

        /** Finds the ways from [place] to [most] points more; answers how many of [most] were not needed for all. */
        fun advance(place: Position, most: Int): Int {
            val isCurrent = version == closed.version || (obstacle === NOTHING && version != NONE)
            if (place != start || !isCurrent) {
                start = place
                version = closed.version
                leads = routes.begin(place.x, place.y)
                isFound = false
            }
            if (isFound) return most
            val left = most - routes.find(most)
            isFound = left > 0
            return left
        }
    }

    private companion object {
        const val NONE = -1
        val NOTHING = Obstacle { _, _, _, _ -> false }
    }
}
