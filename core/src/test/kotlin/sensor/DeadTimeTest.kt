package stillwater.sensor

import io.kotest.property.Arb
import io.kotest.property.arbitrary.int
import io.kotest.property.arbitrary.numericDouble
import org.junit.jupiter.api.Test
import stillwater.model.Conditions
import stillwater.property.forEvery
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class DeadTimeTest {
    private fun DeadTime.step(input: Double, dt: Double) = step(input, dt, Conditions.NONE)

    @Test
    fun twoEqualStepsShiftByTwoSamples() {
        val delay = DeadTime(2.0, initial = -1.0)
        assertEquals(listOf(-1.0, -1.0, 1.0, 2.0, 3.0, 4.0), (1..6).map { delay.step(it.toDouble(), 1.0) })
    }

    @Test
    fun stepsOfATenthAreShiftedByWholeSamplesForHours() {
        val delay = DeadTime(0.3, initial = 0.0)
        // A tenth is no binary number: its sums must not lose or win a sample.
        for (i in 1..100_000) assertEquals(maxOf(0, i - 3).toDouble(), delay.step(i.toDouble(), 0.1), "sample $i")
    }

    @Test
    fun showsTheInputThatHeldThen() {
        forEvery(Arb.int(), Arb.numericDouble(0.0, 30.0)) { seed, deadTime ->
            val random = Random(seed)
            val delay = DeadTime(deadTime, initial = -7.0)
            val ends = ArrayList<Double>()
            var now = 0.0
            for (i in 0 until 80) {
                val dt = random.nextDouble(0.01, 4.0)
                now += dt
                ends += now
                val wanted = now - deadTime
                val shown = delay.step(i.toDouble(), dt)
                // Where the wanted time is next to the end of a step, roundings decide.
                if (ends.any { kotlin.math.abs(it - wanted) < 1e-6 } || kotlin.math.abs(wanted) < 1e-6) continue
                val expected = if (wanted < 0) -7.0 else ends.indexOfFirst { it >= wanted }.toDouble()
                assertEquals(expected, shown, "seed $seed, step $i")
            }
        }
    }

    @Test
    fun aStepLongerThanTheDeadTimeShowsItself() {
        val delay = DeadTime(2.0, initial = 0.0)
        assertEquals(5.0, delay.step(5.0, 100.0), 0.0)
        assertEquals(5.0, delay.step(6.0, 1.0), 0.0)
    }

    @Test
    fun manyTinyStepsDoNotFillTheMemory() {
        val delay = DeadTime(1.0, initial = 0.0)
        var shown = 0.0
        for (i in 1..1_000_000) shown = delay.step(i * 1e-6, 1e-6)
        for (i in 1..1_000_000) shown = delay.step(1 + i * 1e-6, 1e-6)
        // Steps are held together over a 65 536th of the dead time, 16 of them here.
        assertEquals(1.0, shown, 2.0 / 65_536)
    }

    @Test
    fun timeStandsStillWithoutALengthOrAnInput() {
        val delay = DeadTime(1.5, initial = 4.0)
        delay.step(1.0, 1.0)
        for (dt in listOf(0.0, -1.0, Double.NaN, Double.POSITIVE_INFINITY)) assertEquals(4.0, delay.step(9.0, dt), 0.0)
        assertEquals(4.0, delay.step(Double.NaN, 5.0), 0.0)
        assertEquals(1.0, delay.step(2.0, 1.0), 0.0)
    }

    @Test
    fun noDeadTimeIsNoDelay() {
        val none = DeadTime(0.0, initial = 4.0)
        assertEquals(9.0, none.step(9.0, 1.0), 0.0)
        assertTrue((1..1000).all { none.step(it.toDouble(), 0.5) == it.toDouble() })
    }

    @Test
    fun impossibleNumbersAreRefusedByName() {
        for (time in listOf(-1.0, Double.NaN, Double.POSITIVE_INFINITY)) {
            val error = assertFailsWith<IllegalArgumentException> { DeadTime(time, 0.0) }
            assertEquals("deadTime ($time s) must be at least 0 and finite", error.message)
        }
    }
}
