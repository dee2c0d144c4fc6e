package stillwater.estimate

import org.junit.jupiter.api.Test
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class EpsilonCalibrationTest {
    @Test
    fun findsNothingToIgnoreInASilentSensor() {
        val calibration = EpsilonCalibration()
        for (i in 0 until 100) calibration.add(i.toDouble(), 7.5)
        assertEquals(0.0, calibration.epsilon())
        assertEquals(100 - 6, calibration.slopes)
    }

    @Test
    fun doesNotTakeASteadyDriftForNoise() {
        val calibration = EpsilonCalibration()
        for (i in 0 until 100) calibration.add(i * 0.5, 3.0 - 0.02 * i)
        assertEquals(-0.04, calibration.drift(), 1e-12)
        assertEquals(0.0, calibration.epsilon(), 1e-12)
    }

    @Test
    fun growsInProportionToTheNoise() {
        fun epsilon(noise: Double): Double {
            val random = Random(SEED)
            val calibration = EpsilonCalibration()
            for (i in 0 until 500) calibration.add(i.toDouble(), noise * random.nextDouble(-1.0, 1.0))
            return calibration.epsilon()
        }
        assertTrue(epsilon(0.1) > 0, "seed $SEED")
        assertEquals(10 * epsilon(0.1), epsilon(1.0), 1e-12)
    }

    @Test
    fun leavesHardlyASlopeOfTheStretchAboveIt() {
        val random = Random(SEED)
        val readings = DoubleArray(2_000) { random.nextDouble() }
        val calibration = EpsilonCalibration()
        readings.forEachIndexed { i, value -> calibration.add(i.toDouble(), value) }
        // The definition: 99 % of the slopes are no further from the median slope than epsilon.
        val epsilon = calibration.epsilon()
        val medians = MedianWindow(3)
        val slopes = SlopeWindow(5)
        var above = 0
        readings.forEachIndexed { i, value ->
            medians.add(i.toDouble(), value)
            if (medians.full) slopes.add(medians.time, medians.median)
            if (slopes.full && kotlin.math.abs(slopes.slope() - calibration.drift()) > epsilon) above++
        }
        assertTrue(above in 1..calibration.slopes / 100, "seed $SEED: $above of ${calibration.slopes}")
    }

    @Test
    fun takesNoSingleStepOfTheResolutionForASlope() {
        for (size in listOf(2, 5, 8)) {
            val least = EpsilonCalibration.stepSlope(resolution = 0.01, step = 2.0, slopeWindow = size)
            val window = SlopeWindow(size)
            var steepest = 0.0
            // A flat line, one step, a flat line: the step passes through every place of the window.
            for (i in 0 until 4 * size) {
                window.add(2.0 * i, if (i < 2 * size) 7.00 else 7.01)
                if (window.full) steepest = maxOf(steepest, window.slope())
            }
            assertTrue(least > steepest, "$size medians: $least, steepest $steepest")
            // No more than the margin of 5 % above it.
            assertEquals(1.05 * steepest, least, 1e-9)
        }
        assertEquals(1.05 * 0.3 * 0.1, EpsilonCalibration.stepSlope(resolution = 0.1, step = 1.0), 1e-12)
        assertFailsWith<IllegalArgumentException> { EpsilonCalibration.stepSlope(0.1, 0.0) }
    }

    @Test
    fun startsAgainAfterAGap() {
        val calibration = EpsilonCalibration()
        for (i in 0 until 10) calibration.add(i.toDouble(), 1.0)
        calibration.interrupt()
        for (i in 0 until 10) calibration.add(1_000.0 + i, 9.0)
        assertEquals(8, calibration.slopes)
        assertEquals(0.0, calibration.epsilon(quantile = 1.0))
        calibration.clear()
        assertTrue(calibration.epsilon().isNaN())
    }

    @Test
    fun leavesOutWhatIsNotFiniteAndRefusesWhatIsNoQuantile() {
        val calibration = EpsilonCalibration(medianWindow = 1, slopeWindow = 2)
        calibration.add(0.0, 1.0)
        calibration.add(1.0, Double.NaN)
        calibration.add(2.0, 1.0)
        assertEquals(1, calibration.slopes)
        assertFailsWith<IllegalArgumentException> { calibration.epsilon(1.5) }
        assertFailsWith<IllegalArgumentException> { EpsilonCalibration(medianWindow = 2) }
    }

    private companion object {
        const val SEED = 5
    }
}
