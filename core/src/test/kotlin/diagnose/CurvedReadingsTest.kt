package stillwater.diagnose

import java.util.Random
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertTrue

/** Without a reference a curved calibration looks like a lag that is faster one way than the other, and the other way round. */
class CurvedReadingsTest {
    private val track = CrossingTrack(ROWS)

    private fun water(x: Double, y: Double) = sin(x / 4) + sin(y / 5 + 1) + sin((x + y) / 7)

    /** What a lag of [rising] s, and of [falling] s where the water is below, shows, stepped often. */
    private fun shown(rising: Double, falling: Double): DoubleArray {
        var state = water(track.x[0], track.y[0])
        return DoubleArray(ROWS) { row ->
            for (k in 0 until if (row > 0) STEPS else 0) {
                val part = (k + 0.5) / STEPS
                val x = track.x[row - 1] + part * (track.x[row] - track.x[row - 1])
                val y = track.y[row - 1] + part * (track.y[row] - track.y[row - 1])
                val gap = water(x, y) - state
                state += (1 - exp(-1 / (STEPS * if (gap > 0) rising else falling))) * gap
            }
            state
        }
    }

    /** Twice the log-likelihood by which a curved calibration is likelier than an asymmetric lag. */
    private fun ahead(shown: DoubleArray, curvature: Double): Double {
        val random = Random(SEED)
        val values = DoubleArray(ROWS) { shown[it] + curvature * shown[it] * shown[it] + NOISE * random.nextGaussian() }
        val search = BlindSearch(MeasuredSeries(track.times, track.x, track.y, values, null))
        val base = search.best()
        val tries = BlindTrials(search, base)
        val asymmetric = tries.begun(tries.attempt(Term(Cause.ASYMMETRIC_RESPONSE)), base)
        return CurvedReadings(search, base).score - search.fullySuited(asymmetric).score
    }

    @Test
    fun aCurvedCalibrationIsNoAsymmetricLag() {
        for (curvature in listOf(-0.1, -0.02, 0.02, 0.1)) {
            val ahead = ahead(shown(LAG, LAG), curvature)
            assertTrue(ahead > BlindLag.MUCH, "$curvature: $ahead, seed $SEED")
        }
    }

    @Test
    fun anAsymmetricLagIsNoCurvedCalibration() {
        for (ratio in listOf(0.6, 0.9, 1.1, 1.7)) {
            val ahead = ahead(shown(LAG, ratio * LAG), curvature = 0.0)
            assertTrue(ahead < -BlindLag.MUCH, "$ratio: $ahead, seed $SEED")
        }
    }

    private companion object {
        const val SEED = 20261127L
        const val ROWS = 900
        const val NOISE = 0.004
        const val LAG = 5.0
        const val STEPS = 50
    }
}
