package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import java.util.Random
import kotlin.math.exp
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** A slow sensor beside a reference whose noise wanders for longer than the sensor takes. */
class WanderingNoiseTest {
    private val rows = 1200

    private fun truth(time: Double) = 9 + sin(time / 31) + 0.6 * sin(time / 17 + 1) + 0.3 * sin(time / 73)

    /** A lag of 8 s, a row every two; the logger repeats the row before in those [stale]. */
    private fun log(seed: Long, stale: Set<Int>): MeasuredSeries {
        val random = Random(seed)
        var state = truth(0.0)
        var noise = random.nextGaussian()
        val keep = exp(-PERIOD / WANDER)
        val values = DoubleArray(rows)
        for (row in 0 until rows) {
            for (step in 0 until if (row > 0) STEPS else 0) {
                val time = (row - 1 + (step + 0.5) / STEPS) * PERIOD
                state += (1 - exp(-PERIOD / STEPS / LAG)) * (truth(time) - state)
            }
            noise = keep * noise + sqrt(1 - keep * keep) * random.nextGaussian()
            values[row] = if (row in stale) values[row - 1] else state + NOISE * (noise + 0.1 * random.nextGaussian())
        }
        val times = DoubleArray(rows) { it * PERIOD }
        val still = DoubleArray(rows)
        return MeasuredSeries(times, still, still, values, DoubleArray(rows) { truth(times[it]) })
    }

    /** Whitened, each shows there and back: next to each other, and neither then sticks out of those beside it. */
    @Test
    fun readingsThatAreRepeatedAreWildAndNoJumps() {
        for (seed in 1L..4L) {
            val random = Random(seed)
            val stale = List(20) { 20 + random.nextInt(rows - 40) }.toSet()
            val result = Diagnosis(log(seed, stale)).run()
            val named = (result.verdict as? Verdict.Named)?.causes.orEmpty()
            assertTrue(named.all { it == Cause.OUTLIERS }, "${result.verdict}, seed $seed")
        }
    }

    @Test
    fun itIsSaidThatWhatComesAndGoesMayBeTakenForIt() {
        val result = Diagnosis(log(SEED, emptySet())).run()
        assertEquals(Verdict.Consistent, result.verdict, "seed $SEED")
        assertTrue(result.warnings.any { "longer than the lag is" in it }, "${result.warnings}")
    }

    private companion object {
        const val SEED = 7L
        const val PERIOD = 2.0
        const val LAG = 8.0
        const val WANDER = 30.0
        const val NOISE = 0.01
        const val STEPS = 20
    }
}
