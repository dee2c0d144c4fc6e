package stillwater.plan

import stillwater.model.Plan
import stillwater.model.WaterArea
import kotlin.math.ceil
import kotlin.math.hypot
import kotlin.math.sqrt

/**
 * Ways through the water from one place to all others, none nearer to land than a margin.
 *
 * A lattice of points [resolution] apart is laid over the water; a point joins its eight neighbours where the leg
 * between them is clear. Dijkstra's algorithm finds the shortest way along it from the place given to [start]; ways are
 * then straightened wherever a clear leg joins two of their points. So a way is found through every passage that holds
 * a clear stretch of lattice, which every straight one wider than 2 · [margin] + 2 · [resolution] does, and is longer
 * than the shortest by no more than what eight directions and the lattice cost: 8 % and a few [resolution]s. Confined
 * to one thread; nothing but the constructor allocates.
 *
 * Source: Dijkstra 1959, doi:10.1007/BF01386390.
 *
 * @property area the water.
 * @property margin smallest distance of a way from land and keep-outs, m, at least 0.
 * @property resolution distance of the lattice's points, m, above 0.
 * @throws IllegalArgumentException if a number is out of its range, or the lattice would have more than [MAX_POINTS].
 */
public class WaterRoutes(public val area: WaterArea, public val margin: Double, public val resolution: Double) {
    private val lattice: RouteLattice

    /** For each point and each of [STEPS] whether the leg there is clear, one bit each. */
    private val ways: ByteArray
    private val clear: BooleanArray
    private val distances: DoubleArray
    private val parents: IntArray
    private val queue: PointQueue
    private var startX = Double.NaN
    private var startY = Double.NaN
    private val scratch = Plan()

    /** What ways lead round besides land, from the next [start] on. */
    internal var avoided: Obstacle? = null

    init {
        require(margin >= 0 && margin.isFinite()) { "margin ($margin m) must be at least 0 and finite" }
        require(resolution > 0 && resolution.isFinite()) { "resolution ($resolution m) must be above 0 and finite" }
        lattice = RouteLattice(area, resolution)
        clear = BooleanArray(lattice.size) { area.isClear(x(it), y(it), margin) }
        ways = ByteArray(lattice.size)
        distances = DoubleArray(lattice.size)
        parents = IntArray(lattice.size)
        queue = PointQueue(distances)
        for (point in clear.indices) if (clear[point]) join(point)
    }

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

    private fun join(point: Int) {
        val column = point % lattice.columns
        val row = point / lattice.columns
        // Far from land every neighbour is clear too.
        val isOpen = area.distanceToOutline(x(point), y(point)) > margin + SQRT_2 * resolution * (1 + ROUNDING)
        var bits = 0
        for (step in 0 until STEPS) {
            val toColumn = column + COLUMN_STEPS[step]
            val toRow = row + ROW_STEPS[step]
            if (toColumn !in 0 until lattice.columns || toRow !in 0 until lattice.rows) continue
            val to = toRow * lattice.columns + toColumn
            if (isOpen ||
                (clear[to] && area.isClear(x(point), y(point), x(to), y(to), margin))
            ) {
                bits = bits or (1 shl step)
            }
        }
        ways[point] = bits.toByte()
    }

    /**
     * Finds the ways from the place ([x], [y]), local frame, m.
     *
     * A place on the water but nearer to land than [margin] is joined to the lattice by legs that stay on the water.
     *
     * @return whether any point can be reached from there.
     */
    public fun start(x: Double, y: Double): Boolean {
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
        if (queue.isEmpty) return false
        while (!queue.isEmpty) expand(queue.poll())
        return true
    }

