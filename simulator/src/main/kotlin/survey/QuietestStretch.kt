package stillwater.survey

import stillwater.estimate.EpsilonCalibration

/**
 * The ε found for a log.
 *
 * @property epsilon smallest slope that counts as one, sensor units/s.
 * @property stretch the stretch it was found on.
 * @property slopes number of slopes it rests on.
 * @property found what the stretch itself gave, sensor units/s: below [epsilon] where that was raised.
 */
data class Calibration(
    val epsilon: Double,
    val stretch: Stretch,
    val slopes: Int,
    val found: Double = epsilon,
) {
    /**
     * This, with an ε of at least [stepSlope], sensor units/s.
     *
     * A sensor that rounds coarsely reads one and the same value over its quietest stretch, which gives an ε of 0; every
     * flicker between two neighbouring values would then be a bound. See [EpsilonCalibration.stepSlope].
     */
    fun atLeast(stepSlope: Double): Calibration = if (epsilon < stepSlope) copy(epsilon = stepSlope) else this
}

/**
 * Finds the stretch of a log in which the sensor was quietest, and the ε it gives.
 *
 * The log is cut into stretches of at least [SECONDS] s and [SLOPES] slopes that no gap interrupts; the one with the
 * smallest ε wins. A boat that never rests gives an ε that holds some of the water's own change: too large rather than
 * too small. The smallest of many estimates is biased downwards; the stretches are made long enough for that to be
 * little. Confined to one thread.
 *
 * @param medianWindow see [EpsilonCalibration]. @param slopeWindow see [EpsilonCalibration].
 */
class QuietestStretch(medianWindow: Int, slopeWindow: Int) {
    private val current = EpsilonCalibration(medianWindow, slopeWindow)
    private var start = Double.NaN
    private var from = Double.NaN
    private var last = Double.NaN
    private var readings = 0L
    private var quietest: Calibration? = null
    private var longest: Calibration? = null

    /** Takes the reading [value], sensor units, of the time [seconds], s, growing. */
    fun add(seconds: Double, value: Double) {
        if (start.isNaN()) start = seconds
        if (readings >= 2 && seconds - last > GAP_STEPS * (last - from) / (readings - 1)) finish()
        if (readings == 0L) from = seconds
        current.add(seconds, value)
        readings++
        last = seconds
        if (last - from >= SECONDS && current.slopes >= SLOPES) finish()
    }

    /** The quietest stretch; the longest uninterrupted one where none is long enough; null without any slope. */
    fun calibration(): Calibration? {
        finish()
        return quietest ?: longest
    }

    private fun finish() {
        if (current.slopes > 0) {
            val found = Calibration(current.epsilon(), Stretch(from - start, last - start), current.slopes)
            val isLong = last - from >= SECONDS && found.slopes >= SLOPES
            if (isLong && quietest.let { it == null || found.epsilon < it.epsilon }) quietest = found
            if (longest.let { it == null || found.slopes > it.slopes }) longest = found
        }
        current.clear()
        readings = 0
    }

    private companion object {
        const val SECONDS = 60.0
        const val SLOPES = 40
        const val GAP_STEPS = 10
    }
}
