package stillwater.diagnose.response

import stillwater.diagnose.algebra.Spline
import kotlin.math.exp
import kotlin.math.expm1

/**
 * Rows as sums: of the input at rows j and j + 1, of the bends there, and of the output's row before.
 *
 * @property isBent whether bends count.
 */
internal class NeighbourSums(private val times: DoubleArray, val isBent: Boolean) {
    private val n = times.size
    private val place = IntArray(n)
    private val factors = DoubleArray(n * FACTORS)

    private fun put(i: Int, j: Int, here: Double, next: Double, bend: Double, nextBend: Double, fade: Double = 0.0) {
        place[i] = j
        factors[i * FACTORS] = here
        factors[i * FACTORS + 1] = next
        factors[i * FACTORS + 2] = bend
        factors[i * FACTORS + 3] = nextBend
        factors[i * FACTORS + 4] = fade
    }

    /** Row [i] is the input at [time], in the step after row [j]. */
    fun read(i: Int, j: Int, time: Double) {
        if (time <= times[0]) return put(i, 0, 1.0, 0.0, 0.0, 0.0)
        if (time >= times[n - 1]) return put(i, n - 2, 0.0, 1.0, 0.0, 0.0)
        val h = times[j + 1] - times[j]
        val b = (time - times[j]) / h
        val a = 1 - b
        put(i, j, a, b, (a * a * a - a) * h * h / 6, (b * b * b - b) * h * h / 6)
    }

    /** Row [i] is the input there. */
    fun same(i: Int) = if (i == 0) put(0, 0, 1.0, 0.0, 0.0, 0.0) else put(i, i - 1, 0.0, 1.0, 0.0, 0.0)

    /**
     * Row [i] is what a lag of [tau] s shows of an input that is held over the step before it: the share [earlier] of the
     * row before, the rest of that row.
     */
    fun hold(i: Int, tau: Double, earlier: Double) {
        val fade = exp(-(times[i] - times[i - 1]) / tau)
        put(i, i - 1, earlier * (1 - fade), (1 - earlier) * (1 - fade), 0.0, 0.0, fade)
    }

    /** Row [i] is what a lag of [tau] s shows of an input that is the spline; see [Spline.follower]. */
    fun follow(i: Int, tau: Double) {
        val h = times[i] - times[i - 1]
        val faded = -expm1(-h / tau)
        val fade = 1 - faded
        // u − τ u' + τ² u'' − τ³ u''' at the step's ends, as sums of both rows and both bends.
        val slope = faded * tau / h
        val third = slope * tau * tau
        val here = slope - fade
        val next = 1 - slope
        val bend = third - fade * tau * tau - tau * h * (1 + 2 * fade) / 6
        val nextBend = tau * tau - third - tau * h * (2 + fade) / 6
        put(i, i - 1, here, next, bend, nextBend, fade)
    }

    /** Goes through four columns [input] with the [bends] of their splines, into [out]. */
    fun of(input: Array<DoubleArray>, bends: Array<DoubleArray>, out: Array<DoubleArray>) {
        for (k in 0 until LinearResponse.AT_ONCE step 2) {
            pair(input[k], input[k + 1], bends[k], bends[k + 1], out[k], out[k + 1])
        }
    }

    private fun pair(
        one: DoubleArray,
        two: DoubleArray,
        bend: DoubleArray,
        bendTwo: DoubleArray,
        out: DoubleArray,
        outTwo: DoubleArray,
    ) {
        var last = 0.0
        var lastTwo = 0.0
        for (i in 0 until n) {
            val j = place[i]
            val at = i * FACTORS
            val p = factors[at]
            val q = factors[at + 1]
            val r = factors[at + 2]
            val s = factors[at + 3]
            val fade = factors[at + 4]
            last = p * one[j] + q * one[j + 1] + r * bend[j] + s * bend[j + 1] + fade * last
            lastTwo = p * two[j] + q * two[j + 1] + r * bendTwo[j] + s * bendTwo[j + 1] + fade * lastTwo
            out[i] = last
            outTwo[i] = lastTwo
        }
    }

    private companion object {
        const val FACTORS = 5
    }
}
