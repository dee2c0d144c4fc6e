package stillwater.diagnose.blind

import org.junit.jupiter.api.Tag
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import kotlin.math.exp
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs

/** Noise that is not as large everywhere, in a log without a reference. */
class BlindUnevenNoiseTest {
    private val track = CrossingTrack(900)
    private val shown = track.shown(4.0)

    /** A lag of 4 s with noise of 0.01 times [factor] of the row and of what is shown there. */
    private fun verdict(factor: (Int, Double) -> Double): Verdict {
        val random = java.util.Random(SEED)
        val values = DoubleArray(shown.size) { shown[it] + 0.01 * factor(it, shown[it]) * random.nextGaussian() }
        return Diagnosis(MeasuredSeries(track.times, track.x, track.y, values, null)).run().verdict
    }

    @Test
    fun noiseThatIsLargerForAWhileIsUnexplained() {
        val verdict = verdict { row, _ -> if (row in 400..520) 6.0 else 1.0 }
        assertContains(assertIs<Verdict.Unexplained>(verdict, "seed $SEED").what, "the noise comes and goes")
    }

    @Test
    @Tag("long")
    fun noiseThatGoesWithTheValueIsUnexplained() {
        val verdict = verdict { _, value -> exp(value) }
        assertContains(assertIs<Verdict.Unexplained>(verdict, "seed $SEED").what, "the noise goes with the value")
    }

    @Test
    @Tag("long")
    fun evenNoiseIsNone() {
        assertEquals(Verdict.Consistent, verdict { _, _ -> 1.0 }, "seed $SEED")
    }

    private companion object {
        const val SEED = 20_281L
    }
}
