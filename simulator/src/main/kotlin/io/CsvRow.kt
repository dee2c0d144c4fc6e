package stillwater.io

import de.siegmar.fastcsv.reader.AbstractBaseCsvCallbackHandler

/**
 * The row a CSV reader stands at, with only the numbers that are in use taken out of it. One object for all rows.
 *
 * @param slots where to keep the number of each column, or [CsvColumns.NONE] for columns nobody reads. Retained.
 * @param size number of slots.
 */
internal class CsvRow(private val slots: IntArray, size: Int) : AbstractBaseCsvCallbackHandler<CsvRow>() {
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

    private val unreadable = HashMap<Int, String>()

    /** The text of the field of [column], which turned out not to be a finite number. */
    fun textOf(column: Int): String = unreadable[column].orEmpty()

    override fun handleBegin(startingLineNumber: Long) {
        line = startingLineNumber
        blank = false
        numbers.fill(Double.NaN)
        if (unreadable.isNotEmpty()) unreadable.clear()
    }

    override fun handleField(fieldIdx: Int, buf: CharArray, offset: Int, len: Int, quoted: Boolean) {
        val slot = if (fieldIdx < slots.size) slots[fieldIdx] else CsvColumns.NONE
        if (slot == CsvColumns.NONE) return
        val number = DecimalText.parse(buf, offset, len)
        numbers[slot] = number
        if (!number.isFinite()) unreadable[fieldIdx] = String(buf, offset, len)
    }

    override fun handleEmpty() {
        blank = true
    }

    override fun buildRecord(): CsvRow = this
}
