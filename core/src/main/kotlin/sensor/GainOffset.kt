package stillwater.sensor

import stillwater.model.Conditions

/**
 * A wrong calibration: y = g ψ + o. What is not finite passes unchanged; what would leave the range of numbers stays at
 * its end.
 *
 * @property gain g, dimensionless, finite and not 0.
 * @property offset o, sensor units, finite.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class GainOffset(public val gain: Double, public val offset: Double) : SensorModel {
    init {
        require(gain != 0.0 && gain.isFinite()) { "gain ($gain) must be finite and not 0" }
        require(offset.isFinite()) { "offset ($offset) must be finite" }
    }

    override fun step(input: Double, dt: Double, conditions: Conditions): Double =
        if (input.isFinite()) inRange(gain * input + offset) else input
}

/** [value], or the largest number where it is beyond. */
internal fun inRange(value: Double): Double = value.coerceIn(-Double.MAX_VALUE, Double.MAX_VALUE)
