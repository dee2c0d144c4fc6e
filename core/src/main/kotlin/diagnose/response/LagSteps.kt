package stillwater.diagnose.response

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.Spline
import kotlin.math.abs
import kotlin.math.exp

/**
 * How lags go from row to row of a log: exactly for a truth that is a cubic in each step, or that is held over it.
 *
 * @param series the log. @param isGap before which rows nothing is known: the sensor is taken to have settled; where null
 *   by their distance. @param steps how the truth goes on between the rows.
 */
internal class LagSteps(
    private val series: MeasuredSeries,
    private val isGap: BooleanArray?,
    private val steps: Steps,
) {
    private val n = series.size
    private val held = steps.isHeld

    /**
     * The share of each row's predecessor in what is held over the step between them; of missing rows between, in their
     * mean. Empty where steps are not held.
     */
    val earlier = DoubleArray(if (held) n else 0) { i ->
        val ticks = series.ticks(i)
        ((ticks - 1) / 2 + if (steps == Steps.UNTIL_NEXT) 1 else 0) / ticks
    }

    /** What time constants are times while the sensor rises, [up], and while it falls, [down]. */
    class Sides(val up: Double, val down: Double)

    /** What is left over a step; worked out where it is not as in the step before. */
    private class Fade {
        private var lastDt = Double.NaN
        private var lastTau = Double.NaN
        private var last = 0.0

        fun of(dt: Double, tau: Double): Double {
            // Even times differ by a rounding error.
            if (tau != lastTau || !(abs(dt - lastDt) < SAME * dt)) {
                last = exp(-dt / tau)
                lastDt = dt
                lastTau = tau
            }
            return last
        }
    }

    /** Whether nothing is known of the step before row [i], from 1 on. */
    fun isGap(i: Int): Boolean = isGap?.get(i) ?: (series.times[i] - series.times[i - 1] > series.gap)

    /** What of [input] is held over the step before row [i]. */
    private fun heldOver(i: Int, input: DoubleArray): Double {
        val earlier = earlier[i]
        return earlier * input[i - 1] + (1 - earlier) * input[i]
    }

    /**
     * Writes what a lag with [factor] times the time constants [taus], s, shows of [input] into [out], [first] above it at first.
     * [curve] goes through [input], or is not used where steps are held. All of length n.
     */
    fun even(input: DoubleArray, curve: Spline, taus: DoubleArray, factor: Double, first: Double, out: DoubleArray) {
        var state = input[0] + first
        out[0] = state
        val fade = Fade()
        for (i in 1 until n) {
            val dt = series.times[i] - series.times[i - 1]
            val tau = taus[i] * factor
            if (isGap(i)) {
                state = input[i]
            } else {
                // The response to a cubic is a cubic; what is off it fades.
                if (held) {
                    val still = heldOver(i, input)
                    state = still + (state - still) * fade.of(dt, tau)
                } else {
                    state = curve.late(i - 1, tau) + (state - curve.early(i - 1, tau)) * fade.of(dt, tau)
                }
            }
            out[i] = state
        }
    }

    /**
     * [even] with the [sides] of an asymmetric lag; it changes by no more than [most], units of [input] a second.
     */
    fun uneven(
        input: DoubleArray,
        curve: Spline,
        taus: DoubleArray,
        sides: Sides,
        first: Double,
        most: Double,
        out: DoubleArray,
    ) {
        var state = input[0] + first
        out[0] = state
        val fade = Fade()
        for (i in 1 until n) {
            val dt = series.times[i] - series.times[i - 1]
            val before = if (held) heldOver(i, input) else input[i - 1]
            val after = if (held) before else input[i]
            val tau = taus[i] * if ((before + after) / 2 > state) sides.up else sides.down
            if (isGap(i)) {
                state = input[i]
            } else {
                val early = if (held) before else curve.early(i - 1, tau)
                val late = if (held) before else curve.late(i - 1, tau)
                val free = late + (state - early) * fade.of(dt, tau)
                val isFree = maxOf(abs(before - state), abs(after - free)) <= most * tau
                state = if (isFree) {
                    free
                } else {
                    limited(state, most, tau, dt) { if (held) before else curve.follower(i - 1, it, tau) }
                }
            }
            out[i] = state
        }
    }

    /**
     * What a lag of [tau] s shows [dt] s after it showed [state], where it changes by at most [most] a second; once its past
     * has faded it shows what [follows], s into the step. The limit may begin or end to act on the way.
     */
    private inline fun limited(
        state: Double,
        most: Double,
        tau: Double,
        dt: Double,
        follows: (Double) -> Double,
    ): Double {
        val part = dt / PARTS
        val fade = exp(-part / tau)
        var now = state
        for (k in 0 until PARTS) {
            val free = follows((k + 1) * part) + (now - follows(k * part)) * fade
            now = free.coerceIn(now - most * part, now + most * part)
        }
        return now
    }

    /** Has [out] change by no more than [rate], its units a second. */
    fun slew(out: DoubleArray, rate: Double) {
        for (i in 1 until n) {
            val dt = series.times[i] - series.times[i - 1]
            if (!isGap(i)) out[i] = out[i].coerceIn(out[i - 1] - rate * dt, out[i - 1] + rate * dt)
        }
    }

    /**
     * A play of [width], [start] widths above the middle of it at first. Where the truth goes on between the rows it takes the
     * turning points there, too: a parabola through three rows says how far they are.
     */
    fun play(out: DoubleArray, width: Double, start: Double) {
        var earlier = out[0]
        var before = out[0]
        out[0] += start * width
        for (i in 1 until n) {
            val here = out[i]
            var state = out[i - 1]
            if (!held) {
                state = pulled(state, if (i > 1) turn(earlier, before, here) else before, width)
                state = pulled(state, if (i < n - 1) turn(out[i + 1], here, before) else here, width)
            }
            out[i] = pulled(state, here, width)
            earlier = before
            before = here
        }
    }

    private fun pulled(state: Double, to: Double, width: Double) = state.coerceIn(to - width / 2, to + width / 2)

    /**
     * The extreme of a parabola through [far], [near] and [beyond], each a row apart, where it lies between the last
     * two; else [near].
     */
    private fun turn(far: Double, near: Double, beyond: Double): Double {
        val slope = (beyond - far) / 2
        val bend = beyond - 2 * near + far
        return if (bend != 0.0 && -slope / bend in 0.0..1.0) near - slope * slope / (2 * bend) else near
    }

    private companion object {
        const val SAME = 1e-9

        /** Of a step in which a limit begins or ends to act. */
        const val PARTS = 8
    }
}
