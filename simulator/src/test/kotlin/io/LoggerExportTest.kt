package stillwater.io

import org.junit.jupiter.api.io.TempDir
import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.MethodSource
import stillwater.model.BoatTime
import java.nio.charset.Charset
import java.nio.file.Path
import kotlin.io.path.writeBytes
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/**
 * Files laid out as loggers and spreadsheets lay them out, all made up here, hold the same three readings: 8.1, 8.2 and
 * 8.3 at intervals of a minute, and what was taken for what is said.
 */
class LoggerExportTest {
    @TempDir
    private lateinit var directory: Path

    /** @property first time of the first reading, s. @property said what the format must say. */
    class Case(
        private val name: String,
        val text: String,
        val said: String,
        val first: Double,
        val choice: LogChoice = LogChoice(),
        val skipped: Map<String, Long> = emptyMap(),
        val charset: Charset = Charsets.UTF_8,
    ) {
        override fun toString() = name
    }

    private fun file(case: Case): Path =
        directory.resolve("log.csv").apply { writeBytes(case.text.toByteArray(case.charset)) }

    @ParameterizedTest
    @MethodSource("cases")
    fun isReadAndSaysWhatWasTakenForWhat(case: Case) {
        val log = SurveyLog.open(file(case), case.choice)
        val times = ArrayList<Double>()
        val values = ArrayList<Double>()
        val pass = log.read { time: BoatTime, _, _, value, _ ->
            times += time.seconds
            values += value
        }
        assertEquals(listOf(8.1, 8.2, 8.3), values)
        // A spreadsheet's days have five decimals here: nearly half a second either way.
        val step = if ("spreadsheet" in case.said) 0.9 else 1e-6
        listOf(0.0, 60.0, 120.0).zip(times) { after, time -> assertEquals(case.first + after, time, step) }
        assertTrue(case.said in log.format, "'${case.said}' is not in '${log.format}'")
        assertEquals(case.skipped, pass.skipped)
        assertEquals(linesBelowTheHeader(case, log), pass.readings + pass.skipped.values.sum())
    }

    /** Every line below the header is a reading or counted for what it is. */
    private fun linesBelowTheHeader(case: Case, log: SurveyLog): Long {
        val headerLine = (log as CsvSurvey).layout.headerLine
        return case.text.removeSuffix("\n").lines().size.toLong() - headerLine
    }

    @ParameterizedTest
    @MethodSource("cases")
    fun everyRowIsFoundAgainWhenItIsWrittenWithMore(case: Case) {
        val log = SurveyLog.open(file(case), case.choice)
        val readings = log.readings()
        val added = twice(log)
        val again = directory.resolve("again.csv")
        AnnotatedLog(listOf(added)).write(again.toFile().outputStream())
        val twice = SurveyLog.open(again, case.choice.copy(value = "twice")).readings()
        assertEquals(listOf(16.2, 16.4, 16.6), twice.map { it.value })
        assertEquals(readings.map { it.time }, twice.map { it.time })
    }

    @Test
    fun aDateAboveTheTwelfthDecidesHoweverLateItComes() {
        val rows = (1..28).joinToString("") { "$it/06/2025 10:00,$it,0,$it\n" }
        val log = directory.resolve("log.csv").apply { writeBytes("date time,x_m,y_m,v\n$rows".toByteArray()) }
        val opened = SurveyLog.open(log)
        assertTrue("dates as day/month/year, as line 14 shows" in opened.format, opened.format)
        val days = opened.readings().zipWithNext { a, b -> b.time.seconds - a.time.seconds }
        assertTrue(days.all { it == 86_400.0 }, "$days")
    }

