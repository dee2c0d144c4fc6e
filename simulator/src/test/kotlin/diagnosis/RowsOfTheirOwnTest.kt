package stillwater.diagnosis

import org.junit.jupiter.api.io.TempDir
import stillwater.io.LogChoice
import stillwater.io.LogPass
import stillwater.io.SurveyLog
import stillwater.model.Conditions
import java.nio.file.Path
import kotlin.io.path.writeText
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertNotSame
import kotlin.test.assertSame

/** Columns that hardly ever stand in one row with the readings are taken at the readings' times. */
class RowsOfTheirOwnTest {
    @TempDir
    private lateinit var directory: Path

    private val names = mapOf(REFERENCE to "sample", Conditions.TEMPERATURE to "temp_c")
    private val rows = 200

    private fun log(
        text: String,
        conditions: Map<String, String> = names,
        keepsUnread: Boolean = true,
    ): SurveyLog {
        val file = directory.resolve("log.csv").apply { writeText("time_s,probe,sample,temp_c,heading\n$text") }
        val choice =
            LogChoice(value = "probe", conditions = conditions, needsPlace = false, keepsUnread = keepsUnread)
        return RowsOfTheirOwn.of(SurveyLog.open(file, choice), choice, REFERENCE)
    }

    private class Row(val time: Double, val value: Double, val conditions: Conditions)

    private fun read(log: SurveyLog): Pair<List<Row>, LogPass> {
        val rows = ArrayList<Row>()
        val pass = log.read { time, _, _, value, conditions -> rows += Row(time.seconds, value, conditions) }
        return rows to pass
    }

    /** The probe every second, the sample a quarter of a second later, the temperature half a second later. */
    private fun apart() = (0 until rows).joinToString("") {
        "$it,${it / 10.0},,,\n$it.25,,${it + 0.25},,\n$it.5,,,${20 + it + 0.5},\n"
    }

    @Test
    fun numbersAreTakenInProportionToTime() {
        for (keepsUnread in listOf(true, false)) {
            val log = log(apart(), keepsUnread = keepsUnread)
            assertNotSame(log, log.asWritten)
            val (read, pass) = read(log)
            // Behind the last reading there is none whose times would be in order.
            assertEquals(List(rows) { it.toDouble() }, read.map { it.time })
            assertEquals(List(rows) { it / 10.0 }, read.map { it.value })
            for (row in read.drop(1).dropLast(1)) {
                assertEquals(row.time, row.conditions[REFERENCE], 1e-9)
                assertEquals(20 + row.time, row.conditions[Conditions.TEMPERATURE], 1e-9)
            }
            assertEquals(rows.toLong(), pass.readings)
            assertContains(
                pass.warnings,
                "the column sample stands in rows of its own (199 rows): at the readings' times it was taken from " +
                    "the numbers before and after, in proportion to time",
            )
        }
    }

    @Test
    fun rowsOfOneTimeAreOne() {
        val before = (0 until rows).joinToString("") { "$it,,$it.5,,\n$it,$it,,,\n" }
        val after = (0 until rows).joinToString("") { "$it,$it,,,\n$it,,$it.5,,\n" }
        for (text in listOf(before, after)) {
            val timed = text.replace(Regex("(?m)^(\\d+)"), "$1.125")
            for (keepsUnread in listOf(true, false)) {
                val (read, _) = read(log(timed, mapOf(REFERENCE to "sample"), keepsUnread))
                assertEquals(List(rows) { it + 0.125 }, read.map { it.time })
                for (row in read) assertEquals(row.value + 0.5, row.conditions[REFERENCE])
            }
        }
    }

    @Test
    fun stepsFromOneSensorToTheNextAreNoRoundedTimes() {
        val text = (0 until rows).joinToString("") { "$it.0,$it,,,\n$it.4,,${it + 0.4},,\n$it.7,,,20,\n" }
        val (read, _) = read(log(text))
        assertEquals(List(rows) { it.toDouble() }, read.map { it.time })
    }

    @Test
    fun headingsGoTheShorterWayRound() {
        val text = (0 until rows).joinToString("") { "$it,$it,,,\n$it.5,,,,${if (it % 2 == 0) 359 else 3}\n" }
        val (read, _) = read(log(text, mapOf(Conditions.HEADING to "heading")))
        // Behind the last reading, and before the first, there is none to turn to.
        val turns = read.filter { !it.value.isNaN() }.drop(1).dropLast(1).map { row ->
            Math.floorMod(Math.round(row.conditions[Conditions.HEADING]), 360L)
        }
        assertEquals(setOf(1L), turns.toSet())
    }

    @Test
    fun whatIsTooFarOffIsNotKnown() {
        val text = (0 until rows).joinToString("") {
            "$it,$it,,,\n" + if (it in 60..139) "" else "$it.5,,$it.5,,\n"
        }
        val (read, _) = read(log(text, mapOf(REFERENCE to "sample")))
        val unknown = read.filter { it.conditions[REFERENCE].isNaN() }.map { it.time }
        assertEquals(List(21) { 90.0 + it }, unknown)
    }

    @Test
    fun logsWithoutSuchRowsAreReadAsTheyAre() {
        val whole = (0 until rows).joinToString("") { "$it,$it,$it,20,\n" }
        val missing = (0 until rows).joinToString("") { "$it,${if (it % 3 == 0) "" else it},$it,20,\n" }
        // Samples a hundred seconds apart say nothing of the truth between them.
        val rare = (0 until rows).joinToString("") { "$it,$it,,,\n" + if (it % 100 == 0) "$it.5,,$it.5,,\n" else "" }
        for (text in listOf(whole, missing, rare)) {
            val file = directory.resolve("log.csv").apply { writeText("time_s,probe,sample,temp_c,heading\n$text") }
            val choice = LogChoice(value = "probe", conditions = mapOf(REFERENCE to "sample"), needsPlace = false)
            val log = SurveyLog.open(file, choice)
            assertSame(log, RowsOfTheirOwn.of(log, choice, REFERENCE))
        }
    }

    private companion object {
        const val REFERENCE = "(reference)"
    }
}
