package stillwater.hidden

import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Path
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/**
 * More seeds of the work on the diagnosis without a reference than every run has time for, each of which once came out
 * otherwise. `mvn verify -Dtests.excluded=none` runs them.
 */
@Tag("long")
class HiddenSeedsTest {
    @TempDir
    private lateinit var directory: Path

    private fun blind(vararg seeds: Long) =
        HiddenCampaign.run(seeds.toList(), Regime.BLIND, directory, withGain = false)

    /**
     * Seeds of the work on it: a probe ahead of the receiver on a random walk where a lag alone is no better than none,
     * two lags of which stretches of the log told nothing by what was left of rows that had been fitted, coarse rounding
     * that one half shows more than the other, and an offset with heading in a log that shows a lag of either kind.
     */
    @Test
    fun withoutAReferenceWhatWasMissedIsTold() {
        val cases = blind(195_263, 195_157, 191_018, 190_008)
        val hidden =
            listOf(HiddenEffect.POSITION, HiddenEffect.SECOND_ORDER, HiddenEffect.QUANTISATION, HiddenEffect.HEADING)
        assertEquals(hidden, cases.map { it.truth.effects.keys.single() })
        assertTrue(cases.dropLast(1).all { it.correct }, Scores(cases).markdown())
        assertEquals("unexplained", cases.last().answer.verdict)
    }

    /** A seed of the work on it: a probe far ahead, which water that changes took, so that a lag of either kind was left. */
    @Test
    fun aWrongResponseIsAskedOfWaterThatDoesNotChange() {
        val case = blind(218_077).single()
        assertEquals(setOf(HiddenEffect.POSITION), case.truth.effects.keys)
        assertTrue(case.correct, Scores(listOf(case)).markdown())
    }

    /**
     * Seeds of the work on it: a response that rings in water too fine for its log, which a probe ahead seemed to explain,
     * and nothing in a log whose rate of change shows more of itself at some times by chance.
     */
    @Test
    fun whatIsNotThereIsNotNamed() {
        val cases = blind(209_055, 204_015)
        assertEquals(listOf(setOf(HiddenEffect.RESONANCE), emptySet()), cases.map { it.truth.effects.keys })
        assertTrue(cases.first().answer.sets.none { "position-offset" in it }, Scores(cases).markdown())
        assertEquals("consistent", cases.last().answer.verdict, Scores(cases).markdown())
    }

    /**
     * Seeds of the work on it: a warmth in water that is finer than its columns showed at first, two lags that are later
     * than the half row of a way of sampling, and water that changes, which others seemed to explain as well at first.
     */
    @Test
    fun whatFinerWatersOrTheFirstStepsHidIsTold() {
        val cases = blind(234_290, 234_142, 234_158, 238_306)
        val hidden = listOf(
            HiddenEffect.TEMPERATURE,
            HiddenEffect.SECOND_ORDER,
            HiddenEffect.TIME_VARYING,
            HiddenEffect.TIME_VARYING,
        )
        assertEquals(hidden, cases.map { it.truth.effects.keys.single() })
        assertTrue(cases.all { it.correct }, Scores(cases).markdown())
    }

    /**
     * Seeds of the work on it: nothing in a random walk whose waves are not resolved, and interference beside a lag that
     * few stretches of the log tell from a dead time, these for certain.
     */
    @Test
    fun wavesThatAreMissingAreNoDriftAndALagThatIsFarLikelierIsOne() {
        val cases = blind(238_045, 236_177)
        assertEquals(listOf(emptySet(), setOf(HiddenEffect.INTERFERENCE)), cases.map { it.truth.effects.keys })
        assertTrue(cases.first().answer.sets.none { "drift" in it }, Scores(cases).markdown())
        assertEquals("unexplained", cases.last().answer.verdict, Scores(cases).markdown())
    }

    /**
     * Seeds of the work on it: a second order and a lag that follows the speed, to which together an offset of place comes
     * nearest alone, and a dead time and a jump, which in still water look like a response that rings.
     */
    @Test
    fun twoEffectsAreToldThatLookLikeOneOrLikeNone() {
        val cases = blind(262_775, 255_340)
        val hidden = listOf(
            setOf(HiddenEffect.SECOND_ORDER, HiddenEffect.FLOW),
            setOf(HiddenEffect.DEAD_TIME, HiddenEffect.STEPS),
        )
        assertEquals(hidden, cases.map { it.truth.effects.keys })
        assertTrue(cases.all { it.bothFound }, Scores(cases).markdown())
    }

    /** A seed of the work on it: interference of 1.3x, whose period the water takes most of. */
    @Test
    fun whatIsOutsideTheListIsUnexplainedWhereItIsFaint() {
        val case = blind(204_010).single()
        assertEquals(setOf(HiddenEffect.INTERFERENCE), case.truth.effects.keys)
        assertEquals("unexplained", case.answer.verdict, Scores(listOf(case)).markdown())
    }
}