    companion object {
        // date -u -d 2025-07-14T08:00:00Z +%s
        private const val EIGHT = 1_752_480_000.0
        private const val AT_EIGHT = 28_800.0
        private val WINDOWS = Charset.forName("windows-1252")

        private const val MISSING = "time_s,x_m,y_m,v\n0,0,0,8.1\n10,0,0,\n20,0,0,NaN\n30,0,0,n/a\n40,0,0,---\n" +
            "50,0,0,NULL\n60,1,0,8.2\n70,1,0,-9999\n120,2,0,8.3\n"

        @JvmStatic
        fun cases() = exports() + people() + stamps() + listOf(
            Case(
                "codes for missing numbers beside an empty condition, and as a place",
                "time_s,x_m,y_m,v,ref\n0,0,0,8.1,\n30,0,0,-9999,\n40,-9999,0,9,9\n50,0,-9999,9,\n60,1,0,8.2,8\n" +
                    "120,2,0,8.3,\n",
                "survey CSV",
                0.0,
                LogChoice(value = "v", conditions = mapOf("reference" to "ref")),
                mapOf("codes for a missing reading" to 1, "rows without a position" to 2),
            ),
            Case(
                "the code of exchange files of cruises",
                "time_s,x_m,y_m,v\n0,0,0,8.1\n30,0,0,-999\n40,0,0,-999.00\n60,1,0,8.2\n120,2,0,8.3\n",
                "survey CSV",
                0.0,
                skipped = mapOf("codes for a missing reading" to 2),
            ),
            Case(
                "a logger's settings between the names and the rows",
                "Date,Time,x_m,y_m,v\nDISPLAY OPTIONS\nType=made up\n2025-07-14,08:00:00,0,0,8.1\n" +
                    "2025-07-14,08:01:00,1,0,8.2\n2025-07-14,08:02:00,2,0,8.3\n",
                "survey CSV",
                1_752_480_000.0,
                LogChoice(value = "v", skipBadRows = true),
                mapOf("rows with a wrong number of fields" to 2),
            ),
            Case(
                "missing readings",
                MISSING,
                "survey CSV",
                0.0,
                skipped = mapOf("missing readings" to 5, "codes for a missing reading" to 1),
            ),
            Case(
                "no position, empty rows, remarks and a summary",
                "time_s,lat_deg,lon_deg,v\n0,45,7,8.1\n30,,,9\n# rebooted\n60,45,7.0001,8.2\n120,45,7.0002,8.3\n,,,\n" +
                    "Mean,,,8.2\n",
                "survey CSV",
                0.0,
                skipped = mapOf(
                    "rows without a position" to 1,
                    "remarks" to 1,
                    "empty rows" to 1,
                    "lines that sum up" to 1,
                ),
            ),
            Case(
                "a summary behind a number of the row",
                "id,time_s,x_m,y_m,v\n0,0,0,0,8.1\n1,60,1,0,8.2\n2,120,2,0,8.3\nSum,180,3,0,24.6\n",
                "survey CSV",
                0.0,
                LogChoice(value = "v"),
                mapOf("lines that sum up" to 1),
            ),
            Case(
                "a boat called Max",
                "boat,time_s,x_m,y_m,v\nAnn,0,0,0,8.1\nMax,60,1,0,8.2\nAnn,120,2,0,8.3\n",
                "survey CSV",
                0.0,
                LogChoice(value = "v"),
            ),
            Case(
                "two columns of one name",
                "time_s,x_m,y_m,temp,temp\n0,0,0,8.1,1\n60,1,0,8.2,1\n120,2,0,8.3,1\n",
                "survey CSV",
                0.0,
                LogChoice(value = "temp#1"),
            ),
        )

        /** As the programs of loggers lay their files out. */
        private fun exports() = listOf(
            Case(
                "miniDOT: preamble, header, line of units",
                "MiniDOT made up\nSensor: 1\nDO compensated for salinity: 0.0 ppt\n\n" +
                    "Unix Timestamp, UTC_Date_&_Time, Battery, x, y, Dissolved Oxygen\n" +
                    "(Second), (none), (Volt), (m), (m), (mg/l)\n" +
                    "1752480000, 2025-07-14 08:00:00, 3.5, 0, 0, 8.1\n" +
                    "1752480060, 2025-07-14 08:01:00, 3.5, 1, 0, 8.2\n" +
                    "1752480120, 2025-07-14 08:02:00, 3.5, 2, 0, 8.3\n",
                "header in line 5, units in line 6, places from x and y, times from Unix Timestamp",
                EIGHT,
                LogChoice(value = "Dissolved Oxygen"),
                mapOf("lines of units" to 1),
            ),
            Case(
                "a table of flags before that of readings",
                "Flag,Meaning\n1,good\n2,bad\n\nTime (s),x_m,y_m,DO,Flag\n0,0,0,8.1,1\n60,1,0,8.2,1\n120,2,0,8.3,1\n",
                "header in line 5",
                0.0,
            ),
            Case(
                "HOBO: title, short years, AM and PM, rows of events",
                "\"Plot Title: 7\"\n" +
                    "\"#\",\"Date Time, GMT-05:00\",\"DO, mg/L (LGR S/N: 1)\",\"x_m\",\"y_m\",\"Detached\"\n" +
                    "1,07/14/25 08:00:00 AM,8.1,0,0,\n2,07/14/25 08:00:30 AM,,0,0,Logged\n" +
                    "3,07/14/25 08:01:00 AM,8.2,1,0,\n4,07/14/25 08:02:00 AM,8.3,2,0,\n",
                "header in line 2, dates as month/day/year, as line 3 shows",
                EIGHT,
                LogChoice(value = "DO, mg/L (LGR S/N: 1)"),
                mapOf("missing readings" to 1),
            ),
            Case(
                "EXO: padded preamble, means before the header, date and time apart, Latin-1",
                "KOR made up,,,,,\nSerial,1,,,,\n,,,MEAN:,8.2,1\n" +
                    "Date (MM/DD/YYYY),Time (HH:mm:ss),Time (Fract. Sec),x_m,ODO mg/L,Cond µS/cm\n" +
                    "07/11/2025,08:00:00,0,0,8.1,1\n07/11/2025,08:01:00,0,1,8.2,2\n07/11/2025,08:02:00,0,2,8.3,3\n",
                "header in line 4, text in Windows-1252, times from Date (MM/DD/YYYY) and Time (HH:mm:ss), " +
                    "dates as month/day/year, as the column's name says",
                EIGHT - 3 * 86_400,
                LogChoice(value = "ODO mg/L", x = "x_m"),
                charset = WINDOWS,
            ),
            Case(
                "Campbell: a line about the logger, header, units, kinds",
                "\"TOA5\",\"s\",\"CR1000\",\"1\",\"a\"\n\"TIMESTAMP\",\"RECORD\",\"Lat\",\"Lon\",\"DO\"\n" +
                    "\"TS\",\"RN\",\"deg\",\"deg\",\"mg/L\"\n\"\",\"\",\"Smp\",\"Smp\",\"Avg\"\n" +
                    "\"2025-07-14 08:00:00\",0,45,7,8.1\n\"2025-07-14 08:00:30\",1,45,7,\"NAN\"\n" +
                    "\"2025-07-14 08:01:00\",2,45,7.0001,8.2\n\"2025-07-14 08:02:00\",3,45,7.0002,8.3\n",
                "header in line 2, units in lines 3 to 4, places from Lat and Lon, times from TIMESTAMP",
                EIGHT,
                skipped = mapOf("lines of units" to 2, "missing readings" to 1),
            ),
            Case(
                "RBR: Time to the millisecond",
                "Time,x_m,y_m,Dissolved O2\n2025-07-14 08:00:00.000,0,0,8.1\n2025-07-14 08:01:00.000,1,0,8.2\n" +
                    "2025-07-14 08:02:00.000,2,0,8.3\n",
                "times from Time",
                EIGHT,
            ),
        )

        private fun iso(time: String, rest: String) = "2025-07-14T$time,$rest\n"

        /** Times of day, some of them wrong, and dates with a T. */
        private fun stamps() = listOf(
            Case(
                "rows without readings first, whose times have a T",
                "Timestamp,x_m,y_m,DO\n" + iso("07:58:00Z", ",,") + iso("07:59:00Z", ",,") +
                    iso("08:00:00Z", "0,0,8.1") +
                    iso("08:01:00Z", "1,0,8.2") + iso("08:02:00Z", "2,0,8.3"),
                "survey CSV, times from Timestamp",
                EIGHT,
                skipped = mapOf("rows without a position" to 2),
            ),
            Case(
                "words beside times with a T",
                "Device: 7\nTimestamp,Crew,x_m,y_m,DO\n" + iso("08:00:00Z", "Ann,0,0,8.1") +
                    iso("08:01:00Z", "Ann,1,0,8.2") + iso("08:02:00Z", "Ann,2,0,8.3"),
                "header in line 2, times from Timestamp",
                EIGHT,
                LogChoice(value = "DO"),
            ),
            stamp("midnight by day", "08:00:00,0,0,8.1\n00:00:00,1,0,9\n08:01:00,1,0,8.2\n", "times going back"),
            stamp("midnight in a short row", "08:00:00,0,0,8.1\n00:00:00,1\n08:01:00,1,0,8.2\n", WIDTH),
            stamp("an evening by night", "08:00:00,0,0,8.1\n23:59:59,1,0,9\n08:01:00,1,0,8.2\n", AHEAD),
        )

        private const val WIDTH = "rows with a wrong number of fields"
        private const val AHEAD = "times ahead of the rows around them"

        /** Times of day of which one is wrong: no other row is moved by it. */
        private fun stamp(name: String, rows: String, reason: String) = Case(
            name,
            "time,x_m,y_m,v\n${rows}08:02:00,2,0,8.3\n",
            "times of day without a date",
            AT_EIGHT,
            LogChoice(skipBadRows = true),
            mapOf(reason to 1),
        )

        /** As people and spreadsheets write. */
        private fun people() = listOf(
            Case(
                "semicolons, decimal commas, day first",
                "sep=;\nDatum;Latitude;Longitude;DO\n" +
                    "14.07.2025 08:00;45,0;7,0;8,1\n14.07.2025 08:01;45,0;7,0001;8,2\n" +
                    "14.07.2025 08:02;45,0;7,0002;8,3\n",
                "semicolon separated, header in line 2, decimal commas, dates as day/month/year, as line 3 shows",
                EIGHT,
                LogChoice(time = "Datum"),
            ),
            Case(
                "semicolons, decimal commas, names with commas",
                "Time, s;x, m;y, m;DO, mg/L\n0,0;0,0;0,0;8,1\n60,0;1,0;0,0;8,2\n120,0;2,0;0,0;8,3\n",
                "semicolon separated, decimal commas",
                0.0,
            ),
            Case(
                "names of one's own in capitals",
                "TIME_S,X_M,Y_M,DO\n0,0,0,8.1\n60,1,0,8.2\n120,2,0,8.3\n",
                "places from X_M and Y_M, times from TIME_S",
                0.0,
            ),
            Case(
                "a date before a table of two columns",
                "Date,14/07/2025\nLatitude,45.5\nTime (s),DO\n0,8.1\n60,8.2\n120,8.3\n",
                "header in line 3",
                0.0,
                LogChoice(needsPlace = false),
            ),
            Case(
                "comments, one of them the header",
                "# made up\n# time_s, x_m, y_m, v\n0,0,0,8.1\n60,1,0,8.2\n120,2,0,8.3\n",
                "header in line 2",
                0.0,
            ),
            Case(
                "keys and values before a table of more columns",
                "Device,EXO\nSerial,12\nInterval,1\n" +
                    "Time (s),Latitude,Longitude,DO\n0,45,7,8.1\n60,45,7,8.2\n120,45,7,8.3\n",
                "header in line 4",
                0.0,
            ),
            Case(
                "asked for day first",
                "date,time,x_m,y_m,v\n" +
                    "05/06/2025,08:00:00,0,0,8.1\n05/06/2025,08:01:00,1,0,8.2\n05/06/2025,08:02:00,2,0,8.3\n",
                "dates as day/month/year, as asked for",
                EIGHT - 39 * 86_400,
                LogChoice(dateOrder = DateOrder.DAY_FIRST),
            ),
            Case(
                "a date that is the same either way",
                "date,time,x_m,y_m,v\n" +
                    "05/05/2025,8:00 a.m.,0,0,8.1\n05/05/2025,8:01 a.m.,1,0,8.2\n05/05/2025,8:02 am,2,0,8.3\n",
                "times from date and time",
                EIGHT - 70 * 86_400,
            ),
            Case(
                "name of the month",
                "date_time,x_m,y_m,v\n" +
                    "14-Jul-2025 08:00,0,0,8.1\n14-Jul-2025 08:01,1,0,8.2\n14-Jul-2025 08:02,2,0,8.3\n",
                "times from date_time",
                EIGHT,
            ),
            Case(
                "times of day across midnight",
                "time,x_m,y_m,v\n23:59:00,0,0,8.1\n00:00:00,1,0,8.2\n00:01:00,2,0,8.3\n",
                "times of day without a date",
                AT_EIGHT * 3 - 60,
            ),
            Case(
                "hours",
                "time_h,x_m,y_m,v\n8,0,0,8.1\n8.016666666667,1,0,8.2\n8.033333333333,2,0,8.3\n",
                "times in units of 3600.0 s, by the column's name",
                AT_EIGHT,
            ),
            Case(
                "milliseconds",
                "unix_ms,x_m,y_m,v\n1752480000000,0,0,8.1\n1752480060000,1,0,8.2\n1752480120000,2,0,8.3\n",
                "times in units of 0.001 s, by the column's name",
                EIGHT,
            ),
            Case(
                "milliseconds in brackets with more",
                "Time Stamp (UTC ms),x_m,y_m,v\n0,0,0,8.1\n60000,1,0,8.2\n120000,2,0,8.3\n",
                "times in units of 0.001 s, by the column's name",
                0.0,
            ),
            Case(
                "minutes by the line of units",
                "Time,x,y,DO\nmin,m,m,mg/L\n0,0,0,8.1\n1,1,0,8.2\n2,2,0,8.3\n",
                "units in line 2, times in units of 60.0 s, by the line of units",
                0.0,
                skipped = mapOf("lines of units" to 1),
            ),
            Case(
                "minutes that nothing states",
                "Time,x_m,y_m,v\n0,0,0,8.1\n1,30,0,8.2\n2,60,0,8.3\n",
                "times in units of 60.0 s, as asked for",
                0.0,
                LogChoice(timeUnit = TimeUnit.MINUTES),
            ),
            Case(
                "x, y and z in metres, below and in their names",
                "time_s,x,y,z (m),DO\ns,m,m,,mg/L\n0,0,0,1,8.1\n60,1,0,1,8.2\n120,2,0,1,8.3\n",
                "places from x and y",
                0.0,
                LogChoice(value = "DO"),
                mapOf("lines of units" to 1),
            ),
            Case(
                "a separator at the end of the lines, UTC behind the times",
                "Timestamp,x_m,y_m,v,\n2025-07-14 08:00:00 UTC,0,0,8.1,\n2025-07-14 08:01:00 UTC,1,0,8.2,\n" +
                    "2025-07-14 08:02:00 UTC,2,0,8.3,\n",
                "times from Timestamp",
                EIGHT,
            ),
            Case(
                "seconds that could be a spreadsheet's days",
                "update_s,x_m,y_m,v\n25000,0,0,8.1\n25060,1,0,8.2\n25120,2,0,8.3\n",
                "survey CSV",
                25_000.0,
                LogChoice(time = "update_s"),
            ),
            Case(
                "a spreadsheet's days",
                "Date Time,x_m,y_m,v\n45852.33333,0,0,8.1\n45852.33403,1,0,8.2\n45852.33472,2,0,8.3\n",
                "times as a spreadsheet's days",
                EIGHT,
            ),
        )
    }
}
