package stillwater.plan

import stillwater.model.Plan
import stillwater.model.WaterArea
import kotlin.math.hypot

/**
 * Ways through the water from one place to all others, none nearer to land than a margin.
 *
 * A lattice of points [resolution] apart is laid over the water; a point joins its eight neighbours where the leg
 * between them is clear. Dijkstra's algorithm finds the shortest way along it from the place given to [start]; ways are
 * then straightened wherever a clear leg joins two of their points. So a way is found through every passage that holds
 * a clear stretch of lattice, which every straight one wider than 2 · [margin] + 2 · [resolution] does, and is longer
 * than the shortest by no more than what eight directions and the lattice cost: 8 % and a few [resolution]s. Confined
 * to one thread; nothing but the constructors allocates.
 *
 * Source: Dijkstra 1959, doi:10.1007/BF01386390.
 */
public class WaterRoutes private constructor(private val graph: RouteGraph) {
    private val lattice = graph.lattice
    private val clear = graph.clear
    private val distances = DoubleArray(lattice.size)
    private val parents = IntArray(lattice.size)
    private val queue = PointQueue(distances)
    private var startX = Double.NaN
    private var startY = Double.NaN
    private val scratch = Plan()

    /**
     * Lays the lattice.
     *
     * @param area the water.
     * @param margin smallest distance of a way from land and keep-outs, m, at least 0.
     * @param resolution distance of the lattice's points, m, above 0.
     * @throws IllegalArgumentException if a number is out of its range, or the lattice would have more than
     *   [MAX_POINTS].
     */
    public constructor(area: WaterArea, margin: Double, resolution: Double) : this(RouteGraph(area, margin, resolution))

    /** The water. */
    public val area: WaterArea get() = graph.area

    /** Smallest distance of a way from land and keep-outs, m. */
    public val margin: Double get() = graph.margin

    /** Distance of the lattice's points, m. */
    public val resolution: Double get() = graph.resolution

    /** What ways lead round besides land, from the next [start] on. */
    internal var avoided: Obstacle? = null

    /** Other ways over the same lattice, which is not laid again. */
    internal fun others(): WaterRoutes = WaterRoutes(graph)

    /** Number of points of the lattice. */
    public val points: Int get() = clear.size

    /** Metres east of [point], 0 until [points]. */
    public fun x(point: Int): Double = lattice.x(point)

    /** Metres north of [point], 0 until [points]. */
    public fun y(point: Int): Double = lattice.y(point)

    /** Length of the way from [start]'s place to [point], m; infinite where there is none. */
    public fun distance(point: Int): Double = distances[point]

    /** Whether [point] lies on the water and farther than the margin from land. */
    internal fun isClear(point: Int): Boolean = clear[point]

    /**
     * Finds the ways from the place ([x], [y]), local frame, m.
     *
     * A place on the water but nearer to land than [margin] is joined to the lattice by legs that stay on the water.
     *
     * @return whether any point can be reached from there.
     */
    public fun start(x: Double, y: Double): Boolean = begin(x, y).also { find(Int.MAX_VALUE) }

    /** Begins to find the ways from a place as [start] does, and answers as it does; [find] goes on. */
    internal fun begin(x: Double, y: Double): Boolean {
        startX = x
        startY = y
        distances.fill(Double.POSITIVE_INFINITY)
        queue.clear()
        // What leads out of the margin may be nearer to land than the margin, and nothing else.
        val kept = if (area.isClear(x, y, margin)) margin else 0.0
        forNear(x, y) { point ->
            if (area.isClear(x, y, x(point), y(point), kept) && !isAvoided(x, y, x(point), y(point))) {
                distances[point] = hypot(x(point) - x, y(point) - y)
                parents[point] = START
                queue.push(point)
            }
        }
        return !queue.isEmpty
    }

    /** Finds the ways to [most] points more at most. Answers to how many: fewer than [most] where all are found. */
    internal fun find(most: Int): Int {
        var count = 0
        while (count < most && !queue.isEmpty) {
            expand(queue.poll())
            count++
        }
        return count
    }

