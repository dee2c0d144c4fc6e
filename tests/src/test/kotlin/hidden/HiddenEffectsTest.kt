package stillwater.hidden

import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Path
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotEquals
import kotlin.test.assertTrue

/**
 * A fixed small set of the campaign whose results are in docs/diagnosis.md. More seeds than every run has time for are
 * tagged: `mvn verify -Dtests.excluded=none` runs them.
 */
class HiddenEffectsTest {
    @TempDir
    private lateinit var directory: Path

    private fun blind(vararg seeds: Long) =
        HiddenCampaign.run(seeds.toList(), Regime.BLIND, directory, withGain = false)

    @Test
    fun theFinderNamesWhatIsHiddenAndSeldomWhatIsNot() {
        val cases = HiddenCampaign.run(70_000L..70_013L, Regime.REFERENCE, directory)
        val scores = Scores(cases)
        // At a rate of 5 % two alarms come in one of some thirty such sets.
        assertTrue(cases.count { it.isEmpty && it.alarmed } <= 1, scores.markdown())
        // The campaign names nineteen in twenty; of the few strong effects here one may be missed.
        val missed = cases.filter { it.isSingle && it.multiple >= 1 && !it.correct }
        assertTrue(missed.size <= 1, scores.markdown())
    }

    /** Seeds of the work on it, not of a campaign's report: an end of the range and a rate limit that show once in a log. */
    @Test
    fun whatActsOnceInALogIsNamed() {
        val cases = HiddenCampaign.run(listOf(80_198L, 81_047L), Regime.REFERENCE, directory)
        assertEquals(listOf(HiddenEffect.SLEW, HiddenEffect.SATURATION), cases.map { it.truth.effects.keys.single() })
        assertTrue(cases.all { it.correct }, Scores(cases).markdown())
    }

    /**
     * Seeds of the work on it: an asymmetry and a play beside which chance looked like something else at 1 %, and a short
     * second lag on the bench, which a truth held over each step and a delay that undoes it hid.
     */
    @Test
    @Tag("long")
    fun whatIsBesideACauseMustBeSurerAndADelayThatUndoesHeldStepsIsNone() {
        val cases = HiddenCampaign.run(listOf(240_120L, 240_152L, 241_180L), Regime.REFERENCE, directory)
        val hidden = listOf(HiddenEffect.ASYMMETRIC, HiddenEffect.HYSTERESIS, HiddenEffect.SECOND_ORDER)
        assertEquals(hidden, cases.map { it.truth.effects.keys.single() })
        assertTrue(cases.all { it.correct }, Scores(cases).markdown())
    }

    /**
     * Seeds of the work on it: a probe ahead of the receiver on a random walk where a lag alone is no better than none,
     * two lags of which stretches of the log told nothing by what was left of rows that had been fitted, coarse rounding
     * that one half shows more than the other, and an offset with heading in a log that shows a lag of either kind.
     */
    @Test
    @Tag("long")
    fun withoutAReferenceWhatWasMissedIsTold() {
        val cases = blind(195_263, 195_157, 191_018, 190_008)
        val hidden =
            listOf(HiddenEffect.POSITION, HiddenEffect.SECOND_ORDER, HiddenEffect.QUANTISATION, HiddenEffect.HEADING)
        assertEquals(hidden, cases.map { it.truth.effects.keys.single() })
        assertTrue(cases.dropLast(1).all { it.correct }, Scores(cases).markdown())
        assertEquals("unexplained", cases.last().answer.verdict)
    }

    /**
     * Seeds of the work on it: fixes that wander by half a metre and more, and foretell each other. A course that follows
     * them looks like a second lag.
     */
    @Test
    @Tag("long")
    fun fixesThatWanderAreNoSecondLag() {
        val seeds = listOf(309_194L, 309_257L, 309_272L, 309_671L)
        val cases = HiddenCampaign.run(seeds, Regime.BLIND_FIELD, directory, withGain = false)
        assertTrue(cases.all { it.isEmpty && !it.alarmed }, Scores(cases).markdown())
    }

    /** Seeds of the work on it: fixes that wander, which make passes disagree as water that changes does. */
    @Test
    @Tag("long")
    fun fixesThatWanderAreNoChangingWaterBesideACause() {
        val seeds = listOf(331_516L, 331_627L, 331_656L)
        val cases = HiddenCampaign.run(seeds, Regime.BLIND_FIELD, directory, withGain = false)
        val hidden = listOf(HiddenEffect.HYSTERESIS, HiddenEffect.SECOND_ORDER, HiddenEffect.SLEW)
        assertEquals(hidden, cases.map { it.truth.effects.keys.single() })
        assertTrue(cases.all { it.correct }, Scores(cases).markdown())
    }

    /**
     * Seeds of the work on it: a jump and water that changes, each held against the other on a base of its own; and two
     * lags that no step led to while a fit did not know how tightly the water is bound.
     */
    @Test
    @Tag("long")
    fun whatChangesAndWhatNoStepLedToIsTold() {
        val cases = blind(198_071, 194_036, 196_034)
        val hidden = listOf(HiddenEffect.STEPS, HiddenEffect.TIME_VARYING, HiddenEffect.SECOND_ORDER)
        assertEquals(hidden, cases.map { it.truth.effects.keys.single() })
        assertTrue(cases.all { it.correct }, Scores(cases).markdown())
    }

    /** Seeds of the work on it: curved calibrations whose logs tell a lag but not of which kind. */
    @Test
    @Tag("long")
    fun whatIsCertainlyLeftBesideAnOpenLagIsUnexplained() {
        val cases = blind(199_041, 215_000)
        assertTrue(cases.all { it.truth.effects.keys == setOf(HiddenEffect.CURVED) })
        assertTrue(cases.all { it.answer.verdict == "unexplained" }, Scores(cases).markdown())
    }

