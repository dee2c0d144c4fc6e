package stillwater.io

import de.siegmar.fastcsv.reader.CsvParseException
import de.siegmar.fastcsv.reader.CsvReader

/**
 * Finds the order of day, month and year in a log's dates: as asked for, as the column's name states, or as the first
 * date that has one reading only decides. Where none does, nobody can know.
 *
 * @property order the order. @property why what it is known by, for people; empty where there was nothing to decide.
 */
internal class DateDecision private constructor(val order: DateOrder?, val why: String) {
    companion object {
        /**
         * Decides for the dates in [column] of the log.
         *
         * @param name the column's name. @param given the order asked for, or null.
         * @throws LogProblem if the log leaves it open.
         */
        fun of(content: LogContent, layout: CsvLayout, column: Int, name: String, given: DateOrder?): DateDecision {
            if (given != null) {
                requireNeeded(content, layout, column, name, given)
                return DateDecision(given, "dates as ${given.words}, as asked for")
            }
            DateOrder.stated(name)?.let { return DateDecision(it, "dates as ${it.words}, as the column's name says") }
            val search = Search()
            val line = look(content, layout, column, search::isDone)
            return search.decision(line) ?: throw LogProblem(
                content.file,
                search.openLine,
                name,
                "--date-order ${search.flags()}, which no date in the log decides",
                quoted(search.open.orEmpty()),
            )
        }

        /** Refuses an order that the dates' own form contradicts in all rows: it would be ignored. */
        private fun requireNeeded(content: LogContent, layout: CsvLayout, column: Int, name: String, given: DateOrder) {
            var first: String? = null
            var firstLine = 0L
            var isNeeded = false
            look(content, layout, column) { text, line ->
                val parts = DateText.parts(text)
                val order = parts?.order
                isNeeded = parts != null && (order == null || order == given)
                if (first == null && order != null) {
                    first = text
                    firstLine = line
                }
                isNeeded
            }
            val other = first
            if (isNeeded || other == null) return
            val expected = "a date such as 05/06/2025, as --date-order says"
            throw LogProblem(content.file, firstLine, name, expected, quoted(other))
        }

        /** Shows [isDone] the fields of [column] with their lines until it is; answers the last line. */
        private fun look(
            content: LogContent,
            layout: CsvLayout,
            column: Int,
            isDone: (String, Long) -> Boolean,
        ): Long {
            var line = 0L
            try {
                reader(content, layout).use { records ->
                    for (record in records) {
                        line = record.startingLineNumber + layout.bodyLine - 1
                        if (record.fieldCount > column && isDone(record.getField(column), line)) break
                    }
                }
            } catch (_: CsvParseException) {
                // The reading proper says what is wrong there.
            }
            return line
        }

        private fun reader(content: LogContent, layout: CsvLayout) = CsvReader.builder()
            .fieldSeparator(layout.separator)
            .skipEmptyLines(true)
            .allowExtraFields(true)
            .allowMissingFields(true)
            .ofCsvRecord(content.reader(layout.bodyLine - 1) {})
    }

    /** Looks through dates until one of them decides. */
    private class Search {
        private var orders = DateOrder.entries.toSet()
        private var isByForm = false

        /** A date that may be read in several ways, or null. */
        var open: String? = null
            private set

        /** The line it is in. */
        var openLine = 0L
            private set

        fun isDone(text: String, line: Long): Boolean {
            val parts = DateText.parts(text) ?: return false
            val possible = parts.orders()
            // 05/05/2025 is the same day either way.
            if (open == null && possible.map { parts.day(it) }.distinct().size > 1) {
                open = text
                openLine = line
            }
            isByForm = parts.order != null
            // A date that contradicts those before it, or is none in any order, is told of with its row.
            if (orders.any { it in possible }) orders = orders intersect possible.toSet()
            return orders.size == 1
        }

        fun flags() = orders.map { it.flag }.let { it.dropLast(1).joinToString() + " or " + it.last() }

        fun decision(line: Long): DateDecision? = when {
            orders.size == 1 && !isByForm ->
                DateDecision(orders.single(), "dates as ${orders.single().words}, as line $line shows")
            open == null -> DateDecision(orders.first(), "")
            else -> null
        }
    }
}
