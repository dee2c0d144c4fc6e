package stillwater.sensor

import stillwater.model.Conditions

/**
 * Rounds every output to the nearest multiple of a step, ties to even, as an instrument's last digit does. What is not
 * finite, or has too many steps for a number, passes unchanged.
 *
 * @property step the resolution, sensor units, above 0 and finite.
 * @throws IllegalArgumentException if [step] is out of its range.
 */
public class Quantisation(public val step: Double) : SensorModel {
    init {
        require(step > 0 && step.isFinite()) { "step ($step) must be above 0 and finite" }
    }

    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        val rounded = step * Math.rint(input / step)
        return if (rounded.isFinite()) rounded else input
    }
}
