package stillwater.diagnose

import org.junit.jupiter.api.Tag
import stillwater.diagnose.blind.BeyondWaves
import stillwater.diagnose.blind.BlindSearch
import stillwater.diagnose.blind.BlindTrial
import stillwater.diagnose.response.Term
import java.util.Random
import kotlin.math.floor
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/**
 * Water with sharp fronts needs more waves than a log can be given. What the missing ones leave goes with how readings rise
 * and fall, with the way and with single rows, and is neither a play, nor a response of another shape, nor outliers.
 */
class ChessboardTest {
    private val track = CrossingTrack(ROWS)

    /** What a lag of [LAG] s shows of squares of [SIDE] m. */
    private val shown =
        track.shown(LAG) { x, y -> if ((floor(x / SIDE) + floor(y / SIDE)).mod(2.0) == 0.0) 1.0 else -1.0 }

    private fun series(readings: DoubleArray): MeasuredSeries {
        val random = Random(SEED)
        val values = DoubleArray(ROWS) { readings[it] + NOISE * random.nextGaussian() }
        return MeasuredSeries(track.times, track.x, track.y, values, null)
    }

    private fun verdict(readings: DoubleArray): Verdict = Diagnosis(series(readings)).run().verdict

    @Test
    @Tag("long")
    fun missingWavesAreNoCause() {
        assertEquals(Verdict.Consistent, verdict(shown), "seed $SEED")
    }

    @Test
    @Tag("long")
    fun aDeadTimeIsNamed() {
        val delayed = DoubleArray(ROWS) { shown[maxOf(it - DEAD_TIME, 0)] }
        assertEquals(Verdict.Named(listOf(Cause.DEAD_TIME)), verdict(delayed), "seed $SEED")
    }

    @Test
    fun whatExplainsMoreThanMissingWavesCounts() {
        val search = BlindSearch(series(shown))
        val state = search.best()
        fun kept(cause: Cause, share: Double): Boolean {
            val ratio = share * ROWS
            val trial =
                BlindTrial(Term(cause), cause.label, null, null, DoubleArray(ROWS), ratio, 1.0, 1, 0.0, state, ratio)
            return BeyondWaves(search, state).of(trial).ratio == ratio
        }
        for ((cause, least) in listOf(Cause.HYSTERESIS to 0.09, Cause.DEAD_TIME to 0.25)) {
            assertEquals(listOf(false, true), listOf(0.9, 1.1).map { kept(cause, it * least) }, "$cause")
        }
        assertTrue(kept(Cause.DRIFT, 1e-3))
    }

    private companion object {
        const val SEED = 20261128L
        const val ROWS = 1200
        const val SIDE = 8.0
        const val LAG = 8.0
        const val NOISE = 0.003
        const val DEAD_TIME = 5
    }
}
