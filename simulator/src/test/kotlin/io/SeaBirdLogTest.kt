package stillwater.io

import org.junit.jupiter.api.assertThrows
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Path
import java.util.Locale
import kotlin.io.path.readText
import kotlin.io.path.writeBytes
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Sea-Bird's `.cnv`: made-up files in its form, with the header lines that public ones have. */
class SeaBirdLogTest {
    @TempDir
    private lateinit var directory: Path

    private val track = listOf(
        "timeS: Time, Elapsed [seconds]",
        "latitude: Latitude [deg]",
        "longitude: Longitude [deg]",
        "sbeox0Mg/L: Oxygen, SBE 43 [mg/l]",
        "sigma-é00: Density [sigma-theta, kg/m^3]",
        "flag:  0.000e+00",
    )
    private val scans = listOf(
        "      0.000   45.54372  -73.15357     8.1000    24.1000  0.000e+00",
        "      0.042   45.54373  -73.15357 -9.990e-29    24.1000  0.000e+00",
        "      0.083   45.54374  -73.15357     8.2000 -9.990e-29  0.000e+00",
        "      0.125   45.54375  -73.15357     8.9000    24.1000 -9.990e-29",
        "    100.000   45.54376  -73.15357     8.3000    24.1000  0.000e+00",
    )

    // date -u -d 2023-10-08T12:26:20Z +%s
    private val begin = 1_696_767_980.0

    private fun file(
        names: List<String>,
        rows: List<String>,
        interval: String = "seconds: 0.0416667",
        start: String? = "Oct 08 2023 12:26:20 [NMEA time, first data scan]",
        end: String = "\r\n",
    ): Path {
        val first = listOf("* Sea-Bird SBE 9 Data File:", "* FileName = C:\\made_up.hex", "** Ship: none")
        val columns = names.mapIndexed { i, name -> "# name $i = $name" }
        val times = listOfNotNull("# interval = $interval   ", start?.let { "# start_time = $it" })
        val last = listOf("# bad_flag = -9.990e-29", "# <Sensors count=\"1\" >", "# </Sensors>", "# file_type = ascii")
        val text = (first + columns + times + last + "*END*" + rows).joinToString("") { it + end }
        return directory.resolve("made_up.cnv").apply { writeBytes(text.toByteArray(Charsets.ISO_8859_1)) }
    }

    private fun times(log: SurveyLog) = log.readings().map { it.time.seconds }

    private fun assertTimes(expected: List<Double>, file: Path, choice: LogChoice) {
        val found = times(SurveyLog.open(file, choice))
        assertEquals(expected.size, found.size)
        // 10 µs are what the times are written with.
        expected.zip(found) { e, f -> assertEquals(e, f, 6e-6) }
    }

    @Test
    fun readsTimesFromTheStartAndCountsWhatIsMissingOrMarkedBad() {
        val log = SurveyLog.open(file(track, scans), LogChoice(value = "Oxygen, SBE 43"))
        val pass = log.read { _, _, _, _, _ -> }
        assertEquals("sbeox0Mg/L", log.quantity)
        assertEquals(3, pass.readings)
        assertEquals(mapOf("missing readings" to 1L, "scans marked bad" to 1L), pass.skipped)
        assertEquals(listOf(8.1, 8.2, 8.3), log.readings().map { it.value })
        assertTimes(listOf(begin, begin + 0.083, begin + 100), log.file, LogChoice(value = "sbeox0Mg/L"))
        val said = "Sea-Bird .cnv, times from timeS after Oct 08 2023 12:26:20"
        assertTrue(log.format.startsWith(said), log.format)
    }

    @Test
    fun aColumnThatIsMissingElsewhereLosesNoReading() {
        val pass = SurveyLog.open(file(track, scans), LogChoice(value = "sigma-é00")).read { _, _, _, _, _ -> }
        assertEquals(3, pass.readings)
        assertEquals(mapOf("missing readings" to 1L, "scans marked bad" to 1L), pass.skipped)
    }

    @Test
    fun isWrittenAsCsvWithItsHeaderAndReadAgain() {
        val choice = LogChoice(value = "sbeox0Mg/L")
        val log = SurveyLog.open(file(track, scans), choice)
        val readings = log.readings()
        val added = twice(log)
        val again = directory.resolve("again.csv")
        assertEquals(listOf(2L), AnnotatedLog(listOf(added)).write(again.toFile().outputStream()))
        val text = again.readText(Charsets.ISO_8859_1)
        val row = "1696767980.00000,0.000,45.54372,-73.15357,8.1000,24.1000,0.000e+00,16.2\r\n"
        assertTrue(row in text && "NaN" in text && "-9.990e-29\r\n" !in text.substringAfter("unix_time_s"), text)
        val twice = SurveyLog.open(again, LogChoice(value = "twice")).readings()
        assertEquals(listOf(16.2, 16.4, 16.6), twice.map { it.value })
        assertEquals(readings.map { it.time }, twice.map { it.time })
    }

