package stillwater.diagnose.blind

import stillwater.diagnose.algebra.dot
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.all
import stillwater.diagnose.track.SmoothTrack
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * Whether the water has waves finer than those that a model of it was given: a score test for the variance of waves of
 * all directions just shorter than its shortest, seen through the sensor.
 *
 * Of whitened residuals z with a part c of such a wave that the water's own cannot show, (c·z)² is σ²|c|² on average
 * where nothing is missing, and more by what such waves hold.
 */
internal object FinerWaves {
    private const val WAVES = 32

    /** The golden angle, by which directions are spread evenly however many there are. */
    private val TURN = PI * (3 - sqrt(5.0))

    /** How many times shorter the shortest of them is than the model's. */
    private const val SHORTER = 1.6

    /** Power of missing waves over the noise's that is not more than the noise. */
    private const val NOISE = 1.0

    /**
     * The same above which finer waves show although the finest that a model has hold little, as on even cells, whose power
     * falls slowly from ring to ring: it was 1.6 to 4.4 on three of these of which a play was named, and at most 1.24 in 63
     * rounds but one of 60 logs of smooth water (276730 to 276789).
     */
    private const val SHOWN = 1.4

    /** Whether what is left of [state] has finer waves beyond chance. */
    fun show(state: BlindState, search: BlindSearch): Boolean = excess(state, search) > SHOWN

    /** Whether the water of [state] was not given all its waves: columns were too few, or finer ones hold more than the noise. */
    fun areMissing(state: BlindState, search: BlindSearch): Boolean =
        !state.isResolved && (state.modes.isCut || !isNone(state, search))

    /** Whether such waves hold no more than the noise does. */
    fun isNone(state: BlindState, search: BlindSearch): Boolean = excess(state, search) < 1 + NOISE

    /** Power of what is left of [state] along such waves, over the noise's: 1 where none is missing. */
    fun excess(state: BlindState, search: BlindSearch): Double {
        val longest = state.modes.shortest
        var found = 0.0
        var expected = 0.0
        for (wave in waves(state, search, longest, longest / SHORTER)) {
            val column = state.fit.unlike(wave)
            val score = dot(column, state.whitened)
            found += score * score
            expected += state.variance * squares(column)
        }
        return found / expected
    }

    /**
     * The same along waves from [longest] down to [shortest], m, without what the fit takes: with w a wave, whitened, and
     * P what takes off it what the water's own can show, z has the covariance σ²P, and (w·z)² is σ² w·Pw on average.
     */
    fun excessBetween(state: BlindState, search: BlindSearch, longest: Double, shortest: Double): Double {
        val left = state.whitened
        val found = search.loops.all(waves(state, search, longest, shortest)) { wave ->
            val white = state.fit.whitened(wave)
            val score = dot(white, left)
            score * score to state.variance * (squares(white) - squares(state.fit.imitated(white)))
        }
        return found.sumOf { it.first } / found.sumOf { it.second }
    }

    /** Waves of all directions from [longest] down to [shortest], m, as the sensor shows them. */
    private fun waves(state: BlindState, search: BlindSearch, longest: Double, shortest: Double): List<DoubleArray> {
        val waves = (0 until WAVES).flatMap { k ->
            val length = longest - (longest - shortest) * (k + 0.5) / WAVES
            val phase = phases(state.modes.track, 2 * PI / length * cos(k * TURN), 2 * PI / length * sin(k * TURN))
            listOf(DoubleArray(phase.size) { cos(phase[it]) }, DoubleArray(phase.size) { sin(phase[it]) })
        }
        val model = state.model
        return search.seen(model.terms, state.numbers, waves.toTypedArray(), model.behind).asList()
    }

    /** The phase along [track] of a wave with [east] and [north] radians per metre. */
    private fun phases(track: SmoothTrack, east: Double, north: Double) =
        DoubleArray(track.x.size) { east * track.x[it] + north * track.y[it] }
}
