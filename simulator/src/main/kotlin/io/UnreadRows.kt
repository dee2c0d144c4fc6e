package stillwater.io

import stillwater.model.Conditions

/**
 * Keeps rows that lack the reading alone until the next reading shows that their times are in order: what a sensor has
 * seen there says what it shows later.
 *
 * Those of the same time as a reading, as of a logger that gives each sensor a row, lend it what it lacks. Where times are
 * not in order they are dropped: a row without a reading is no reason to refuse one that has one.
 *
 * @param mayShare whether rows may share one time, which is rounded then. @param take takes a row whose turn has come;
 *   without a reading its value is NaN.
 */
internal class UnreadRows(private val mayShare: Boolean, private val take: (TimedRow) -> Unit) {
    private val waiting = ArrayList<TimedRow>()
    private var last = Double.NEGATIVE_INFINITY

    /** The last row with a reading, until all rows of its time are there. */
    private var held: TimedRow? = null

    /** Keeps [row], whose reading is missing. */
    fun add(row: TimedRow) {
        val reading = held
        if (reading != null && !mayShare && row.seconds == reading.seconds) {
            held = reading.lent(row)
        } else {
            waiting += TimedRow(row.line, row.seconds, row.x, row.y, Double.NaN, row.conditions)
        }
    }

    /** Hands [row], which has a reading, on after those that wait and lie before it. */
    fun read(row: TimedRow) {
        end()
        var own = row
        for (unread in waiting) {
            if (isBetween(unread.seconds, row.seconds)) {
                last = unread.seconds
                take(unread)
            } else if (unread.seconds == row.seconds) {
                own = own.lent(unread)
            }
        }
        waiting.clear()
        last = maxOf(last, row.seconds)
        held = own
    }

    /** Hands on the row that still waits for others of its time, after the last. */
    fun end() {
        held?.let(take)
        held = null
    }

    /** The same row with the conditions of [other] that it has not. */
    private fun TimedRow.lent(other: TimedRow) =
        TimedRow(line, seconds, x, y, value, conditions.completedBy(other.conditions))

    private fun isBetween(seconds: Double, next: Double) =
        (seconds > last && seconds < next) || (mayShare && seconds >= last && seconds <= next)

    companion object {
        /** Why a row may lack the reading, as it is counted. */
        const val MISSING = "missing readings"
        const val CODES = "codes for a missing reading"
        val REASONS = setOf(MISSING, CODES)
    }
}

/** These conditions, and those of [others] that are not among them. */
internal fun Conditions.completedBy(others: Conditions): Conditions {
    val missing = others.names - names
    if (missing.isEmpty()) return this
    return Conditions(names.associateWith { this[it] } + missing.associateWith { others[it] })
}
