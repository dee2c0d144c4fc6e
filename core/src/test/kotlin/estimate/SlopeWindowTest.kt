package stillwater.estimate

import org.junit.jupiter.api.Test
import stillwater.property.between
import stillwater.property.drawn
import stillwater.property.forEvery
import java.math.BigDecimal
import java.math.MathContext
import kotlin.math.abs
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class SlopeWindowTest {
    @Test
    fun findsTheSlopeOfALineForStepsOfAnyLength() {
        val window = SlopeWindow(4)
        for (time in listOf(0.0, 1.0, 1.5, 7.0)) window.add(time, 3.0 - 0.25 * time)
        assertEquals(-0.25, window.slope(), 1e-16)
    }

    @Test
    fun anExampleByHand() {
        // t = 0, 1, 2, 3; v = 0, 1, 0, 1: t̄ = 1.5, v̄ = 0.5, Σ(t−t̄)(v−v̄) = 1, Σ(t−t̄)² = 5.
        val window = SlopeWindow(4)
        for ((time, value) in listOf(0.0 to 0.0, 1.0 to 1.0, 2.0 to 0.0, 3.0 to 1.0)) window.add(time, value)
        assertEquals(0.2, window.slope(), 1e-16)
    }

    @Test
    fun isExactlyZeroForAConstant() {
        val window = SlopeWindow(5)
        val random = Random(7)
        var time = 1.6e9
        repeat(50) {
            time += random.nextDouble()
            window.add(time, 0.1)
            assertEquals(0.0, window.slope(), 0.0)
        }
    }

    @Test
    fun isZeroWithoutTwoTimes() {
        val window = SlopeWindow(3)
        assertEquals(0.0, window.slope(), 0.0)
        window.add(5.0, 1.0)
        assertEquals(0.0, window.slope(), 0.0)
        window.add(5.0, 2.0)
        window.add(5.0, 9.0)
        assertTrue(window.full)
        assertEquals(0.0, window.slope(), 0.0)
    }

    @Test
    fun isFullAfterItsSizeAndEmptyAfterClear() {
        val window = SlopeWindow(2)
        window.add(0.0, 0.0)
        assertFalse(window.full)
        window.add(1.0, 100.0)
        assertTrue(window.full)
        window.clear()
        assertFalse(window.full)
        assertEquals(0.0, window.slope(), 0.0)
        window.add(2.0, 0.0)
        window.add(4.0, 1.0)
        assertEquals(0.5, window.slope(), 0.0)
    }

    @Test
    fun agreesWithExactArithmetic() {
        forEvery(drawn(::History), cases = 300) { history ->
            val window = SlopeWindow(history.size)
            val kept = ArrayList<Pair<Double, Double>>()
            for ((time, value) in history.samples) {
                window.add(time, value)
                kept += time to value
                val last = kept.takeLast(history.size)
                val spanTime = last.maxOf { it.first } - last.minOf { it.first }
                val spanValue = last.maxOf { it.second } - last.minOf { it.second }
                // Each sum of n terms loses at most n last places of spanTime · spanValue, and the sum of squares is at
                // least spanTime² / 2: n · n · 2e-16 · 4 with n up to 12, doubled twice for the means.
                val tolerance = if (spanTime > 0) 1e-12 * spanValue / spanTime else 0.0
                val exact = exactSlope(last)
                assertTrue(abs(exact - window.slope()) <= tolerance, "${window.slope()} instead of $exact of $last")
            }
        }
    }

    @Test
    fun theSignOfAMonotoneWindowIsNeverWrong() {
        // What the bounds rest on: no rounding may turn a rise into a fall, however uneven the times.
        forEvery(drawn { random -> random.nextLong() }, cases = 2000) { seed ->
            val random = Random(seed)
            val window = SlopeWindow(2 + random.nextInt(10))
            var time = 1.6e9
            var value = random.between(-5.0, 5.0)
            repeat(window.size) {
                window.add(time, value)
                if (random.nextBoolean()) time += if (random.nextInt(8) == 0) 1e5 else random.nextDouble() * 0.01
                if (random.nextInt(3) == 0) value += random.nextDouble() * if (random.nextBoolean()) 1e-12 else 1.0
            }
            assertTrue(window.slope() >= 0.0, "${window.slope()} of a rise, seed $seed")
        }
    }

    @Test
    fun sizeIsTwoAtLeast() {
        for (size in listOf(1, 0, -5)) {
            val error = assertFailsWith<IllegalArgumentException> { SlopeWindow(size) }
            assertEquals("slope window ($size values) must be at least 2", error.message)
        }
    }

    /** (n Σtv − Σt Σv) / (n Σt² − (Σt)²), all sums exact. */
    private fun exactSlope(samples: List<Pair<Double, Double>>): Double {
        val n = BigDecimal(samples.size)
        val times = samples.map { BigDecimal(it.first) }
        val values = samples.map { BigDecimal(it.second) }
        val sumTimes = times.fold(BigDecimal.ZERO, BigDecimal::add)
        val sumValues = values.fold(BigDecimal.ZERO, BigDecimal::add)
        val products = times.zip(values).fold(BigDecimal.ZERO) { sum, (t, v) -> sum + t * v }
        val squares = times.fold(BigDecimal.ZERO) { sum, t -> sum + t * t }
        val variance = n * squares - sumTimes * sumTimes
        if (variance.signum() == 0) return 0.0
        return (n * products - sumTimes * sumValues).divide(variance, MathContext.DECIMAL64).toDouble()
    }

    /** Irregular, sometimes equal times, small or as large as Unix stamps; values that repeat or do not. */
    private class History(random: Random) {
        val size = random.nextInt(2, 13)
        val samples: List<Pair<Double, Double>>

        init {
            var time = if (random.nextBoolean()) 1.6e9 else 0.0
            samples = List(random.nextInt(1, 60)) {
                if (random.nextInt(4) > 0) time += random.nextDouble(0.0, 3.0)
                time to if (random.nextBoolean()) random.nextInt(4) * 0.25 else random.between(-10.0, 40.0)
            }
        }

        override fun toString() = "size $size, $samples"
    }
}
