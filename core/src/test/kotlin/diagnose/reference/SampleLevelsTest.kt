package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.Loops
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import stillwater.diagnose.response.UnknownTruth
import java.util.Random
import kotlin.math.exp
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertTrue

/**
 * A probe that is moved between samples beside a reference whose noise is more than its own: what it does not follow is
 * noise, and no dead band, and no end of its range. Seeds fixed before the first run.
 */
class SampleLevelsTest {
    private val n = 900

    /** Samples of 30 to 90 s, a row a second. */
    private fun samples(random: Random): DoubleArray {
        var left = 0
        var level = 0.0
        return DoubleArray(n) {
            if (left-- == 0) {
                left = 30 + random.nextInt(60)
                level = 4 + 10 * random.nextDouble()
            }
            level
        }
    }

    /** What a lag of 5 s shows of samples, as [read] reads it with noise of 0.01, beside a reference with noise of [spread]. */
    private fun log(seed: Long, spread: Double, read: (Double) -> Double = { it }): MeasuredSeries {
        val random = Random(seed)
        val truth = samples(random)
        var shown = truth[0]
        val values = DoubleArray(n) {
            shown += (1 - exp(-1.0 / 5)) * (truth[it] - shown)
            read(shown) + 0.01 * random.nextGaussian()
        }
        val still = DoubleArray(n)
        val reference = DoubleArray(n) { truth[it] + spread * random.nextGaussian() }
        return MeasuredSeries(DoubleArray(n) { it.toDouble() }, still, still, values, reference)
    }

    @Test
    fun theNoiseOfAReferenceIsNoEffectOfTheSensor() {
        for (spread in listOf(0.01, 0.02, 0.05)) {
            for (seed in 20261201L..20261203L) {
                val verdict = Diagnosis(log(seed, spread)).run().verdict
                assertIs<Verdict.Consistent>(verdict, "seed $seed, noise of the reference $spread: $verdict")
            }
        }
    }

    @Test
    fun anEndOfTheRangeAndADeadBandAreFoundAllTheSame() {
        var last = Double.NaN
        val band = 0.1
        val logs = listOf(
            Cause.SATURATION to log(20261204, 0.02) { minOf(it, 12.0) },
            Cause.HYSTERESIS to log(20261205, 0.02) {
                last = if (last.isNaN()) it else last.coerceIn(it - band, it + band)
                last
            },
        )
        for ((cause, log) in logs) {
            val verdict = assertIs<Verdict.Named>(Diagnosis(log).run().verdict)
            assertEquals(listOf(cause), verdict.causes)
        }
    }

    @Test
    fun heightsAreToldByTheReadingsToo() {
        val log = log(20261206, 0.05)
        val truth = samples(Random(20261206))
        val models = BaseModels(
            log,
            DiagnosisSettings(),
            UnknownTruth.of(log),
            BooleanArray(n) { true },
            0.0,
        )
        val isBroken = BooleanArray(n) { it > 0 && truth[it] != truth[it - 1] }
        val levels = SampleLevels(log, isBroken, 0.05, 60.0, Loops.IN_TURN)
        fun off(course: DoubleArray) = (0 until n).sumOf { (course[it] - truth[it]) * (course[it] - truth[it]) }
        val (heights, _) = levels.told(models.settled(null))
        assertTrue(levels.isFew)
        assertTrue(off(heights) < off(levels.means), "${off(heights)} and ${off(levels.means)}")
    }
}
