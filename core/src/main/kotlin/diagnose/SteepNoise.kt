package stillwater.diagnose

import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/** Noise that is wider where the water is steep: fixes that are off do more harm there. */
internal object SteepNoise {
    /** Variances where the water is as steep as usual, of which one is chosen, over that of even noise. */
    private val UNEVEN = listOf(0.0, 0.3, 1.0, 3.0, 10.0, 100.0)

    /** [noise] with the relative spread of each row that suits the residuals of [state] best. */
    fun of(state: BlindState, noise: CorrelatedNoise): BlindNoise {
        val series = state.model.series
        val n = series.size
        val steep = state.modes.let { it.steepness(it.along(state.fit.heights)) }
        val tau = maxOf(state.timeConstant, series.period)
        var felt = 0.0
        for (i in 0 until n) {
            val dt = if (i == 0) 0.0 else series.times[i] - series.times[i - 1]
            felt += (1 - exp(-dt / tau)) * (steep[i] * steep[i] - felt)
            steep[i] = felt
        }
        val usual = maxOf(steep.average(), 1e-290)
        val z = DoubleArray(n)
        return UNEVEN.map { share -> BlindNoise(noise, DoubleArray(n) { sqrt(1 + share * steep[it] / usual) }) }.maxBy {
            it.whiten(state.residuals, z)
            -noise.rows * ln(squares(z) / noise.rows) - it.logDeterminant
        }
    }
}
