package stillwater.diagnose

import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** One number that is no reading must not hide all others. */
class WildNumbersTest {
    private val n = 400
    private val random = java.util.Random(8)
    private val truth = DoubleArray(n) { 5 + sin(it / 9.0) + 0.5 * sin(it / 23.0) }

    private fun diagnosed(values: DoubleArray, reference: DoubleArray): DiagnosisResult {
        val still = DoubleArray(n)
        return Diagnosis(MeasuredSeries(DoubleArray(n) { it.toDouble() }, still, still, values, reference)).run()
    }

    /** A lag of 6 rows that drifts. */
    private fun readings(): DoubleArray {
        var state = truth[0]
        return DoubleArray(n) { i ->
            state += (1 - exp(-1 / 6.0)) * (truth[i] - state)
            state + 2e-4 * i + 0.01 * random.nextGaussian()
        }
    }

    @Test
    fun oneReadingFarBeyondAllOthersIsToldAndTheRestIsDiagnosed() {
        val values = readings().also { it[133] = 1e6 }
        val result = diagnosed(values, truth)
        assertEquals(Verdict.Named(listOf(Cause.DRIFT)), result.verdict)
        assertEquals(listOf(133), result.spikes)
        assertContains(result.warnings, "1 single reading is far off and left out of the fits.")
        assertEquals(n, result.baseline.predicted.size)
    }

    @Test
    fun severalAreOutliers() {
        val values = readings().also { wild -> listOf(40, 133, 250, 251 + 60).forEach { wild[it] = -1e5 } }
        val result = diagnosed(values, truth)
        assertEquals(Verdict.Named(listOf(Cause.DRIFT, Cause.OUTLIERS)), result.verdict)
        assertEquals(listOf(40, 133, 250, 311), result.spikes)
    }

    @Test
    fun oneNumberOfTheReferenceFarBeyondAllOthersIsToldAndTheRestIsDiagnosed() {
        val result = diagnosed(readings(), truth.copyOf().also { it[200] = 1e6 })
        assertEquals(Verdict.Named(listOf(Cause.DRIFT)), result.verdict)
        assertTrue(result.warnings.any { "1 number of the reference" in it }, "${result.warnings}")
    }

    @Test
    fun whatTheWaterDoesIsNotWild() {
        val front = DoubleArray(n) { if (it < 200) 0.001 * random.nextGaussian() else 40.0 }
        val plateau = DoubleArray(n) { if (it in 100..102) 500.0 else sin(it / 9.0) }
        for (column in listOf(front, plateau, truth, DoubleArray(n), DoubleArray(2) { 1e6 * it })) {
            assertEquals(emptyList(), WildNumbers.of(column))
        }
    }
}