    @Test
    fun everyColumnOfTimesHasItsUnitAndItsZero() {
        fun timed(name: String, vararg times: String) = file(
            listOf(name, "prdM: Pressure, Strain Gauge [db]", "v: Voltage 0"),
            times.map { "  $it   1.000   2.000" },
        )
        val choice = LogChoice(x = "prdM", value = "v")
        assertTimes(listOf(begin, begin + 90), timed("timeM: Time, Elapsed [minutes]", "0", "1.5"), choice)
        assertTimes(listOf(begin, begin + 1800), timed("timeH: Time, Elapsed [hours]", "0", "0.5"), choice)
        // date -u -d '2000-01-01 UTC + 750083314 sec' +%s
        assertTimes(listOf(1_696_768_114.0), timed("timeQ: Time, NMEA [seconds]", "750083314"), choice)
        assertTimes(listOf(1_696_768_114.0), timed("timeK: Time, Instrument [seconds]", "750083314"), choice)
        // date -u -d 2023-10-08T12:00:00Z +%s; 8 October is the 281st day.
        assertTimes(listOf(1_696_766_400.0), timed("timeJV2: Time, Instrument [julian days]", "281.5"), choice)
        assertTimes(listOf(1_696_766_400.0), timed("timeJ: Julian Days", "281.5"), choice)
    }

    @Test
    fun takesTheTimesThatAreNamed() {
        val names = listOf("timeS: Time, Elapsed [seconds]", "timeM: Time, Elapsed [minutes]", "v: Voltage 0")
        val log = file(names, listOf("0 0 1", "1 2 1"))
        assertTimes(listOf(begin, begin + 1), log, LogChoice(value = "v", needsPlace = false))
        assertTimes(listOf(begin, begin + 120), log, LogChoice(time = "timeM", value = "v", needsPlace = false))
    }

    @Test
    fun countsScansWhereThereIsAnIntervalOnly() {
        val cast = listOf("prdM: Pressure, Strain Gauge [db]", "tv290C: Temperature [ITS-90, deg C]")
        val choice = LogChoice(x = "Pressure, Strain Gauge", value = "tv290C")
        val rows = listOf("1.0 20.0", "2.0 19.0", "3.0 18.0")
        assertTimes(listOf(begin, begin + 0.25, begin + 0.5), file(cast, rows, "seconds: 0.25"), choice)
        assertTimes(listOf(0.0, 0.25, 0.5), file(cast, rows, "seconds: 0.25", start = null, end = "\n"), choice)
    }

    @Test
    fun scansThatWereTakenOutMakeNoLaterOneEarly() {
        val cast = listOf("scan: Scan Count", "prdM: Pressure [db]", "tv290C: Temperature [ITS-90, deg C]")
        val choice = LogChoice(x = "prdM", value = "tv290C")
        val rows = listOf("1001 1.0 20.0", "1002 2.0 19.0", "1401 3.0 18.0")
        val gapped = file(cast, rows, "seconds: 0.25")
        assertTimes(listOf(begin, begin + 0.25, begin + 100), gapped, choice)
        val said = "times from a scan every 0.25 s, as scan counts them, after Oct 08 2023 12:26:20"
        assertTrue(said in SurveyLog.open(gapped, choice).format)
        // The mean of the scans' numbers in a bin is none.
        val type = "seconds: 10\n# binavg_bintype = seconds\n# binavg_binsize = 10"
        val means = listOf("20.5 1.0 20.0", "60.5 2.0 19.0", "100.5 3.0 18.0")
        val binned = file(cast, means, type, end = "\n")
        assertTimes(listOf(begin, begin + 10, begin + 20), binned, choice)
        val format = SurveyLog.open(binned, choice).format
        assertTrue("averaged into bins of seconds: 10" in format, format)
    }

    @Test
    fun scansAreCountedWhereThatIsAskedFor() {
        val names = listOf("scan: Scan Count", "timeJ: Julian Days", "v: Voltage 0")
        val rows = listOf("11 281.500000 1", "12 281.500001 1", "14 281.500001 1")
        val counted = LogChoice(time = "scan", value = "v", needsPlace = false)
        assertTimes(listOf(begin, begin + 0.25, begin + 0.75), file(names, rows, "seconds: 0.25"), counted)
    }

