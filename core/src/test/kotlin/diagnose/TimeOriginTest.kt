package stillwater.diagnose

import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals

/** A log counted from 1970 and the same from its first row differ by a quarter of a microsecond here and there. */
class TimeOriginTest {
    private val n = 600
    private val track = CrossingTrack(n)
    private val truth = DoubleArray(n) { sin(track.x[it] / 4) + sin(track.y[it] / 5 + 1) }

    private fun answer(origin: Double, withReference: Boolean): String {
        val random = java.util.Random(SEED)
        val times = DoubleArray(n) { origin + 0.7 * it }
        var state = truth[0]
        val values = DoubleArray(n) { i ->
            state += (truth[i] - state) / 4
            state + 0.01 * random.nextGaussian()
        }
        val reference = truth.takeIf { withReference }
        val result = Diagnosis(MeasuredSeries(times, track.x, track.y, values, reference)).run()
        return "${result.verdict} ${result.baseline.parameters} ${result.candidates.map { it.cause to it.pValue }}"
    }

    @Test
    fun whereTimeIsCountedFromDoesNotMatter() {
        for (withReference in listOf(true, false)) {
            val first = answer(0.0, withReference)
            assertEquals(first, answer(1.6e9, withReference), "seed $SEED")
            assertEquals(first, answer(-12_345.0, withReference), "seed $SEED")
        }
    }

    private companion object {
        const val SEED = 20261126L
    }
}
