package stillwater.io

import org.junit.jupiter.api.Test
import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.ValueSource
import stillwater.model.Conditions
import kotlin.math.abs
import kotlin.math.floor
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** What was cut off times comes back as far as it can be known. */
class RestoredTimesTest {
    private fun cut(times: List<Double>, unit: Double) = times.map { floor(it / unit) * unit }

    private fun restored(stamps: List<Double>, unit: Double): List<Double> = buildList {
        val string = RestoredTimes(unit) { add(it.seconds) }
        stamps.forEach { string.take(TimedRow(1, it, 0.0, 0.0, 0.0, Conditions.NONE)) }
        string.end()
    }

    /** Root mean square of the errors of the steps between [found], of which [times] are true, s. */
    private fun ofSteps(found: List<Double>, times: List<Double>): Double {
        val errors = found.indices.map { found[it] - times[it] }.zipWithNext { a, b -> b - a }
        return sqrt(errors.sumOf { it * it } / errors.size)
    }

    @ParameterizedTest
    @ValueSource(doubles = [0.07, 0.2, 0.5, 0.7, 0.95, 0.998, 1.003, 1.05, 1.3, 2.5])
    fun rowsAtAConstantRateComeOutAtAConstantRate(step: Double) {
        val times = List(3000) { 0.37 + step * it }
        val found = restored(cut(times, 1.0), 1.0).zipWithNext { a, b -> b - a }
        // As far as the log is long: its first and last row are known to a second.
        for (each in found) assertEquals(step, each, 1.0 / times.size, "of ${found.size} steps")
        assertEquals(found.min(), found.max(), 1e-9)
    }

    @Test
    fun rowsStayWithinTheirUnitAndInOrder() {
        for (seed in 1..200) {
            val random = Random(seed)
            val unit = listOf(60.0, 1.0, 0.1)[seed % 3]
            val step = unit * random.nextDouble(0.05, 3.0)
            var time = if (seed % 2 == 0) 1.7e9 else 0.0
            // With pauses, and rows that come at once.
            val times = List(1 + random.nextInt(400)) {
                time += step * random.nextDouble(0.0, 2.0) + if (random.nextInt(40) == 0) 30 * unit else 0.0
                time
            }
            val stamps = cut(times, unit)
            val found = restored(stamps, unit)
            assertEquals(stamps.size, found.size, "seed $seed")
            for (i in found.indices) assertTrue(found[i] in stamps[i]..stamps[i] + unit, "seed $seed: row $i")
            assertTrue(found.zipWithNext().all { (a, b) -> b > a }, "seed $seed")
        }
    }

    @Test
    fun unevenRowsComeOutNearerThanTheyWereWritten() {
        for (seed in 1..20) {
            val random = Random(seed)
            var time = 0.0
            val times = List(2000) {
                time += random.nextDouble(0.9, 1.1)
                time
            }
            val stamps = cut(times, 1.0)
            // No more than their own unevenness, a twentieth of a second and some, is left.
            val left = ofSteps(restored(stamps, 1.0), times)
            assertTrue(left < 0.065, "seed $seed: $left s")
            assertTrue(ofSteps(stamps, times) > 0.15, "seed $seed")
        }
    }

    @Test
    fun theStringGoesOnWhereItWasTiedForItsLength() {
        val times = List(20_000) { 0.2 * it + 0.01 }
        val steps = restored(cut(times, 1.0), 1.0).zipWithNext { a, b -> b - a }
        assertTrue(steps.all { abs(it - 0.2) < 1e-3 }, "${steps.min()} to ${steps.max()}")
    }
}