    /** A seed of the work on it: a probe far ahead, which water that changes took, so that a lag of either kind was left. */
    @Test
    @Tag("long")
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
    @Tag("long")
    fun whatIsNotThereIsNotNamed() {
        val cases = blind(209_055, 204_015)
        assertEquals(listOf(setOf(HiddenEffect.RESONANCE), emptySet()), cases.map { it.truth.effects.keys })
        assertTrue(cases.first().answer.sets.none { "position-offset" in it }, Scores(cases).markdown())
        assertEquals("consistent", cases.last().answer.verdict, Scores(cases).markdown())
    }

    /** A seed of the work on it: where rounding was told first, nothing else moved the fit any more. */
    @Test
    @Tag("long")
    fun whatIsHiddenBesideCoarseRoundingIsNamedToo() {
        val case = blind(192_035).single()
        assertEquals(setOf(HiddenEffect.FLOW, HiddenEffect.QUANTISATION), case.truth.effects.keys)
        assertTrue(case.bothFound, Scores(listOf(case)).markdown())
    }

    /** A seed of the work on it: water that changes as no drift does, which only the model of the water knew of. */
    @Test
    @Tag("long")
    fun waterThatChangesBesideANamedCauseIsToldToo() {
        val case = blind(196_075).single()
        assertEquals(setOf(HiddenEffect.TIME_VARYING, HiddenEffect.HYSTERESIS), case.truth.effects.keys)
        assertTrue(case.bothFound, Scores(listOf(case)).markdown())
    }

    /** Seeds of the work on it: a drift and water that changes evenly, which noise that wanders had taken. */
    @Test
    @Tag("long")
    fun aDriftIsAskedOfNoiseThatDoesNotWander() {
        val cases = blind(203_063, 208_029)
        val hidden = listOf(HiddenEffect.DRIFT, HiddenEffect.TIME_VARYING)
        assertEquals(hidden, cases.map { it.truth.effects.keys.single() })
        assertTrue(cases.all { it.correct }, Scores(cases).markdown())
    }

    /**
     * Seeds of the work on it: a warmth in water that is finer than its columns showed at first, two lags that are later
     * than the half row of a way of sampling, and water that changes, which others seemed to explain as well at first.
     */
    @Test
    @Tag("long")
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
    @Tag("long")
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
    @Tag("long")
    fun twoEffectsAreToldThatLookLikeOneOrLikeNone() {
        val cases = blind(262_775, 255_340)
        val hidden = listOf(
            setOf(HiddenEffect.SECOND_ORDER, HiddenEffect.FLOW),
            setOf(HiddenEffect.DEAD_TIME, HiddenEffect.STEPS),
        )
        assertEquals(hidden, cases.map { it.truth.effects.keys })
        assertTrue(cases.all { it.bothFound }, Scores(cases).markdown())
    }

    /**
     * Seeds of the work on it: two jumps that undo each other, of which neither gains anything alone, and a response that
     * rings in water whose waves are resolved, by less than waves that are missing may do.
     */
    @Test
    @Tag("long")
    fun jumpsThatUndoEachOtherAndAFaintRingAreTold() {
        val cases = blind(269_240, 269_453)
        val hidden = listOf(HiddenEffect.STEPS, HiddenEffect.RESONANCE)
        assertEquals(hidden, cases.map { it.truth.effects.keys.single() })
        assertTrue(cases.first().correct, Scores(cases).markdown())
        assertEquals("unexplained", cases.last().answer.verdict, Scores(cases).markdown())
    }

    /** A seed of the work on it: a response that rings by 3.0x, which was told as a lag of either kind. */
    @Test
    @Tag("long")
    fun aRingIsToldWhereTheLagMayBeOfEitherKind() {
        val case = blind(270_291).single()
        assertEquals(setOf(HiddenEffect.RESONANCE), case.truth.effects.keys)
        assertEquals("unexplained", case.answer.verdict, Scores(listOf(case)).markdown())
    }

    /** A seed of the work on it: interference of 1.3x, whose period the water takes most of. */
    @Test
    @Tag("long")
    fun whatIsOutsideTheListIsUnexplainedWhereItIsFaint() {
        val case = blind(204_010).single()
        assertEquals(setOf(HiddenEffect.INTERFERENCE), case.truth.effects.keys)
        assertEquals("unexplained", case.answer.verdict, Scores(listOf(case)).markdown())
    }

    /** Seed 150128 hides a dead time, 150120 nothing. */
    @Test
    fun aTwinIsTheSameLogWithoutTheEffect() {
        fun text(seed: Long, isTwin: Boolean): List<String> = directory.resolve("log-$seed-$isTwin.csv")
            .also { HiddenCase(seed, withReference = false, isTwin = isTwin).write(it) }.toFile().readLines()

        /** All columns but the reading's. */
        fun rest(lines: List<String>) = lines.map { line -> line.split(",").filterIndexed { i, _ -> i != 3 } }
        assertEquals(text(150_120, isTwin = false), text(150_120, isTwin = true))
        val log = text(150_128, isTwin = false)
        val twin = text(150_128, isTwin = true)
        assertNotEquals(log, twin)
        assertEquals(rest(log), rest(twin))
    }

    @Test
    fun aCaseIsDrawnFromItsSeedAlone() {
        val files = (1..2).map { run ->
            directory.resolve("log-$run.csv").also { HiddenCase(71_000, withReference = true).write(it) }
        }
        assertEquals(files[0].toFile().readText(), files[1].toFile().readText())
    }
}
