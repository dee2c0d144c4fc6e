package stillwater.cli

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import org.junit.jupiter.api.io.TempDir
import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.MethodSource
import java.nio.charset.Charset
import java.nio.file.Files
import java.nio.file.Path
import kotlin.io.path.exists
import kotlin.io.path.writeBytes
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Whatever is wrong with a log or a flag: one line that says where and what, exit code 2, nothing written. */
class MapBadInputTest {
    @TempDir
    private lateinit var directory: Path

    /**
     * @property log bytes of the log. @property flags more flags. @property message what the line must hold.
     * @property skipped reason that `--skip-bad-rows` counts it under; null where skipping is no help.
     */
    class Case(
        private val name: String,
        val log: ByteArray,
        val message: String,
        val skipped: String? = null,
        val flags: List<String> = emptyList(),
        val file: String = "log.csv",
    ) {
        override fun toString() = name
    }

    @ParameterizedTest
    @MethodSource("badLogs", "stillwater.cli.BadPlatypusLogs#all", "stillwater.cli.BadMapFlags#all")
    fun isRefusedInOneLineAndWritesNothing(case: Case) {
        val log = directory.resolve(case.file).apply { writeBytes(case.log) }
        val result = runMap(log.toString(), "--out", directory.out().toString(), *case.flags.toTypedArray())
        assertEquals(BAD_INPUT, result.statusCode, result.output)
        assertEquals("", result.stdout)
        assertEquals(1, result.stderr.trim().lines().size, result.stderr)
        assertTrue(result.stderr.startsWith("stillwater map: "), result.stderr)
        assertTrue(case.message in result.stderr, "${case.message} is not in ${result.stderr}")
        assertEquals(case.skipped != null, "--skip-bad-rows" in result.stderr, result.stderr)
        assertNothingWritten()
    }

    @ParameterizedTest
    @MethodSource("badLogs", "stillwater.cli.BadPlatypusLogs#all")
    fun isSkippedAndCountedWhereThatHelps(case: Case) {
        if (case.skipped == null) return
        val log = directory.resolve(case.file).apply { writeBytes(case.log) }
        val flags = case.flags + listOf("--skip-bad-rows", "--filter", "averaging")
        val result = runMap(log.toString(), "--out", directory.out().toString(), *flags.toTypedArray())
        assertEquals(0, result.statusCode, result.output)
        assertTrue(Regex("${Regex.escape(case.skipped)} +1 skipped").containsMatchIn(result.stdout), result.stdout)
        assertTrue(directory.out().resolve("cells.csv").exists())
    }

    @ParameterizedTest
    @MethodSource("missingFiles")
    fun saysThatThereIsNoLog(name: String, message: String) {
        val result = runMap(directory.resolve(name).toString(), "--out", directory.out().toString())
        assertEquals(BAD_INPUT, result.statusCode)
        assertTrue(message in result.stderr, result.stderr)
        assertNothingWritten()
    }

    @Test
    @Timeout(60)
    fun refusesAPipeAtOnce() {
        val pipe = directory.resolve("log.pipe")
        assertEquals(0, ProcessBuilder("mkfifo", pipe.toString()).start().waitFor())
        val result = runMap(pipe.toString(), "--out", directory.out().toString())
        assertEquals(BAD_INPUT, result.statusCode)
        assertTrue("expected a regular file (it is read twice)" in result.stderr, result.stderr)
        assertNothingWritten()
    }

    private fun assertNothingWritten() {
        assertFalse(directory.out().exists())
        val left = Files.list(directory).use { files -> files.map { it.fileName.toString() }.toList() }
        assertTrue(left.all { it.startsWith("log") || it.startsWith("platypus") }, "left behind: $left")
    }

