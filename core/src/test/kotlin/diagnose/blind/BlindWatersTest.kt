package stillwater.diagnose.blind

import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.dot
import stillwater.diagnose.noise.CorrelatedNoise
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertTrue

/** Logs of water and noise as a model says they are: what its residuals go with by chance is known of many. */
class BlindWatersTest {
    private val n = 500
    private val track = CrossingTrack(n)

    private fun log(values: DoubleArray) = MeasuredSeries(track.times, track.x, track.y, values, null)

    private class Seen(val product: Double, val chance: Double)

    /** What [of] makes of the likeliest water goes with the residuals as [BlindWaters.chance] says, on average. */
    private fun assertTold(of: (DoubleArray) -> DoubleArray) {
        val random = java.util.Random(SEED)
        println("seed $SEED")
        val search = BlindSearch(log(DoubleArray(n) { random.nextGaussian() }))
        val white = BlindNoise(CorrelatedNoise(track.times, 0.3, 4.0, search.used), DoubleArray(n) { 1.0 })
        val numbers = doubleArrayOf(3.0, 1.0, 0.0, 0.0)
        val variances = DoubleArray(search.modes.bands) { if (it in search.modes.moving) 1e-8 else 0.3 }
        val model = search.settled(emptyList(), numbers, white, variances, rounds = 0)
        val size = model.modes.size
        val seen = (1..LOGS).map {
            val heights = DoubleArray(size) { k ->
                val band = model.modes.band[k]
                if (band < 0 || band in model.modes.moving) 0.0 else sqrt(variances[band]) * random.nextGaussian()
            }
            val water = search.along(model.modes, arrayOf(heights))
            val shown = search.seen(emptyList(), numbers, water, model.modes.behind).single()
            val noise = noise(random)
            val own = BlindSearch(log(DoubleArray(n) { i -> shown[i] + noise[i] }))
            val state = own.settled(emptyList(), numbers, white, variances, rounds = 0)
            val prediction = DoubleArray(n) { i -> state.model.series.values[i] - state.residuals[i] }
            val chance = BlindWaters(own, state, draws = DRAWS).chance { change ->
                val up = of(DoubleArray(n) { i -> prediction[i] + change[i] })
                val down = of(DoubleArray(n) { i -> prediction[i] - change[i] })
                listOf(DoubleArray(n) { i -> (up[i] - down[i]) / 2 })
            }
            Seen(dot(state.fit.whitened(of(prediction)), state.whitened), chance.single())
        }
        val products = seen.map { it.product }
        val mean = products.average()
        val error = sqrt(products.sumOf { (it - mean) * (it - mean) } / (LOGS - 1.0) / LOGS)
        val told = seen.map { it.chance }.average()
        assertTrue(abs(mean - told) < 4 * error, "$mean ± $error, told $told")
        assertTrue(abs(mean) > 8 * error, "$mean ± $error is not to be told from nothing")
    }

    /** White noise and such as wanders, as the model has it, of variance 1. */
    private fun noise(random: java.util.Random): DoubleArray {
        var wander = sqrt(0.3) * random.nextGaussian()
        return DoubleArray(n) { i ->
            if (i > 0) {
                val keep = exp(-(track.times[i] - track.times[i - 1]) / 4.0)
                wander = keep * wander + sqrt(0.3 * (1 - keep * keep)) * random.nextGaussian()
            }
            wander + sqrt(0.7) * random.nextGaussian()
        }
    }

    @Test
    fun theLikeliestWaterGoesWithWhatItLeaves() = assertTold { it.copyOf() }

    @Test
    fun soDoesItsCube() = assertTold { shown -> DoubleArray(n) { shown[it] * shown[it] * shown[it] } }

    private companion object {
        const val LOGS = 60
        const val DRAWS = 200
        const val SEED = 20261123L
    }
}
