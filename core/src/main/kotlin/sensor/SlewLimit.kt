package stillwater.sensor

import stillwater.model.Conditions

/**
 * A sensor that follows the truth exactly but never faster than a fixed rate.
 *
 * |ṡ| ≤ r. Source: the report's original simulation, where s moves by at most 0.01 a sample.
 *
 * @property rate r, sensor units/s, above 0 and finite.
 * @param initial the sensor's state before the first step, sensor units, finite.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class SlewLimit(public val rate: Double, initial: Double) : SensorModel {
    init {
        require(rate > 0 && rate.isFinite()) { "rate ($rate sensor units/s) must be above 0 and finite" }
        require(initial.isFinite()) { "initial ($initial) must be finite" }
    }

    private var state = initial

    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        if (!input.isFinite() || !(dt > 0 && dt.isFinite())) return state
        val most = rate * dt
        state = if (input > state) minOf(input, state + most) else maxOf(input, state - most)
        return state
    }
}
