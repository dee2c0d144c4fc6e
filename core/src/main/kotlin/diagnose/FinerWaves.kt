package stillwater.diagnose

import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * Whether the water has waves finer than those that a model of it was given: a score test for the variance of waves of
 * all directions just shorter than its shortest, seen through the sensor.
 *
 * Of what is left of whitened residuals, z, a wave w, whitened, has (w·z)², which is σ² times the square of what the
 * water's own cannot show of w on average where nothing is missing, and more by what such waves hold.
 */
internal object FinerWaves {
    private const val WAVES = 32

    /** The golden angle, by which directions are spread evenly however many there are. */
    private val TURN = PI * (3 - sqrt(5.0))

    /** How many times shorter the shortest of them is than the model's. */
    private const val SHORTER = 1.6

    /** Power of missing waves over the noise's that is not more than the noise. */
    private const val NOISE = 1.0

    /** Whether such waves hold no more than the noise does. */
    fun isNone(state: BlindState, search: BlindSearch): Boolean = excess(state, search) < 1 + NOISE

    /** Power of what is left of [state] along such waves, over the noise's: 1 where none is missing. */
    fun excess(state: BlindState, search: BlindSearch): Double =
        excess(state, search, state.modes.shortest, state.modes.shortest / SHORTER)

    /** The same along waves from [longest] down to [shortest], m. */
    fun excess(state: BlindState, search: BlindSearch, longest: Double, shortest: Double): Double {
        val waves = (0 until WAVES).flatMap { k ->
            val length = longest - (longest - shortest) * (k + 0.5) / WAVES
            val phase = phases(search.track, 2 * PI / length * cos(k * TURN), 2 * PI / length * sin(k * TURN))
            listOf(DoubleArray(phase.size) { cos(phase[it]) }, DoubleArray(phase.size) { sin(phase[it]) })
        }
        val seen = search.seen(state.model.terms, state.numbers, waves.toTypedArray()).asList()
        val left = state.whitened
        // With P = 1 − R H⁻¹ Rᵀ what is left has the covariance σ² P, where H is the posterior's precision.
        val found = search.loops.all(seen) { wave ->
            val white = state.fit.whitened(wave)
            val score = dot(white, left)
            score * score to state.variance * (squares(white) - squares(state.fit.imitated(white)))
        }
        return found.sumOf { it.first } / found.sumOf { it.second }
    }

    /** The phase along [track] of a wave with [east] and [north] radians per metre. */
    private fun phases(track: SmoothTrack, east: Double, north: Double) =
        DoubleArray(track.x.size) { east * track.x[it] + north * track.y[it] }
}
