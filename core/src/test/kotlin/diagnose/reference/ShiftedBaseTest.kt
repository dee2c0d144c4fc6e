package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import kotlin.math.exp
import kotlin.math.round
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** What a named cause gains is its own: a shift that the log's sampling makes is in the base, too; nor is it more than measured. */
class ShiftedBaseTest {
    private val n = 1080
    private val samples = listOf(2.0, 8.0, 12.0, 8.0, 2.0, 12.0, 2.0, 8.0, 12.0, 5.0, 8.0, 2.0)
    private val truth = DoubleArray(n) { samples[it / 90] }

    /** A lag of 8 s in twenty steps a row, each reading taken before the sample of its row has acted: nearly a row late. */
    private fun bench(drift: Double): DiagnosisResult {
        val random = java.util.Random(11)
        var state = truth[0]
        val values = DoubleArray(n) { i ->
            val reading = state + drift * i + 0.03 * random.nextGaussian()
            repeat(20) { state += (1 - exp(-0.05 / 8)) * (truth[i] - state) }
            reading
        }
        return diagnosed(values)
    }

    /** A lag of 8 s in one step a row, of which [shown] makes the reading of a row. */
    private fun lagging(seed: Long, shown: (Int, Double, java.util.Random) -> Double): DiagnosisResult {
        val random = java.util.Random(seed)
        var state = truth[0]
        val values = DoubleArray(n) { i ->
            state += (1 - exp(-1 / 8.0)) * (truth[i] - state)
            shown(i, state, random)
        }
        return diagnosed(values)
    }

    private fun diagnosed(values: DoubleArray): DiagnosisResult {
        val still = DoubleArray(n)
        return Diagnosis(MeasuredSeries(DoubleArray(n) { it.toDouble() }, still, still, values, truth)).run()
    }

    @Test
    fun aDriftOnABenchIsNotCreditedWithAShiftOfARow() {
        val result = bench(drift = 1e-4)
        assertEquals(Verdict.Named(listOf(Cause.DRIFT)), result.verdict)
        // Of the noise, 0.03, and what a mean leaves of a drift of 1e-4 a second over 1080 s, 0.031.
        assertTrue(result.baseline.trainRmse in 0.035..0.05, "${result.baseline.trainRmse}")
        assertTrue(result.baseline.heldOutRmse < 0.06, "${result.baseline.heldOutRmse}")
        val tau = result.baseline.parameters.first { it.name == "time_constant_s" }
        assertTrue(checkNotNull(tau.interval).let { 8.0 in it.lower..it.upper }, "$tau")
    }

    @Test
    fun blocksAreHeldOutForWhatIsWorthALookAlone() {
        val candidates =
            lagging(13) { i, state, random -> state + 2e-4 * i + 0.03 * random.nextGaussian() }.candidates
        assertTrue(candidates.first { it.cause == Cause.DRIFT }.heldOutRmse.isFinite())
        val unlikely = candidates.filter { it.pValue > 0.5 }
        assertTrue(unlikely.isNotEmpty() && unlikely.all { it.heldOutRmse.isNaN() }, "$unlikely")
    }

    @Test
    fun roundingThatReadingsShowIsNoChance() {
        val result = lagging(12) { _, state, random ->
            0.12 * round((state + 0.05 * random.nextGaussian()) / 0.12)
        }
        assertEquals(Verdict.Named(listOf(Cause.QUANTISATION)), result.verdict)
        assertEquals(0.0, result.candidates.first { it.cause == Cause.QUANTISATION }.adjustedPValue)
    }
}
