package stillwater.sensor

import stillwater.model.Conditions
import kotlin.math.abs
import kotlin.math.expm1

/**
 * A first-order lag whose own rate of change is limited, as of a membrane or an amplifier that passes only so much.
 *
 * ṡ = (ψ − s)/τ where that is within ±r, else ±r. For a truth ψ that is constant over the step the solution is exact
 * whatever its length: s moves evenly until it is within rτ of ψ, and closes the rest as a lag does.
 *
 * Differs from a [FirstOrderLag] with a [SlewLimit] behind it: there the lag goes on while the limit holds the reading
 * back, which then catches up at the full rate.
 *
 * @property timeConstant τ, s, above 0 and finite. @property rate r, sensor units/s, above 0 and finite.
 * @param initial the sensor's state before the first step, sensor units, finite.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class RateLimitedLag(
    public val timeConstant: Double,
    public val rate: Double,
    initial: Double,
) : SensorModel {
    init {
        require(timeConstant > 0 && timeConstant.isFinite()) {
            "timeConstant ($timeConstant s) must be above 0 and finite"
        }
        require(rate > 0 && rate.isFinite()) { "rate ($rate sensor units/s) must be above 0 and finite" }
        require(initial.isFinite()) { "initial ($initial) must be finite" }
    }

    private var state = initial

    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        if (!input.isFinite() || !(dt > 0 && dt.isFinite())) return state
        // In halves: the difference of two huge numbers overflows.
        val evenly = 2 * (abs(input / 2 - state / 2) / rate - timeConstant / 2).coerceAtLeast(0.0)
        val limited = minOf(evenly, dt)
        if (limited > 0) {
            val moved = limited * rate
            state = if (input > state) minOf(input, state + moved) else maxOf(input, state - moved)
        }
        if (limited < dt) state = towards(state, input, -expm1(-(dt - limited) / timeConstant))
        return state
    }
}
