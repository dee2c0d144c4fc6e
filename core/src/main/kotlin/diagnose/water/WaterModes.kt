package stillwater.diagnose.water

import stillwater.diagnose.Loops
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.Combination
import stillwater.diagnose.algebra.PivotedCholesky
import stillwater.diagnose.median
import stillwater.diagnose.track.SmoothTrack
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.hypot
import kotlin.math.sqrt

/**
 * The water where nobody knows it: waves of many lengths, the shorter ones as short as the log can tell, and some
 * processes that also change in time.
 *
 * What stays are rings of plane waves ([WaterRings]), each of a variance of its own, which the log tells: so no
 * smoothness is assumed, and a lag that weakens short waves is not told by that. Where the track is a line, they are
 * Gaussian processes of several lengths. Those that change have the covariance exp(-d²/2ℓ² - Δt²/2T²). Rows of one
 * process are F β with β of one variance and F a [PivotedCholesky] factor, which has as many columns as the track needs,
 * wherever it goes.
 *
 * @property track the places that the water is told at. @param most columns at most. @param rings the rings; null where the
 *   track is a line. @param spectrum variance of each ring over the noise's, or over each other's where nothing is known.
 *   @param left variance, in the same measure, that may be left anywhere. @param known variances of the level and of what
 *   changes over the noise's; null where nothing is known.
 */
