package stillwater.diagnose

import stillwater.diagnose.algebra.Spline
import stillwater.diagnose.evidence.LooseReadings
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.UnknownTruth
import kotlin.math.abs
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

/** Rows at which the truth is not known well are no wild readings, and do not make others look so. */
class MissingRowsTest {
    private fun water(time: Double) = 5 + sin(time / 1.1) + 0.8 * sin(time / 1.7 + 1)

    /** A row a second, but for every thirtieth, which is missing. */
    private val times = (0 until 600).filter { it % 30 != 17 }.map { it.toDouble() }.toDoubleArray()

    private fun seen(height: Double): UnknownTruth {
        val truth = DoubleArray(times.size) { height * water(times[it]) }
        return UnknownTruth.of(MeasuredSeries(times, times, DoubleArray(times.size), truth, truth))
    }

    @Test
    fun aRowMissingInWaterThatChangesFastShakesTheReading() {
        for (isHeld in listOf(false, true)) {
            val shocks = assertNotNull(seen(1.0).shocks(5.0, 1.0, 0.02, isHeld))
            val after = times.indices.filter { it > 5 && times[it] % 30 == 18.0 }
            assertTrue(after.all(shocks::isShaken), "$isHeld")
            // What a spline through the others is off by there, and a third of it that the lag lets through.
            val curve = Spline(times, null).also { curve -> curve.fit(DoubleArray(times.size) { water(times[it]) }) }
            val off =
                sqrt(
                    after.map {
                        (curve.at(it - 1, times[it] - 1) - water(times[it] - 1)).let { e -> e * e }
                    }.average(),
                )
            val shock = sqrt(after.map { shocks.variance[it] }.average()) * 0.02
            assertTrue(shock in 0.1 * off..3 * off, "$shock for $off")
        }
    }

    @Test
    fun aRowMissingInWaterThatChangesLittleDoesNot() {
        assertEquals(null, seen(1e-4).shocks(5.0, 1.0, 0.02, false))
    }

    @Test
    fun readingsThatAreSureAreNotOutliersForManyThatAreNot() {
        // The truth rests for more than half of the log: all rows in which it moves are in doubt.
        val n = 1000
        val random = java.util.Random(3)
        val at = DoubleArray(n) { it.toDouble() }
        val truth = DoubleArray(n) { if (it < MOVING) sin(at[it] / 9) - sin(MOVING / 9.0) else 0.0 }
        val values = DoubleArray(n) { truth[it] + (if (it < MOVING) 0.002 else 0.01) * random.nextGaussian() }
        // Of so many normal ones the farthest is 3.6 deviations off at times.
        values[700] = 0.036
        val series = MeasuredSeries(at, at, DoubleArray(n), values, truth)
        val unknown = UnknownTruth.of(series)
        assertTrue((2 until MOVING).count(unknown::isInDoubt) > 0.9 * MOVING)
        val scales = Scales(series, unknown)
        val model = ResponseModel(series, emptyList(), Steps.HELD, scales)
        val numbers = DoubleArray(model.parameters.size).also {
            it[ResponseModel.TIME_CONSTANT] = 1e-3
            it[ResponseModel.GAIN] = 1.0
        }
        val free = BooleanArray(numbers.size)
        val used = BooleanArray(n) { true }
        val fit = Fitting.at(model, numbers, free, scales.white(used))
        assertTrue(abs(fit.residuals[700] - 0.036) < 1e-6)
        assertTrue(LooseReadings(fit).pValue > 0.01, "${LooseReadings(fit).pValue}")
    }

    private companion object {
        const val MOVING = 490
    }
}
