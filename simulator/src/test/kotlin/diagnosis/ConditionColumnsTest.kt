package stillwater.diagnosis

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.io.LogChoice
import stillwater.io.LogProblem
import stillwater.io.SurveyLog
import stillwater.model.Conditions
import java.nio.file.Path
import kotlin.io.path.writeText
import kotlin.math.sin
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

/** Rows of which a condition is not known are told, and too many are refused: the user asked for the condition. */
class ConditionColumnsTest {
    @TempDir
    private lateinit var directory: Path

    /** A bench log of a row a second whose temperature is known in the rows that [isKnown]. */
    private fun read(rows: Int = 400, isBlind: Boolean = false, isKnown: (Int) -> Boolean): DiagnosisLog {
        val text = "time_s,probe,sample,temp_c\n" + (0 until rows).joinToString("") { i ->
            "$i,${sin(i / 9.0)},${sin(i / 9.0)},${if (isKnown(i)) "${15 + i / 100.0}" else ""}\n"
        }
        val temperature = mapOf(Conditions.TEMPERATURE to "temp_c")
        val wanted = if (isBlind) temperature else temperature + (DiagnosisLog.REFERENCE to "sample")
        val choice = LogChoice(value = "probe", conditions = wanted, needsPlace = false, keepsUnread = !isBlind)
        val log = SurveyLog.open(directory.resolve("log.csv").apply { writeText(text) }, choice)
        return DiagnosisLog.of(log, temperature, "sample".takeUnless { isBlind })
    }

    private fun refused(isKnown: (Int) -> Boolean) = assertFailsWith<LogProblem> { read(isKnown = isKnown) }.message

    @Test
    fun missingNumbersAreCountedAndSaidToBeBridged() {
        assertEquals(emptyList(), read { true }.bridged)
        val told = read { it % 4 != 1 }.bridged.single()
        assertContains(told, "the column temp_c has no number in 100 of 400 rows: temperature was taken there from")
    }

    @Test
    fun aConditionThatIsMostlyMissingIsRefusedWithItsColumn() {
        val most = refused { it < 4 }
        assertContains(most.orEmpty(), "log.csv: column temp_c: expected a number for temperature in at least half")
        assertContains(most.orEmpty(), "found numbers in 4 of 400 rows")
        assertContains(refused { false }.orEmpty(), "found numbers in 0 of 400 rows")
    }

    @Test
    fun rowsOfALongGapAreLeftOutAndCounted() {
        val log = read { it !in 100..199 }
        assertEquals(
            "the column temp_c has no number in 100 of 400 rows: in 60 of them temperature was taken from the " +
                "numbers before and after, in proportion to time; 40 rows left out: more than 30.0 s from a number",
            log.bridged.single(),
        )
        val left = (130..169).map { it.toDouble() }
        assertEquals((0 until 400).map { it.toDouble() } - left.toSet(), log.columns.times.toList())
        // What the sensor saw in these rows shows in the readings after them.
        assertEquals(400, log.series.size)
    }

    @Test
    fun withoutAReferenceTheRowsOfALongGapAreAGapOfTheLog() {
        val log = read(isBlind = true) { it >= 100 }
        assertContains(log.bridged.single(), "in 30 of them temperature was taken")
        assertContains(log.bridged.single(), "; 70 rows left out: more than 30.0 s from a number")
        assertEquals(330, log.series.size)
        assertEquals(70.0, log.columns.times.first())
    }
}
