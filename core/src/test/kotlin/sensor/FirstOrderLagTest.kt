package stillwater.sensor

import io.kotest.property.Arb
import io.kotest.property.arbitrary.numericDouble
import org.junit.jupiter.api.Test
import stillwater.model.Conditions
import stillwater.property.forEvery
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.pow
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class FirstOrderLagTest {
    private fun FirstOrderLag.step(input: Double, dt: Double) = step(input, dt, Conditions.NONE)

    @Test
    fun followsTheClosedFormForIrregularSteps() {
        val lag = FirstOrderLag(timeConstant = 9.5, initial = 2.0)
        var elapsed = 0.0
        for (dt in listOf(0.1, 3.0, 0.007, 25.0, 1e-6, 9.5)) {
            elapsed += dt
            // s(t) = ψ + (s(0) − ψ) exp(−t/τ) with ψ = 8, s(0) = 2.
            val expected = 8.0 - 6.0 * exp(-elapsed / 9.5)
            // Six steps, each rounded a few times at magnitude 8: 1e-14 is ten units in the last place.
            assertEquals(expected, lag.step(8.0, dt), 1e-14)
        }
    }

    @Test
    fun showsSixtyThreePercentOfAStepAfterTheTimeConstant() {
        // 1 − 1/e; one rounding of a number below 1.
        assertEquals(0.632120558828557678, FirstOrderLag(30.0, 0.0).step(1.0, 30.0), 1e-15)
    }

    @Test
    fun twoPartialStepsEqualOneWholeStep() {
        forEvery(
            Arb.numericDouble(0.01, 1000.0),
            Arb.numericDouble(1e-4, 5000.0),
            Arb.numericDouble(0.0, 1.0),
        ) { tau, dt, share ->
            val whole = FirstOrderLag(tau, initial = -3.0)
            val parts = FirstOrderLag(tau, initial = -3.0)
            parts.step(10.0, share * dt)
            // Exact but for rounding; share·dt + (1 − share)·dt itself is rounded, at most 1e-15 of dt/τ · 13.
            val tolerance = 1e-14 * (1 + dt / tau) * 13
            assertEquals(whole.step(10.0, dt), parts.step(10.0, dt - share * dt), minOf(tolerance, 1e-9))
        }
    }

    @Test
    fun neverLeavesTheRangeOfStateAndInput() {
        forEvery(
            Arb.numericDouble(-1e6, 1e6),
            Arb.numericDouble(-1e6, 1e6),
            Arb.numericDouble(1e-3, 1e3),
            cases = 20_000,
        ) { initial, input, dt ->
            val output = FirstOrderLag(10.0, initial).step(input, dt)
            assertTrue(output in minOf(initial, input)..maxOf(initial, input), "$output")
        }
    }

    @Test
    fun alphaAndTimeConstantAreTwoNamesOfOneThing() {
        forEvery(Arb.numericDouble(1e-6, 0.999), Arb.numericDouble(1e-3, 1e4)) { alpha, period ->
            val tau = FirstOrderLag.timeConstant(alpha, period)
            // A unit step shows the gain per sample. Near alpha = 1 the exponent is up to 7: a few last places.
            assertEquals(alpha, FirstOrderLag(tau, 0.0).step(1.0, period), 1e-14)
        }
        // τ = −Δt / ln(1 − α), computed by hand for the report's alpha of 0.1 at 1 s.
        assertEquals(9.491221581029903, FirstOrderLag.timeConstant(0.1, 1.0), 1e-14)
        assertEquals(-2.0 / ln(0.5), FirstOrderLag.timeConstant(0.5, 2.0), 1e-15)
    }

    @Test
    fun aTinyAlphaKeepsItsDigits() {
        // τ → Δt/α − Δt/2 for small α; relative error of the series α²/12.
        assertEquals(1e18, FirstOrderLag.timeConstant(1e-18, 1.0), 1e3)
        assertEquals(1e9 - 0.5, FirstOrderLag.timeConstant(1e-9, 1.0), 1e-6)
    }

    @Test
    fun smallStepsKeepTheirGain() {
        // dt/τ = 1e-12: 1 − exp(−x) would keep four digits, expm1 keeps all; x − x²/2.
        assertEquals(1e-12, FirstOrderLag(1.0, 0.0).step(1.0, 1e-12), 1e-24)
    }

    @Test
    fun noTimeNoChange() {
        for (dt in listOf(0.0, -0.0, -1.0, Double.NaN, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY)) {
            val lag = FirstOrderLag(5.0, initial = 4.0)
            assertEquals(4.0, lag.step(9.0, dt), 0.0, "dt = $dt")
        }
    }

    @Test
    fun keepsItsStateWhenTheInputIsNotFinite() {
        val lag = FirstOrderLag(5.0, initial = 4.0)
        val before = lag.step(9.0, 1.0)
        for (input in listOf(Double.NaN, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY)) {
            assertEquals(before, lag.step(input, 1.0), 0.0, "input = $input")
        }
        assertTrue(lag.step(9.0, 1.0) > before)
    }

    @Test
    fun theLargestNumbersDoNotOverflow() {
        val lag = FirstOrderLag(1.0, initial = -Double.MAX_VALUE)
        val output = lag.step(Double.MAX_VALUE, 1.0)
        // −M + (1 − 1/e) 2M = (1 − 2/e) M.
        assertEquals(1 - 2 / exp(1.0), output / Double.MAX_VALUE, 1e-15)
    }

    @Test
    fun theSameBitsWithHalvesAndWithout() {
        val random = Random(20_261_123)

        // From numbers without a full mantissa to those whose difference overflows, and those of everyday water.
        fun drawn(): Double {
            val size = if (random.nextBoolean()) 0.0 else random.nextDouble(-323.0, 308.2)
            return listOf(-1, 1).random(random) * random.nextDouble(0.1, 1.0) * 10.0.pow(size)
        }
        repeat(200_000) {
            val state = drawn()
            // Near the state too, where the step is small.
            val input = if (random.nextInt(3) == 0) state * (1 + random.nextDouble() * 1e-14) else drawn()
            val gain = if (random.nextInt(4) == 0) 10.0.pow(random.nextDouble(-300.0, 0.0)) else random.nextDouble()
            if (!input.isFinite()) return@repeat
            val next = 2 * (state / 2 + gain * (input / 2 - state / 2))
            val isBeyond = if (input > state) next > input else next < input
            val expected = if (isBeyond) input else next
            assertEquals(expected.toRawBits(), towards(state, input, gain).toRawBits(), "$state, $input, $gain")
        }
    }

    @Test
    fun theGainFollowsAChangeOfStepAndBack() {
        val lag = FirstOrderLag(2.0, initial = 0.0)
        var expected = 0.0
        for (dt in listOf(1.0, 1.0, 0.5, 1.0, 0.5, 0.5)) {
            expected += (1 - exp(-dt / 2.0)) * (1 - expected)
            // A handful of roundings below 1.
            assertEquals(expected, lag.step(1.0, dt), 1e-15)
        }
    }

    @Test
    fun stepsTogetherAreTheSameBits() {
        val random = Random(20_261_125)
        fun build() = SensorSpec("lag", listOf(SensorStage.Lag(3.0))).build(0.4, Random(1))
        val together = build()
        val singly = build()
        val outputs = DoubleArray(12)
        for (stay in 0 until 1000) {
            val input = if (stay % 9 == 0) Double.NaN else random.nextDouble() - 0.2
            val dt = listOf(1.0, 0.25, 0.0, Double.POSITIVE_INFINITY)[random.nextInt(4)]
            val count = random.nextInt(outputs.size + 1)
            outputs.fill(-9.0)
            together.stepAll(input, dt, Conditions.NONE, outputs, count)
            for (i in 0 until count) assertEquals(singly.step(input, dt, Conditions.NONE), outputs[i])
            for (i in count until outputs.size) assertEquals(-9.0, outputs[i])
        }
    }

    @Test
    fun aChainsStepsTogetherAreTheSameBits() {
        val stages = listOf(SensorStage.Noise(0.1), SensorStage.Lag(3.0), SensorStage.Noise(0.2))
        fun build() = SensorSpec("noisy", stages).build(0.4, Random(7))
        val together = build()
        val singly = build()
        val outputs = DoubleArray(10)
        for (stay in 0 until 100) {
            together.stepAll(stay % 3.0, 1.0, Conditions.NONE, outputs, 10)
            for (i in 0 until 10) assertEquals(singly.step(stay % 3.0, 1.0, Conditions.NONE), outputs[i])
        }
    }

    @Test
    fun impossibleNumbersAreRefusedByName() {
        for (tau in listOf(0.0, -1.0, Double.NaN, Double.POSITIVE_INFINITY)) {
            val error = assertFailsWith<IllegalArgumentException> { FirstOrderLag(tau, 0.0) }
            assertEquals("timeConstant ($tau s) must be above 0 and finite", error.message)
        }
        for (initial in listOf(Double.NaN, Double.NEGATIVE_INFINITY)) {
            val error = assertFailsWith<IllegalArgumentException> { FirstOrderLag(1.0, initial) }
            assertEquals("initial ($initial) must be finite", error.message)
        }
        for (alpha in listOf(0.0, 1.0, -0.1, 1.1, Double.NaN)) {
            assertFailsWith<IllegalArgumentException> { FirstOrderLag.timeConstant(alpha, 1.0) }
        }
        for (period in listOf(0.0, -1.0, Double.NaN, Double.POSITIVE_INFINITY)) {
            assertFailsWith<IllegalArgumentException> { FirstOrderLag.timeConstant(0.1, period) }
        }
    }

    @Test
    fun theLagBehindARampIsTheTimeConstant() {
        // A first-order sensor trails a ramp of slope r by r·τ. Steps hold the input, which adds r·dt/2 of lead.
        val tau = 7.0
        val dt = 0.01
        val lag = FirstOrderLag(tau, 0.0)
        var output = 0.0
        var time = 0.0
        while (time < 20 * tau) {
            time += dt
            output = lag.step(0.3 * time, dt)
        }
        // exp(−20) of the transient is left, 2e-9, times r·τ; the held input moves it by r·dt/2 = 0.0015.
        assertTrue(abs(0.3 * time - output - 0.3 * tau) < 0.002, "${0.3 * time - output}")
    }
}
