package stillwater.diagnose

import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** Fixes whose errors wander over minutes move readings along the slopes of the water. */
class FixWandersTest {
    private val rows = 1200
    private val track = CrossingTrack(rows)

    /** Readings of a lag of 4 s in noise of 0.02, whose fixes wander by [size] m over 60 s. */
    private fun log(size: Double, seed: Long): MeasuredSeries {
        val random = java.util.Random(seed)
        val shown = track.shown(4.0)
        val keep = exp(-1 / 60.0)
        fun wander(): DoubleArray {
            var now = random.nextGaussian()
            return DoubleArray(rows) {
                now = keep * now + sqrt(1 - keep * keep) * random.nextGaussian()
                size * now
            }
        }
        val (east, north) = List(2) { wander() }
        return MeasuredSeries(
            track.times,
            DoubleArray(rows) { track.x[it] + east[it] },
            DoubleArray(rows) { track.y[it] + north[it] },
            DoubleArray(rows) { shown[it] + 0.02 * random.nextGaussian() },
            null,
        )
    }

    private fun wander(series: MeasuredSeries): Pair<BlindState, FixWander?> {
        val best = BlindSearch(series).best()
        return best to best.fit.design.noise.noise.wander
    }

    @Test
    fun fixesThatWanderAreFound() {
        for (seed in 1L..2L) {
            val (best, found) = wander(log(0.4, seed))
            val size = sqrt(assertNotNull(found, "seed $seed").variance * best.variance)
            assertTrue(size in 0.2..0.8, "wander by $size m, seed $seed")
        }
    }

    @Test
    fun fixesThatDoNotWanderAreLeftAsTheyAre() {
        for (seed in 1L..2L) assertNull(wander(log(0.0, seed)).second, "seed $seed")
    }

    @Test
    fun slopesOfTheWaterAreFoundAlongTheWayAndAcross() {
        val best = BlindSearch(log(0.0, 3)).best()
        val (east, north) = assertNotNull(best.modes.slopes(best.fit.heights))
        var off = 0.0
        var all = 0.0
        for (i in 0 until rows) {
            val (a, b) = track.slope(i)
            off += (east[i] - a) * (east[i] - a) + (north[i] - b) * (north[i] - b)
            all += a * a + b * b
        }
        assertEquals(0.0, sqrt(off / all), 0.1)
    }

    @Test
    fun aLineTellsNothingAcross() {
        val random = java.util.Random(4)
        val line = MeasuredSeries(
            track.times,
            track.x,
            DoubleArray(rows),
            DoubleArray(rows) { track.x[it] / 5 + 0.02 * random.nextGaussian() },
            null,
        )
        val best = BlindSearch(line).best()
        assertNull(best.modes.slopes(best.fit.heights))
    }
}
