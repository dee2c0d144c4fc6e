package stillwater.report

/** On which side the texts of a column line up. */
public enum class Align { LEFT, RIGHT }

/**
 * One column of a [Table].
 *
 * @property header plain text, with the unit where there is one, such as `Error (mg/L)`.
 * @property align numbers to the right, so that digits stand under each other.
 */
public class TableColumn(public val header: String, public val align: Align)

/**
 * A small table of finished texts, written once and shown on a terminal ([toTerminal]) or in a page ([tableOf] a
 * report section). For numbers that a machine reads, write a [CsvTable] instead.
 *
 * @property columns the columns, at least one.
 * @property rows the cells' plain texts, row by row, one cell for each column.
 */
public class Table(public val columns: List<TableColumn>, public val rows: List<List<String>>) {
    init {
        require(columns.isNotEmpty()) { "a table needs at least one column" }
        rows.forEachIndexed { index, row ->
            require(row.size == columns.size) { "row $index has ${row.size} cells, the table ${columns.size} columns" }
        }
    }

    public companion object {
        /** A table with one row for each of [items], by the columns that [build] names, in that order. */
        public fun <T> of(items: Iterable<T>, build: Builder<T>.() -> Unit): Table {
            val builder = Builder<T>().apply(build)
            return Table(builder.columns, items.map { item -> builder.cells.map { it(item) } })
        }
    }

    /** Names the columns of a table, each with how to get its text from an item. */
    public class Builder<T> internal constructor() {
        internal val columns = ArrayList<TableColumn>()
        internal val cells = ArrayList<(T) -> String>()

        /** A column of words. */
        public fun text(header: String, cell: (T) -> String): Unit = add(header, Align.LEFT, cell)

        /** A column of numbers with [digits] significant digits; null and NaN are shown as missing. */
        public fun number(header: String, digits: Int = 3, cell: (T) -> Double?) {
            val format = SignificantDigits(digits)
            add(header, Align.RIGHT) { item -> format.format(cell(item) ?: Double.NaN) }
        }

        /** A column of whole numbers, all digits shown. */
        public fun count(header: String, cell: (T) -> Long?): Unit =
            add(header, Align.RIGHT) { item -> cell(item)?.toString() ?: SignificantDigits.MISSING }

        private fun add(header: String, align: Align, cell: (T) -> String) {
            columns += TableColumn(header, align)
            cells += cell
        }
    }
}
