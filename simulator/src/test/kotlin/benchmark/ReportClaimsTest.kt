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
                "uniform: lawnmower with the bounded filter is good at first, then stays above zero",
                "gaussian: lawnmower with the bounded filter is good at first, then stays above zero",
                "uniform: bounded planner beats the random walk only for a while (bounded filter)",
                "gaussian: bounded planner beats the random walk only for a while (bounded filter)",
                "averaging suffers more from the lag where cells are independent (random walk)",
            ),
            all.map { it.text },
        )
        assertTrue(all.all { it.holds }, "$all")
    }

    @Test
    fun theWalkIsEventuallyLowestFromTheMoveAfterWhichItStaysSo() {
        val claim = claim("eventually lowest") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(PLANNER, BOUNDED, 0.3, 0.15, 0.06)
            curve(LAWNMOWER, AVERAGING, 0.1, 0.12, 0.2)
        }
        assertTrue(claim.holds)
        assertEquals("lowest from move 100 on", claim.detail)
    }

    @Test
    fun theWalkIsNotEventuallyLowestWhereAnotherIsLowerInTheEnd() {
        val claim = claim("eventually lowest") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(PLANNER, BOUNDED, 0.3, 0.15, 0.06)
            curve(LAWNMOWER, AVERAGING, 0.4, 0.2, 0.04)
        }
        assertFalse(claim.holds)
        assertEquals("at move 200 lawnmower with averaging is lower: 0.0400 against 0.0500", claim.detail)
    }

    @Test
    fun aTieInTheEndIsNotLowest() {
        val claim = claim("eventually lowest") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.0625)
            curve(PLANNER, BOUNDED, 0.3, 0.15, 0.0625)
        }
        assertFalse(claim.holds)
        assertEquals("at move 200 bounded with bounded is as low: 0.0625", claim.detail)
    }

    @Test
    fun theLawnmowerClaimHoldsWhereItIsBetterAtFirstAndThenConstantAboveTheWalk() {
        val claim = claim("lawnmower") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(LAWNMOWER, BOUNDED, 0.15, 0.125, 0.125)
        }
        assertTrue(claim.holds)
        assertEquals("below the walk at move 50; constant 0.1250 from move 100 on", claim.detail)
    }

    @Test
    fun theLawnmowerClaimFailsWhereAnyOfItsPartsDoes() {
        fun holds(vararg lawnmower: Double) = claim("lawnmower") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(LAWNMOWER, BOUNDED, *lawnmower)
        }.holds
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
        assertTrue(claim.holds)
        assertEquals("below the walk at moves 50 to 100", claim.detail)
    }

    @Test
    fun thePlannerClaimFailsWhereItIsNeverBetterOrToTheEnd() {
        val never = claim("bounded planner") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(PLANNER, BOUNDED, 0.3, 0.2, 0.1)
        }
        assertFalse(never.holds)
        assertEquals("below the walk at no checkpoint", never.detail)
        val always = claim("bounded planner") {
            curve(WALK, BOUNDED, 0.2, 0.1, 0.05)
            curve(PLANNER, BOUNDED, 0.1, 0.05, 0.04)
        }
        assertFalse(always.holds)
        assertEquals("below the walk at moves 50 to 200", always.detail)
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
        assertTrue(holds.holds)
        assertEquals(
            "averaging is 4.0 times worse in the uniform field, 2.0 times in the Gaussian, at move 200",
            holds.detail,
        )
        assertFalse(averaging(uniform = 0.1, gaussian = 0.2).holds)
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
        val before = Locale.getDefault()
        try {
            Locale.setDefault(Locale.GERMANY)
            assertContains(averaging(0.2, 0.1).detail, "4.0 times")
            Locale.setDefault(Locale.forLanguageTag("ar-EG"))
            assertContains(averaging(0.2, 0.1).detail, "4.0 times")
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
            assertTrue(claims.none { it.holds }, "$claims")
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
}
