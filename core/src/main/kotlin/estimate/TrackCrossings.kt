package stillwater.estimate

import kotlin.math.abs
import kotlin.math.floor
import kotlin.math.hypot

/**
 * Where a track comes to a place again that it has been to before: crossings of two of its segments or, on a transect,
 * places that a later pass goes through.
 *
 * Crossing k is [shareOne] of the way from reading [one] to the next, and [shareOther] of the way from reading [other]
 * to the next; reading [other] is at least [LEAST_STEPS] median steps later. Segments over gaps, and those of a boat
 * that lies still, count for nothing; nor do two passes in nearly the same direction and at nearly the same speed, which
 * agree there whatever the sensor's delay: of these the number is known alone, [alike].
 *
 * @param series the readings, with positions that grow from fix to fix. Retained.
 */
internal class TrackCrossings(private val series: TrackSeries) {
    private val ones = ArrayList<Int>()
    private val others = ArrayList<Int>()
    private val sharesOfOne = ArrayList<Double>()
    private val sharesOfOther = ArrayList<Double>()

    private val longEnough: Double
    private val reach = maxOf(VELOCITY_TIME, VELOCITY_STEPS * series.medianStep)

    /** Number of places that two passes go through in nearly the same direction and at nearly the same speed. */
    var alike: Int = 0
        private set

    init {
        val lengths = DoubleArray(maxOf(0, series.size - 1)) { length(it) }.apply { sort() }
        val typical = if (lengths.isEmpty()) 0.0 else lengths[lengths.size / 2]
        longEnough = STILL * typical
        when {
            !(typical > 0) -> Unit
            series.ys.all { it == series.ys[0] } -> onALine()
            else -> inThePlane(CELL_STEPS * typical)
        }
    }

    /** Number of crossings. */
    val size: Int get() = ones.size

    /** See the class. */
    fun one(k: Int): Int = ones[k]

    /** See the class. */
    fun other(k: Int): Int = others[k]

    /** See the class. */
    fun shareOne(k: Int): Double = sharesOfOne[k]

    /** See the class. */
    fun shareOther(k: Int): Double = sharesOfOther[k]

    /**
     * Number of different places among the crossings in the plane: a course that is sailed again and again crosses itself in the
     * same few. Places are squares as wide as the boat usually goes while its velocity is taken; on a transect all count.
     */
    val places: Int by lazy {
        if (series.ys.all { it == series.ys[0] }) return@lazy size
        val ways = ones.map { hypot(velocity(it).first, velocity(it).second) * 2 * reach }.sorted()
        val wide = if (ways.isEmpty()) 0.0 else ways[ways.size / 2]
        if (!(wide > 0)) return@lazy size
        fun at(of: DoubleArray, k: Int) = of[ones[k]] + sharesOfOne[k] * (of[ones[k] + 1] - of[ones[k]])
        (0 until size).map { key(at(series.xs, it), at(series.ys, it), wide) }.distinct().size
    }

    private fun length(i: Int) = hypot(series.xs[i + 1] - series.xs[i], series.ys[i + 1] - series.ys[i])

    private fun isSailed(i: Int) =
        series.times[i + 1] - series.times[i] <= series.gapLimit && length(i) > longEnough

    private fun isLater(one: Int, other: Int) =
        series.times[other] - series.times[one] > LEAST_STEPS * series.medianStep

    /** Whether the boat goes through segments [i] and [j] in other directions, or at other speeds, by some rows either way. */
    private fun isUnlike(i: Int, j: Int): Boolean = areUnlike(velocity(i), velocity(j))

    /** Mean velocity about segment [i], m/s: of a single one it is that of the fixes' errors as well. */
    private fun velocity(i: Int): Pair<Double, Double> {
        var from = i
        while (from > 0 && !series.isAfterGap(from) && series.times[i] - series.times[from - 1] <= reach) from--
        var to = i + 1
        val end = series.times[to] + reach
        while (to < series.size - 1 && !series.isAfterGap(to + 1) && series.times[to + 1] <= end) to++
        val time = series.times[to] - series.times[from]
        return (series.xs[to] - series.xs[from]) / time to (series.ys[to] - series.ys[from]) / time
    }

