package stillwater.io

/**
 * The way of rows from a table to those who use them, in the order of their times.
 *
 * @param rounding what times were cut to; null where they are as good as they are written.
 * @param refuse see [TimeOrder].
 * @param use takes a row, later than the last.
 */
internal class RowTimes(
    private val rounding: TimeRounding?,
    refuse: (TimedRow, TimedRow, TimeFault) -> Unit,
    use: (TimedRow) -> Unit,
) {
    private val restored = rounding?.let { RestoredTimes(it.unit, use) }
    private val order = TimeOrder(rounding?.most ?: 1, restored?.let { it::take } ?: use, refuse)
    private val unread = UnreadRows(rounding != null, order::take)

    /** What to say of them, one sentence each. */
    val notes: List<String>
        get() = listOfNotNull(order.note, rounding?.note(order.shared))

    /** Takes the next row of the file, which has a reading. */
    fun read(row: TimedRow) = unread.read(row)

    /** Takes the next row of the file, in which nothing but the reading is missing. */
    fun missed(row: TimedRow) = unread.add(row)

    /** Decides on the rows that still wait, after the last. */
    fun end() {
        unread.end()
        order.end()
        restored?.end()
    }
}
