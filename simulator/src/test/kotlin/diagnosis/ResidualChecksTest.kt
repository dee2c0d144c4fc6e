package stillwater.diagnosis

import org.junit.jupiter.api.Test
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.ModelAssessment
import java.util.Random
import kotlin.math.exp
import kotlin.math.round
import kotlin.math.sin
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Residuals are held against what the model itself would leave of a log that it is right about. Seeds fixed before the first run. */
class ResidualChecksTest {
    private class Log(val series: MeasuredSeries, val values: DoubleArray)

    /** Legs of 60 s to and fro, 4 m apart, over smooth water, by a sensor with a lag of 5 s and independent noise. */
    private fun survey(
        seed: Long,
        hasReference: Boolean,
        step: Double = 0.0,
        rows: Int = 900,
        extra: (Random) -> () -> Double = { { 0.0 } },
    ): Log {
        val random = Random(seed)
        val more = extra(random)
        val x = DoubleArray(rows) { row -> (row % 120).let { if (it < 60) it else 120 - it }.toDouble() }
        val y = DoubleArray(rows) { 4.0 * (it / 60) }
        val truth = DoubleArray(rows) { 8 + sin(x[it] / 7 + seed) + sin(y[it] / 9) + 0.5 * sin((x[it] + y[it]) / 11) }
        var state = truth[0]
        val values = DoubleArray(rows) { row ->
            if (row > 0) state += (1 - exp(-1 / 5.0)) * ((truth[row] + truth[row - 1]) / 2 - state)
            val shown = state + 0.02 * random.nextGaussian() + more()
            if (step > 0) round(shown / step) * step else shown
        }
        val times = DoubleArray(rows) { it.toDouble() }
        return Log(MeasuredSeries(times, x, y, values, truth.takeIf { hasReference }), values)
    }

    private fun best(result: DiagnosisResult): ModelAssessment = result.extended ?: result.baseline

    private fun checks(log: Log): ResidualChecks =
        Diagnosis(log.series).run().let { ResidualChecks(best(it), it.baseline, log.values) }

    private fun outside(log: Log) = checks(log).all.filter { it.isOutside }

    /** Each check is outside in one of twenty logs; against independent numbers a log without a reference has three at once. */
    @Test
    fun whatAModelIsRightAboutIsWithinChance() {
        for (hasReference in listOf(false, true)) {
            val found = (71L..76L).map { outside(survey(it, hasReference)).map(ResidualCheck::name) }
            val words = "reference: $hasReference, seeds 71 to 76: $found"
            assertTrue(found.sumOf { it.size } <= 5, words)
            assertTrue(found.none { it.size > 2 }, words)
        }
    }

    @Test
    fun tailsThatAreHeavyAndSpreadThatGrowsAreOutside() {
        val tails = survey(81, hasReference = true) { random ->
            { if (random.nextDouble() < 0.06) 0.06 * random.nextGaussian() else 0.0 }
        }
        assertContains(outside(tails).map { it.name }, "heaviness of the tails (excess kurtosis)")
        var row = 0
        val growing = survey(82, hasReference = true) { random -> { 0.00005 * row++ * random.nextGaussian() } }
        assertTrue(outside(growing).any { it.name.startsWith("spread") })
    }

    @Test
    fun coarseRoundingGoesWithWhatIsLeftAndFineRoundingDoesNot() {
        fun names(step: Double) = outside(survey(83, hasReference = true, step = step)).map { it.name }
        assertContains(names(0.1), "correlation with rounding to 0.1, base")
        assertTrue("correlation with rounding to 0.001, base" !in names(0.001))
    }

    @Test
    fun theBandOfCorrelationsIsWhereNineteenOfTwentyLie() {
        val log = survey(84, hasReference = false)
        val (lower, upper) = checks(log).correlations(40)
        val found = ResidualChecks.correlations(best(Diagnosis(log.series).run()).whitened, 40)
        val within = found.indices.count { found[it] in lower[it]..upper[it] }
        assertTrue(within >= 34, "$within of 40")
        assertTrue(found[0] < -0.05, "against independent numbers neighbours would not be alike: ${found[0]}")
    }

    @Test
    fun fewRowsHaveNone() {
        val few = survey(85, hasReference = true, rows = 15)
        assertEquals(emptyList(), checks(few).all)
    }
}
