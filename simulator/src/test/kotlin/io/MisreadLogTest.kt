package stillwater.io

import org.junit.jupiter.api.assertThrows
import org.junit.jupiter.api.io.TempDir
import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.MethodSource
import java.nio.file.Path
import kotlin.io.path.writeText
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Logs that can be read in more than one way, or only in part, are refused where that shows. */
class MisreadLogTest {
    @TempDir
    private lateinit var directory: Path

    /** @property message what the refusal must say. */
    class Case(
        private val name: String,
        val text: String,
        val message: String,
        val choice: LogChoice = LogChoice(),
    ) {
        override fun toString() = name
    }

    private fun open(text: String, choice: LogChoice = LogChoice()) =
        SurveyLog.open(directory.resolve("log.csv").apply { writeText(text) }, choice)

    @ParameterizedTest
    @MethodSource("cases")
    fun isRefused(case: Case) {
        val problem = assertThrows<LogProblem> { open(case.text, case.choice).readings() }
        assertTrue(case.message in problem.message.orEmpty(), "'${case.message}' is not in '${problem.message}'")
    }

    /** Receivers without a fix say midnight, once or for a while; a log through the night passes a true one. */
    @Test
    fun timesOfDayPassMidnightAtNightOnly() {
        fun seconds(vararg times: String): List<Double> {
            val rows = times.joinToString("") { "$it,0,0,1\n" }
            return open("time,x_m,y_m,v\n$rows", LogChoice(skipBadRows = true)).readings().map { it.time.seconds }
        }
        assertEquals(listOf(86_340.0, 86_400.0, 151_200.0), seconds("23:59", "0:00", "18:00"))
        assertEquals(listOf(82_800.0, 90_000.0, 118_800.0, 158_400.0), seconds("23:00", "1:00", "9:00", "20:00"))
        assertEquals(listOf(68_400.0, 68_460.0, 68_520.0), seconds("19:00", "0:00", "19:01", "19:02"))
        assertEquals(listOf(18_000.0, 18_060.0, 18_120.0), seconds("5:00", "23:59", "23:59", "5:01", "5:02"))
        assertEquals(listOf(50_340.0, 50_400.0, 50_460.0), seconds("13:59", "14:00", "0:00", "0:01", "14:01"))
    }

    @Test
    fun saysHowOftenTimesOfDayPassMidnight() {
        fun warnings(vararg times: String): List<String> {
            val rows = times.joinToString("") { "$it,0,0,1\n" }
            return open("time,x_m,y_m,v\n$rows", LogChoice(skipBadRows = true)).read { _, _, _, _, _ -> }.warnings
        }
        val twice = "times of day pass midnight 2 times, the longest before line 6 with 7.0 h between two rows"
        assertEquals(listOf(twice), warnings("23:00", "1:00", "9:00", "20:00", "3:00"))
        val once = "times of day pass midnight once, before line 3 with 2.0 h between two rows"
        assertEquals(listOf(once), warnings("23:00", "1:00", "9:00"))
        assertEquals(emptyList(), warnings("19:00", "0:00", "19:01", "19:02"))
    }

    @Test
    fun aNightFromTheAfternoonOnIsOneWhereTheUserSaysSo() {
        val rows = listOf("17:50", "17:51", "7:30", "7:31").joinToString("") { "$it,0,0,1\n" }
        fun seconds(hours: Double) = open("time,x_m,y_m,v\n$rows", LogChoice(overnight = hours * 3600)).readings()
            .map { it.time.seconds }
        assertEquals(listOf(64_200.0, 64_260.0, 113_400.0, 113_460.0), seconds(8.0))
        val refused = assertThrows<LogProblem> { seconds(11.0) }.message.orEmpty()
        val expected = "log.csv:4: column time: expected a time after 17:51, or --overnight HOURS if the next day " +
            "begins here, found 07:30"
        assertTrue(expected in refused, refused)
    }

