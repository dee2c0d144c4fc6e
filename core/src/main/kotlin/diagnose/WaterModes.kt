package stillwater.diagnose

import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.ln
import kotlin.math.sin

/**
 * The water where nobody knows it: a sum of waves that stand in a box about the track, and of waves that change slowly
 * in time, with unknown heights.
 *
 * u(x, y, t) = Σ β cos(π j x/a) cos(π k y/b) cos(π l t/c). Heights are normal, of one variance in each band of wave
 * numbers, which the log tells: so no smoothness is assumed, and a lag that weakens short waves is not told by that.
 * A wave that has the same height everywhere at a time (j = k = 0, l > 0) is left out: it is a drift, not the water's.
 *
 * Source of the waves: Solin and Särkkä 2020, Hilbert space methods for reduced-rank Gaussian process regression,
 * doi:10.1007/s11222-019-09886-w. Differs: bands of free variance in place of a covariance function.
 *
 * @param most waves at most.
 */
internal class WaterModes(private val series: MeasuredSeries, private val track: SmoothTrack, most: Int) {
    private class Wave(val j: Int, val k: Int, val l: Int, val order: Double)

    private class Side(of: DoubleArray, margin: Double) {
        val from = of.min()
        val reach = of.max() - of.min()
        val length = maxOf(reach * (1 + 2 * margin), 1e-9)

        fun angle(at: Double) = PI * (at - from + (length - reach) / 2) / length
    }

    private val n = series.size
    private val east = Side(track.x, MARGIN)
    private val north = Side(track.y, MARGIN)
    private val clock = Side(series.times, 0.0)
    private val isFlat = minOf(east.reach, north.reach) < 1e-3 * maxOf(east.reach, north.reach)
    private val waves = waves(most)

    /** Number of waves. */
    val size: Int get() = waves.size

    /** Band of each wave; 0 is the level. */
    val band: IntArray = bands()

    /** Number of bands. */
    val bands: Int = (band.maxOrNull() ?: 0) + 1

    /** Each wave along the track at height 1. */
    val columns: Array<DoubleArray> = columns()

    /** Half the length of the shortest wave that does not change in time, m. */
    val finest: Double = waves.filter { it.l == 0 && it.order > 0 }.maxOfOrNull { it.order }?.let { 1 / it } ?: 0.0

    private fun waves(most: Int): List<Wave> {
        val still = ((if (isFlat) FLAT_STILL else STILL) * most).toInt()
        val longest = maxOf(east.length, north.length)
        // A line's waves need not be shorter than twice the way between rows.
        val steps = 2 * still
        val all = ArrayList<Wave>()
        val ends = if (isFlat) steps else maxOf(2, kotlin.math.sqrt(8.0 * still * longest * longest /
            (east.length * north.length)).toInt())
        fun order(j: Int, k: Int) = hypot(j / east.length, k / north.length)
        val many = ends.coerceAtMost(steps)
        for (j in 0..many) for (k in 0..many) {
            if (isFlat && (if (east.reach >= north.reach) k else j) > 0) continue
            if (order(j, k) * longest <= many) all += Wave(j, k, 0, order(j, k))
        }
        all.sortBy { it.order }
        val chosen = all.take(still)
        val usual = chosen[minOf(chosen.size - 1, if (isFlat) USUAL_FLAT else USUAL)].order
        val times = if (isFlat) MOST_TIMES_FLAT else MOST_TIMES
        val moving = chosen.drop(1).flatMap { wave ->
            (1..times).map { l -> Wave(wave.j, wave.k, l, hypot(wave.order / usual, l.toDouble() * 2 / times)) }
        }.sortedBy { it.order }.take(most - still)
        return chosen + moving
    }

    private fun bands(): IntArray {
        var still = 0
        var moving = 0
        val highest = BAND_RATE * ln(waves.count { it.l == 0 }.toDouble().coerceAtLeast(1.0))
        return IntArray(size) { i ->
            if (waves[i].l == 0) {
                if (i == 0) 0 else 1 + (BAND_RATE * ln((++still).toDouble())).toInt()
            } else {
                2 + highest.toInt() + (ln((++moving).toDouble())).toInt()
            }
        }
    }

    private fun cosines(count: Int, side: Side, at: DoubleArray) =
        Array(count + 1) { j -> DoubleArray(n) { cos(j * side.angle(at[it])) } }

    private fun columns(): Array<DoubleArray> {
        val xs = cosines(waves.maxOf { it.j }, east, track.x)
        val ys = cosines(waves.maxOf { it.k }, north, track.y)
        val ts = cosines(waves.maxOf { it.l }, clock, series.times)
        return Array(size) { i ->
            val wave = waves[i]
            DoubleArray(n) { xs[wave.j][it] * ys[wave.k][it] * ts[wave.l][it] }
        }
    }

    /** The water along the track with heights [beta], length [size]. */
    fun along(beta: DoubleArray): DoubleArray {
        val out = DoubleArray(n)
        for (k in 0 until size) {
            val column = columns[k]
            val height = beta[k]
            for (i in 0 until n) out[i] += height * column[i]
        }
        return out
    }

    /** How steep the water with heights [beta] is at each row, whatever the direction, sensor units/m. */
    fun steepness(beta: DoubleArray): DoubleArray {
        val dx = DoubleArray(n)
        val dy = DoubleArray(n)
        val xs = cosines(waves.maxOf { it.j }, east, track.x)
        val ys = cosines(waves.maxOf { it.k }, north, track.y)
        val xSines = Array(xs.size) { j -> DoubleArray(n) { sin(j * east.angle(track.x[it])) } }
        val ySines = Array(ys.size) { k -> DoubleArray(n) { sin(k * north.angle(track.y[it])) } }
        for (m in 0 until size) {
            val wave = waves[m]
            if (wave.l > 0) continue
            val a = beta[m] * wave.j * PI / east.length
            val b = beta[m] * wave.k * PI / north.length
            for (i in 0 until n) {
                dx[i] -= a * xSines[wave.j][i] * ys[wave.k][i]
                dy[i] -= b * xs[wave.j][i] * ySines[wave.k][i]
            }
        }
        return DoubleArray(n) { hypot(dx[it], dy[it]) }
    }

    private companion object {
        const val MARGIN = 0.12
        const val STILL = 0.8
        const val FLAT_STILL = 0.4
        const val USUAL = 30
        const val USUAL_FLAT = 15
        const val MOST_TIMES = 4
        const val MOST_TIMES_FLAT = 16
        const val BAND_RATE = 1.3
    }
}
