package stillwater.estimate

import kotlin.math.exp
import kotlin.math.ln

/** The geometric mean of the times between readings, as these come. */
internal class UsualInterval {
    private var logarithm = 0.0
    private var count = 0
    private var waited = 0.0

    /** The mean, s; 1 before there were two readings at different times. */
    val seconds: Double get() = exp(logarithm)

    /** Forgets all. */
    fun reset() {
        logarithm = 0.0
        count = 0
        waited = 0.0
    }

    /** So many s have passed since the last reading, and the next is still to come. */
    fun wait(elapsed: Double) {
        waited += elapsed
    }

    /** A reading comes [elapsed] s after that, or after the last one. */
    fun take(elapsed: Double) {
        val interval = elapsed + waited
        waited = 0.0
        if (interval > 0) logarithm += (ln(interval) - logarithm) / ++count
    }
}
