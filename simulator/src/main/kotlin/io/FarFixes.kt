package stillwater.io

import kotlin.math.hypot

/**
 * Leaves out rows with a fix far off from which the next row is back where the one before was: one wild fix would set
 * the size of the whole map.
 *
 * @param use takes the other rows, in the order in which they come, each once the next one is known.
 */
internal class FarFixes(private val use: (TimedRow) -> Unit) {
    private var before: TimedRow? = null
    private var latest: TimedRow? = null
    private var first: TimedRow? = null
    private var firstMetres = 0.0

    /** Rows left out so far. */
    var count = 0L
        private set

    /** What to say of them; null where there are none. */
    val note: String?
        get() = first?.let {
            val km = "%.0f".format(java.util.Locale.ROOT, firstMetres / KILOMETRE)
            val more = if (count > 1) ", the first of $count such rows" else ""
            "line ${it.line}: a single fix $km km off the rows before and after it$more: left out"
        }

    /** Takes the next row, which has a fix. */
    fun take(row: TimedRow) {
        val held = latest
        latest = row
        if (held == null) return
        val last = before
        if (last != null && isFar(last, held) && isFar(held, row) && apart(last, row) < apart(last, held) / BACK) {
            if (count++ == 0L) {
                first = held
                firstMetres = apart(last, held)
            }
            return
        }
        use(held)
        before = held
    }

    /** No row follows. */
    fun end() {
        latest?.let(use)
        latest = null
    }

    private fun apart(one: TimedRow, other: TimedRow) = hypot(other.x - one.x, other.y - one.y)

    private fun isFar(one: TimedRow, other: TimedRow) =
        apart(one, other).let { it > FAR_METRES && it > FAR_SPEED * (other.seconds - one.seconds) }

    private companion object {
        const val KILOMETRE = 1000.0
        const val FAR_METRES = 1000.0

        /** Metres per second: no boat. */
        const val FAR_SPEED = 100.0
        const val BACK = 10
    }
}
