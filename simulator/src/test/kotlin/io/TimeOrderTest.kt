package stillwater.io

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Path
import kotlin.io.path.writeText
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

/** One wrong time stamp costs its row and no other; a clock that was set back is told. */
class TimeOrderTest {
    @TempDir
    private lateinit var directory: Path

    private class Found(val times: List<Double>, val pass: LogPass)

    private fun read(text: String, choice: LogChoice): Found {
        val times = ArrayList<Double>()
        val log = SurveyLog.open(directory.resolve("log.txt").apply { writeText(text) }, choice)
        val pass = log.read { time, _, _, _, _ -> times += time.seconds }
        return Found(times, pass)
    }

    private fun csv(times: List<Number>, skip: Boolean = true) = read(
        "time_s,lat_deg,lon_deg,v\n" + times.withIndex().joinToString("") { (i, t) -> "$t,45.000${i + 10},7,$i\n" },
        LogChoice(skipBadRows = skip),
    )

    @Test
    fun oneStampInTheFutureCostsItsRowOnly() {
        for (at in listOf(0, 1, 20, 37)) {
            val times = (0 until 40).map { if (it == at) 1e9 else it.toDouble() }
            val found = csv(times)
            assertEquals(times - 1e9, found.times, "at $at")
            assertEquals(mapOf("times ahead of the rows around them" to 1L), found.pass.skipped, "at $at")
            assertEquals(emptyList(), found.pass.warnings)
        }
    }

    @Test
    fun withoutSkippingTheRowThatIsAheadIsNamed() {
        val problem = assertFailsWith<LogProblem> { csv(listOf(0, 1, 900, 3, 4), skip = false) }
        val expected = "log.txt:4: column time_s: expected a time before 3 s, which the next row has"
        assertContains(problem.message.orEmpty(), expected)
    }

    @Test
    fun whereTheRowsAfterDoNotTellTheSecondOfTwoIsRefused() {
        for ((times, kept) in listOf(
            listOf(0, 1, 3, 2, 4, 5) to listOf(0, 1, 3, 4, 5),
            listOf(0, 1, 2, 3, 2.5) to listOf(0, 1, 2, 3),
            listOf(0, 1, 9, 3, 3, 9, 4, 5) to listOf(0, 1, 3, 4, 5),
            listOf(0, 1, 1, 2) to listOf(0, 1, 2),
            listOf(5, 4) to listOf(5),
        )) {
            val found = csv(times)
            assertEquals(kept.map { it.toDouble() }, found.times, "$times")
            assertEquals((times.size - kept.size).toLong(), found.pass.skipped.values.sum(), "$times")
        }
    }

    @Test
    fun timesThatRunBackwardsAreToldOfTheFirstRowThatDoes() {
        val problem = assertFailsWith<LogProblem> { csv(listOf(9, 8, 7, 6, 5), skip = false) }
        assertContains(problem.message.orEmpty(), "log.txt:3: column time_s: expected a time after 9 s")
        val later = assertFailsWith<LogProblem> { csv(listOf(1, 2, 9, 8, 7, 6), skip = false) }
        assertContains(later.message.orEmpty(), "log.txt:5: column time_s: expected a time after 9 s")
        // A stamp ahead of rows in disorder is still the one that is wrong.
        assertEquals(listOf(2.0, 11.0, 12.0), csv(listOf(2, 900, 10, 9, 11, 12)).times - listOf(9.0, 10.0))
        assertEquals(listOf(9.0), csv(listOf(9, 8, 7, 6, 5)).times)
    }

    @Test
    fun clockThatWasSetBackIsToldWithItsLine() {
        // The week rolls over behind row 20, which stands in line 21.
        val found = csv((604_780 until 604_800).toList() + (0 until 30).toList())
        assertEquals(20, found.times.size)
        assertEquals(mapOf("times going back" to 30L), found.pass.skipped)
        assertContains(found.pass.warnings.single(), "30 rows in a row after line 21 lie before its time")
    }

    private fun line(millis: Int, content: String) = "$millis\tI\t{$content}\n"

    /** A pose and a reading each second; their stamps are [shift] later. */
    private fun platypus(shift: (Int, Boolean) -> Int) = read(
        line(0, "\"date\":\"Thu May 19\",\"time\":1463679383361") + (1..40).joinToString("") { i ->
            val at = "[${592_300 + i},4481762.0,252],\"q\":[1,0,0,0]"
            line(1000 * i + shift(i, false), "\"pose\":{\"p\":$at,\"zone\":\"17North\"}") +
                line(1000 * i + 500 + shift(i, true), "\"sensor\":{\"channel\":1,\"type\":\"ATLAS_DO\",\"data\":[$i]}")
        },
        LogChoice(skipBadRows = true),
    )

    @Test
    fun oneStampAheadInAPlatypusLogCostsItsLineOnly() {
        val found = platypus { i, isReading -> if (i == 12 && isReading) 90_000_000 else 0 }
        assertEquals(39, found.times.size)
        assertEquals(mapOf("times ahead of the rows around them" to 1L), found.pass.skipped)
    }

    @Test
    fun platypusCounterThatStartsAgainIsTold() {
        val found = platypus { i, _ -> if (i < 20) 90_000_000 else 0 }
        assertContains(found.pass.warnings.single(), "lines in a row after line")
    }
}
