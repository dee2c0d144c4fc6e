package stillwater.sensor

import stillwater.model.Conditions
import kotlin.math.abs
import kotlin.math.expm1
import kotlin.math.ln1p

/**
 * A sensor that closes a fixed share of its distance to the truth per unit of time: exponential response.
 *
 * τ ṡ = ψ − s. For a truth ψ that is constant over the step Δt the solution is exact whatever its length:
 * s ← s + (1 − exp(−Δt/τ)) (ψ − s).
 *
 * Source: the report, section 2. Differs: its eq. 1 has the gain αᵗ and its eq. 2 diverges as printed; here the gain
 * per sample is α = 1 − exp(−Δt/τ), so τ = −Δt / ln(1 − α).
 *
 * @property timeConstant τ, s, above 0 and finite: after τ seconds 63 % of a step is shown.
 * @param initial the sensor's state before the first step, sensor units, finite.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class FirstOrderLag(public val timeConstant: Double, initial: Double) : SensorModel {
    init {
        require(timeConstant > 0 && timeConstant.isFinite()) {
            "timeConstant ($timeConstant s) must be above 0 and finite"
        }
        require(initial.isFinite()) { "initial ($initial) must be finite" }
    }

    private var state = initial
    private var gainDt = 0.0
    private var gain = 0.0

    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        if (!input.isFinite() || !(dt > 0 && dt.isFinite())) return state
        state = towards(state, input, gainOf(dt))
        return state
    }

    override fun stepAll(input: Double, dt: Double, conditions: Conditions, outputs: DoubleArray, count: Int) {
        if (!input.isFinite() || !(dt > 0 && dt.isFinite())) {
            outputs.fill(state, 0, count)
            return
        }
        val gain = gainOf(dt)
        // In a local variable: a step waits for the one before and for nothing else.
        var last = state
        for (i in 0 until count) {
            last = towards(last, input, gain)
            outputs[i] = last
        }
        state = last
    }

    private fun gainOf(dt: Double): Double {
        if (dt != gainDt) {
            gainDt = dt
            gain = -expm1(-dt / timeConstant)
        }
        return gain
    }

    public companion object {
        /**
         * The time constant of a sensor that closes the share [alpha] of its distance each [period].
         *
         * @param alpha gain per sample, dimensionless, above 0 and below 1.
         * @param period time between samples, s, above 0.
         * @return τ, s.
         * @throws IllegalArgumentException if a number is out of its range.
         */
        public fun timeConstant(alpha: Double, period: Double): Double {
            require(alpha > 0 && alpha < 1) { "alpha ($alpha) must be above 0 and below 1" }
            require(period > 0 && period.isFinite()) { "period ($period s) must be above 0 and finite" }
            return -period / ln1p(-alpha)
        }
    }
}

/** s + α (ψ − s) for [state] s, [input] ψ and [gain] α within 0..1. */
internal fun towards(state: Double, input: Double, gain: Double): Double {
    // In halves, because the difference of two huge numbers overflows. Of numbers far from the ends of what a Double holds
    // halves are exact and every rounding is the same without them; the next step has less to wait for.
    val next = if (isMiddling(state) && isMiddling(input) && gain >= LEAST_GAIN) {
        state + gain * (input - state)
    } else {
        2 * (state / 2 + gain * (input / 2 - state / 2))
    }
    // Rounding must not carry it beyond the truth: bounds rest on the side from which it comes.
    // Not minOf and maxOf: they also order 0 and -0, and everything that follows would wait for it.
    val isBeyond = if (input > state) next > input else next < input
    return if (isBeyond) input else next
}

/**
 * Whether nothing overflows, nor loses bits for being too small, in the difference of two such numbers, of which one is
 * at least 1e-16 of the other or 0, and in its product with a gain of [LEAST_GAIN] or more.
 */
private fun isMiddling(number: Double): Boolean = abs(number) >= 1e-250 && abs(number) <= 1e250

private const val LEAST_GAIN = 1e-15
