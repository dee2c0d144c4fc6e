package stillwater.diagnose.algebra

/**
 * The natural cubic spline through a column: what a smooth truth was between the rows.
 *
 * Source: Press et al. 2007, Numerical Recipes, section 3.3. Confined to one thread; fitting is O(n), no allocation.
 *
 * @param times knots, s, ascending, length n. Retained, not modified. @param isBroken whether the curve is straight in
 * the step before a row and bends anew on both sides of it, length n; null where it is nowhere. Retained, not modified.
 */
internal class Spline(private val times: DoubleArray, private val isBroken: BooleanArray? = null) {
    private val n = times.size

    /** Number of knots. */
    val size: Int get() = n
    private val bend = DoubleArray(n)
    private val work = DoubleArray(n)
    private var column = work

    // Of each step: the third derivative, the slope at its begin, value, slope and bend at its end; empty until needed.
    private var third = work.copyOf(0)
    private var slope = third
    private var endValue = third
    private var endSlope = third
    private var endBend = third

    // What of the elimination depends on the knots alone.
    private val back = DoubleArray(n)
    private val forth = DoubleArray(n)
    private val slopes = DoubleArray(n)
    private val changes = DoubleArray(n)

    init {
        for (i in 1 until n) slopes[i] = 1 / (times[i] - times[i - 1])
        for (i in 1 until n - 1) {
            if (isBroken != null && (isBroken[i] || isBroken[i + 1])) continue
            val left = times[i] - times[i - 1]
            val both = times[i + 1] - times[i - 1]
            val share = left / both
            val pivot = share * back[i - 1] + 2
            back[i] = (share - 1) / pivot
            forth[i] = share / pivot
            changes[i] = 6 / (both * pivot)
        }
    }

    /** Goes through [values], length n. Retained, not modified. */
    fun fit(values: DoubleArray) {
        column = values
        for (i in 1 until n - 1) {
            val change = (values[i + 1] - values[i]) * slopes[i + 1] - (values[i] - values[i - 1]) * slopes[i]
            work[i] = changes[i] * change - forth[i] * work[i - 1]
        }
        if (n > 0) bend[n - 1] = 0.0
        for (i in n - 2 downTo 1) bend[i] = back[i] * bend[i + 1] + work[i]
        if (n > 0) bend[0] = 0.0
    }

    /** [fit], and what [early] and [late] need. */
    fun fitForLags(values: DoubleArray) {
        fit(values)
        if (third.size < n) {
            third = DoubleArray(n)
            slope = DoubleArray(n)
            endValue = DoubleArray(n)
            endSlope = DoubleArray(n)
            endBend = DoubleArray(n)
        }
        for (i in 0 until n - 1) {
            val h = times[i + 1] - times[i]
            val bent = (bend[i + 1] - bend[i]) / h
            val rise = (values[i + 1] - values[i]) / h - h * (2 * bend[i] + bend[i + 1]) / 6
            third[i] = bent
            slope[i] = rise
            endValue[i] = values[i] + h * (rise + h * (bend[i] / 2 + bent * h / 6))
            endSlope[i] = rise + h * (bend[i] + bent * h / 2)
            endBend[i] = bend[i] + bent * h
        }
    }

    /** [follower] at the begin of the step after row [i], after [fitForLags]. */
    fun early(i: Int, tau: Double): Double = column[i] - tau * (slope[i] - tau * (bend[i] - tau * third[i]))

    /** [follower] at the end of the step after row [i], after [fitForLags]. */
    fun late(i: Int, tau: Double): Double = endValue[i] - tau * (endSlope[i] - tau * (endBend[i] - tau * third[i]))

    /**
     * Second derivatives at the knots of the curves through [columns], of which there is an even number, into [out],
     * two at a time: each waits for its own row before. What [fit] has found stays.
     */
    fun bends(columns: Array<DoubleArray>, out: Array<DoubleArray>) {
        for (k in columns.indices step 2) bends(columns[k], columns[k + 1], out[k], out[k + 1])
    }

    private fun bends(one: DoubleArray, two: DoubleArray, out: DoubleArray, outTwo: DoubleArray) {
        out[0] = 0.0
        outTwo[0] = 0.0
        out[n - 1] = 0.0
        outTwo[n - 1] = 0.0
        var last = 0.0
        var lastTwo = 0.0
        for (i in 1 until n - 1) {
            val before = slopes[i]
            val after = slopes[i + 1]
            val change = (one[i + 1] - one[i]) * after - (one[i] - one[i - 1]) * before
            val changeTwo = (two[i + 1] - two[i]) * after - (two[i] - two[i - 1]) * before
            last = changes[i] * change - forth[i] * last
            lastTwo = changes[i] * changeTwo - forth[i] * lastTwo
            out[i] = last
            outTwo[i] = lastTwo
        }
        last = 0.0
        lastTwo = 0.0
        for (i in n - 2 downTo 1) {
            last = back[i] * last + out[i]
            lastTwo = back[i] * lastTwo + outTwo[i]
            out[i] = last
            outTwo[i] = lastTwo
        }
    }

    /** The value at [time] in the step after row [i]; beyond the first and last row theirs. */
    fun at(i: Int, time: Double): Double {
        if (time <= times[0]) return column[0]
        if (time >= times[n - 1]) return column[n - 1]
        val h = times[i + 1] - times[i]
        val b = (time - times[i]) / h
        val a = 1 - b
        return a * column[i] + b * column[i + 1] +
            ((a * a * a - a) * bend[i] + (b * b * b - b) * bend[i + 1]) * h * h / 6
    }

    /**
     * u − τ u' + τ² u'' − τ³ u''' at [after] s into the step after row [i]: the response to the spline of a lag with
     * time constant [tau] once its past has faded.
     */
    fun follower(i: Int, after: Double, tau: Double): Double {
        val h = times[i + 1] - times[i]
        val third = (bend[i + 1] - bend[i]) / h
        val second = bend[i] + third * after
        val slope = (column[i + 1] - column[i]) / h - h * (2 * bend[i] + bend[i + 1]) / 6
        val first = slope + after * (bend[i] + third * after / 2)
        val value = column[i] + after * (slope + after * (bend[i] / 2 + third * after / 6))
        return value - tau * (first - tau * (second - tau * third))
    }
}
