package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.response.Term
import java.util.Random
import kotlin.test.Test
import kotlin.test.assertTrue

/** Without a reference a curved calibration looks like a lag that is faster one way than the other, and the other way round. */
class CurvedReadingsTest {
    private val track = CrossingTrack(ROWS)

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
            val ahead = ahead(track.shown(LAG), curvature)
            assertTrue(ahead > BlindLag.MUCH, "$curvature: $ahead, seed $SEED")
        }
    }

    @Test
    fun anAsymmetricLagIsNoCurvedCalibration() {
        for (ratio in listOf(0.6, 0.9, 1.1, 1.7)) {
            val ahead = ahead(track.shownUnevenly(LAG, ratio * LAG), curvature = 0.0)
            assertTrue(ahead < -BlindLag.MUCH, "$ratio: $ahead, seed $SEED")
        }
    }

    private companion object {
        const val SEED = 20261127L
        const val ROWS = 900
        const val NOISE = 0.004
        const val LAG = 5.0
    }
}
