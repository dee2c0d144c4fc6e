package stillwater.diagnose

import org.junit.jupiter.api.Tag
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs

/** What is usual in the field and no effect of the sensor is named as none. Seeds are fixed, the cases no tuned ones. */
class FieldConditionsTest {
    private val n = 1200
    private val lag = 8.0

    /** Waves of 12 to 200 s, those of 40 s as high as any. */
    private class Water(seed: Long) {
        private val random = java.util.Random(seed)
        private val waves = List(24) {
            val period = 12 * exp(random.nextDouble() * 2.8)
            Triple(2 * PI / period, 2 * PI * random.nextDouble(), 0.2 * minOf(period / 40, 1.0))
        }

        fun at(time: Double) = 8 + waves.sumOf { (rate, phase, height) -> height * sin(rate * time + phase) }
    }

    private fun lagged(water: (Double) -> Double, vararg more: SensorStage): DoubleArray {
        val stages = listOf<SensorStage>(SensorStage.Lag(lag)) + more
        val sensor = SensorSpec("", stages).build(water(0.0), kotlin.random.Random(1))
        return DoubleArray(n) { row ->
            var shown = sensor.step(water(row.toDouble()), 0.0, Conditions.NONE)
            if (row > 0) {
                repeat(10) { k -> shown = sensor.step(water(row - 1 + (k + 0.5) / 10), 0.1, Conditions.NONE) }
            }
            shown
        }
    }

    private fun readings(water: Water, random: java.util.Random) =
        lagged(water::at).also { for (i in it.indices) it[i] += 0.01 * random.nextGaussian() }

    private fun diagnosed(values: DoubleArray, reference: DoubleArray): DiagnosisResult {
        val times = DoubleArray(n) { it.toDouble() }
        return Diagnosis(MeasuredSeries(times, times, DoubleArray(n), values, reference)).run()
    }

    private fun truth(water: Water) = DoubleArray(n) { water.at(it.toDouble()) }

    @Test
    fun noiseThatGrowsWithTheRateOfChangeIsNoCause() {
        for (seed in 1L..4L) {
            val water = Water(seed)
            val random = java.util.Random(seed + 100)
            val clean = lagged(water::at)
            val noisy = DoubleArray(n) { i ->
                val rate = abs(clean[i] - clean[maxOf(i - 1, 0)])
                clean[i] + (0.005 + rate) * random.nextGaussian()
            }
            assertEquals(Verdict.Consistent, diagnosed(noisy, truth(water)).verdict, "seed $seed")
        }
    }

    @Test
    fun noiseThatGrowsWithTheWatersOwnRateIsNoCause() {
        for (seed in 5L..6L) {
            val water = Water(seed)
            val random = java.util.Random(seed + 100)
            val rates = DoubleArray(n) { abs(water.at(it + 0.05) - water.at(it - 0.05)) / 0.1 }
            val noisy = lagged(water::at)
            for (i in 0 until n) noisy[i] += 0.02 * (0.4 + 1.2 * rates[i] / rates.average()) * random.nextGaussian()
            assertEquals(Verdict.Consistent, diagnosed(noisy, truth(water)).verdict, "seed $seed")
        }
    }

    @Test
    fun noiseWithHeavyTailsIsNoSingleWrongReadings() {
        for (seed in 41L..43L) {
            val water = Water(seed)
            val random = java.util.Random(seed)
            val values = lagged(water::at)
            // Student's t with five degrees of freedom.
            for (i in values.indices) {
                val squares = List(5) { random.nextGaussian() }.sumOf { it * it }
                values[i] += 0.01 * random.nextGaussian() / sqrt(squares / 5)
            }
            assertEquals(Verdict.Consistent, diagnosed(values, truth(water)).verdict, "seed $seed")
        }
    }

    @Test
    fun aReferenceThatIsLateIsSaidToBe() {
        for (seed in 11L..13L) {
            val water = Water(seed)
            val random = java.util.Random(seed)
            val values = readings(water, random)
            val late = DoubleArray(n) { water.at(it - 2.0) }
            val verdict = assertIs<Verdict.Unexplained>(diagnosed(values, late).verdict, "seed $seed")
            assertContains(verdict.what, "ahead of the reference by")
        }
    }

    @Test
    @Tag("long")
    fun smallWaterThatTheReferenceAloneSeesIsNoEndOfTheRange() {
        for (seed in 21L..23L) {
            val water = Water(seed)
            val random = java.util.Random(seed)
            val values = readings(water, random)
            var patch = 0.0
            val beside = DoubleArray(n) { i ->
                patch = 0.7 * patch + 0.05 * random.nextGaussian()
                water.at(i.toDouble()) + patch
            }
            val verdict = diagnosed(values, beside).verdict
            val named = (verdict as? Verdict.Named)?.causes.orEmpty()
            assertEquals(emptyList(), named, "seed $seed: $verdict")
        }
    }

    @Test
    fun dipsThatFadeAreNoOutliers() {
        val water = Water(31)
        val random = java.util.Random(31)
        val begins = List(10) { 60 + 110 * it }
        val values = lagged(water::at)
        for (i in values.indices) {
            val dips = begins.filter { it <= i }.sumOf { 0.15 * exp(-(i - it) / 30.0) }
            values[i] += 0.01 * random.nextGaussian() - dips
        }
        val verdict = assertIs<Verdict.Unexplained>(diagnosed(values, truth(water)).verdict)
        assertContains(verdict.what, "change suddenly")
    }
}
