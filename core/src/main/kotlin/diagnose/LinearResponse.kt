package stillwater.diagnose

import kotlin.math.exp
import kotlin.math.expm1

/**
 * What a sensor whose parts are linear in the truth shows of many truths along one log, four of them at a time.
 *
 * Each part makes of a column a sum of two neighbouring rows, of the bends of the spline through it there and of its
 * own row before. These factors depend on the sensor and the log's times alone, so that they are found once.
 *
 * @param spline through the log's times. @param delay how late and where the truth is seen; null for at once.
 * @param path the lag. @param slow a second path and its share of the reading; null for none.
 * @param second a lag behind the first; null for none.
 */
internal class LinearResponse(
    private val spline: Spline,
    private val delay: NeighbourSums?,
    private val path: NeighbourSums,
    private val slow: Pair<NeighbourSums, Double>?,
    private val second: NeighbourSums?,
) {
    /** Working space of one thread. */
    private inner class Work {
        val bends = Array(AT_ONCE) { DoubleArray(spline.size) }
        val late = Array(AT_ONCE) { DoubleArray(spline.size) }
        val other = Array(AT_ONCE) { DoubleArray(spline.size) }
        val spare = DoubleArray(spline.size)
    }

    /**
     * Writes what is shown of each of [truths], length n, into the first of [shown]. Whenever some are there, [then] is
     * told the first of them and the one behind the last, so that they are done with while they are in the cache.
     */
    fun of(
        truths: Array<DoubleArray>,
        loops: Loops,
        shown: List<DoubleArray>,
        then: (Int, Int) -> Unit = { _, _ -> },
    ) {
        val groups = (truths.size + AT_ONCE - 1) / AT_ONCE
        loops.each(PARTS) { part ->
            val work = Work()
            for (group in part until groups step PARTS) {
                val from = group * AT_ONCE
                // Where columns are no multiple of four the last is done more than once, for nobody.
                val own = Array(AT_ONCE) { truths[minOf(from + it, truths.size - 1)] }
                show(own, Array(AT_ONCE) { if (from + it < truths.size) shown[from + it] else work.spare }, work)
                then(from, minOf(from + AT_ONCE, truths.size))
            }
        }
    }

    private fun show(truths: Array<DoubleArray>, out: Array<DoubleArray>, work: Work) {
        var seen = truths
        bend(seen, work, delay, path, slow?.first)
        if (delay != null) {
            delay.of(seen, work.bends, work.late)
            seen = work.late
            bend(seen, work, path, slow?.first)
        }
        path.of(seen, work.bends, out)
        if (slow != null) {
            val (own, share) = slow
            own.of(seen, work.bends, work.other)
            for (k in 0 until AT_ONCE) mix(out[k], work.other[k], share)
        }
        if (second != null) {
            for (k in 0 until AT_ONCE) out[k].copyInto(work.late[k])
            bend(work.late, work, second)
            second.of(work.late, work.bends, out)
        }
    }

    private fun bend(columns: Array<DoubleArray>, work: Work, vararg users: NeighbourSums?) {
        if (users.any { it != null && it.isBent }) spline.bends(columns, work.bends)
    }

    private fun mix(out: DoubleArray, other: DoubleArray, share: Double) {
        for (i in out.indices) out[i] += share * (other[i] - out[i])
    }

    companion object {
        /** Columns that are gone through together: each waits for its own row before. */
        const val AT_ONCE = 4

        /** Parts of the work that may be done at the same time. */
        private const val PARTS = 4
    }
}

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

    /** Row [i] is what a lag of [tau] s shows of an input that is held over the step before it. */
    fun hold(i: Int, tau: Double) {
        val fade = exp(-(times[i] - times[i - 1]) / tau)
        put(i, i - 1, 0.0, 1 - fade, 0.0, 0.0, fade)
    }

    /** The same of an input that is the spline; see [Spline.follower]. */
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