    /** Six decimals of a day are 0.0864 s: at 24 scans a second most times come twice. */
    @Test
    fun daysThatComeTwiceAreSpread() {
        val rows = (0 until 600).map { "%.6f %d".format(Locale.ROOT, 281 + it / 24.0 / 86_400, it) }
        val log = SurveyLog.open(
            file(listOf("timeJ: Julian Days", "v: Voltage 0"), rows),
            LogChoice(value = "v", needsPlace = false),
        )
        assertTrue("times in multiples of 0.0864 s" in log.format, log.format)
        val steps = times(log).zipWithNext { a, b -> b - a }
        assertEquals(599, steps.size)
        assertTrue(steps.all { it > 0.02 && it < 0.07 }, "${steps.min()} to ${steps.max()}")
    }

    @Test
    fun aUnitThatTheFileStatesIsNotAskedFor() {
        val choice = LogChoice(value = "sbeox0Mg/L", timeUnit = TimeUnit.MINUTES)
        for (time in listOf(null, "timeS", "unix_time_s")) {
            val refused = refusal(file(track, scans), choice.copy(time = time))
            val expected = "expected no --time-unit, for a Sea-Bird file states its own (times from timeS after " +
                "Oct 08 2023 12:26:20), found --time-unit min"
            assertTrue(expected in refused, refused)
        }
        // Of a column that is none of Sea-Bird's times nothing is known.
        val own = file(listOf("timeS: Time [seconds]", "minute: Time", "v: V"), listOf("0 0 1", "1 2 1"))
        val named = LogChoice(time = "minute", value = "v", timeUnit = TimeUnit.MINUTES, needsPlace = false)
        assertTimes(listOf(0.0, 120.0), own, named)
    }

    private fun refusal(file: Path, choice: LogChoice = LogChoice()) =
        assertThrows<LogProblem> { SurveyLog.open(file, choice).readings() }.message.orEmpty()

    private fun refusal(text: String) =
        refusal(directory.resolve("made_up.cnv").apply { writeBytes(text.toByteArray()) })

    @Test
    fun saysWhatCannotBeRead() {
        val binned = refusal(file(listOf("prdM: Pressure [db]", "v: V"), listOf("1 2", "2 2"), "decibars: 1"))
        assertTrue("made_up.cnv:12: expected a column timeS" in binned, binned)
        val hex = refusal("* Sea-Bird SBE 19plus Data File:\n*END*\n0A53711BC722C14C\n")
        assertTrue("made_up.cnv:2: expected lines '# name 0 = ...' before *END*" in hex, hex)
        val endless = refusal("* Sea-Bird SBE 19plus Data File:\n# name 0 = timeS: Time\n")
        assertTrue("expected a line *END*" in endless, endless)
        val gapped = refusal("* Sea-Bird SBE 9 Data File:\n# name 1 = timeS: Time\n*END*\n1\n")
        assertTrue("in their order" in gapped, gapped)
        val binary = refusal("* Sea-Bird SBE 9 Data File:\n# name 0 = timeS: Time\n*END*\n\u0000\u0001\u0000")
        assertTrue("binary data: convert it to file_type = ascii" in binary, binary)
        val short = refusal(file(track, scans + "101.0 45.54376"), LogChoice(value = "sbeox0Mg/L"))
        assertTrue("made_up.cnv:22: expected 7 fields as in the header, found 3" in short, short)
        val noPlace = refusal(file(listOf("timeS: Time", "depSM: Depth [m]", "v: V"), listOf("0 1 2", "1 1 2")))
        assertTrue("(--x 'depSM' for a profile)" in noPlace, noPlace)
    }

    /** Fathom, the program that came after Data Conversion, tells the columns in lines of XML. */
    @Test
    fun readsTheColumnsThatFathomTellsInXml() {
        val ids = listOf("timeS" to "Time", "latitude" to "", "longitude" to "", "t090C" to "Temperature")
        val columns = ids.flatMapIndexed { i, (id, name) ->
            listOfNotNull(
                "#         <Column Number='$i' ID='$id'>",
                "#           <Name>$name</Name>".takeIf { name.isNotEmpty() },
                "#           <Units>deg C</Units>".takeIf { id == "t090C" },
                "#         </Column>",
            )
        }
        val head = listOf("* Sea-Bird SBE19plus Data File:", "* FileName = made_up.hex") +
            "# <FathomProcessing Version=2.1.7>" + "#       <BadFlag>-9.99e-29</BadFlag>" + "#       <Columns>" +
            columns + "#       </Columns>" + "# </FathomProcessing>" + "*END*"
        val rows = listOf("19.967", "-9.99e-29", "16.05").mapIndexed { i, value -> "$i  45.5437$i  -73.15357  $value" }
        val file = directory.resolve("made_up.cnv").apply { writeBytes((head + rows).joinToString("\n").toByteArray()) }
        val log = SurveyLog.open(file, LogChoice(value = "Temperature"))
        assertEquals("t090C", log.quantity)
        assertEquals(listOf(19.967, 16.05), log.readings().map { it.value })
        assertEquals(listOf(0.0, 2.0), times(log))
    }
}