    private fun expand(point: Int) {
        val isBeset = avoided?.isNear(x(point), y(point), RouteGraph.SQRT_2 * resolution) ?: false
        graph.forJoined(point) { to, leg ->
            val length = distances[point] + leg
            if (length < distances[to] && !(isBeset && isAvoided(x(point), y(point), x(to), y(to)))) {
                distances[to] = length
                parents[to] = point
                queue.push(to)
            }
        }
    }

    /** Fills [plan] with the way from [start]'s place to [point], that place not included; empty where there is none. */
    public fun wayTo(point: Int, plan: Plan) {
        plan.clear()
        if (distances[point] == Double.POSITIVE_INFINITY) return
        gather(point)
        // Gathered backwards, from the point to the start.
        straighten(plan, scratch.size - 1, -1, startX, startY)
    }

    /**
     * Fills [plan] with the way from ([x], [y]) to [start]'s place, its end included; empty where there is none.
     *
     * A place nearer to land than [margin] is left by a leg that stays on the water.
     */
    public fun wayBack(x: Double, y: Double, plan: Plan) {
        plan.clear()
        if (isLeg(x, y, startX, startY)) {
            plan.add(startX, startY)
            return
        }
        var best = START
        var least = Double.POSITIVE_INFINITY
        val kept = if (area.isClear(x, y, margin)) margin else 0.0
        forNear(x, y) { point ->
            val length = distances[point] + hypot(x(point) - x, y(point) - y)
            if (length < least && area.isClear(x, y, x(point), y(point), kept) &&
                !isAvoided(x, y, x(point), y(point))
            ) {
                least = length
                best = point
            }
        }
        if (best == START) return
        gather(best)
        scratch.add(startX, startY)
        straighten(plan, 0, 1, x, y)
    }

    /** The points from [point] to the start's nearest, into [scratch]. */
    private fun gather(point: Int) {
        scratch.clear()
        var at = point
        while (at != START) {
            scratch.add(x(at), y(at))
            at = parents[at]
        }
    }

    /** From [first] of [scratch] on, forwards or backwards by [step]; each point that clear legs make needless is left out. */
    private fun straighten(plan: Plan, first: Int, step: Int, fromX: Double, fromY: Double) {
        var x = fromX
        var y = fromY
        var place = first
        while (place + step in 0 until scratch.size) {
            val next = place + step
            if (!isLeg(x, y, scratch.x(next), scratch.y(next))) {
                x = scratch.x(place)
                y = scratch.y(place)
                plan.add(x, y)
            }
            place = next
        }
        plan.add(scratch.x(place), scratch.y(place))
    }

    private fun isLeg(fromX: Double, fromY: Double, toX: Double, toY: Double) =
        area.isClear(fromX, fromY, toX, toY, margin) && !isAvoided(fromX, fromY, toX, toY)

    private fun isAvoided(fromX: Double, fromY: Double, toX: Double, toY: Double) =
        avoided?.blocks(fromX, fromY, toX, toY) ?: false

    /** Calls [use] with the clear points within two steps of the lattice, or with the margin's more. */
    private inline fun forNear(x: Double, y: Double, use: (Int) -> Unit) {
        lattice.forNear(x, y, margin) { point -> if (clear[point]) use(point) }
    }

    public companion object {
        /** The most points a lattice may have. */
        public const val MAX_POINTS: Int = 250_000

        /**
         * The least distance of a lattice's points over [area], m, that is at least [wanted] m and needs no more points
         * than [most]. Passages narrower than some two of it may not be found.
         */
        public fun resolution(area: WaterArea, wanted: Double, most: Int = MAX_POINTS): Double {
            var resolution = wanted
            while (RouteLattice.points(area, resolution) > most) resolution *= COARSER
            return resolution
        }

        /** Whether [start] would find a way from ([x], [y]), without a lattice having to be laid. */
        public fun leadsFrom(area: WaterArea, margin: Double, resolution: Double, x: Double, y: Double): Boolean {
            val lattice = RouteLattice(area, resolution)
            val kept = if (area.isClear(x, y, margin)) margin else 0.0
            var leads = false
            lattice.forNear(x, y, margin) { point ->
                leads = leads ||
                    (
                        area.isClear(lattice.x(point), lattice.y(point), margin) &&
                            area.isClear(x, y, lattice.x(point), lattice.y(point), kept)
                        )
            }
            return leads
        }

        private const val START = -1
        private const val COARSER = 1.05
    }
}
