package stillwater.diagnose.blind

import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.track.SmoothTrack
import stillwater.diagnose.water.WaterModes
import stillwater.model.Conditions
import stillwater.sensor.GaussianNoise
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class WaterDetailTest {
    private val n = 900
    private val track = CrossingTrack(n)

    /** The log of a lag of 4 s in [water]. */
    private fun series(water: (Double, Double) -> Double): MeasuredSeries {
        val noise = GaussianNoise(0.02, Random(SEED))
        val shown = track.shown(LAG, water = water)
        val values = DoubleArray(n) { noise.step(shown[it], 1.0, Conditions.NONE) }
        return MeasuredSeries(track.times, track.x, track.y, values, null)
    }

    /** What [series] has been found to be with [most] waves. */
    private fun found(series: MeasuredSeries, search: BlindSearch, most: Int): BlindState {
        val white = CorrelatedNoise(series.times, 0.0, 10.0, BooleanArray(n) { true })
        val few = WaterModes.flat(series, SmoothTrack.of(series), most)
        val noise = BlindNoise(white, DoubleArray(n) { 1.0 })
        return search.improved(
            search.settled(emptyList(), doubleArrayOf(3.0, 1.0, 0.0, 0.0), noise, DoubleArray(0), ROUNDS, few),
        )
    }

    private fun long(x: Double, y: Double) = sin(x / 4) + sin(y / 5 + 1)

    @Test
    fun ringsThatAreOfferedAreAddedBeyondAGap() {
        val series = series(::long)
        val state = found(series, BlindSearch(series), FEW)
        val ring = state.modes.finer[2]
        val waves = state.modes.refined(state.variances, n, setOf(ring))
        assertEquals(ring, waves.finest)
        assertTrue(waves.size > state.modes.size && !waves.isCut, "${waves.size} of ${state.modes.size}")
        assertTrue(state.modes.refined(state.variances, n).finest > ring, "$ring")
    }

    @Test
    fun wavesBeyondAGapShow() {
        fun excess(series: MeasuredSeries): Double {
            val search = BlindSearch(series)
            // Of 4.8 and 5.6 m.
            return FinerWaves.excessBetween(found(series, search, FEW), search, 6.0, 4.6)
        }
        val more = excess(series { x, y -> long(x, y) + FAINT * (sin(1.2 * x + y / 2) + sin(y - x / 2)) })
        val none = excess(series(::long))
        assertTrue(more > 2 * none, "$more and $none")
    }

    @Test
    fun wavesThatAreNotThereAreNotOffered() {
        val series = series(::long)
        val search = BlindSearch(series)
        val coarse = found(series, search, ENOUGH)
        val fine = WaterDetail(search, ENOUGH).of(coarse)
        assertTrue(fine.modes.finest >= coarse.modes.finest && fine.modes.size <= ENOUGH, "${fine.modes.lengths}")
    }

    private companion object {
        const val LAG = 4.0
        const val SEED = 7

        /** Five deviations of the noise, of which a lag shows one. */
        const val FAINT = 0.1

        /** Columns for waves of some 10 m, and of some 6 m. */
        const val FEW = 100
        const val ENOUGH = 150
        const val ROUNDS = 12
    }
}
