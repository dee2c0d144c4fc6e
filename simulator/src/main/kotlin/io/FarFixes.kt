package stillwater.io

import kotlin.math.hypot

/**
 * Leaves out fixes far off, farther than any boat goes between rows: such from which the log is back where it was after
 * [MOST] rows at the most, and as few at its beginning or end beside [SETTLED] others. One wild fix would set the size of
 * the whole map. A log that goes on elsewhere stays as it is.
 *
 * @param use takes the other rows, in the order in which they come, each once it is known that it stays.
 */
internal class FarFixes(private val use: (TimedRow) -> Unit) {
    /** The log's first rows, as long as they may be wild; null once they are not. */
    private var start: ArrayList<TimedRow>? = ArrayList()

    /** The last row that stays, and how many have come since the last jump. */
    private var before: TimedRow? = null
    private var settled = 0

    /** Rows after a jump of which it is not known whether they stay. */
    private val pending = ArrayList<TimedRow>()
    private var first: String? = null

    /** Rows left out so far. */
    var count = 0L
        private set

    /** What to say of them; null where there are none. */
    val note: String?
        get() = first?.let { it + (if (count > firstCount) ", the first of $count such rows" else "") + ": left out" }
    private var firstCount = 0L

    /** Takes the next row, which has a fix. */
    fun take(row: TimedRow) {
        val last = before
        if (pending.isEmpty()) {
            if (last == null || !isFar(last, row)) accept(row) else pending += row
        } else if (isFar(pending.last(), row) && isBack(checkNotNull(last), row)) {
            leaveOut(pending, last, if (pending.size == 1) "the rows before and after it" else "the rows beside them")
            pending.clear()
            accept(row)
        } else {
            pending += row
            if (start != null) {
                decideStart()
            } else if (pending.size > MOST) {
                release()
            }
        }
    }

    /** Whether [row] is where the log was before what is pending, of which there is no more than was there. */
    private fun isBack(last: TimedRow, row: TimedRow) =
        pending.size <= minOf(MOST, settled) && apart(last, row) < apart(last, pending[0]) / BACK

    /** Once enough rows are near each other: whether those before them are wild. */
    private fun decideStart() {
        val jump = (1 until pending.size).lastOrNull { isFar(pending[it - 1], pending[it]) } ?: 0
        if (pending.size - jump >= SETTLED) {
            val wild = checkNotNull(start) + pending.take(jump)
            if (wild.size <= MOST) {
                leaveOut(wild, pending[jump], "the rows after")
                start = null
                pending.subList(0, jump).clear()
            }
            release()
        } else if (pending.size > MOST + SETTLED) {
            release()
        }
    }

    /** No row follows. */
    fun end() {
        if (pending.isNotEmpty() && pending.size <= MOST && settled >= SETTLED) {
            leaveOut(pending, checkNotNull(before), "the rows before")
            pending.clear()
        }
        release()
    }

    private fun accept(row: TimedRow) {
        before = row
        settled++
        val held = start
        if (held == null) {
            use(row)
        } else {
            held += row
            if (held.size > MOST) keepStart()
        }
    }

    /** The log goes on where it jumped to: all rows stay. */
    private fun release() {
        keepStart()
        if (pending.isEmpty()) return
        pending.forEach(use)
        before = pending.last()
        settled = pending.size
        pending.clear()
    }

    private fun keepStart() {
        start?.forEach(use)
        start = null
    }

    private fun leaveOut(rows: List<TimedRow>, near: TimedRow, beside: String) {
        count += rows.size
        if (first != null) return
        val km = "%.0f".format(java.util.Locale.ROOT, apart(rows[0], near) / KILOMETRE)
        val what = if (rows.size == 1) "a single fix" else "${rows.size} fixes"
        first = "line ${rows[0].line}: $what $km km off $beside"
        firstCount = count
    }

    private fun apart(one: TimedRow, other: TimedRow) = hypot(other.x - one.x, other.y - one.y)

    private fun isFar(one: TimedRow, other: TimedRow) =
        apart(one, other).let { it > FAR_METRES && it > FAR_SPEED * (other.seconds - one.seconds) }

    companion object {
        private const val KILOMETRE = 1000.0

        /** Metres from row to row from which on a fix may be wild. */
        const val FAR_METRES = 1000.0

        /** Metres per second: no boat. */
        private const val FAR_SPEED = 100.0
        private const val BACK = 10

        /** Rows in a row that may be wild. */
        const val MOST = 3

        /** Rows beside them that are where the log is. */
        const val SETTLED = 10
    }
}
