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

/** Numbers of conditions that are missing are told, and too many are refused: the user asked for the condition. */
class ConditionColumnsTest {
    @TempDir
    private lateinit var directory: Path

    /** A bench log of a row a second whose temperature is known in the rows that [isKnown]. */
    private fun read(rows: Int = 400, isKnown: (Int) -> Boolean): DiagnosisLog {
        val text = "time_s,probe,sample,temp_c\n" + (0 until rows).joinToString("") { i ->
            "$i,${sin(i / 9.0)},${sin(i / 9.0)},${if (isKnown(i)) "${15 + i / 100.0}" else ""}\n"
        }
        val wanted = mapOf(DiagnosisLog.REFERENCE to "sample", Conditions.TEMPERATURE to "temp_c")
        val choice = LogChoice(value = "probe", conditions = wanted, needsPlace = false, keepsUnread = true)
        val log = SurveyLog.open(directory.resolve("log.csv").apply { writeText(text) }, choice)
        return DiagnosisLog.of(log, mapOf(Conditions.TEMPERATURE to "temp_c"), "sample")
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
        assertContains(most.orEmpty(), "found numbers in 4 of 400 rows, the farthest row 396 s from one")
        assertContains(refused { false }.orEmpty(), "found numbers in 0 of 400 rows")
    }

    @Test
    fun aLongGapIsRefusedWithItsLength() {
        val message = refused { it !in 100..199 }.orEmpty()
        assertContains(message, "none of the others more than 30.0 s from one")
        assertContains(message, "found numbers in 300 of 400 rows, the farthest row 50.0 s from one")
    }
}
