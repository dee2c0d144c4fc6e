package stillwater.io

/** Columns that say of which sensor, quantity or boat a row is, in tables that hold several below each other. */
internal object RowLabels {
    /** A time or two that come twice are a fault of the log, whatever else differs there. */
    private const val FEWEST_TWINS = 3

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
        if (twins.size < FEWEST_TWINS) return null
        val others = columns.names.indices - setOf(columns.time, columns.date, columns.value)
        return others.firstOrNull { column ->
            val isLabel = NAME.containsMatchIn(columns.names[column].replace('_', ' '))
            fun label(row: Int) = rows[row].getOrNull(column)?.takeIf { isLabel || isWord(it) }
            2 * twins.count { label(it) != null && label(it - 1) != null && label(it) != label(it - 1) } > twins.size
        }
    }

    /**
     * Whether most of the rows that share a time with the one before, [times] s, lie more than [far] m from it, as those
     * of two boats in turn do; [number] reads a field.
     */
    fun areApart(
        rows: List<List<String>>,
        times: List<Double>,
        columns: CsvColumns,
        far: Double,
        number: (String) -> Double,
    ): Boolean {
        val places = HeadPlaces.of(columns) { column -> rows.map { number(it.getOrNull(column).orEmpty()) } }
            ?: return false
        val twins = twins(times).filter { places.isPlace(it) && places.isPlace(it - 1) }
        return 2 * twins.count { places.metres(it - 1, it) > far } > twins.size
    }

    private fun twins(times: List<Double>) = times.indices.drop(1).filter { times[it] == times[it - 1] }

    private fun isWord(text: String) =
        !CellText.isMissing(text) && !CellText.isNumber(text, comma = true) && !CellText.isTime(text)
}
