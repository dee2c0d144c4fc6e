package stillwater.app.screen

import android.animation.ArgbEvaluator
import android.graphics.Color

/**
 * Colours of a field's values: viridis, which grows evenly lighter, also in print and for the colour-blind.
 *
 * Source: S. van der Walt, N. Smith (2015), matplotlib's viridis, at nine of its 256 steps.
 */
internal object FieldColours {
    private val stops =
        intArrayOf(
            0xFF440154.toInt(),
            0xFF472D7B.toInt(),
            0xFF3B528B.toInt(),
            0xFF2C728E.toInt(),
            0xFF21918C.toInt(),
            0xFF28AE80.toInt(),
            0xFF5EC962.toInt(),
            0xFFADDC30.toInt(),
            0xFFFDE725.toInt(),
        )
    private val between = ArgbEvaluator()

    /** The colour of a value [share] of the way up the scale, 0 to 1; what lies beyond has the colour of the end. */
    fun of(share: Double): Int {
        val place = (if (share.isFinite()) share.coerceIn(0.0, 1.0) else 0.0) * (stops.size - 1)
        val stop = place.toInt().coerceAtMost(stops.size - 2)
        return between.evaluate((place - stop).toFloat(), stops[stop], stops[stop + 1]) as Int
    }

    /** [colour] as opaque as [certainty], 0 to 1, says; never quite invisible, for the cell is there. */
    fun faded(colour: Int, certainty: Double): Int {
        val share = if (certainty.isFinite()) certainty.coerceIn(0.0, 1.0) else 0.0
        val alpha = (LEAST_ALPHA + (FULL_ALPHA - LEAST_ALPHA) * share).toInt()
        return Color.argb(alpha, Color.red(colour), Color.green(colour), Color.blue(colour))
    }

    private const val LEAST_ALPHA = 90
    private const val FULL_ALPHA = 255
}