    private fun expand(point: Int) {
        for (step in 0 until STEPS) {
            if (ways[point].toInt() shr step and 1 == 0) continue
            val to = point + ROW_STEPS[step] * lattice.columns + COLUMN_STEPS[step]
            if (isAvoided(x(point), y(point), x(to), y(to))) continue
            val length = distances[point] + resolution * (if (step < EDGE_STEPS) 1.0 else SQRT_2)
            if (length < distances[to]) {
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
        private const val STEPS = 8
        private const val EDGE_STEPS = 4
        private const val ROUNDING = 1e-9
        private val SQRT_2 = sqrt(2.0)
        private val COLUMN_STEPS = intArrayOf(-1, 1, 0, 0, -1, -1, 1, 1)
        private val ROW_STEPS = intArrayOf(0, 0, -1, 1, -1, 1, -1, 1)
    }
}

/** Where the points of a lattice over [area] are, [resolution] m apart. */
private class RouteLattice(area: WaterArea, private val resolution: Double) {
    val columns: Int
    val rows: Int
    private val westmost: Double
    private val southmost: Double

    init {
        val wide = ceil((area.east - area.west) / resolution)
        val high = ceil((area.north - area.south) / resolution)
        require(wide * high <= WaterRoutes.MAX_POINTS) {
            "a resolution of $resolution m makes ${wide.toLong()} x ${high.toLong()} points; " +
                "${WaterRoutes.MAX_POINTS} are allowed"
        }
        columns = maxOf(1, wide.toInt())
        rows = maxOf(1, high.toInt())
        westmost = (area.west + area.east - (columns - 1) * resolution) / 2
        southmost = (area.south + area.north - (rows - 1) * resolution) / 2
    }

    val size get() = columns * rows

    fun x(point: Int) = westmost + point % columns * resolution

    fun y(point: Int) = southmost + point / columns * resolution

    /** Calls [use] with the points within two steps of the lattice, or with the [margin]'s more. */
    inline fun forNear(x: Double, y: Double, margin: Double, use: (Int) -> Unit) {
        if (!x.isFinite() || !y.isFinite()) return
        val reach = NEAR + ceil(margin / resolution).toInt()
        val column = Math.round((x - westmost) / resolution).coerceIn(0L, columns - 1L).toInt()
        val row = Math.round((y - southmost) / resolution).coerceIn(0L, rows - 1L).toInt()
        for (r in maxOf(0, row - reach)..minOf(rows - 1, row + reach)) {
            for (c in maxOf(0, column - reach)..minOf(columns - 1, column + reach)) use(r * columns + c)
        }
    }

    companion object {
        const val NEAR = 2

        fun points(area: WaterArea, resolution: Double): Double =
            ceil((area.east - area.west) / resolution) * ceil((area.north - area.south) / resolution)
    }
}

/** The points that wait in Dijkstra's algorithm, the nearest first; [distances] is shared with it. */
private class PointQueue(private val distances: DoubleArray) {
    private val heap = IntArray(distances.size)
    private val places = IntArray(distances.size) { NOT_IN }
    private var size = 0

    val isEmpty: Boolean get() = size == 0

    fun clear() {
        for (i in 0 until size) places[heap[i]] = NOT_IN
        size = 0
    }

    /** Adds [point], or moves it forward where its distance has become less. */
    fun push(point: Int) {
        var place = places[point]
        if (place == NOT_IN) place = size++
        while (place > 0) {
            val above = (place - 1) / 2
            if (distances[heap[above]] <= distances[point]) break
            put(place, heap[above])
            place = above
        }
        put(place, point)
    }

    fun poll(): Int {
        val first = heap[0]
        places[first] = NOT_IN
        val moved = heap[--size]
        if (size == 0) return first
        var place = 0
        while (true) {
            var child = 2 * place + 1
            if (child >= size) break
            if (child + 1 < size && distances[heap[child + 1]] < distances[heap[child]]) child++
            if (distances[heap[child]] >= distances[moved]) break
            put(place, heap[child])
            place = child
        }
        put(place, moved)
        return first
    }

    private fun put(place: Int, point: Int) {
        heap[place] = point
        places[point] = place
    }

    private companion object {
        const val NOT_IN = -1
    }
}
