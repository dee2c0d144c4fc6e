package stillwater.diagnose.water

import stillwater.diagnose.Loops
import stillwater.diagnose.algebra.Combination
import stillwater.diagnose.algebra.PivotedCholesky
import stillwater.diagnose.algebra.SymmetricEigen
import kotlin.math.PI
import kotlin.math.hypot
import kotlin.math.roundToInt
import kotlin.math.sqrt

/**
 * Still water along a track as a sum of plane waves of all directions, in rings of lengths, each ring of a variance of
 * its own.
 *
 * Waves whose numbers fill a disc of radius k have the covariance 2 J₁(kd)/(kd) between places d apart; a ring is the
 * difference of two discs. Of the sum of all rings a [PivotedCholesky] factor along the track has as many columns as can
 * be told apart, whatever way the track goes: about A k²/4π where it fills an area A, L k/π where it is a line of the
 * length L. The factor is turned so that its columns are in the order of the lengths of their waves; the prior stays of
 * unit variance and uncorrelated.
 *
 * Source: Slepian 1983, Some comments on Fourier analysis, uncertainty and modeling, doi:10.1137/1025078, for how many
 * columns that takes.
 *
 * @param x metres east. @param y metres north. @param least the shortest length allowed, m. @param loops how columns are
 *   gone through. @param extent how far the rings reach, m.
 */