    @Test
    fun summerTimeEndsOnClocksOnTheWallOnly() {
        fun refusal(first: String, second: String, name: String = "Time") =
            assertThrows<LogProblem> { open("$name,x_m,y_m,v\n$first,0,0,8.1\n$second,1,0,8.2\n").readings() }
                .message.orEmpty()
        for (local in listOf(
            refusal("26/10/2025 02:59", "26/10/2025 02:00"),
            refusal("2025-10-26T02:59:59", "2025-10-26T02:00:00"),
        )) {
            assertTrue("summer time may end" in local, local)
        }
        for (other in listOf(
            refusal("2025-10-26T02:59:59Z", "2025-10-26T02:00:00Z"),
            refusal("2025-10-26T02:59:59.5+02:00", "2025-10-26T02:00:00.5+02:00"),
            refusal("26/10/2025 02:59 UTC", "26/10/2025 02:00 UTC"),
            refusal("59", "0", "Time (min)"),
        )) {
            assertTrue("expected a time after" in other && "summer time" !in other, other)
        }
    }

    @Test
    fun nothingIsNearAWordOfOneLetter() {
        assertEquals(null, NearName.of("t", listOf("x", "y")))
        assertEquals("T", NearName.of("t", listOf("x", "T")))
    }

    @Test
    fun timesOfDayAreToldToTheMillisecond() {
        val rows = "00:00:04.2,0,0,1\n00:00:04.1,1,0,1\n"
        val refused = assertThrows<LogProblem> { open("time,x_m,y_m,v\n$rows").readings() }.message.orEmpty()
        assertTrue("expected a time after 00:00:04.200, " in refused && "found 00:00:04.100" in refused, refused)
    }

    /** A fix of four decimals: 0 for 20 rows, then 11 m, at 5 m/s all along. */
    @Test
    fun coarseFixesAreNoFlight() {
        val rows = (0 until 200).joinToString("") { "${it * 0.1},${45 + it / 20 * 1e-4},7,1\n" }
        assertEquals(200, open("Time,Latitude,Longitude,v\n$rows").readings().size)
    }

    @Test
    fun codesInAConditionAreCounted() {
        val choice = LogChoice(value = "v", conditions = mapOf("temperature" to "t"))
        val log = open("time_s,x_m,y_m,v,t\n0,0,0,1,20\n1,0,0,1,-9999\n2,0,0,1,\n3,0,0,1,-9999\n", choice)
        val pass = log.read { _, _, _, _, _ -> }
        assertEquals(4, pass.readings)
        val codes = "column t has 2 numbers that stand for none, such as -9999: temperature is taken for unknown there"
        assertEquals(listOf(codes), pass.warnings)
    }

