package stillwater.io

import java.nio.charset.Charset
import java.time.LocalDateTime
import java.time.ZoneOffset
import java.time.format.DateTimeFormatter
import java.time.format.DateTimeParseException
import java.util.Locale

/**
 * What stands before the numbers of a Sea-Bird `.cnv` file: `*` and `#` lines up to `*END*`.
 *
 * Sources: headers of public files and the readers of such files; which zero a time has was held against files that
 * give the same moment twice (timeK and timeJV2, timeQ and the header's clock).
 *
 * @param longNames long names of the columns, as `Temperature [ITS-90, deg C]`. @param start when the first scan was
 * taken, or null. @param bins what the scans were averaged by, as `decibars: 1`, or null where nothing says so.
 * @param counted times from how many scans there were, or null where nothing says how often.
 * @property names short names of the columns, as `t090C`. @property endLine line of `*END*`, from 1.
 * @property badFlag number that stands for none. @property clock what the times are made of, or null where there is
 * nothing to make them of.
 */
internal class SeaBirdHeader private constructor(
    val names: List<String>,
    private val longNames: List<String>,
    val endLine: Int,
    val badFlag: Double,
    val clock: Clock?,
    private val start: Start?,
    private val bins: String?,
    private val counted: Clock?,
) {
    /** When the first scan was taken: as written, and seconds since 1970 if that is UTC. */
    class Start(val text: String, val seconds: Double, val year: Int)

    /**
     * Where times come from.
     *
     * @property column index of the column, or [BY_COUNT] for scans at a fixed interval. @property factor seconds in
     * one of its units. @property zero seconds since 1970 where it is 0, or null where nothing says so.
     * @property note for people. @property fromFirst whether the column counts scans, and the first is to be 0.
     */
    class Clock(
        val column: Int,
        val factor: Double,
        val zero: Double?,
        val note: String,
        val fromFirst: Boolean = false,
    ) {
        /** Name of the column of times that is put before the file's own. */
        val name: String get() = if (zero == null) "time_s" else "unix_time_s"
    }

    /** What was taken for what, for people. */
    fun notes(): List<String> = listOfNotNull(
        clock?.note,
        bins?.let { "averaged into bins of $it" },
    )

    /** The names of a table with a column of times before the file's own, as a line of CSV. */
    fun csvHeader(): String = (listOfNotNull(clock?.name) + names).joinToString(",") {
        if (it.any { c -> c == ',' || c == '"' }) "\"${it.replace("\"", "\"\"")}\"" else it
    }

    /** The column that [name] means: short, long with or without its unit, or none of these. */
    private fun short(name: String): String {
        if (name in names) return name
        val found = longNames.indices.singleOrNull { name in listOf(longNames[it], longNames[it].withoutUnit()) }
        return found?.let { names[it] } ?: name
    }

    private fun String.withoutUnit() = substringBefore('[').trim()

    /** [choice] with short names. */
    fun short(choice: LogChoice): LogChoice = choice.copy(
        time = choice.time?.let(::short),
        latitude = choice.latitude?.let(::short),
        longitude = choice.longitude?.let(::short),
        x = choice.x?.let(::short),
        y = choice.y?.let(::short),
        value = choice.value?.let(::short),
        conditions = choice.conditions.mapValues { (_, name) -> short(name) },
    )

    /** The same with times from the column [name]; null where that is no time as Sea-Bird writes it. */
    fun timedBy(name: String): SeaBirdHeader? {
        val scans = counted?.takeIf { name == SCAN && it.fromFirst }
        val found = clock(names.indexOf(name), names, longNames, start) ?: scans ?: return null
        return SeaBirdHeader(names, longNames, endLine, badFlag, found, start, bins, counted)
    }

    /** Column [number] of a file, with its short [name] and its [longName], as they stand there. */
    class Column(val number: String, val name: String, val longName: String)

    companion object {
        /** In place of a column: one scan after the other. */
        const val BY_COUNT = -1
        private const val END = "*END*"
        private const val DAY = 86_400.0

        /** The column that counts scans. */
        private const val SCAN = "scan"

        /** Times that count from 1 January 2000. */
        private val SINCE_2000 = setOf("timeK", "timeQ")
        private const val YEAR_2000 = 946_684_800.0

        /** Columns of times, the finest first. */
        private val TIMES = listOf("timeS", "timeM", "timeH", "timeK", "timeQ", "timeJV2", "timeSCP", "timeJ")
        private val UNITS = mapOf("timeS" to 1.0, "timeM" to 60.0, "timeH" to 3600.0)
        private val NAME = Regex("""#\s*name\s+(\d+)\s*=\s*([^:]*?)\s*(?::\s*(.*?))?\s*""")
        private val ENTRY =
            Regex("""#\s*(interval|start_time|bad_flag|file_type|binavg_bintype|binavg_binsize)\s*=\s*(.*?)\s*""")
        private val START = Regex("""([A-Za-z]{3} +\d{1,2} +\d{4} +\d{2}:\d{2}:\d{2}).*""")
        private val STAMP = DateTimeFormatter.ofPattern("MMM d yyyy HH:mm:ss", Locale.ENGLISH)
        private val SECONDS = Regex("""seconds:\s*(\S+)""")

        /** What the scans were averaged by: the unit of the interval, or what the program that averages says. */
        private fun bins(entries: Map<String, String>): String? {
            val interval = entries["interval"].orEmpty()
            if (interval.isNotEmpty() && !interval.startsWith("seconds")) return interval
            return entries["binavg_bintype"]?.let { "$it: ${entries["binavg_binsize"] ?: "unknown"}" }
        }

        /**
         * Whether a file that begins with [head] is one of Sea-Bird's. What [AnnotatedLog] makes of one has its
         * remarks, but is a table with a header.
         */
        private fun isSeaBird(head: List<String>): Boolean {
            val isNamed = head[0].startsWith("* Sea-Bird") || head.any { NAME.matches(it) }
            return isNamed &&
                (head.any { it.trim() == END } || head.all { it.isBlank() || it[0] == '*' || it[0] == '#' })
        }

        /**
         * The header that the lines [head] begin with; null where the file is another's.
         *
         * @param problem makes the error for line, expected and found.
         * @throws LogProblem if it is Sea-Bird's but not a `.cnv` of text.
         */
        fun of(head: List<String>, problem: (Int?, String, String) -> LogProblem): SeaBirdHeader? {
            if (!isSeaBird(head)) return null
            val end = head.indexOfFirst { it.trim() == END }
            if (end < 0) throw problem(null, "a line $END that ends a Sea-Bird header", "none in the first lines")
            val entries = HashMap<String, String>()
            val columns = ArrayList<Column>()
            for (line in head.subList(0, end)) {
                NAME.matchEntire(line)?.destructured?.let { (i, name, long) -> columns += Column(i, name, long) }
                ENTRY.matchEntire(line)?.let { entries[it.groupValues[1]] = it.groupValues[2] }
            }
            if (columns.isEmpty()) columns += SeaBirdXml.columns(head.subList(0, end), entries)
            if (columns.isEmpty()) {
                val found = "a Sea-Bird file without them, as .hex is: convert it by Sea-Bird's Data Conversion"
                throw problem(end + 1, "lines '# name 0 = ...' before $END", found)
            }
            if (columns.withIndex().any { (i, column) -> column.number != "$i" }) {
                throw problem(end + 1, "lines '# name 0 = ...' in their order", "a number that is missing or twice")
            }
            if (entries["file_type"] == "binary") throw problem(end + 1, "file_type = ascii", "binary")
            val names = columns.map { it.name }
            val longNames = columns.map { it.longName }
            val flag = entries["bad_flag"]?.let { DecimalText.parse(it) } ?: Double.NaN
            val start = entries["start_time"]?.let(::start)
            val interval = entries["interval"].orEmpty()
            val bins = bins(entries)
            val counted = byCount(interval, start, if (bins == null) names.indexOf(SCAN) else BY_COUNT)
            val clock = TIMES.firstNotNullOfOrNull { clock(names.indexOf(it), names, longNames, start) } ?: counted
            return SeaBirdHeader(names, longNames, end + 1, flag, clock, start, bins, counted)
        }

        /** Times from the column [index]; null where it is no time, or one of days and nothing says of which year. */
        private fun clock(index: Int, names: List<String>, longNames: List<String>, start: Start?): Clock? {
            val name = names.getOrNull(index) ?: return null
            val elapsed = UNITS[name]
            return when {
                elapsed != null -> Clock(index, elapsed, start?.seconds, "times from $name${after(start)}")
                name in SINCE_2000 -> Clock(index, 1.0, YEAR_2000, "times from $name, seconds since 2000")
                name !in TIMES || start == null || "days" !in longNames[index].lowercase() -> null
                else -> {
                    val january = LocalDateTime.of(start.year, 1, 1, 0, 0).toEpochSecond(ZoneOffset.UTC)
                    // The first of January is day 1.
                    Clock(index, DAY, january - DAY, "times from $name, days of ${start.year}")
                }
            }
        }

        /**
         * Times from a scan every [interval], counted by the column [scan], for scans may have been taken out; or by
         * rows where that is [BY_COUNT], as of bins, which have the mean of their scans' numbers there.
         */
        private fun byCount(interval: String, start: Start?, scan: Int): Clock? {
            val seconds = SECONDS.matchEntire(interval)?.let { DecimalText.parse(it.groupValues[1]) }
            if (seconds == null || !(seconds > 0) || seconds.isInfinite()) return null
            val counted = if (scan == BY_COUNT) "" else ", as $SCAN counts them,"
            val note = "times from a scan every $seconds s$counted${after(start)}".removeSuffix(",")
            return Clock(scan, seconds, start?.seconds, note, fromFirst = scan != BY_COUNT)
        }

        private fun after(start: Start?) = if (start == null) "" else " after ${start.text}"

        private fun start(text: String): Start? {
            val stamp = START.matchEntire(text)?.groupValues?.get(1)?.replace(Regex(" +"), " ") ?: return null
            return try {
                val time = LocalDateTime.parse(stamp, STAMP)
                Start(stamp, time.toEpochSecond(ZoneOffset.UTC).toDouble(), time.year)
            } catch (_: DateTimeParseException) {
                null
            }
        }

        /** The lines [head] of the file as its table reads; see [SeaBirdTable]. */
        fun table(head: List<String>, header: SeaBirdHeader, charset: Charset): List<String> =
            SeaBirdTable(head.joinToString("\n").toByteArray(charset).inputStream(), header, charset)
                .readAllBytes().toString(charset).lines()
    }
}