internal class WaterRings(
    private val x: DoubleArray,
    private val y: DoubleArray,
    private val least: Double,
    private val loops: Loops = Loops.IN_TURN,
    private val extent: Double = hypot(x.max() - x.min(), y.max() - y.min()),
) {
    private val n = x.size
    private val kernel = DiscKernel()

    /** The wave numbers that end each ring, 1/m, the longest waves first. */
    private val edges: DoubleArray = run {
        val first = PI / maxOf(extent, least)
        generateSequence(first) { it * FACTOR }.takeWhile { it <= 2 * PI / least || it == first }.toList()
            .toDoubleArray()
    }

    /** The same rings at the places [x], [y]. */
    fun at(x: DoubleArray, y: DoubleArray) = WaterRings(x, y, least, loops, extent)

    /** Number of rings. */
    val size: Int get() = edges.size

    /** The shortest wave of each ring, m. */
    val lengths: List<Double> get() = edges.map { 2 * PI / it }

    /** The first rings, as many as [most] columns can show where all are equally strong; of the first [count] alone. */
    fun coarsest(most: Int, count: Int = size): Int {
        var low = 1
        var high = maxOf(count, 1)
        val thin = maxOf(1, n / PivotedCholesky.THINNED)
        while (low < high) {
            val middle = (low + high + 1) / 2
            val flat = DoubleArray(size) { if (it < middle) 1.0 else 0.0 }
            val factor = factor(flat, PivotedCholesky.LEFT * middle, most + 1, thin)
            if (factor.columns.size > most) high = middle - 1 else low = middle
        }
        return low
    }

    /**
     * Columns along the track and the ring of each in [all], the variance that they leave of some row, [left], and what
     * tells the gradient of their sums.
     */
    class Columns(val all: List<Pair<Int, DoubleArray>>, val left: Double, val gradient: RingGradient)

    /**
     * Columns along the track and the ring of each, the longest waves first.
     *
     * @param spectrum variance of each ring. @param left variance that may be left anywhere.
     * @param most columns at most.
     */
    fun columns(spectrum: DoubleArray, left: Double, most: Int): Columns {
        val factor = factor(spectrum, left, most, 1)
        val turned = SymmetricEigen(order(factor, spectrum), loops)
        val rings = List(factor.pivots.size) { turned.values[it].roundToInt().coerceIn(0, size - 1) }
        val gradient = RingGradient(x, y, factor.pivots, step(spectrum)) { covariance(spectrum, it) }
        return Columns(rings.zip(turned(factor, turned.vectors)).sortedBy { it.first }, factor.left, gradient)
    }

    /** In what order waves are: L⁻¹ (Σ ring · its covariance) L⁻ᵀ has the ring of a wave for its eigenvalue. */
    private fun order(factor: PivotedCholesky, spectrum: DoubleArray): Array<DoubleArray> {
        val lower = lower(factor)
        val order = covariances(factor.pivots, DistanceCurve(step(spectrum)) { ordered(spectrum, it) })
        solve(lower, order)
        transpose(order)
        solve(lower, order)
        for (a in order.indices) for (b in 0 until a) order[b][a] = order[a][b]
        return order
    }

    /** L: the rows of [factor] that were its pivots. */
    private fun lower(factor: PivotedCholesky) = Array(factor.pivots.size) { a ->
        DoubleArray(a + 1) { b -> factor.columns[b][factor.pivots[a]] }
    }

    private fun covariances(places: List<Int>, curve: DistanceCurve) = Array(places.size) { a ->
        DoubleArray(places.size) { b -> curve.at(distance(places[a], places[b])) }
    }

    private fun transpose(rows: Array<DoubleArray>) {
        for (a in rows.indices) for (b in 0 until a) rows[a][b] = rows[b][a].also { rows[b][a] = rows[a][b] }
    }

    /** The columns of [factor] times each of [heights]. */
    private fun turned(factor: PivotedCholesky, heights: Array<DoubleArray>): List<DoubleArray> {
        val r = heights.size
        val out = List(r) { DoubleArray(n) }
        // So many rows of all columns stay in the processor's cache.
        loops.each((n + AT_ONCE - 1) / AT_ONCE) { part ->
            val from = part * AT_ONCE
            for (k in 0 until r) Combination.add(factor.columns, heights[k], out[k], r, from, minOf(from + AT_ONCE, n))
        }
        return out
    }

    /** Replaces [rows] by L⁻¹ of them, with L = [lower]; whole rows are taken off each other. */
    private fun solve(lower: Array<DoubleArray>, rows: Array<DoubleArray>) {
        val r = rows.size
        loops.each(HALVES) { half ->
            for (a in 0 until r) {
                val row = lower[a]
                val own = rows[a]
                Combination.add(
                    rows.asList(),
                    DoubleArray(a) { -row[it] },
                    own,
                    a,
                    half * r / HALVES,
                    (half + 1) * r / HALVES,
                )
                for (i in half * r / HALVES until (half + 1) * r / HALVES) own[i] /= row[a]
            }
        }
    }

    /** The covariance of all rings at a distance of [d] m, each times its variance and its [weight]. */
    private inline fun sum(spectrum: DoubleArray, d: Double, weight: (Int) -> Double): Double {
        var sum = 0.0
        var inside = 0.0
        var a = 0.0
        for (k in edges.indices) {
            val isCounted = spectrum[k] > 0
            // A ring ends where the next one begins.
            val isNeeded = isCounted || (k + 1 < edges.size && spectrum[k + 1] > 0)
            val b = edges[k] * edges[k]
            val disc = if (isNeeded) kernel.at(edges[k] * d) else 0.0
            if (isCounted) {
                sum += weight(k) * if (k == 0) spectrum[0] * disc else spectrum[k] * (b * disc - a * inside) / (b - a)
            }
            inside = disc
            a = b
        }
        return sum
    }

    private fun covariance(spectrum: DoubleArray, d: Double): Double = sum(spectrum, d) { 1.0 }

    private fun ordered(spectrum: DoubleArray, d: Double): Double = sum(spectrum, d) { it.toDouble() }

    /** Between places of a curve: a hundredth of a radian of the shortest wave. */
    private fun step(spectrum: DoubleArray) = FINE / edges[maxOf(spectrum.indexOfLast { it > 0 }, 0)]

    private fun distance(a: Int, b: Int) = sqrt((x[a] - x[b]) * (x[a] - x[b]) + (y[a] - y[b]) * (y[a] - y[b]))

    private fun factor(spectrum: DoubleArray, left: Double, most: Int, thin: Int): PivotedCholesky {
        val variance = spectrum.sum()
        val curve = DistanceCurve(step(spectrum)) { covariance(spectrum, it) }
        // The first column is there however little may be left.
        return PivotedCholesky.of((n + thin - 1) / thin, variance, minOf(left, variance), most, loops) { a, b ->
            curve.at(distance(a * thin, b * thin))
        }
    }

    private companion object {
        const val FACTOR = 1.3
        const val FINE = 0.01
        const val AT_ONCE = 128

        /** Parts of the work that may be done at the same time. */
        const val HALVES = 2
    }
}
