package stillwater.io

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Path
import java.time.LocalTime
import kotlin.io.path.writeText
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

/** Logs whose times were cut to whole seconds or minutes are read with what was cut off given back. */
class RoundedLogTest {
    @TempDir
    private lateinit var directory: Path

    private class Found(val log: SurveyLog, val times: List<Double>, val pass: LogPass)

    private fun read(text: String, choice: LogChoice = LogChoice(value = "v")): Found {
        val times = ArrayList<Double>()
        val log = SurveyLog.open(directory.resolve("log.csv").apply { writeText(text) }, choice)
        val pass = log.read { time, _, _, _, _ -> times += time.seconds }
        return Found(log, times, pass)
    }

    /** Five rows a second, each in whole seconds. */
    private fun seconds(rows: Int, value: (Int) -> String = { "$it" }) =
        "Time (s),x_m,y_m,v\n" + (0 until rows).joinToString("") { "${it / 5},${it / 10.0},0,${value(it)}\n" }

    @Test
    fun fiveRowsASecondAreAFifthOfASecondApart() {
        val found = read(seconds(100))
        for ((a, b) in found.times.zipWithNext()) assertEquals(0.2, b - a, 0.003)
        assertEquals("survey CSV, times in whole seconds, times from Time (s)", found.log.format)
        assertContains(found.pass.warnings.single(), "times are whole seconds (80 rows of the time of the row before)")
        assertEquals(100, found.pass.readings)
        assertEquals(emptyMap(), found.pass.skipped)
    }

    @Test
    fun rowsWithoutAReadingKeepTime() {
        val found = read(seconds(100) { if (it % 10 in 3..7) "" else "$it" })
        assertEquals(50, found.times.size)
        for ((a, b) in found.times.zipWithNext()) assertEquals(if (b - a > 0.7) 1.2 else 0.2, b - a, 0.02)
        assertEquals(mapOf("missing readings" to 50L), found.pass.skipped)
    }

    @Test
    fun timesOfDayWithoutSecondsAreSpreadOverTheMinute() {
        val rows = (0 until 60).joinToString("") { "${LocalTime.of(8, 58).plusMinutes(it / 6L)},$it,0,$it\n" }
        val found = read("time,x_m,y_m,v\n$rows")
        for ((a, b) in found.times.zipWithNext()) assertEquals(10.0, b - a, 0.3)
        assertContains(found.log.format, "times in whole minutes")
    }

    @Test
    fun aClockThatStoodStillIsNoRounding() {
        val rows = (0 until 200).map { if (it < 100) it / 5 else 20 + maxOf(0, it - 140) / 5 }
        val text = "time_s,x_m,y_m,v\n" + rows.withIndex().joinToString("") { (i, time) -> "$time,$i,0,$i\n" }
        val problem = assertFailsWith<LogProblem> { read(text) }
        assertContains(problem.message.orEmpty(), "column time_s: expected a time after 20 s, found 20 s")
        val found = read(text, LogChoice(value = "v", skipBadRows = true))
        assertEquals(setOf("duplicate times"), found.pass.skipped.keys)
        assertEquals(200, found.times.size + found.pass.skipped.values.sum().toInt())
    }

    @Test
    fun severalSensorsBelowEachOtherAreNoRounding() {
        for ((name, labels) in listOf("parameter" to listOf("temp", "odo"), "sensor_id" to listOf("3", "12"))) {
            val rows = (0 until 100).joinToString("") { "${it / 2},$it,0,${labels[it % 2]},${20 - it % 2 * 12}\n" }
            val problem = assertFailsWith<LogProblem> { read("time_s,x_m,y_m,$name,v\n$rows") }
            val expected = "expected a time after 0 s, or one $name alone, not several in turn, found 0 s"
            assertContains(problem.message.orEmpty(), expected)
        }
        // Words that stay tell nothing apart.
        assertEquals(100, read(seconds(100).replace("\n", ",ok\n").replace("v,ok", "v,state")).times.size)
    }

    @Test
    fun aTimeThatComesTwiceBesideOtherWordsIsAFault() {
        val rows = (0 until 50).map { "$it,$it,0,a,$it" }.toMutableList()
        rows[20] = "19,20,0,b,20"
        val text = "time_s,x_m,y_m,note,v\n" + rows.joinToString("\n")
        val problem = assertFailsWith<LogProblem> { read(text) }
        assertContains(problem.message.orEmpty(), "expected a time after 19 s, found 19 s")
    }

    @Test
    fun twoBoatsInTurnAreNoRounding() {
        for ((names, place) in listOf("x_m,y_m" to "5,%d", "lat_deg,lon_deg" to "45.00%d,7")) {
            val rows = (0 until 100).joinToString("") { "${it / 2},${place.format(it % 2 * 300)},$it\n" }
            val problem = assertFailsWith<LogProblem> { read("time_s,$names,v\n$rows") }
            assertContains(problem.message.orEmpty(), "expected a time after 0 s, found 0 s")
        }
    }

    @Test
    fun aWrongTimeAmongThemCostsItsRowOnly() {
        val rows = (0 until 100).map { if (it == 41) 5000 else it / 5 }
        val text = "time_s,x_m,y_m,v\n" + rows.withIndex().joinToString("") { (i, time) -> "$time,$i,0,$i\n" }
        val found = read(text, LogChoice(value = "v", skipBadRows = true))
        assertEquals(mapOf("times ahead of the rows around them" to 1L), found.pass.skipped)
        assertEquals(99, found.times.size)
        assertTrue(found.times.zipWithNext().all { (a, b) -> b > a })
    }
}
