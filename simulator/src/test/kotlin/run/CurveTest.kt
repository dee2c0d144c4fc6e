package stillwater.run

import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class CurveTest {
    /** A curve over one checkpoint for each list of [means], one environment for each of its numbers. */
    private fun curve(vararg means: List<Double>, inExtremes: Double = 0.0): Curve {
        val environments = List(means[0].size) { environment ->
            TrialErrors(means.size).apply {
                for (checkpoint in means.indices) {
                    mean[checkpoint] = means[checkpoint][environment]
                    this.inExtremes[checkpoint] = inExtremes
                }
            }
        }
        val moves = List(means.size) { 10 * (it + 1) }
        return Curve("uniform", FilterKind.BOUNDED, PlannerKind.LAWNMOWER, moves, environments)
    }

    @Test
    fun meanAndStandardErrorAreThoseOfASample() {
        val summary = curve(listOf(2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0)).summaries.single()
        assertEquals(5.0, summary.mean)
        // Squared deviations 9+1+1+1+0+0+4+16 = 32, over n − 1 = 7, over n = 8. Rounding of two roots.
        assertEquals(sqrt(32.0 / 7 / 8), summary.standardError, 1e-15)
    }

    @Test
    fun percentilesLieAtThePlacesOfTheOrderedSample() {
        // 1 to 9 in any order: place p (n + 1) = 1 and 9 of 9, the lowest and the highest.
        val nine = curve(listOf(5.0, 9.0, 1.0, 3.0, 7.0, 2.0, 8.0, 4.0, 6.0)).summaries.single()
        assertEquals(1.0 to 9.0, nine.p10 to nine.p90)
        // 1 to 19: places 2 and 18.
        val nineteen = curve((19 downTo 1).map { it.toDouble() }).summaries.single()
        assertEquals(2.0 to 18.0, nineteen.p10 to nineteen.p90)
        // 10, 20, .., 140: places 1.5 and 13.5, half way between two.
        val fourteen = curve((1..14).map { 10.0 * it }).summaries.single()
        assertEquals(15.0 to 135.0, fourteen.p10 to fourteen.p90)
    }

    @Test
    fun oneEnvironmentHasNoStandardErrorAndItselfAsPercentiles() {
        val summary = curve(listOf(0.25)).summaries.single()
        assertEquals(0.25, summary.mean)
        assertTrue(summary.standardError.isNaN())
        assertEquals(0.25 to 0.25, summary.p10 to summary.p90)
    }

    @Test
    fun environmentsThatAgreeHaveAStandardErrorOfZero() {
        assertEquals(0.0, curve(listOf(0.5, 0.5, 0.5)).summaries.single().standardError)
    }

    @Test
    fun theShareInExtremesIsOfAllError() {
        // 0.1 in each of two environments, of 0.2 + 0.6.
        val share = curve(listOf(0.2, 0.6), inExtremes = 0.1).summaries.single().shareInExtremes
        assertEquals(0.25, share, 1e-15, "rounding of three sums")
        assertTrue(curve(listOf(0.0, 0.0)).summaries.single().shareInExtremes.isNaN(), "no error to share")
    }

    @Test
    fun aSummaryIsFoundByItsMoveOnly() {
        val curve = curve(listOf(0.5), listOf(0.25))
        assertEquals(0.5, curve.at(10).mean)
        assertEquals(0.25, curve.at(20).mean)
        val refused = assertFailsWith<IllegalArgumentException> { curve.at(15) }
        assertEquals("move (15) must be one of the checkpoints [10, 20]", refused.message)
    }
}
