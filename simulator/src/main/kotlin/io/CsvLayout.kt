package stillwater.io

/**
 * Where the table of a CSV log is and how it is written, as the first lines of the file show it.
 *
 * Before the header there may be what loggers say about themselves; below it lines with units.
 *
 * @property separator what stands between fields. @property headerLine physical line of the header, from 1.
 * @property header the header as it stands. @property bodyLine physical line of the first row that may hold readings.
 * @property sample the first such row, or empty. @property decimalComma whether numbers have commas for points.
 * @property units the first line of units below the header, or empty. @property rows the lines of the head below these.
 */
internal class CsvLayout(
    val separator: Char,
    val headerLine: Int,
    val header: String,
    val bodyLine: Int,
    val sample: List<String>,
    val decimalComma: Boolean,
    val units: List<String>,
    private val rows: List<String>,
) {
    /** The unit of [column] by the line of units, without brackets; empty where there is none. */
    fun unit(column: Int): String = units.getOrNull(column).orEmpty().trim(' ', '(', ')', '[', ']', '<', '>')

    private val split by lazy { rows.map { fields(it, separator).orEmpty() } }

    /** The numbers that the head of the log has in [column], NaN for others. */
    fun numbers(column: Int): List<Double> {
        val reader = FieldReader(decimalComma, TimeForm(TimeForm.Kind.PLAIN))
        return split.map { reader.number(it.getOrNull(column).orEmpty()) }
    }

    /** Fields of the rows in the head of the log; a line that is the one before it once more is left out. */
    fun body(): List<List<String>> =
        split.filterIndexed { i, _ -> i == 0 || rows[i] != rows[i - 1] }

    /** What to add to a message about [text], which is no number: whether its comma makes it none. */
    fun commaHint(text: String): String = when {
        DecimalText.parse(text.replace(',', '.')).isNaN() -> ""
        decimalComma -> " (decimals have a comma in this log)"
        else -> " (decimals need a point)"
    }

    /** What it is, for people. */
    val kind: String get() = "survey CSV" + KINDS.getValue(separator)

    /** What is not plain about it, for people. */
    fun notes(): List<String> = buildList {
        if (headerLine > 1) add("header in line $headerLine")
        if (bodyLine == headerLine + 2) add("units in line ${headerLine + 1}")
        if (bodyLine > headerLine + 2) add("units in lines ${headerLine + 1} to ${bodyLine - 1}")
        if (decimalComma) add("decimal commas")
    }

    companion object {
        /** Separators that are looked for, in the order in which they are preferred. */
        val SEPARATORS = listOf(',', ';', '\t')
        private val KINDS = mapOf(',' to "", ';' to ", semicolon separated", '\t' to ", tab separated")
        private const val MOST_UNITS = 3
        private const val LONGEST_ENTRY = 3
        private val STATED = Regex("""(?i)\s*"?sep=(.)"?\s*""")
        private val BLANKS = Regex("\\s+")
        private val DECIMAL_COMMA = Regex("""[+-]?\d*,\d+([eE][+-]?\d+)?""")
        private val THOUSANDS = Regex("""[+-]?[1-9]\d{0,2},\d{3}""")
        private val DECIMAL_POINT = Regex("""[+-]?\d*\.\d+([eE][+-]?\d+)?""")

        /**
         * The layout of [content].
         *
         * @param wanted names of columns that the user gave.
         * @throws LogProblem if it has two tables, or numbers that may be meant in two ways.
         */
        fun of(content: LogContent, wanted: Set<String>): CsvLayout {
            content.seaBird?.let { return layout(content, Header(it.endLine - 1, ',')) }
            val head = content.head
            val first = head.indexOfFirst { it.isNotBlank() }
            val stated = STATED.matchEntire(head[first])?.groupValues?.get(1)?.get(0)?.takeIf { it in SEPARATORS }
            val from = if (stated == null) first else first + 1
            val begin = (from until head.size).firstOrNull { head[it].isNotBlank() } ?: first
            // Where another separates, commas in names stand before their units.
            val separator = stated ?: listOf(';', '\t', ',').firstOrNull { isPlain(head, begin, it, wanted) }
                ?: SEPARATORS.maxBy { mark -> head[begin].count { it == mark } }
            val header = if (isPlain(head, begin, separator, wanted)) {
                Header(begin, separator)
            } else {
                search(content, begin, stated?.let(::listOf) ?: SEPARATORS, wanted)
            }
            if (header == null && !isOfNumbers(head[begin])) refuseBlanks(content)
            return layout(content, header ?: Header(begin, separator))
        }

        /** Whether one of the separators parts [line] into numbers and times alone: its table has no header. */
        private fun isOfNumbers(line: String): Boolean = SEPARATORS.any { separator ->
            val fields = fields(line, separator).orEmpty()
            fields.size > 1 && fields.all { CellText.isTime(it) || CellText.isNumber(it, separator != ',') }
        }

        /** Of columns with blanks between them nobody can say where a name or a time with blanks in it ends. */
        private fun refuseBlanks(content: LogContent) {
            val last = content.head.indexOfLast { it.isNotBlank() }
            val fields = content.head[last].trim().split(BLANKS)
            if (fields.size < 2 || fields.any { !CellText.isTime(it) && !CellText.isNumber(it, comma = true) }) return
            val expected = "commas, semicolons or tabs between columns"
            // The header is the last line of words alone; without one the first line is as wrong as any.
            val header = (last downTo 0).firstOrNull { isHeader(content.head[it].trim().split(BLANKS)) }
            val line = header ?: content.head.indexOfFirst { it.isNotBlank() }
            throw LogProblem(content.file, line + 1L, null, expected, "blanks")
        }

        private fun isHeader(fields: List<String>) = fields.size > 1 &&
            fields.none { CellText.isMissing(it) || CellText.isTime(it) || CellText.isNumber(it, comma = true) }

        private class Header(val index: Int, val separator: Char)

        /** Whether the line [begin] is a header of a table that goes on to the end of [head]. */
        private fun isPlain(head: List<String>, begin: Int, separator: Char, wanted: Set<String>): Boolean {
            if (CellText.isRemark(head[begin])) return false
            val names = fields(head[begin], separator) ?: return false
            if (names.none { it in wanted || ColumnNames.isKnown(it) }) return false
            if (isEntry(names)) return false
            val last = head.indexOfLast { it.isNotBlank() }
            return names.size > 1 && (last == begin || fields(head[last], separator)?.size == names.size)
        }

        /** Whether these fields say something about the logger, as `Date,14/07/2025` does. */
        private fun isEntry(fields: List<String>) = fields.any { CellText.isTime(it) } ||
            (fields.count { it.isNotEmpty() } <= LONGEST_ENTRY && fields.any { CellText.isNumber(it, comma = true) })

        /**
         * The header of the table that reaches farthest: what stands before it is smaller or has other columns.
         *
         * @throws LogProblem if a table with known columns stands before it, whose readings would be lost.
         */
        private fun search(content: LogContent, begin: Int, separators: List<Char>, wanted: Set<String>): Header? {
            val all = separators.flatMap { Table(content.head, begin, it, wanted).headers() }
            val best = all.maxWithOrNull(
                compareBy({ it.end }, { it.known }, { if (it.isRemark) 0 else 1 }, { -it.index }),
            ) ?: return null
            all.firstOrNull { it.separator == best.separator && it.end < best.index && it.isTableBeside(best) }?.let {
                val found = "a table from line ${it.index + 1} on and another from here on"
                throw LogProblem(content.file, best.index + 1L, null, "one table", found)
            }
            return Header(best.index, best.separator)
        }

        private fun layout(content: LogContent, header: Header): CsvLayout {
            val head = content.head
            val table = Table(head, header.index, header.separator, emptySet())
            val units = table.units(header.index)
            val body = header.index + 1 + units
            val rows = (body until head.size).asSequence().filterNot(table::isPassed)
            // Between a header and its rows a logger's settings may stand.
            val sample = rows.firstOrNull { table.hasRow(it, header.index) } ?: rows.firstOrNull()
            return CsvLayout(
                header.separator,
                header.index + 1,
                head[header.index].let { if (CellText.isRemark(it)) it.trimStart('#', '%', '/', ' ') else it },
                body + 1,
                sample?.let { fields(head[it], header.separator) }.orEmpty(),
                header.separator != ',' && table.hasDecimalCommas(body) { line, column ->
                    val name = fields(head[header.index], header.separator)?.getOrNull(column)
                    val found = quoted(fields(head[line], header.separator).orEmpty()[column])
                    val doubt = "$found: this comma, as every other one in the log, may part thousands"
                    throw LogProblem(content.file, line + 1L, name, "numbers with a decimal point", doubt)
                },
                if (units > 0) fields(head[header.index + 1], header.separator).orEmpty() else emptyList(),
                head.drop(body),
            )
        }

        /** Fields of one [line], trimmed and without quotes; null where a quote is left open. */
        private fun fields(line: String, separator: Char): List<String>? {
            val fields = ArrayList<String>()
            val field = StringBuilder()
            var isQuoted = false
            var i = 0
            while (i < line.length) {
                val c = line[i]
                when {
                    isQuoted && c == '"' && line.getOrNull(i + 1) == '"' -> field.append(line[i++])
                    c == '"' && (isQuoted || field.isBlank()) -> isQuoted = !isQuoted
                    c == separator && !isQuoted -> {
                        fields += field.trim().toString()
                        field.setLength(0)
                    }
                    else -> field.append(c)
                }
                i++
            }
            return if (isQuoted) null else fields.apply { add(field.trim().toString()) }
        }
    }

    /** A line that may be a header, of a table of [width] columns with [rows] rows to the line [end]. */
    private class Candidate(
        val index: Int,
        val separator: Char,
        val isRemark: Boolean,
        val known: Int,
        val width: Int,
        val rows: Int,
        val end: Int,
    ) {
        /** Whether it has readings, as the one of [other], and is no block of entries about the logger. */
        fun isTableBeside(other: Candidate) = known > 0 && !isRemark && (rows > 1 || width == other.width)
    }

    /** The lines [head] from [begin] as a table with one [separator]. */
    private class Table(
        private val head: List<String>,
        private val begin: Int,
        private val separator: Char,
        private val wanted: Set<String>,
    ) {
        private val rows = HashMap<Int, List<String>>()

        private fun row(i: Int): List<String> = rows.getOrPut(i) {
            fields(head[i].trimStart('#', '%', '/', ' ').ifEmpty { " " }, separator).orEmpty()
        }

        /** Lines that may be a header, and how far the table below each reaches. */
        fun headers(): List<Candidate> {
            val found = ArrayList<Candidate>()
            for (i in begin until head.size) {
                if (!isText(row(i)) || row(i)[0] == CAMPBELL) continue
                candidate(i)?.let { found += it }
            }
            return found
        }

        /** The header [i] with its table; null where it has no rows. A header that comes again ends no table. */
        private fun candidate(i: Int): Candidate? {
            val width = row(i).size
            var end = i
            var rows = 0
            for (j in i + 1 + units(i) until head.size) {
                if (isPassed(j) || row(j) == row(i)) continue
                if (row(j).size != width || !isData(row(j))) break
                end = j
                rows++
            }
            if (rows == 0) return null
            return Candidate(i, separator, CellText.isRemark(head[i]), known(row(i)), width, rows, end)
        }

        /** Lines with units right below the header [i]. */
        fun units(i: Int): Int {
            var units = 0
            while (units < MOST_UNITS && i + 1 + units < head.size && isUnits(i + 1 + units, row(i).size)) units++
            // A table of words alone has no units, but rows in which no number is.
            return if (i + 1 + units == head.size) 0 else units
        }

        private fun isUnits(j: Int, width: Int) = !isPassed(j) && row(j).size == width && isWords(row(j))

        /** Whether numbers have decimal commas; [doubt] is told of a line and a column where nothing decides. */
        fun hasDecimalCommas(from: Int, doubt: (Int, Int) -> Nothing): Boolean {
            var open: (() -> Nothing)? = null
            var isSure = false
            for (j in (from until head.size).filterNot(::isPassed)) {
                row(j).forEachIndexed { column, field ->
                    if (DECIMAL_POINT.matches(field)) return false
                    val isThousands = THOUSANDS.matches(field)
                    if (isThousands && open == null) open = { doubt(j, column) }
                    if (!isThousands && DECIMAL_COMMA.matches(field)) isSure = true
                }
            }
            if (!isSure) open?.invoke()
            return isSure
        }

        /** Whether the line [j] has as many columns as the header [i], and numbers or times in them. */
        fun hasRow(j: Int, i: Int) = row(j).size == row(i).size && isData(row(j))

        /** Whether the line [j] is blank or a remark. */
        fun isPassed(j: Int) = head[j].isBlank() || CellText.isRemark(head[j])

        private fun isNumber(text: String) = CellText.isNumber(text, separator != ',')

        /** Words in more than half of the fields and no number or time in any. */
        private fun isText(row: List<String>) =
            row.size > 1 && 2 * row.count { !CellText.isMissing(it) } > row.size && isWords(row)

        /** Words and no number or time. */
        private fun isWords(row: List<String>) =
            row.any { !CellText.isMissing(it) } && row.none { isNumber(it) || CellText.isTime(it) }

        /** Numbers or times, and little else but what is missing. */
        private fun isData(row: List<String>): Boolean {
            val numbers = row.count { isNumber(it) || CellText.isTime(it) }
            return numbers > 1 || (numbers > 0 && 2 * (numbers + row.count { CellText.isMissing(it) }) >= row.size)
        }

        private fun known(row: List<String>) = row.count { it in wanted || ColumnNames.isKnown(it) }

        private companion object {
            /** Begins the first line of a Campbell logger's table, which has as many fields as the table may have. */
            const val CAMPBELL = "TOA5"
        }
    }
}
