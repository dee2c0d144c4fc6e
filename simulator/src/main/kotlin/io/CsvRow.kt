package stillwater.io

import de.siegmar.fastcsv.reader.AbstractBaseCsvCallbackHandler

/**
 * The row a CSV reader stands at, with only the numbers that are in use taken out of it. One object for all rows.
 *
 * @param slots where to keep the number of each column, or [CsvColumns.NONE] for columns nobody reads. Retained.
 * @param size number of slots.
 * @param separator what stands between fields.
 * @param timeSlot slot of the time, which may also be a date and time of day.
 */
internal class CsvRow(private val slots: IntArray, size: Int, private val separator: Char, private val timeSlot: Int) :
    AbstractBaseCsvCallbackHandler<CsvRow>() {
    /** Numbers of the row by slot; NaN where the field is missing or no number. */
    val numbers = DoubleArray(size)

    /** Number of fields in the row. */
    val fields: Int get() = fieldCount

    /** Whether the line holds nothing at all. */
    var blank = false
        private set

    /** Physical line on which the row starts, from 1. */
    var line = 0L
        private set

    /** Number of separators in the row's widest line but the first: line breaks in quotes may swallow rows. */
    var widestBreak = -1
        private set

    /** Whether the row is the end mark, so that the log ended before it. */
    var isEnd = false
        private set

    /** Whether the end mark is inside a field: a quote was never closed. */
    var isOpen = false
        private set

    private val unreadable = HashMap<Int, String>()

    /** The text of the field of [column], which turned out not to be a finite number. */
    fun textOf(column: Int): String = unreadable[column].orEmpty()

    override fun handleBegin(startingLineNumber: Long) {
        line = startingLineNumber
        blank = false
        widestBreak = -1
        isEnd = false
        isOpen = false
        numbers.fill(Double.NaN)
        if (unreadable.isNotEmpty()) unreadable.clear()
    }

    override fun handleField(fieldIdx: Int, buf: CharArray, offset: Int, len: Int, quoted: Boolean) {
        if (quoted) {
            lookInside(buf, offset, len)
        } else if (fieldIdx == 0 && len == EndMark.TEXT.length && buf[offset] == EndMark.TEXT[0]) {
            isEnd = true
        }
        val slot = if (fieldIdx < slots.size) slots[fieldIdx] else CsvColumns.NONE
        if (slot == CsvColumns.NONE) return
        val number =
            if (slot == timeSlot) IsoTime.ofField(buf, offset, len) else DecimalText.parse(buf, offset, len)
        numbers[slot] = number
        if (!number.isFinite()) unreadable[fieldIdx] = String(buf, offset, len)
    }

    private fun lookInside(buf: CharArray, offset: Int, len: Int) {
        var count = -1
        for (i in offset until offset + len) {
            when (buf[i]) {
                '\n', '\r' -> count = 0
                EndMark.TEXT[0] -> isOpen = true
                separator -> if (count >= 0) count++
            }
            if (count > widestBreak) widestBreak = count
        }
    }

    override fun handleEmpty() {
        blank = true
    }

    override fun buildRecord(): CsvRow = this
}
