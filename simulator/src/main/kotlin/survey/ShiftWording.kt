package stillwater.survey

import stillwater.survey.Wording.Companion.digits
import kotlin.math.abs

/** A [LagShift] in words. */
internal object ShiftWording {
    /** The best of the shifts and its interval; no interval where a bootstrap says nothing. */
    fun best(shift: LagShift): String = when {
        shift.isAtEnd -> "${moved(shift.seconds)}, the most that was tried"
        shift.legs < LagShift.FEWEST_LEGS -> moved(shift.seconds)
        else -> "${moved(shift.seconds)} (95 %: ${interval(shift)})"
    }

    /** A shift by [seconds]. */
    fun moved(seconds: Double): String {
        val way = if (seconds > 0) "earlier" else "later"
        return if (seconds == 0.0) "0 s" else "${digits(abs(seconds), 3)} s $way"
    }

    /** The way is that of the best shift, or is said of each end. */
    private fun interval(shift: LagShift): String {
        fun ends(from: Double, to: Double) = "${digits(abs(from), 3)} to ${digits(abs(to), 3)} s"
        return when {
            shift.low >= 0 && shift.seconds > 0 -> ends(shift.low, shift.high)
            shift.high <= 0 && shift.seconds < 0 -> ends(shift.high, shift.low)
            else -> "${moved(shift.low)} to ${moved(shift.high)}"
        }
    }
}
