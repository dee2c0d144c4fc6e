package stillwater.estimate

import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotNull

class ReferenceLearnerTest {
    /** A rate limit of [RATE] reference units per second is found whatever the readings are in. */
    @Test
    fun rateLimitIsInTheUnitsOfTheReference() {
        for (gain in listOf(1.0, 1000.0, -0.02)) {
            val random = Random(3)
            val times = DoubleArray(ROWS) { it.toDouble() }
            val reference = DoubleArray(ROWS) { sin(it / 11.0) + sin(it / 4.7) }
            var shown = reference[0]
            val values = DoubleArray(ROWS) {
                shown = reference[it].coerceIn(shown - RATE, shown + RATE)
                gain * (shown + 0.002 * random.nextDouble()) + 5
            }
            val series = TrackSeries(times, times, DoubleArray(ROWS), values)
            val found = assertNotNull(ReferenceLearner(series, reference).candidate(ResponseKind.SLEW))
            // A fiftieth: the noise is a fiftieth of a second's change.
            assertEquals(RATE, found.parameters[0], RATE / 50, "gain $gain")
        }
    }

    private companion object {
        const val ROWS = 600
        const val RATE = 0.1
    }
}
