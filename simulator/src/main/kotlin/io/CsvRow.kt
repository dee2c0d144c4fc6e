package stillwater.io

import de.siegmar.fastcsv.reader.AbstractBaseCsvCallbackHandler

/**
 * The row a CSV reader stands at, with only the numbers that are in use taken out of it. One object for all rows.
 *
 * @param slots where to keep the number of each column, or [CsvColumns.NONE] for columns nobody reads. Retained.
 * @param size number of slots.
 * @param separator what stands between fields.
 * @param timeSlot slot of the time, which may also be a date and time of day.
 * @param dateSlot slot of the date, added to the time where [reader] is given and a column has it.
 * @param reader reads the fields of a log that is not written plainly; null for others.
 * @param isZoned whether times in ISO 8601 have an offset, in a log that is written plainly; null where there are none.
 * @param linesBefore lines of the file that the reader was not given.
 */
internal class CsvRow(
    private val slots: IntArray,
    size: Int,
    private val separator: Char,
    private val timeSlot: Int,
    private val dateSlot: Int,
    private val reader: FieldReader?,
    private val isZoned: Boolean?,
    private val linesBefore: Int,
) : AbstractBaseCsvCallbackHandler<CsvRow>() {
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

    /** Whether every field in use holds a number. */
    val isWhole: Boolean get() = unreadable.isEmpty()

    /** The first character of the row, a blank where the first field is empty. */
    var first = ' '
        private set

    /** The first field where it begins with a letter and nobody reads its column; empty otherwise. */
    var word = ""
        private set

    /** Number of zero characters in the row: text that was lost, as in a power cut. */
    var zeros = 0
        private set

    private val hasDate = reader != null && dateSlot in slots
    private val unreadable = HashMap<Int, String>()

    /** The text of the field of [column], which turned out not to be a finite number. */
    fun textOf(column: Int): String = unreadable[column].orEmpty()

    /** Whether the field of [column] is there and turned out not to be a finite number. */
    fun isUnreadable(column: Int): Boolean = column in unreadable

    override fun handleBegin(startingLineNumber: Long) {
        line = startingLineNumber + linesBefore
        first = ' '
        word = ""
        blank = false
        widestBreak = -1
        isEnd = false
        isOpen = false
        zeros = 0
        numbers.fill(Double.NaN)
        if (unreadable.isNotEmpty()) unreadable.clear()
    }

    override fun handleField(fieldIdx: Int, buf: CharArray, offset: Int, len: Int, quoted: Boolean) {
        if (quoted) {
            lookInside(buf, offset, len)
        } else if (fieldIdx == 0 && len > 0) {
            first = buf[offset]
            if (len == EndMark.TEXT.length && first == EndMark.TEXT[0]) isEnd = true
        }
        val slot = if (fieldIdx < slots.size) slots[fieldIdx] else CsvColumns.NONE
        if (slot == CsvColumns.NONE) {
            countZeros(buf, offset, len)
            if (fieldIdx == 0 && len > 0 && buf[offset].isLetter()) word = String(buf, offset, len)
            return
        }
        val number = when {
            reader != null -> read(reader, slot, buf, offset, len)
            slot == timeSlot -> IsoTime.ofField(buf, offset, len, isZoned)
            else -> DecimalText.parse(buf, offset, len)
        }
        numbers[slot] = number
        if (!number.isFinite()) {
            // No number has a zero in its text.
            countZeros(buf, offset, len)
            unreadable[fieldIdx] = String(buf, offset, len)
        }
    }

    private fun countZeros(buf: CharArray, offset: Int, len: Int) {
        for (i in offset until offset + len) if (buf[i] == '\u0000') zeros++
    }

    private fun read(reader: FieldReader, slot: Int, buf: CharArray, offset: Int, len: Int) = when (slot) {
        timeSlot -> reader.time(buf, offset, len)
        dateSlot -> reader.day(buf, offset, len)
        else -> reader.number(buf, offset, len)
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

    override fun buildRecord(): CsvRow {
        if (hasDate) numbers[timeSlot] += numbers[dateSlot]
        return this
    }
}
