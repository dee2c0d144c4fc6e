package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.Term
import kotlin.test.Test
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertNull

/** A reading that a dead band holds, or a rate limit leads, says nothing of the water that is passed meanwhile. */
class ShownRowsTest {
    private val rows = 900
    private val track = CrossingTrack(rows)

    private fun diagnosed(shown: DoubleArray): DiagnosisResult {
        val random = java.util.Random(5)
        val values = DoubleArray(rows) { shown[it] + 0.02 * random.nextGaussian() }
        return Diagnosis(MeasuredSeries(track.times, track.x, track.y, values, null)).run()
    }

    private fun DiagnosisResult.number(cause: Cause, name: String): Double {
        val sets = (verdict as? Verdict.Named)?.causes?.map { listOf(it) } ?: (verdict as Verdict.Ambiguous).sets
        // On so short a way what lag there is may be of either kind.
        assertEquals(listOf(cause), sets.filterNot { it == listOf(Cause.TIME_CONSTANT, Cause.DEAD_TIME) }.flatten())
        return candidates.first { it.cause == cause }.parameters.single { it.name == name }.value
    }

    @Test
    fun aWideDeadBandIsNoLongerLag() {
        val shown = track.shown(3.0)
        var state = shown[0]
        for (i in shown.indices) {
            state = state.coerceIn(shown[i] - 0.4, shown[i] + 0.4)
            shown[i] = state
        }
        val result = diagnosed(shown)
        assertEquals(0.8, result.number(Cause.HYSTERESIS, "width"), 0.04)
        assertEquals(3.0, result.number(Cause.HYSTERESIS, "time_constant_s"), 0.3)
    }

    @Test
    fun aStrongRateLimitIsTold() {
        val shown = track.shown(3.0)
        for (i in 1 until rows) shown[i] = shown[i].coerceIn(shown[i - 1] - 0.12, shown[i - 1] + 0.12)
        val result = diagnosed(shown)
        assertEquals(0.12, result.number(Cause.SLEW_LIMIT, "rate_per_s"), 0.006)
        assertEquals(3.0, result.number(Cause.SLEW_LIMIT, "time_constant_s"), 0.3)
    }

    @Test
    fun rowsShowTheWaterOfTheLastRowThatFollowedIt() {
        val truth = doubleArrayOf(0.0, 1.0, 2.0, 2.1, 2.0, 1.0, 0.0, -3.0)
        val times = DoubleArray(truth.size) { it.toDouble() }
        val series = MeasuredSeries(times, times, times, truth, truth)
        fun of(number: Double, vararg causes: Cause): DoubleArray? {
            val model = ResponseModel(series, causes.map { Term(it) }, Steps.HELD, Scales(series))
            val numbers = DoubleArray(model.parameters.size)
            doubleArrayOf(1e-6, 1.0, 0.0, 0.0).copyInto(numbers)
            causes.forEach { numbers[model.slot(Term(it))] = number }
            return ShownRows.of(model, numbers)?.let { rows -> times.copyOf().also(rows::showIn) }
        }
        assertNull(of(0.0, Cause.ASYMMETRIC_RESPONSE))
        // The play is pulled up to row 3, and down again from row 5 on.
        val held = assertNotNull(of(1.0, Cause.HYSTERESIS))
        assertContentEquals(doubleArrayOf(0.0, 1.0, 2.0, 3.0, 3.0, 5.0, 6.0, 7.0), held)
        val led = assertNotNull(of(1.5, Cause.SLEW_LIMIT))
        assertContentEquals(doubleArrayOf(0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 6.0), led)
    }
}
