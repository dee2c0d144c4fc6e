package stillwater.diagnose

import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertTrue

/** Of two equal lags either makes up for the other, so that neither seems to show by itself. */
class BlindEqualLagsTest {
    private val rows = 900
    private val random = java.util.Random(7)

    /** The water of the track at any [time], s. */
    private fun water(time: Double): Double {
        val x = 15 * sin(time / 19)
        val y = 15 * sin(time / 25 + 1)
        return sin(x / 4) + sin(y / 5 + 1) + sin((x + y) / 7)
    }

    /** What [lags] in a row show of the water each second, stepped fifty times as often. */
    private fun shown(vararg lags: Double): DoubleArray {
        val states = DoubleArray(lags.size) { water(0.0) }
        return DoubleArray(rows) { row ->
            for (k in 0 until if (row > 0) 50 else 0) {
                var input = water(row - 1 + (k + 0.5) / 50)
                for (i in lags.indices) {
                    states[i] += (1 - exp(-0.02 / lags[i])) * (input - states[i])
                    input = states[i]
                }
            }
            states.last() + 0.01 * random.nextGaussian()
        }
    }

    /** Of three lags a model of two has the likeliest numbers where both are the same. */
    @Test
    fun aSecondLagThatIsAsLongAsTheFirstShows() {
        val track = CrossingTrack(rows)
        val result = Diagnosis(MeasuredSeries(track.times, track.x, track.y, shown(3.0, 3.0, 1.2), null)).run()
        val second = result.candidates.first { it.cause == Cause.SECOND_ORDER_RESPONSE }
        assertTrue(second.pValue < 1e-6, "${second.pValue}, ${result.verdict}")
    }
}
