package stillwater.io

/**
 * Gives rows whose times were cut to whole units times that grow smoothly: the shortest path of time over rows that is
 * nowhere before a row's own time nor a unit or more after it, a taut string (Davies & Kovac 2001, Annals of Statistics
 * 29; found by the funnel of Lee & Preparata 1984, Networks 14). Rows at a constant rate come out at a constant rate.
 *
 * A string needs ends: it begins where the straight line that reaches farthest does, and goes on at the end as straight
 * as it can. Confined to one thread; keeps no more than [MOST] rows.
 *
 * @param unit what times were cut to, s. @param use takes the rows in order, each with the time it is given.
 */
internal class RestoredTimes(private val unit: Double, private val use: (TimedRow) -> Unit) {
    /** The first row, as long as its time is open. */
    private var first: TimedRow? = null
    private var zero = Double.NaN

    /** Where the string may begin, s after [zero]. */
    private var earliest = 0.0
    private var latest = unit * INSIDE

    /** Time of the last knot, s after [zero], and the slope to it, s a row. */
    private var knot = (earliest + latest) / 2
    private var slope = Double.NaN

    /** Rows after the last knot. */
    private val waiting = ArrayList<TimedRow>()
    private val funnel = Funnel()
    private var last = Double.NEGATIVE_INFINITY

    /** Takes the next row, not before the last one. */
    fun take(row: TimedRow) {
        if (zero.isNaN()) {
            zero = row.seconds
            first = row
        } else {
            waiting += row
            narrow()
        }
    }

    /** Hands on the rows that still wait, after the last. */
    fun end() = if (waiting.isEmpty()) handFirst() else emit(waiting.size, funnel.onwards(slope))

    /** Narrows the funnel by the last row; where it closes, the string begins elsewhere or has its next knot. */
    private fun narrow() {
        var i = waiting.size
        while (i <= waiting.size) {
            val low = waiting[i - 1].seconds - zero
            // Short of the next unit, which is another row's.
            if (funnel.take(i, low - knot, low + unit * INSIDE - knot)) {
                if (i++ < MOST) continue
                emit(MOST, funnel.onwards(slope))
            } else if (first == null || !begunElsewhere()) {
                emit(funnel.corner, funnel.slope)
            }
            i = 1
        }
    }

    /** Halves where the string may begin: a later start has lines that are less steep. False where that is known. */
    private fun begunElsewhere(): Boolean {
        if (funnel.isTooSteep) earliest = knot else latest = knot
        if (latest - earliest < unit * NEAR) return false
        knot = (earliest + latest) / 2
        funnel.open()
        return true
    }

    /** Hands on the first [count] rows that wait, [slope] s a row from the knot, and ties the next one. */
    private fun emit(count: Int, slope: Double) {
        handFirst()
        for (i in 1..count) hand(waiting[i - 1], knot + slope * i)
        knot += slope * count
        this.slope = slope
        waiting.subList(0, count).clear()
        funnel.open()
    }

    private fun handFirst() {
        first?.let { hand(it, knot) }
        first = null
    }

    private fun hand(row: TimedRow, time: Double) {
        // Times since 1970 have a resolution, below which two may be one.
        last = maxOf((zero + time).coerceIn(row.seconds, row.seconds + unit), Math.nextUp(last))
        use(row.at(last))
    }

    /** The slopes, s a row, of straight lines from the knot that agree with all rows so far. */
    private class Funnel {
        private var least = Double.NEGATIVE_INFINITY
        private var largest = Double.POSITIVE_INFINITY
        private var ofLeast = 0
        private var ofLargest = 0

        /** Where it has closed: the row of the next knot, and the slope to it. */
        var corner = 0
            private set
        var slope = 0.0
            private set

        /** Whether it closed because the lines left were too steep for a row. */
        var isTooSteep = false
            private set

        /** Takes the row [i] after the knot, [low] to [high] s after it; false where no straight line reaches it. */
        fun take(i: Int, low: Double, high: Double): Boolean {
            isTooSteep = high / i < least
            if (isTooSteep || low / i > largest) {
                corner = if (isTooSteep) ofLeast else ofLargest
                slope = if (isTooSteep) least else largest
                return false
            }
            if (low / i >= least) {
                least = low / i
                ofLeast = i
            }
            if (high / i <= largest) {
                largest = high / i
                ofLargest = i
            }
            return true
        }

        /** The slope in it that is nearest to the one [before]; without one the middle of those that go up. */
        fun onwards(before: Double): Double =
            if (before.isNaN()) (maxOf(least, 0.0) + largest) / 2 else before.coerceIn(least, largest)

        fun open() {
            least = Double.NEGATIVE_INFINITY
            largest = Double.POSITIVE_INFINITY
        }
    }

    private companion object {
        /** So many rows of one straight line are enough to know it, and as many are kept. */
        const val MOST = 4096
        const val INSIDE = 1 - 1e-6

        /** Part of a unit to which the beginning is sought. */
        const val NEAR = 1e-9
    }
}
