package stillwater.diagnose.response

import org.junit.jupiter.api.Tag
import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** A sensor that shows nothing beyond one end of its range, in water that is beyond it for long. */
class RangeEndTest {
    private val n = 1500
    private val times = DoubleArray(n) { it.toDouble() }

    /** Slow water with a little of the fast, so that a few long stretches are cut off. */
    private fun water(time: Double) = 25 + 0.2 * sin(time / 130) + 0.04 * sin(time / 19 + 1)

    /** Seeds from [SEED]; the noise is white, a five-hundredth of the water's spread. */
    @Test
    @Tag("long")
    fun theGainIsThatOfTheReadingsWithinTheRange() {
        for (seed in SEED until SEED + 4) {
            val random = java.util.Random(seed)
            var state = water(0.0)
            val values = DoubleArray(n) { i ->
                repeat(20) { k -> state += -Math.expm1(-0.05 / LAG) * (water(i - 1 + (k + 0.5) / 20) - state) }
                minOf(state + NOISE * random.nextGaussian(), END)
            }
            val reference = DoubleArray(n) { water(times[it]) }
            val result = Diagnosis(MeasuredSeries(times, times, DoubleArray(n), values, reference)).run()
            assertEquals(Verdict.Named(listOf(Cause.SATURATION)), result.verdict, "seed $seed")
            val numbers = checkNotNull(result.extended).parameters.associate { it.name to it.value }
            assertEquals(1.0, numbers.getValue("gain"), 0.005, "seed $seed: $numbers")
            assertEquals(LAG, numbers.getValue("time_constant_s"), 0.02 * LAG, "seed $seed: $numbers")
            assertEquals(END, numbers.getValue("upper"), 3 * NOISE, "seed $seed: $numbers")
            assertTrue("lower" !in numbers, "seed $seed: $numbers")
        }
    }

    /** Slow water with four bursts that are over within rows, as a lag of 2 s shows it; what [read] makes of each row. */
    private fun bursts(random: java.util.Random, read: (Int, Double) -> Double): MeasuredSeries {
        val short = times.copyOf(600)
        fun burst(time: Double) = listOf(110.0, 260.0, 380.0, 520.0).sumOf { exp(-(time - it) * (time - it) / 2) }
        val truth = DoubleArray(short.size) { 10 + sin(short[it] / 15) + 3 * burst(short[it]) }
        var state = truth[0]
        val values = DoubleArray(short.size) {
            state += -Math.expm1(-0.5) * (truth[it] - state)
            read(it, state) + 0.02 * random.nextGaussian()
        }
        return MeasuredSeries(short, short, DoubleArray(short.size), values, truth)
    }

    @Test
    fun aReadingThatAnEndOfTheRangeCutsOffAloneIsNotWild() {
        val shown = bursts(java.util.Random(SEED + 10)) { _, value -> value }.values.sortedDescending()
        // In each of the two highest bursts no more than a row or two is beyond it.
        val end = shown[3] - 0.05
        val result = Diagnosis(bursts(java.util.Random(SEED + 11)) { _, value -> minOf(value, end) }).run()
        assertEquals(Verdict.Named(listOf(Cause.SATURATION)), result.verdict)
        val upper = checkNotNull(result.extended).parameters.single { it.name == "upper" }
        assertEquals(end, upper.value, 0.06)
        assertEquals(emptyList(), result.spikes)
    }

    @Test
    fun wildReadingsBelowTheWaterAreNoEndOfTheRange() {
        val wild = setOf(70, 133, 222, 345, 480)
        val log = bursts(java.util.Random(SEED + 12)) { i, value -> if (i in wild) value - 0.4 else value }
        val verdict = Diagnosis(log).run().verdict
        assertTrue(verdict !is Verdict.Named || Cause.SATURATION !in verdict.causes, "$verdict")
    }

    private companion object {
        const val SEED = 20261126L
        const val LAG = 9.0
        const val NOISE = 4e-4
        const val END = 25.12
    }
}