    companion object {
        private const val TABLE = "Time (s),Latitude,Longitude,DO\n"
        private const val HEAD = "day,t,x_m,y_m,v\n"
        private const val ROWS = "0,45,7,8.1\n1,45,7.0001,8.2\n2,45,7.0002,8.3\n"

        private fun metres(head: String, message: String, choice: LogChoice = LogChoice(), more: String = "") =
            Case(head, "${head}0,0,0,${more}8.1\n1,5,0,${more}8.2\n2,9,0,${more}8.3\n", message, choice)

        private fun times(name: String, unit: String?, vararg times: String, message: String): Case {
            val units = if (unit == null) "" else "$unit,m,m,mg/L\n"
            val rows = times.withIndex().joinToString("") { (k, time) -> "$time,$k,0,8.1\n" }
            return Case("$name as ${times[0]}", "$name,x_m,y_m,v\n$units$rows", message, LogChoice(value = "v"))
        }

        @JvmStatic
        fun cases() = listOf(
            Case(
                "a date beside seconds",
                HEAD + "2025-07-14,28800,0,0,8.1\n2025-07-14,28801,1,0,8.2\n",
                "log.csv:2: column t: expected a time of day as 12:00:00 beside --date, found '28800'",
                LogChoice(date = "day", time = "t", value = "v"),
            ),
            Case(
                "a header that comes again behind lines about the logger",
                "Device: 7\n$TABLE${ROWS}Time (s),Latitude,Longitude,DO\n3,45,7,8\n4,45,7.0001,8\n",
                "log.csv:6: column Time (s): expected seconds",
            ),
            Case(
                "two tables, of which the second begins with an event",
                "Device: 7\n$TABLE${ROWS}rebooted,no fix,no fix,standby\n3,45,7,8\n4,45,7.0001,8\n",
                "log.csv:6: expected one table, found a table from line 2 on and another from here on",
            ),
            Case(
                "two tables of different columns",
                "$TABLE${ROWS}Time (s),Latitude,Longitude,DO,Temp\n3,45,7,8,20\n4,45,7.0001,8,20\n",
                "log.csv:5: expected one table",
            ),
            Case(
                "no more than thousands parted by commas",
                "time_s\tx_m\ty_m\tcond\n0\t0\t0\t998\n1\t1\t0\t999\n2\t2\t0\t1,002\n",
                "log.csv:4: column cond: expected numbers with a decimal point, found '1,002'",
            ),
            metres("Time,x,y,DO\ns,km,km,mg/L\n", "log.csv:2: column x: expected metres, found 'km'"),
            metres("Time,x,y,DO\ninit,init,init,init\n", "log.csv:2: column x: expected metres, found 'init'"),
            metres("Time,x (km),y (km),DO\n", "log.csv:1: column x (km): expected metres"),
            metres("Time,\"x, ft\",\"y, ft\",DO\n", "log.csv:1: column x, ft: expected metres"),
            metres("Time,x (ft),y (ft),DO\n", "x (ft): expected metres", LogChoice(x = "x (ft)", y = "y (ft)")),
            metres("Time,Lat_1,x,y,DO\n", "expected columns lat_deg and lon_deg", LogChoice(value = "DO"), "45,"),
            metres("Time,x,y,z,DO\n", "(--x 'x' --y 'y' if these are metres)", LogChoice(value = "DO"), "9.8,"),
            metres("time_s,x_m,y_m,Odo_mg\n", "no such column; did you mean 'Odo_mg'?", LogChoice(value = "odo mg")),
            metres("time_s,x_m,y_m,odo_mg\n", "no such column; did you mean 'odo_mg'?", LogChoice(value = "odo_mh")),
            metres("time_s,x_m,y_m,odo_mg\n", "found no such column", LogChoice(value = "turbidity")),
            Case(
                "a profile that says where it is by its depth",
                "time_s,depth_m,v\n0,0,8.1\n1,1,8.2\n",
                "or --x (--x 'depth_m' for a profile)",
                LogChoice(value = "v"),
            ),
            Case(
                "metres along a line alone",
                "time_s,x_m,v\n0,0,8.1\n1,1,8.2\n",
                "or --x (--x 'x_m' for a transect)",
                LogChoice(value = "v"),
            ),
            Case(
                "minutes in which the boat would fly",
                "Time,x_m,y_m,v\n0,0,0,8.1\n1,30,0,8.2\n2,60,0,8.3\n",
                "column Time: expected numbers whose unit the name states, as Time (s) does, or --time-unit, found " +
                    "30 m/s between the first rows if they are seconds",
            ),
            Case(
                "--time-unit for what is no number",
                "Time,x_m,y_m,v\n08:00:00,0,0,8.1\n08:01:00,30,0,8.2\n",
                "column Time: expected a number, as --time-unit says, found '08:00:00'",
                LogChoice(timeUnit = TimeUnit.MINUTES),
            ),
            Case(
                "--overnight for times with dates",
                "Time,x_m,y_m,v\n2025-10-26 08:00:00,0,0,8.1\n2025-10-26 08:01:00,30,0,8.2\n",
                "column Time: expected a time of day without a date, as --overnight says, found '2025-10-26 08:00:00'",
                LogChoice(overnight = 8 * 3600.0),
            ),
            Case(
                "--overnight for seconds",
                "Time (s),x_m,y_m,v\n0,0,0,8.1\n60,30,0,8.2\n",
                "column Time (s): expected a time of day without a date, as --overnight says, found '0'",
                LogChoice(overnight = 8 * 3600.0),
            ),
            Case(
                "--overnight for times of day beside dates",
                "Date,Time,x_m,y_m,v\n2025-10-26,08:00:00,0,0,8.1\n2025-10-26,08:01:00,30,0,8.2\n",
                "column Time: expected a time of day without a date, as --overnight says, found '08:00:00' and a date",
                LogChoice(overnight = 8 * 3600.0, value = "v"),
            ),
            Case(
                "the end of summer time",
                "Time,x_m,y_m,v\n2025-10-26 02:59:59,0,0,8.1\n2025-10-26 02:00:00,1,0,8.2\n",
                "log.csv:3: column Time: expected a time after 2025-10-26T02:59:59 (summer time may end here: only " +
                    "times with an offset tell), found 2025-10-26T02:00:00",
            ),
            Case(
                "blanks between columns",
                "Model=made up\n\nDate & Time                  DO\n14-Jul-2025 08:00:00.000    8.1\n" +
                    "14-Jul-2025 08:01:00.000    8.2\n",
                "log.csv:3: expected commas, semicolons or tabs between columns, found blanks",
            ),
            Case(
                "numbers without names, and commas",
                "2014-8-7 22:6:14,1,43.55,69.57,0.15\n2014-8-7 22:6:17,1,43.56,69.57,0.16\n",
                "log.csv:1: expected a header line with column names",
            ),
            Case(
                "numbers without names, and tabs",
                "20.0\t35234.9\t-0.018\n20.0\t1873.1\t-0.019\n",
                "log.csv:1: expected a header line with column names",
            ),
            Case(
                "many rows with blanks between columns",
                "time_s x_m y_m v\n" + (0 until 800).joinToString("") { "$it.0 ${it % 40}.25 1.0 8.$it\n" },
                "log.csv:1: expected commas, semicolons or tabs between columns, found blanks",
            ),
            Case(
                "names of zones",
                "Date Time,x_m,y_m,v\n2018-07-12T14:00:00 EST,0,0,8.1\n2018-07-12T14:00:01 EST,1,0,8.2\n",
                "found '2018-07-12T14:00:00 EST' (names of zones are not read, only Z or an offset as -05:00)",
            ),
            Case(
                "names of zones behind other dates",
                "Date Time,x_m,y_m,v\n07/13/2018 14:00:00 EST,0,0,8.1\n07/13/2018 14:00:01 EST,1,0,8.2\n",
                "found '07/13/2018 14:00:00 EST' (names of zones are not read, only UTC or none)",
            ),
            Case(
                "times since 1970",
                "unix_time_s,x_m,y_m,v\n1752480000.5,0,0,8.1\n1752480000.5,1,0,8.2\n",
                "expected a time after 1752480000.5 s (2025-07-14T08:00:00.5), found 1752480000.5 s",
            ),
            metres("Time,Lat (ddmm.mm),Lon (ddmm.mm),DO\n", "column Lat (ddmm.mm): expected degrees with decimals"),
            metres("Time,Lat,Lon,DO\ns,ddmm.mm,ddmm.mm,mg/L\n", "column Lat: expected degrees, found 'ddmm.mm'"),
            Case(
                "degrees called X and Y",
                "time_s,X,Y,v\n0,7,45,8.1\n1,7.00002,45,8.2\n2,7.00004,45.00001,8.3\n",
                "log.csv:1: column X: expected metres, and --x and --y with so small a track",
            ),
            times("Time", "init", "195.333453", "195.333465", message = "log.csv:2: column Time: expected a unit"),
            times("Time", null, "195.333453", "195.333465", "195.333477", message = "steps are below a millisecond"),
            times("Time", null, "080000", "080001", message = "column Time: expected a time of day as 08:00:00"),
            times("Time,Date", null, "120000,20250714", "120001,20250714", message = "a time of day as 08:00:00"),
            times("Time,Date", null, "0.33333,45852", "0.33334,45852", message = "a time of day as 08:00:00"),
            times("Time (mm:ss)", null, "00:01", "00:02", message = "expected times as 08:00:00, or a name without"),
            Case(
                "a date beside dates",
                HEAD + "2025-07-14,2025-07-14 08:00:00,0,0,8.1\n",
                "column t: expected a time of day as 12:00:00 beside --date",
                LogChoice(date = "day", time = "t", value = "v"),
            ),
        )
    }
}
