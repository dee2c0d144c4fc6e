package stillwater.benchmark

import stillwater.benchmark.HandMadeResult.Companion.AVERAGING
import stillwater.benchmark.HandMadeResult.Companion.BOUNDED
import stillwater.benchmark.HandMadeResult.Companion.LAWNMOWER
import stillwater.benchmark.HandMadeResult.Companion.PLANNER
import stillwater.benchmark.HandMadeResult.Companion.WALK
import stillwater.run.Preset
import java.util.Locale
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class ReportClaimsTest {
    private fun claims(build: HandMadeResult.() -> Unit) = ReportClaims(HandMadeResult().apply(build).build()).all()

    private fun claim(words: String, build: HandMadeResult.() -> Unit) = claims(build).single { words in it.text }

    @Test
    fun allOfTheReportsClaimsAreHeldAgainstBothFieldsInItsOrder() {
        val all = ReportClaims(HandMadeResult.likeTheReport()).all()
        assertEquals(
            listOf(
                "uniform: random walk with the bounded filter is eventually lowest",
                "gaussian: random walk with the bounded filter is eventually lowest",
                "uniform: lawnmower is good at first, then stays above zero with the bounded filter",
                "gaussian: lawnmower is good at first, then stays above zero with the bounded filter",
                "uniform: bounded planner beats the random walk for a while, not in the long run (bounded filter)",
                "gaussian: bounded planner beats the random walk for a while, not in the long run (bounded filter)",
                "averaging suffers more from the lag where cells are independent (random walk)",
            ),
            all.map { it.text },
        )
        assertTrue(all.all { it.verdict == Verdict.HOLDS }, "$all")
    }

    @Test
    fun theWalkIsEventuallyLowestFromTheMoveAfterWhichItStaysSo() {
        val claim = claim("eventually lowest") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(PLANNER, BOUNDED, 0.3, 0.15, 0.06)
            curve(LAWNMOWER, AVERAGING, 0.1, 0.12, 0.2)
        }
        assertEquals(Verdict.HOLDS, claim.verdict)
        assertEquals("lowest from move 100 on", claim.detail)
    }

    @Test
    fun theWalkIsNotEventuallyLowestWhereAnotherIsLowerInTheEnd() {
        val claim = claim("eventually lowest") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(PLANNER, BOUNDED, 0.3, 0.15, 0.06)
            curve(LAWNMOWER, AVERAGING, 0.4, 0.2, 0.04)
        }
        assertEquals(Verdict.UNDECIDED, claim.verdict, "2 moves a cell are not the long run")
        assertEquals(
            "still lower is lawnmower with averaging at move 200: 0.0400 against 0.0500; run more --moves",
            claim.detail,
        )
    }

    @Test
    fun moreBoatsAreNotHeldAgainstOne() {
        val claim = claim("eventually lowest") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(WALK, BOUNDED, 0.1, 0.05, 0.02, boats = 4)
            curve(PLANNER, BOUNDED, 0.3, 0.15, 0.06)
        }
        assertEquals(Verdict.HOLDS, claim.verdict, claim.detail)
    }

    @Test
    fun aTieInTheEndIsNotLowest() {
        val claim = claim("eventually lowest") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.0625)
            curve(PLANNER, BOUNDED, 0.3, 0.15, 0.0625)
        }
        assertEquals(Verdict.UNDECIDED, claim.verdict)
        assertEquals(
            "too close to bounded with bounded at move 200: 0.0625 against 0.0625; run more --moves or --environments",
            claim.detail,
        )
    }

    @Test
    fun theLawnmowerClaimHoldsWhereItIsBetterAtFirstAndThenConstantAboveTheWalk() {
        val claim = claim("lawnmower") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(LAWNMOWER, BOUNDED, 0.15, 0.125, 0.125)
        }
        assertEquals(Verdict.HOLDS, claim.verdict)
        assertEquals(
            "bounded: below the walk at moves 50; bounded: 0.1250 at move 200, the same within 1 % since move 100",
            claim.detail,
        )
    }

    @Test
    fun theLawnmowerClaimFailsWhereAnyOfItsPartsDoes() {
        fun holds(vararg lawnmower: Double) = claim("lawnmower") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(LAWNMOWER, BOUNDED, *lawnmower)
        }.verdict == Verdict.HOLDS
        assertFalse(holds(0.25, 0.125, 0.125), "never better")
        assertFalse(holds(0.15, 0.13, 0.12), "still falling")
        assertFalse(holds(0.15, 0.04, 0.04), "better to the end")
    }

    @Test
    fun thePlannerClaimHoldsWhereItIsBetterForAWhileOnly() {
        val claim = claim("bounded planner") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(PLANNER, BOUNDED, 0.1, 0.09, 0.06)
        }
        assertEquals(Verdict.HOLDS, claim.verdict)
        assertEquals("below the walk at moves 50 to 100; at move 200 0.0600 against 0.0500", claim.detail)
    }

    @Test
    fun thePlannerClaimFailsWhereItIsNeverBetterOrToTheEnd() {
        val never = claim("bounded planner") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(PLANNER, BOUNDED, 0.3, 0.2, 0.1)
        }
        assertEquals(Verdict.UNDECIDED, never.verdict)
        assertEquals("below the walk at no checkpoint; at move 200 0.1000 against 0.0500", never.detail)
        val always = claim("bounded planner") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(PLANNER, BOUNDED, 0.1, 0.05, 0.04)
        }
        assertEquals(Verdict.UNDECIDED, always.verdict)
        assertEquals("below the walk at moves 50 to 200; at move 200 0.0400 against 0.0500", always.detail)
    }

    private fun averaging(uniform: Double, gaussian: Double, bounded: Double = 0.05) = claim("averaging suffers") {
        curve(WALK, BOUNDED, 0.2, 0.1, bounded)
        curve(WALK, AVERAGING, 0.2, 0.1, uniform)
        curve(WALK, BOUNDED, 0.2, 0.1, bounded, field = Preset.GAUSSIAN)
        curve(WALK, AVERAGING, 0.2, 0.1, gaussian, field = Preset.GAUSSIAN)
    }

    @Test
    fun averagingSuffersMoreWhereItsShareOfTheBoundedFiltersErrorIsLarger() {
        val holds = averaging(uniform = 0.2, gaussian = 0.1)
        assertEquals(Verdict.HOLDS, holds.verdict)
        assertEquals(
            "averaging has 4.0 times the bounded filter's error in the uniform field, 2.0 times in the Gaussian, " +
                "at move 200",
            holds.detail,
        )
        assertEquals(Verdict.FAILS, averaging(uniform = 0.1, gaussian = 0.2).verdict)
    }

    @Test
    fun nothingIsSaidAboutCurvesThatWereNotRun() {
        assertEquals(emptyList(), claims { curve(WALK, BOUNDED, 0.2, 0.1, 0.05) }, "nothing to compare the walk with")
        assertEquals(emptyList(), claims { curve(PLANNER, BOUNDED, 0.2, 0.1, 0.05) }, "no walk")
        val withoutBounded = claims {
            curve(WALK, AVERAGING, 0.2, 0.1, 0.05)
            curve(LAWNMOWER, AVERAGING, 0.2, 0.1, 0.05)
        }
        assertEquals(emptyList(), withoutBounded, "no bounded filter")
        val oneField = claims {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(WALK, AVERAGING, 0.2, 0.1, 0.05)
        }
        assertEquals(1, oneField.size, "the claim about averaging needs both fields")
    }

    @Test
    fun numbersHaveAPointInEveryLanguage() {
        fun details() = ReportClaims(HandMadeResult.likeTheReport()).all().map { it.detail }
        val english = details()
        val lawnmower = "bounded: below the walk at moves 50 to 100; " +
            "bounded: 0.0938 at move 200, the same within 1 % since move 100"
        assertContains(english, lawnmower)
        val before = Locale.getDefault()
        try {
            for (language in listOf("de-DE", "ar-EG")) {
                Locale.setDefault(Locale.forLanguageTag(language))
                assertEquals(english, details(), language)
            }
        } finally {
            Locale.setDefault(before)
        }
    }

    @Test
    fun errorsThatAreNoNumbersMakeNoClaimHoldAndNoneThrow() {
        for (odd in listOf(Double.NaN, Double.POSITIVE_INFINITY)) {
            val claims = claims {
                for (planner in listOf(WALK, LAWNMOWER, PLANNER)) curve(planner, BOUNDED, odd, odd, odd)
            }
            assertEquals(3, claims.size)
            assertTrue(claims.none { it.verdict == Verdict.HOLDS }, "$claims")
        }
    }

    @Test
    fun withoutAnyErrorOfTheBoundedFilterNoRatioIsMadeUp() {
        // A spread of nothing: one environment.
        val result = HandMadeResult(environments = 1).run {
            for (field in listOf(Preset.UNIFORM, Preset.GAUSSIAN)) {
                curve(WALK, BOUNDED, 0.2, 0.1, 0.0, field = field)
                curve(WALK, AVERAGING, 0.2, 0.1, 0.1, field = field)
            }
            build()
        }
        assertEquals(emptyList(), ReportClaims(result).all().filter { "averaging suffers" in it.text })
    }

    @Test
    fun runsOfMovesShowTheirGaps() {
        val claim = claim("bounded planner") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(PLANNER, BOUNDED, 0.1, 0.2, 0.04)
        }
        assertContains(claim.detail, "below the walk at moves 50, 200;")
    }

    @Test
    fun oneEnvironmentDecidesNothingAboutCurves() {
        val result = HandMadeResult.likeTheReport(environments = 1)
        val verdicts = ReportClaims(result).all().filter { "averaging suffers" !in it.text }.map { it.verdict }
        assertEquals(List(6) { Verdict.UNDECIDED }, verdicts)
    }
}
