package stillwater.diagnose.response

import kotlin.math.PI
import kotlin.math.exp
import kotlin.math.sin

/** Terms of the Fourier series of a rounding error. */
private const val HARMONICS = 4

/** Keeps these readings within [lower] and [upper], the ends of the range, sensor units. */
internal fun DoubleArray.clip(lower: Double, upper: Double) {
    for (i in indices) this[i] = this[i].coerceIn(minOf(lower, upper), upper)
}

/**
 * Makes of these readings the mean of what rounding to steps of [step] shows where noise of standard deviation [spread] comes
 * before it, both in sensor units: a Fourier series of the rounding error.
 */
internal fun DoubleArray.round(step: Double, spread: Double) {
    for (i in indices) {
        var error = 0.0
        for (k in 1..HARMONICS) {
            val fade = exp(-2 * (PI * k * spread / step) * (PI * k * spread / step))
            error += (if (k % 2 == 1) 1 else -1) * fade * sin(2 * PI * k * this[i] / step) / k
        }
        this[i] -= step / PI * error
    }
}
