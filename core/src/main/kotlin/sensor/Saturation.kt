package stillwater.sensor

import stillwater.model.Conditions

/**
 * A sensor that ends: it shows nothing below [lower] and nothing above [upper]. NaN passes unchanged.
 *
 * @property lower lowest output, sensor units, not NaN.
 * @property upper highest output, sensor units, above [lower].
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class Saturation(public val lower: Double, public val upper: Double) : SensorModel {
    init {
        require(lower < upper) { "lower ($lower) must be below upper ($upper)" }
    }

    override fun step(input: Double, dt: Double, conditions: Conditions): Double = input.coerceIn(lower, upper)
}
