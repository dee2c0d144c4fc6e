package stillwater.estimate

import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class TruncatedNormalTest {
    private val cut = TruncatedNormal()

    /** Part of the cut distribution below [x], by the midpoint rule in 20 000 steps. */
    private fun below(x: Double, mean: Double, deviation: Double, from: Double, to: Double): Double {
        val steps = 20_000
        var part = 0.0
        var all = 0.0
        for (i in 0 until steps) {
            val at = from + (i + 0.5) / steps * (to - from)
            val density = exp(-(at - mean) * (at - mean) / (2 * deviation * deviation))
            all += density
            if (at < x) part += density
        }
        return part / all
    }

    @Test
    fun quantilesAreThoseOfTheDensity() {
        for (mean in listOf(-0.2, 0.0, 0.03, 0.5, 0.97, 1.1)) {
            for (deviation in listOf(0.05, 0.2, 0.5, 3.0)) {
                cut.cut(mean, deviation, 0.0, 1.0)
                // One step of the rule is 1 in 20 000, times a density of at most 30 over the range.
                assertEquals(0.025, below(cut.lower, mean, deviation, 0.0, 1.0), 2e-3, "$mean $deviation")
                assertEquals(0.5, below(cut.median, mean, deviation, 0.0, 1.0), 2e-3, "$mean $deviation")
                assertEquals(0.975, below(cut.upper, mean, deviation, 0.0, 1.0), 2e-3, "$mean $deviation")
            }
        }
    }

    @Test
    fun farFromTheRangesEndsItIsTheNormalDistribution() {
        cut.cut(0.5, 0.01, 0.0, 1.0)
        assertEquals(listOf(0.5 - 0.01 * TruncatedNormal.NORMAL, 0.5, 0.5 + 0.01 * TruncatedNormal.NORMAL), ends())
    }

    @Test
    fun whatContradictsTheRangeIsNotCut() {
        cut.cut(2.0, 0.1, 0.0, 1.0)
        assertEquals(listOf(2 - 0.1 * TruncatedNormal.NORMAL, 2.0, 2 + 0.1 * TruncatedNormal.NORMAL), ends())
    }

    @Test
    fun aWideOneIsTheUniformDistribution() {
        cut.cut(0.3, 1e4, 0.0, 1.0)
        // Differences of probabilities 4e-5 apart; a quantile is good to 1e-9 of 1e4 deviations.
        assertEquals(0.025, cut.lower, 1e-4)
        assertEquals(0.5, cut.median, 1e-4)
        assertEquals(0.975, cut.upper, 1e-4)
    }

    @Test
    fun probabilitiesAndQuantilesUndoEachOther() {
        for (i in -70..70) {
            val x = i / 10.0
            // Near 1 the probability itself has no more digits: only the lower half is exact.
            val tolerance = if (x > 0) 1e-16 * exp(x * x / 2) * 10 + 1e-8 else 2e-8
            if (x <=
                5
            ) {
                assertEquals(x, TruncatedNormal.quantile(TruncatedNormal.cumulative(x)), tolerance * (1 + abs(x)))
            }
            assertEquals(1.0, TruncatedNormal.cumulative(x) + TruncatedNormal.cumulative(-x), 1e-15)
        }
        // Φ'(0) = 1/√(2π), by a difference over 2e-3: off by less than a part in a million.
        val slope = (TruncatedNormal.cumulative(1e-3) - TruncatedNormal.cumulative(-1e-3)) / 2e-3
        assertEquals(1 / sqrt(2 * PI), slope, 1e-6)
        assertTrue(TruncatedNormal.cumulative(-8.0) > 0)
    }

    private fun ends() = listOf(cut.lower, cut.median, cut.upper)
}
