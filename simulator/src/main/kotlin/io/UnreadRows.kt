package stillwater.io

/**
 * Keeps rows that lack the reading alone until the next reading shows that their times are in order: what a sensor has
 * seen there says what it shows later.
 *
 * Where they are not they are dropped: a row without a reading is no reason to refuse one that has one.
 *
 * @param mayShare whether rows may share one time, which is rounded then. @param take takes a row whose turn has come;
 *   without a reading its value is NaN.
 */
internal class UnreadRows(private val mayShare: Boolean, private val take: (TimedRow) -> Unit) {
    private val waiting = ArrayList<TimedRow>()
    private var last = Double.NEGATIVE_INFINITY

    /** Keeps [row], whose reading is missing. */
    fun add(row: TimedRow) {
        waiting += TimedRow(row.line, row.seconds, row.x, row.y, Double.NaN, row.conditions)
    }

    /** Hands [row], which has a reading, on after those that wait and lie before it. */
    fun read(row: TimedRow) {
        for (unread in waiting) {
            if (isBetween(unread.seconds, row.seconds)) {
                last = unread.seconds
                take(unread)
            }
        }
        waiting.clear()
        last = maxOf(last, row.seconds)
        take(row)
    }

    private fun isBetween(seconds: Double, next: Double) =
        (seconds > last && seconds < next) || (mayShare && seconds >= last && seconds <= next)

    companion object {
        /** Why a row may lack the reading, as it is counted. */
        const val MISSING = "missing readings"
        const val CODES = "codes for a missing reading"
        val REASONS = setOf(MISSING, CODES)
    }
}
