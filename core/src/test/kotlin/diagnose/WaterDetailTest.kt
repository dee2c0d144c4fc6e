package stillwater.diagnose

import stillwater.model.Conditions
import stillwater.sensor.GaussianNoise
import kotlin.math.floor
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

    /** What [series] has been found to be with [most] waves, and with as fine ones as it shows. */
    private fun found(series: MeasuredSeries, most: Int): Pair<BlindState, BlindState> {
        val search = BlindSearch(series)
        val white = CorrelatedNoise(series.times, 0.0, 10.0, BooleanArray(n) { true })
        val few = WaterModes.flat(series, SmoothTrack.of(series), most)
        val noise = BlindNoise(white, DoubleArray(n) { 1.0 })
        val coarse = search.improved(
            search.settled(emptyList(), doubleArrayOf(3.0, 1.0, 0.0, 0.0), noise, DoubleArray(0), ROUNDS, few),
        )
        return coarse to WaterDetail(search, most).of(coarse)
    }

    private fun long(x: Double, y: Double) = sin(x / 4) + sin(y / 5 + 1)

    @Test
    fun wavesBeyondAGapAreFound() {
        val (coarse, fine) = found(
            series { x, y ->
                long(x, y) + 0.5 * sin(1.2 * x + y / 2) + 0.5 * sin(y - x / 2)
            },
            FEW,
        )
        assertTrue(coarse.modes.finest > 6.3, "${coarse.modes.lengths}")
        assertTrue(fine.modes.finest < 4.9, "${fine.modes.lengths}")
        assertTrue(fine.modes.size > FEW && fine.score > coarse.score + 100, "${fine.modes.size} ${fine.score}")
        assertEquals(LAG, fine.timeConstant, 0.03 * LAG)
        assertTrue(fine.variance < coarse.variance / 4, "${coarse.variance} ${fine.variance}")
    }

    @Test
    fun wavesThatAreNotThereAreNotOffered() {
        val (coarse, fine) = found(series(::long), ENOUGH)
        assertTrue(fine.modes.finest >= coarse.modes.finest && fine.modes.size <= ENOUGH, "${fine.modes.lengths}")
    }

    @Test
    fun waterOfEvenSquaresHasNothingWrongWithItsSensor() {
        val heights = Random(SEED).let { random -> List(SQUARES * SQUARES) { random.nextDouble(-1.0, 1.0) } }
        fun square(at: Double) = (floor(at / SIDE).toInt() + SQUARES / 2).coerceIn(0, SQUARES - 1)
        val result = Diagnosis(series { x, y -> heights[square(x) * SQUARES + square(y)] }).run()
        assertTrue(result.verdict !is Verdict.Named && result.verdict !is Verdict.Unexplained, "${result.verdict}")
        if (result.verdict is Verdict.Ambiguous) {
            assertEquals(setOf(Cause.TIME_CONSTANT, Cause.DEAD_TIME), result.verdict.ambiguity.flatten().toSet())
        }
    }

    private companion object {
        const val LAG = 4.0
        const val SEED = 7

        /** Columns for waves of some 10 m, and of some 6 m. */
        const val FEW = 60
        const val ENOUGH = 150
        const val ROUNDS = 12

        /** Squares along either side, and how long they are, m. */
        const val SQUARES = 8
        const val SIDE = 5.0
    }
}