    private fun add(one: Int, shareOne: Double, other: Int, shareOther: Double) {
        ones += one
        others += other
        sharesOfOne += shareOne
        sharesOfOther += shareOther
    }

    /** Each of some readings against the first pass that comes by its place later, and not alike. */
    private fun onALine() {
        val every = maxOf(1, series.size / MOST_ON_A_LINE)
        for (i in 0 until series.size - 1 step every) {
            val x = series.xs[i]
            val size = ones.size
            var isAlike = false
            for (j in i + 1 until minOf(series.size - 1, i + FARTHEST)) {
                if (!isLater(i, j) || !isSailed(j) || (series.xs[j] - x) * (series.xs[j + 1] - x) > 0) continue
                isAlike = !isUnlike(i, j)
                if (isAlike) continue
                add(i, 0.0, j, (x - series.xs[j]) / (series.xs[j + 1] - series.xs[j]))
                break
            }
            if (isAlike && ones.size == size) alike++
        }
    }

    private fun inThePlane(cell: Double) {
        val segments = HashMap<Long, ArrayList<Int>>()
        for (i in 0 until series.size - 1) {
            if (!isSailed(i)) continue
            val from = key(series.xs[i], series.ys[i], cell)
            val to = key(series.xs[i + 1], series.ys[i + 1], cell)
            segments.getOrPut(from) { ArrayList() } += i
            if (to != from) segments.getOrPut(to) { ArrayList() } += i
        }
        val seen = HashSet<Long>()
        for (key in segments.keys.sorted()) {
            val here = segments.getValue(key)
            // A boat that goes round and round in one place crosses its track more often than is of use.
            val every = 1 + here.size / MOST_IN_A_CELL
            for (a in here.indices step every) {
                for (b in a + 1 until here.size step every) cross(here[a], here[b], seen)
            }
        }
    }

    private fun key(x: Double, y: Double, cell: Double): Long =
        (floor(x / cell).toLong() shl HALF_A_LONG) xor (floor(y / cell).toLong() and LOW_HALF)

    private fun cross(i: Int, j: Int, seen: HashSet<Long>) {
        if (!isLater(i + 1, j)) return
        val x1 = series.xs[i + 1] - series.xs[i]
        val y1 = series.ys[i + 1] - series.ys[i]
        val x2 = series.xs[j + 1] - series.xs[j]
        val y2 = series.ys[j + 1] - series.ys[j]
        val cross = x1 * y2 - y1 * x2
        if (abs(cross) < PARALLEL * length(i) * length(j)) return
        val x = series.xs[j] - series.xs[i]
        val y = series.ys[j] - series.ys[i]
        val shareOne = (x * y2 - y * x2) / cross
        val shareOther = (x * y1 - y * x1) / cross
        if (shareOne !in 0.0..1.0 || shareOther !in 0.0..1.0) return
        if (!seen.add((i.toLong() shl HALF_A_LONG) or j.toLong())) return
        if (isUnlike(i, j)) add(i, shareOne, j, shareOther) else alike++
    }

    companion object {
        /** Median steps that lie between two readings of one place at least: fewer are the same pass. */
        const val LEAST_STEPS = 20.0

        /**
         * Two velocities that differ by less than this part of the larger are alike: 20 degrees, or a third of the speed. A lag
         * that is wrong by all of its length moves such passes apart by a third of the way that it moves each.
         */
        private const val UNLIKE = 0.35

        /** Whether velocities [a] and [b], m/s east and north, differ by more than [UNLIKE]. */
        fun areUnlike(a: Pair<Double, Double>, b: Pair<Double, Double>): Boolean {
            val (ax, ay) = a
            val (bx, by) = b
            return hypot(ax - bx, ay - by) > UNLIKE * maxOf(hypot(ax, ay), hypot(bx, by))
        }

        /** Velocities are means over so long either way, s, and so many median steps. */
        private const val VELOCITY_TIME = 5.0
        private const val VELOCITY_STEPS = 5.0
        private const val CELL_STEPS = 2.0
        private const val STILL = 0.1
        private const val PARALLEL = 0.05
        private const val MOST_IN_A_CELL = 200
        private const val MOST_ON_A_LINE = 2000
        private const val FARTHEST = 20_000
        private const val HALF_A_LONG = 32
        private const val LOW_HALF = 0xffffffffL
    }
}
