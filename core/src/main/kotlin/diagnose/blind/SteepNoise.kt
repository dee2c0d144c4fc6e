package stillwater.diagnose.blind

import stillwater.diagnose.algebra.squares
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.noise.PlaceErrors
import stillwater.diagnose.noise.PlacedNoise
import stillwater.diagnose.track.FixErrors
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Noise that is wider where the water is steep: fixes that are off do more harm there.
 *
 * @param scatter how far fixes scatter.
 */
internal class SteepNoise(private val scatter: FixScatter) {
    /** [noise] with the relative spread of each row, or the errors of places, that suit the residuals of [state] best. */
    fun of(state: BlindState, noise: CorrelatedNoise): BlindNoise {
        val (wider, score) = wider(state, noise)
        if (!scatter.isWide(state)) return wider
        val (places, placed) = places(state, noise) ?: return wider
        return if (placed > score + CLEARLY) BlindNoise(noise, DoubleArray(noise.times.size) { 1.0 }, places) else wider
    }

    /** [noise] with the relative spread of each row that suits the residuals of [state] best, whatever fixes do. */
    fun without(state: BlindState, noise: CorrelatedNoise): BlindNoise = wider(state, noise).first

    /** The likeliest relative spread of each row, and twice the log-likelihood. */
    private fun wider(state: BlindState, noise: CorrelatedNoise): Pair<BlindNoise, Double> {
        val felt = felt(state)
        val usual = maxOf(felt.average(), 1e-290)
        val z = DoubleArray(felt.size)
        return UNEVEN.map { share -> BlindNoise(noise, DoubleArray(felt.size) { sqrt(1 + share * felt[it] / usual) }) }
            .map {
                it.whiten(state.residuals, z)
                it to -noise.rows * ln(squares(z) / noise.rows) - it.logDeterminant
            }.maxBy { it.second }
    }

    /** [other] for the noise of [state]: errors of places, where it has some, as they then suit its residuals best. */
    fun with(state: BlindState, other: CorrelatedNoise): BlindNoise {
        val now = state.fit.design.noise
        if (now.places == null) return now.with(other)
        val (places, _) = places(state, other) ?: return now.with(other)
        return BlindNoise(other, now.spread, places)
    }

    /** The likeliest errors of places for [noise], of those that explain how fixes scatter, and twice the log-likelihood. */
    private fun places(state: BlindState, noise: CorrelatedNoise): Pair<PlaceErrors, Double>? {
        val (east, north) = state.gradient ?: return null
        val tau = tau(state)
        fun tried(error: FixErrors.Likely, times: Double): Pair<PlaceErrors, Double> {
            val square = times * times * error.variance
            var places = PlaceErrors(east, north, square / state.variance, error.time, tau)
            // The noise's own variance, which errors are measured in, is less with them.
            repeat(SCALED) {
                val variance = PlacedNoise.score(state.residuals, noise, places).variance
                places = PlaceErrors(east, north, square / variance, error.time, tau)
            }
            return places to PlacedNoise.score(state.residuals, noise, places).twice
        }
        val (best, _) = scatter.errors.map { it to tried(it, 1.0).second }.maxByOrNull { it.second } ?: return null
        return ABOUT.map { tried(best, it) }.maxBy { it.second }
    }

    /** The mean square of how steep the water of [state] was, as its lag has it, at each row. */
    private fun felt(state: BlindState): DoubleArray {
        val times = state.model.series.times
        val tau = tau(state)
        val steep = state.modes.let { it.steepness(it.along(state.fit.heights)) }
        var felt = 0.0
        for (i in steep.indices) {
            val dt = if (i == 0) 0.0 else times[i] - times[i - 1]
            felt += (1 - exp(-dt / tau)) * (steep[i] * steep[i] - felt)
            steep[i] = felt
        }
        return steep
    }

    private fun tau(state: BlindState) = maxOf(state.timeConstant, state.model.series.period)

    private companion object {
        /** Variances where the water is as steep as usual, of which one is chosen, over that of even noise. */
        val UNEVEN = listOf(0.0, 0.3, 1.0, 3.0, 10.0, 100.0)

        /** What errors of places may be over what the scatter of fixes says. */
        val ABOUT = listOf(0.6, 0.77, 1.0, 1.3, 1.7)

        const val SCALED = 2

        /** Twice the log-likelihood by which errors of places must be better than noise that is wider where it is steep. */
        const val CLEARLY = 4.0
    }
}