internal class WaterModes private constructor(
    private val series: MeasuredSeries,
    val track: SmoothTrack,
    private val most: Int,
    private val rings: WaterRings?,
    private val spectrum: DoubleArray,
    left: Double,
    known: DoubleArray?,
) {
    private val isFlat = known == null
    private val n = series.size
    private val extent = hypot(track.x.max() - track.x.min(), track.y.max() - track.y.min())
    private val step =
        median(DoubleArray(n - 1) { hypot(track.x[it + 1] - track.x[it], track.y[it + 1] - track.y[it]) })
    private val found = ArrayList<DoubleArray>()
    private val bandOf = ArrayList<Int>()
    private val ringOf = ArrayList<Int>()

    /** How far behind the fixes the water is that these tell, m. */
    val behind: Double get() = track.behind

    /** Length of the shortest process or wave, m. */
    var finest: Double = extent
        private set

    /** Length of the shortest wave that these show, m. */
    val shortest: Double get() = if (lengths.isEmpty()) WAVE * finest else finest

    /** The shortest wave of each process, m, infinite of those that change in time; empty where none is of waves. */
    var lengths: List<Double> = emptyList()
        private set

    /** Whether columns were too few for the rings: some of their waves are missing, by a tenth of the noise's variance. */
    var isCut: Boolean = false
        private set

    private var gradient: RingGradient? = null

    /** The processes that change in time. */
    val moving: IntRange

    init {
        found += DoubleArray(n) { 1.0 }
        bandOf += 0
        var next = 1
        val isLine = rings == null
        val room = ((if (isLine) LINE_MOVING else MOVING) * most / (TIMES.size * SHARES.size)).toInt()
        for (part in TIMES) {
            for (share in if (isLine) LINE_SHARES else SHARES) {
                add(factor(extent / share, series.duration / part, room), next++)
            }
        }
        moving = 1 until next
        val still = most - found.size
        if (rings == null) {
            finest = shortest((FINEST * still).toInt())
            ladder(still).forEach { add(it, next++) }
        } else {
            val found = rings.columns(spectrum, left, still)
            isCut = !isFlat && found.left > MOST_CUT
            val columns = found.all.groupBy({ it.first }, { it.second }).toSortedMap()
            gradient = found.gradient
            lengths = List(next) { Double.POSITIVE_INFINITY } + columns.keys.map { rings.lengths[it] }
            finest = lengths.last()
            columns.forEach { (ring, own) ->
                add(own, next++)
                ringOf += ring
            }
        }
    }

    /** Water of [most] columns of which nothing is known, on the same track. */
    fun flat(most: Int): WaterModes =
        if (rings == null) flat(series, track, most) else flatRings(series, track, most, rings, STEPS_A_WAVE * step)

    /** Whether rings finer than these were offered, and are not in the water. */
    val isWhole: Boolean
        get() = rings != null && !isFlat && !isCut && size < most &&
            spectrum.indices.any { spectrum[it] > 0 && rings.lengths[it] < finest }

    /** The shortest waves of the rings that are finer than these, m, the longest first; none where the track is a line. */
    val finer: List<Double> get() = rings?.lengths.orEmpty().filter { it < finest }

    /**
     * These, of [most] columns, with rings as strong as [variances] of their processes have been found to be, and with
     * those whose shortest waves are [offered], m, as strong as the noise to begin with.
     */
    fun refined(variances: DoubleArray, most: Int, offered: Set<Double> = emptySet()): WaterModes {
        if (rings == null) return this
        return refined(variances, most, offered, track, rings)
    }

    private fun refined(
        variances: DoubleArray,
        most: Int,
        offered: Set<Double>,
        track: SmoothTrack,
        rings: WaterRings,
    ): WaterModes {
        val own = ringOf.withIndex().associate { (i, ring) -> ring to variances[moving.last + 1 + i] }
        val next = DoubleArray(spectrum.size) { ring ->
            // A ring without columns of its own is as strong as the next one, where nothing is known of it.
            val times = own[ring] ?: if (isFlat) own.minBy { (other, _) -> abs(other - ring) }.value else 1.0
            if (rings.lengths[ring] in offered) 1.0 else minOf(spectrum[ring] * times, MOST)
        }
        // The kernel itself is interpolated.
        val left = maxOf(UNSEEN, LEAST_SHARE * next.sum())
        return WaterModes(series, track, most, rings, next, left, variances.copyOf(moving.last + 1))
    }

    /**
     * These at the end of a rigid arm, [behind] m behind the fixes, as strong as [variances] of their processes have been
     * found to be; null where the track is a line, which the arm never leaves.
     */
    fun onArm(behind: Double, variances: DoubleArray): WaterModes? = at(track.onArm(behind), variances)

    /** The same where the boat was on [moved]; null where its own track is a line. */
    fun at(moved: SmoothTrack, variances: DoubleArray): WaterModes? =
        rings?.let { refined(variances, most, emptySet(), moved, it.at(moved.x, moved.y)) }

    /** Processes of ever longer lengths. The shortest takes what it needs first; those above it need ever fewer. */
    private fun ladder(most: Int): List<List<DoubleArray>> {
        var length = finest
        val ladder = ArrayList<List<DoubleArray>>()
        var free = most
        while (length < extent && free > 0) {
            ladder += factor(length, Double.POSITIVE_INFINITY, free).also { free -= it.size }
            length *= FACTOR
        }
        return ladder.reversed()
    }

    /** The shortest length of which [columns] columns hold all that the track can tell, m. */
    private fun shortest(columns: Int): Double {
        var low = SHORTEST * maxOf(step, 1e-9 * extent)
        var high = maxOf(extent / 2, 2 * low)
        val thin = maxOf(1, n / PivotedCholesky.THINNED)
        if (factor(low, Double.POSITIVE_INFINITY, columns + 1, thin).size <= columns) return low
        repeat(HALVINGS) {
            val middle = sqrt(low * high)
            val isEnough = factor(middle, Double.POSITIVE_INFINITY, columns + 1, thin).size <= columns
            if (isEnough) high = middle else low = middle
        }
        return high
    }

    private fun add(columns: List<DoubleArray>, band: Int) {
        found += columns
        repeat(columns.size) { bandOf += band }
    }

    /** Number of columns. */
    val size: Int get() = found.size

    /** The process of each column; 0 is the level. */
    val band: IntArray = bandOf.toIntArray()

    /** Number of processes. */
    val bands: Int = band.max() + 1

    /** Variances of the processes to begin with, over the noise's. */
    val first: DoubleArray = when {
        rings == null -> DoubleArray(bands) { FIRST_RATIO / size }
        known == null -> DoubleArray(bands) { FIRST_RATIO / bands }
        else -> DoubleArray(bands) { if (it < known.size) known[it] else 1.0 }
    }

    /** Each column along the track at height 1. */
    val columns: Array<DoubleArray> = found.toTypedArray()

    /** The first columns of the pivoted Cholesky factor of the process with [length], m, and [time], s. */
    private fun factor(length: Double, time: Double, most: Int, thin: Int = 1): List<DoubleArray> =
        PivotedCholesky.of((n + thin - 1) / thin, 1.0, ENOUGH, most) { a, b -> alike(a * thin, b * thin, length, time) }
            .columns

    private fun alike(a: Int, b: Int, length: Double, time: Double): Double {
        val dx = (track.x[a] - track.x[b]) / length
        val dy = (track.y[a] - track.y[b]) / length
        val dt = (series.times[a] - series.times[b]) / time
        return exp(-(dx * dx + dy * dy + dt * dt) / 2)
    }

    /** The water along the track with heights [beta], of which the first [size] count. */
    fun along(beta: DoubleArray): DoubleArray {
        val out = DoubleArray(n)
        Combination.add(found, beta, out)
        return out
    }

    /**
     * How what is still of the water with [heights] rises to the east and to the north at each row, sensor units/m; null where
     * the track is a line.
     */
    fun gradient(heights: DoubleArray): Pair<DoubleArray, DoubleArray>? =
        gradient?.of(along(DoubleArray(size) { if (band[it] > moving.last) heights[it] else 0.0 }))

    /** How steep [column], length n, is along the way at each row, its units/m; a boat that stands still goes a usual step. */
    fun steepness(column: DoubleArray): DoubleArray = DoubleArray(n) { i ->
        val from = maxOf(i - 1, 0)
        val to = minOf(i + 1, n - 1)
        (column[to] - column[from]) / maxOf(hypot(track.x[to] - track.x[from], track.y[to] - track.y[from]), step)
    }

    companion object {
        /** The largest variance that waves are given. */
        const val MOST = 1e10

        /**
         * Water of [most] columns of which nothing is known: all rings that so many can show are as strong, down to
         * waves of [shortest] m and of eight steps; found in parts that [loops] goes through.
         */
        fun flat(
            series: MeasuredSeries,
            track: SmoothTrack,
            most: Int,
            shortest: Double = 0.0,
            loops: Loops = Loops.IN_TURN,
        ): WaterModes {
            // A line gone to and fro, as a float's casts: it comes back often, to changed water.
            if (isLine(track)) return WaterModes(series, track, most, null, DoubleArray(0), 0.0, null)
            val step = median(
                DoubleArray(series.size - 1) { hypot(track.x[it + 1] - track.x[it], track.y[it + 1] - track.y[it]) },
            )
            val extent = hypot(track.x.max() - track.x.min(), track.y.max() - track.y.min())
            val least = maxOf(FEWEST_STEPS * step, extent / MOST_WAVES_ACROSS)
            val rings = WaterRings(track.x, track.y, least, loops)
            return flatRings(series, track, most, rings, maxOf(STEPS_A_WAVE * step, shortest))
        }

        /** Whether the way is a line, in whatever direction: as wide as a thousandth of its length. */
        private fun isLine(track: SmoothTrack): Boolean {
            val east = track.x.average()
            val north = track.y.average()
            var xx = 0.0
            var yy = 0.0
            var xy = 0.0
            for (i in track.x.indices) {
                val a = track.x[i] - east
                val b = track.y[i] - north
                xx += a * a
                yy += b * b
                xy += a * b
            }
            val half = hypot((xx - yy) / 2, xy)
            return (xx + yy) / 2 - half < LINE * LINE * ((xx + yy) / 2 + half)
        }

        private fun flatRings(
            series: MeasuredSeries,
            track: SmoothTrack,
            most: Int,
            rings: WaterRings,
            shortest: Double,
        ): WaterModes {
            val room = most - 1 - TIMES.size * SHARES.size * (MOVING * most / (TIMES.size * SHARES.size)).toInt()
            val coarsest = rings.coarsest(room, rings.lengths.count { it >= shortest })
            val spectrum = DoubleArray(rings.size) { if (it < coarsest) 1.0 else 0.0 }
            return WaterModes(series, track, most, rings, spectrum, PivotedCholesky.LEFT * coarsest, null)
        }

        private const val FIRST_RATIO = 1e4

        /** Part of the noise's variance that may be left anywhere, where that is known. */
        private const val UNSEEN = 1e-3
        private const val LEAST_SHARE = 1e-8

        /** The same that is too much. */
        private const val MOST_CUT = 0.1
        private const val FINEST = 0.75
        private const val FACTOR = 2.2

        /** The shortest waves that a process holds, over its length: e⁻⁴ of the longest's power. */
        private const val WAVE = 2.2

        /** Steps from row to row in the shortest wave of a ring that is looked for at once: few lags let shorter ones through. */
        private const val STEPS_A_WAVE = 8.0

        /** The same of any ring. */
        private const val FEWEST_STEPS = 3.0

        /** So many of the shortest waves across the track are more than columns can show, where fixes stand still. */
        private const val MOST_WAVES_ACROSS = 500.0
        private const val SHORTEST = 2.0
        private const val ENOUGH = 1e-4
        private const val MOVING = 0.15
        private const val LINE = 1e-3
        private const val LINE_MOVING = 0.6
        private const val HALVINGS = 6
        private val TIMES = doubleArrayOf(2.0, 8.0).toList()
        private val SHARES = doubleArrayOf(1.5, 5.0).toList()
        private val LINE_SHARES = doubleArrayOf(4.0, 16.0).toList()
    }
}
