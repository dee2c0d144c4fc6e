package stillwater.sensor

import stillwater.model.Conditions

/**
 * A calibration that wanders off at a constant rate: y(t) = ψ(t) + r t, with t since the sensor was built. What is not
 * finite passes unchanged.
 *
 * @property rate r, sensor units/s, finite.
 * @throws IllegalArgumentException if [rate] is not finite.
 */
public class Drift(public val rate: Double) : SensorModel {
    init {
        require(rate.isFinite()) { "rate ($rate sensor units/s) must be finite" }
    }

    private var offset = 0.0

    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        if (dt > 0 && dt.isFinite()) offset = inRange(offset + inRange(rate * dt))
        return if (input.isFinite()) inRange(input + offset) else input
    }
}
