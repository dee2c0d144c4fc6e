package stillwater.io

import java.util.Locale

/** Refuses places that are not in metres or degrees, as far as a log's names, units and numbers show. */
internal class CsvUnits(
    private val content: LogContent,
    private val layout: CsvLayout,
    private val names: List<String>,
) {
    /**
     * Looks at the places that [columns] name.
     *
     * @param isChosen whether the user named the column with metres east.
     * @throws LogProblem if they are in another unit.
     */
    fun check(columns: CsvColumns, isChosen: Boolean) {
        for (column in listOf(columns.x, columns.y).filter { it != CsvColumns.NONE }) {
            val unit = layout.unit(column)
            if (!ColumnNames.isMetres(unit)) throw problem(column, "metres", quoted(unit))
            // One who names the column may have more in its brackets than a unit.
            val stated = ColumnNames.stated(names[column])
            if (OTHER.matches(stated)) throw problem(column, "metres", quoted(stated))
        }
        for (column in listOf(columns.latitude, columns.longitude).filter { it != CsvColumns.NONE }) {
            val unit = layout.unit(column)
            if (!ColumnNames.isDegrees(unit)) throw problem(column, "degrees", quoted(unit))
            val stated = ColumnNames.stated(names[column])
            if (MINUTES.containsMatchIn(stated)) throw problem(column, "degrees with decimals", quoted(stated))
        }
        val isPlain = columns.x != CsvColumns.NONE && ColumnNames.plain(names[columns.x]) == "x"
        if (isPlain && columns.y != CsvColumns.NONE && !isChosen) checkSpan(columns)
    }

    /** Programs for maps call longitudes X and latitudes Y: then a pond is less than a metre wide. */
    private fun checkSpan(columns: CsvColumns) {
        fun given(column: Int) = layout.numbers(column).filter { it.isFinite() && !CellText.isCode(it) }
        val xs = given(columns.x)
        val ys = given(columns.y)
        if (xs.isEmpty() || ys.isEmpty() || xs.any { it !in -HALF..HALF } || ys.any { it !in -QUARTER..QUARTER }) return
        val span = maxOf(xs.max() - xs.min(), ys.max() - ys.min())
        // A boat at the bench has one place.
        if (span == 0.0 || span >= 1) return
        val expected = "metres, and --x and --y with so small a track; or degrees with --lat and --lon"
        throw problem(columns.x, expected, "places within %.4g".format(Locale.ROOT, span))
    }

    private fun problem(column: Int, expected: String, found: String): LogProblem {
        val line = if (layout.units.isEmpty()) layout.headerLine else layout.headerLine + 1
        return LogProblem(content.file, line.toLong(), names[column], expected, found)
    }

    private companion object {
        const val HALF = 180.0
        const val QUARTER = 90.0
        val OTHER = Regex("""(?i)km|kilomet(er|re)s?|cm|mm|ft|feet|foot|yd|yards?|mi|miles?|nmi?|in|°|deg.*""")
        val MINUTES = Regex("""(?i)mm|min|rad""")
    }
}