    companion object {
        internal const val HEAD = "time_s,lat_deg,lon_deg,do_mg_l\n"
        internal const val GOOD = "0,45.5,-73.1,8.1\n1,45.50001,-73.1,8.2\n2,45.50002,-73.1,8.3\n"

        @JvmStatic
        fun missingFiles() = listOf(
            arrayOf("none.csv", "none.csv: expected a log file, found no such file"),
            arrayOf(".", "expected a log file, found a directory"),
        )

        private fun csv(name: String, text: String, message: String, skipped: String? = null, vararg flags: String) =
            Case(name, text.toByteArray(), message, skipped, flags.toList())

        /** A log that holds zeros where data never reached the disk. */
        private fun cut(name: String, text: String, message: String, vararg flags: String) =
            csv("power cut $name", text, "log.csv:$message", "rows with zero bytes", *flags)

        /** An order that the form of the dates contradicts, and that would be ignored. */
        private fun orderOf(date: String) = csv(
            "order of $date",
            "Date,Time,x_m,y_m,v\n$date,12:00:00,0,0,1\n$date,12:00:01,1,0,2\n",
            "log.csv:2: column Date: expected a date such as 05/06/2025, as --date-order says, found '$date'",
            null,
            "--date-order",
            "mdy",
        )

        @JvmStatic
        fun badLogs() = listOf(
            csv("empty file", "", "log.csv: expected a log, found an empty file"),
            csv("blank lines only", "\n\n \n", "found nothing but blank lines"),
            csv("header only", HEAD, "log.csv: expected rows after the header, found none"),
            csv("no header", GOOD, "log.csv:1: expected a header line with column names, found '0,45.5,-73.1,8.1'"),
            csv("a single row", HEAD + "0,45.5,-73.1,8.1\n", "expected at least 2 readings of do_mg_l, found 1"),
            csv("no time column", "t,lat_deg,lon_deg,do\n$GOOD", "log.csv:1: expected a column time_s or unix_time_s"),
            csv("no position", "time_s,la,lo,do\n$GOOD", "expected columns lat_deg and lon_deg, or x_m and y_m"),
            csv("no value column", "time_s,lat_deg,lon_deg\n0,45,7\n1,45,7\n", "expected a column with readings"),
            csv("unknown column", HEAD + GOOD, "log.csv:1: column odo: expected one of time_s", null, "--value", "odo"),
            csv("a name twice", "time_s,x_m,y_m,a,a\n0,1,2,3,4\n", "expected one of a#1, a#2", null, "--value", "a"),
            csv(
                "several candidates",
                "time_s,x_m,y_m,temp_c,ph,note\n0,1,2,3,4,a\n1,1,2,3,4,b\n",
                "expected --value with one of temp_c, ph, found 2 columns",
            ),
            csv(
                "text for a number",
                HEAD + GOOD + "3,45.5,-73.1,high\n",
                "log.csv:5: column do_mg_l: expected a finite number, found 'high'",
                "rows with text where a number belongs",
            ),
            csv(
                "another log glued onto it",
                HEAD + GOOD + HEAD + GOOD,
                "log.csv:5: column time_s: expected seconds or a time as 2025-06-01T12:00:00Z, " +
                    "found 'time_s', the header again",
                "rows with text where a number belongs",
            ),
            csv(
                "a time without an offset among some that have one",
                HEAD + "2025-10-26T02:59:58+02:00,45.5,-73.1,8.1\n2025-10-26T02:59:59+0200,45.5,-73.1,8.2\n" +
                    "2025-10-26T02:00:00,45.5,-73.1,8.3\n",
                "log.csv:4: column time_s: expected a time as 2025-06-01T12:00:00Z, with Z or an offset as the first " +
                    "has, found '2025-10-26T02:00:00'",
                "rows with text where a number belongs",
            ),
            csv(
                "a time with an offset among some that have none",
                HEAD + "2025-10-26T02:59:58,45.5,-73.1,8.1\n2025-10-26T02:59:59,45.5,-73.1,8.2\n" +
                    "2025-10-26T03:00:00Z,45.5,-73.1,8.3\n",
                "log.csv:4: column time_s: expected a time as 2025-06-01T12:00:00, without an offset as the first, " +
                    "found '2025-10-26T03:00:00Z'",
                "rows with text where a number belongs",
            ),
            csv(
                "a number beyond all that can be reckoned with",
                HEAD + GOOD + "3,45.5,-73.1,1e300\n",
                "log.csv:5: column do_mg_l: expected a number within -1.0E60..1.0E60, found 1.0E300",
                "rows with a number out of all bounds",
            ),
            csv(
                "decimal commas between commas",
                HEAD + GOOD + "3,0,45,5,-73,1,8,1\n",
                "log.csv:5: expected 4 fields as in the header, found 8 (decimal commas need another separator)",
                "rows with a wrong number of fields",
            ),
            csv(
                "decimal comma beside decimal points",
                "time_s;x_m;y_m;v\n0;0;0;1.2\n1;1;0;2\n2;2;0;1,5\n",
                "log.csv:4: column v: expected a finite number, found '1,5' (decimals need a point)",
                "rows with text where a number belongs",
            ),
            csv(
                "thousands beside decimal commas",
                "time_s;x_m;y_m;v\n0;0;0;1,2\n1;1;0;2\n2;2;0;1.500,5\n",
                "log.csv:4: column v: expected a finite number, found '1.500,5'",
                "rows with text where a number belongs",
            ),
            csv(
                "hexadecimal",
                HEAD + GOOD + "3,45.5,-73.1,0x1p3\n",
                "found '0x1p3'",
                "rows with text where a number belongs",
            ),
            csv("infinite", HEAD + GOOD + "3,45.5,inf,8\n", "column lon_deg", "rows with text where a number belongs"),
            csv(
                "overflow",
                HEAD + GOOD + "3,45.5,-73.1,1e999\n",
                "found '1e999' (too large)",
                "rows with text where a number belongs",
            ),
            csv(
                "milliseconds",
                HEAD + GOOD + "1752480000000,45.5,-73.1,8\n",
                "log.csv:5: column time_s: expected seconds, found 1.75248E12: milliseconds? --time-unit ms",
                "rows with a number out of all bounds",
            ),
            csv(
                "year 9999",
                "time,x_m,y_m,v\n2025-06-01T12:00:00Z,0,0,1\n2025-06-01T12:00:01Z,1,0,1\n2025-06-01T12:00:02Z,2,0,1\n" +
                    "9999-06-01T12:00:03Z,3,0,1\n",
                "log.csv:5: column time: expected a time before the year 5138, found 2.53383854403E11 s (--skip-bad-rows",
                "rows with a number out of all bounds",
            ),
            csv("empty time", HEAD + GOOD + ",45.5,-73.1,8\n", "column time_s", "rows with an empty field"),
            csv(
                "time going back",
                HEAD + GOOD + "1.5,45.5,-73.1,8\n",
                "log.csv:5: column time_s: expected a time after 2 s, found 1.5 s",
                "times going back",
            ),
            csv("duplicate time", HEAD + GOOD + "2,45.5,-73.1,8\n", "expected a time after 2 s", "duplicate times"),
            csv(
                "latitude off the globe",
                HEAD + GOOD + "3,95.5,-73.1,8\n",
                "log.csv:5: column lat_deg: expected a latitude within -90..90, found 95.5",
                "positions off the globe",
            ),
            csv("longitude off the globe", HEAD + GOOD + "3,45,361,8\n", "longitude within", "positions off the globe"),
            csv(
                "start at a pole",
                HEAD + "0,90,0,1\n" + GOOD.replace("0,45.5,-", "0.5,45.5,-"),
                "log.csv:2",
                "positions off the globe",
            ),
            csv("cut last line", HEAD + GOOD + "3,45.5,-7", "expected 4 fields as in the header, found 3", WRONG_COUNT),
            csv("a field too many", HEAD + GOOD + "3,45.5,-73.1,8,9\n", "log.csv:5: expected 4 fields", WRONG_COUNT),
            csv("line of a row after a blank line", HEAD + "\n" + GOOD + "x,1,2,3\n", "log.csv:6: column time_s", TEXT),
            csv(
                "line of a row after a quoted break",
                "time_s,x_m,y_m,v,n\n0,0,0,1,\"a\nb\"\nx,0,0,1,c\n1,1,1,1,d\n",
                "log.csv:4",
                TEXT,
                "--value",
                "v",
            ),
            csv(
                "a quote left open",
                HEAD + GOOD + "3,45.5,-73.1,\"8\n4,45.5,-73.1,8\n5,45.5,-73.1,8\n",
                "log.csv:5: expected a closing quote, found none to the end of the file",
            ),
            csv("a quote in the last line", HEAD + GOOD + "3,45.5,-73.1,\"8", "log.csv:5: expected a closing quote"),
            csv(
                "a quote over several rows",
                "time_s,x_m,y_m,v,n\n0,0,0,1,\"a\n1,1,1,1,b\n2,2,2,2,\"\n3,3,3,3,d\n",
                "log.csv:2: expected a closing quote, found none before the next row",
                null,
                "--value",
                "v",
            ),
            csv("text after a quote", HEAD + GOOD + "3,45.5,-73.1,\"8\"9\n", "log.csv:5: "),
            csv("far fix", HEAD + GOOD + "3,10,-73.1,8\n", "log.csv:5: column lat_deg: $FAR", FAR_REASON),
            csv("antipodal fix", HEAD + GOOD + "3,-45.5,106.9,8\n", FAR, FAR_REASON),
            csv("huge x", "time_s,x_m,y_m,v\n0,0,0,1\n1,1,1,2\n2,1e10,0,3\n", "log.csv:4: column x_m", OUT),
            csv("huge value", HEAD + GOOD + "3,45.5,-73.1,1.7e308\n", "log.csv:5: column do_mg_l", OUT),
            csv("--lat alone", "time_s,la,x_m,y_m,v\n0,1,2,3,4\n", "expected --lon with --lat", null, "--lat", "la"),
            csv("--x and --lat", HEAD + GOOD, "some of both", null, "--x", "lat_deg", "--lat", "lat_deg"),
            csv("a column twice", HEAD + GOOD, "column time_s: expected one use", null, "--value", "time_s"),
            csv("x as y", "time_s,x_m,v\n0,1,2\n1,2,3\n", "column x_m", null, "--x", "x_m", "--y", "x_m"),
            csv("next to nothing", "time_s,x_m,y_m,v\n0,0,0,1e-55\n1,1,1,2e-55\n", "expected readings of which some"),
            csv(
                "long name",
                "t" + "v".repeat(5000) + ",x_m,y_m\n0,1,2\n",
                "found columns t${"v".repeat(47)}..., x_m, y_m",
            ),
            csv("long header", "time_s,x_m,y_m," + "v".repeat(70_000) + "\n0,1,2,3\n", "log.csv:1: expected a header"),
            Case("UTF-32", (HEAD + GOOD).toByteArray(Charsets.UTF_32), "expected a text log, found binary data"),
            Case(
                "UTF-32 with its mark",
                byteArrayOf(-1, -2, 0, 0) + (HEAD + GOOD).toByteArray(Charsets.UTF_32LE),
                "expected text in UTF-8 or UTF-16, found text in UTF-32",
            ),
            Case("binary", byteArrayOf(0x7f, 0x45, 0x4c, 0x46, 0, 0, 1, 2), "expected a text log, found binary data"),
            cut("after a row", HEAD + GOOD + "\u0000".repeat(500), "5: expected a row of text, found 500 zero bytes"),
            cut("in a row", HEAD + GOOD + "3,45" + "\u0000".repeat(7), "5: expected a row of text, found 7 zero bytes"),
            // What is left of 8.4 is a number.
            cut("in a value", HEAD + GOOD + "3,45.50003,-73.1,8" + "\u0000".repeat(500), "5: expected a row of text"),
            cut(
                "in a column that nobody reads",
                "time_s,x_m,y_m,v,note\n0,0,0,1,a\n1,1,1,1,b\n2,2,2,2,c\n3,3,3,3,d\u0000\u0000",
                "5: expected a row of text, found 2 zero bytes",
                "--value",
                "v",
            ),
            cut("in a time", HEAD + GOOD + "3\u0000,45.5,-73.1,8\n", "5: expected a row of text, found 1 zero byte"),
            cut("before a line's end", HEAD + GOOD + "\u0000\u0000\n", "5: expected a row of text"),
            cut("before rows", HEAD + "\u0000\u0000\n" + GOOD, "2: expected a row of text"),
            cut("among rows", HEAD + "\u0000\u0000" + GOOD + "3,45.5,-73.1,8\n", "2: expected a row of text"),
            cut("of a long file", HEAD + GOOD + "\u0000".repeat(200_000), "5: expected a row of text, found 200000 z"),
            // More than any field may be long.
            cut("of megabytes", HEAD + GOOD + "\u0000".repeat(2_000_000), "5: expected a row of text, found more than"),
            csv("nothing but zeros", "\u0000".repeat(99), "expected a text log, found binary data"),
            csv("zeros in the header", "time_s\u0000" + HEAD + GOOD, "expected a text log, found binary data"),
            csv("zeros and other bytes", HEAD + "\u0000\u0001\n" + GOOD, "expected a text log, found binary data"),
            Case("gzip", byteArrayOf(0x1f, 0x8b.toByte(), 8, 0, 0), "found a gzip archive: unpack it first"),
            Case("workbook", byteArrayOf(0x50, 0x4b, 3, 4, 20, 0), "or a workbook: save its sheet as CSV"),
            Case("PDF", "%PDF-1.4\n".toByteArray(), "expected a text log, found a PDF document"),
            Case(
                "neither UTF-8 nor Windows-1252",
                "time_s,x_m,y_m,t_\u0081\n0,0,0,1\n1,1,1,1\n".toByteArray(Charset.forName("ISO-8859-1")),
                "expected text in UTF-8 or Windows-1252, found another encoding",
            ),
            csv(
                "dates that may be read either way",
                "Date Time,x_m,y_m,v\n05/06/2025 12:00:00,0,0,1\n05/06/2025 12:00:01,1,0,2\n",
                "log.csv:2: column Date Time: expected --date-order dmy or mdy, which no date in the log decides, " +
                    "found '05/06/2025 12:00:00'",
            ),
            csv(
                "a date of another order",
                "Date Time,x_m,y_m,v\n25/06/2025 12:00:00,0,0,1\n06/25/2025 12:00:01,1,0,2\n26/06/2025 1:00,1,0,2\n" +
                    "26/06/2025 1:01,1,0,2\n",
                "log.csv:3: column Date Time: expected a date as day/month/year with the time, found '06/25/2025",
                TEXT,
            ),
            csv(
                "half past 24",
                "Date,Time,x_m,y_m,v\n25/06/2025,12:00,0,0,1\n25/06/2025,24:30,1,0,2\n25/06/2025,12:02,1,0,3\n",
                "log.csv:3: column Time: expected a time of day as 12:00:00 or 12:00:00 PM, found '24:30'",
                TEXT,
            ),
            csv(
                "no such day",
                "Date,Time,x_m,y_m,v\n28/02/2025,12:00,0,0,1\n30/02/2025,12:01,1,0,2\n28/02/2025,12:02,1,0,3\n",
                "log.csv:3: column Date: expected a date as day/month/year, found '30/02/2025'",
                "rows without a date",
            ),
            orderOf("2025-06-25"),
            orderOf("2025/06/25"),
            orderOf("25-Jun-2025"),
            csv(
                "preamble without a table",
                "Logger: 7\nSite: pond\n",
                "log.csv:1: expected",
            ),
            csv(
                "garbage",
                "\u0001\u0002lots of (stuff\n%%\n",
                "log.csv:1: expected a header without control characters, found U+0001",
            ),
        )

        internal const val WITHIN = "a number within -1.0E60..1.0E60"
        internal const val FAR = "expected a fix within 1000 km of the first"
        internal const val FAR_REASON = "fixes more than 1000 km from the first"
        private const val OUT = "rows with a number out of all bounds"
        private const val WRONG_COUNT = "rows with a wrong number of fields"
        private const val TEXT = "rows with text where a number belongs"
    }
}
