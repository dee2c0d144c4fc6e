package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.MeasuredSeries
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

/** Without a reference it does not matter in which unit what a sensor also shows is logged. */
class ConditionUnitsTest {
    private val track = CrossingTrack(ROWS)

    /** Readings that show a condition [light] by [shown] for what it differs by from its middle in all. */
    private fun diagnosed(unit: Double): DiagnosisResult {
        val random = java.util.Random(5)
        val light = DoubleArray(ROWS) { sin(it / 47.0) + 0.6 * sin(it / 13.0 + 2) }
        val response = track.shown(5.0)
        val values = DoubleArray(ROWS) { response[it] + SHOWN * light[it] + 0.01 * random.nextGaussian() }
        val logged = mapOf("light" to DoubleArray(ROWS) { unit * (3 + light[it]) })
        return Diagnosis(MeasuredSeries(track.times, track.x, track.y, values, null, logged)).run()
    }

    @Test
    fun theAnswerIsTheSameInAnyUnit() {
        val coefficients = listOf(1e-3, 1.0, 1e4).map { unit ->
            val found = diagnosed(unit)
            val cross = assertNotNull(found.candidates.firstOrNull { it.cause == Cause.CROSS_SENSITIVITY })
            assertTrue(cross.adjustedPValue < 1e-6, "p ${cross.adjustedPValue} with a unit of $unit")
            cross.parameters.first { "coefficient" in it.name }.value * unit
        }
        for (each in coefficients) assertEquals(SHOWN, each, 0.1 * SHOWN, "$coefficients")
    }

    private companion object {
        const val ROWS = 700
        const val SHOWN = 0.04
    }
}
