package stillwater.io

import kotlin.math.hypot

/** Columns that say of which sensor, quantity or boat a row is, in tables that hold several below each other. */
internal object RowLabels {
    /** Along a meridian; along a circle of latitude no more. */
    private const val METRES_A_DEGREE = 111_195.0

    /** Names of columns whose numbers are such labels. */
    private val NAME =
        Regex("""(?i)(?<![a-z])(id|sensor|device|boat|node|channel|probe|station|serial|parameter)(?![a-z])""")

    /**
     * The column by which most of the rows that share a time with the one before, [times] s, differ from that: by a
     * word, or by a number where the column's name says that it is a label; null where there is none.
     *
     * @param rows fields of the rows of the head.
     */
    fun column(rows: List<List<String>>, times: List<Double>, columns: CsvColumns): Int? {
        val twins = twins(times)
        val others = columns.names.indices - setOf(columns.time, columns.date, columns.value)
        return others.firstOrNull { column ->
            val isLabel = NAME.containsMatchIn(columns.names[column].replace('_', ' '))
            fun label(row: Int) = rows[row].getOrNull(column)?.takeIf { isLabel || isWord(it) }
            2 * twins.count { label(it) != null && label(it - 1) != null && label(it) != label(it - 1) } > twins.size
        }
    }

    /**
     * Whether most of the rows that share a time with the one before lie more than [far] m from it, as those of two
     * boats in turn do.
     *
     * @param number reads a field.
     */
    fun areApart(
        rows: List<List<String>>,
        times: List<Double>,
        columns: CsvColumns,
        far: Double,
        number: (String) -> Double,
    ): Boolean {
        val inDegrees = columns.latitude != CsvColumns.NONE
        val north = if (inDegrees) columns.latitude else columns.y
        val east = if (inDegrees) columns.longitude else columns.x
        if (north == CsvColumns.NONE) return false
        val unit = if (inDegrees) METRES_A_DEGREE else 1.0
        fun step(row: Int, column: Int) =
            number(rows[row].getOrNull(column).orEmpty()) - number(rows[row - 1].getOrNull(column).orEmpty())

        val twins = twins(times)
        return 2 * twins.count { unit * hypot(step(it, north), step(it, east)) > far } > twins.size
    }

    private fun twins(times: List<Double>) = times.indices.drop(1).filter { times[it] == times[it - 1] }

    private fun isWord(text: String) =
        !CellText.isMissing(text) && !CellText.isNumber(text, comma = true) && !CellText.isTime(text)
}
