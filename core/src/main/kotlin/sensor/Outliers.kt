package stillwater.sensor

import stillwater.model.Conditions
import kotlin.random.Random

/**
 * Now and then a reading that has little to do with the water: with probability p a number drawn evenly from ± a is
 * added. What is not finite passes unchanged.
 *
 * @property probability p of each reading, dimensionless, within 0..1.
 * @property size a, sensor units, at least 0 and finite.
 * @param random where chance comes from; two numbers are drawn every step. Retained.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class Outliers(
    public val probability: Double,
    public val size: Double,
    private val random: Random,
) : SensorModel {
    init {
        require(probability in 0.0..1.0) { "probability ($probability) must be within 0..1" }
        require(size >= 0 && size.isFinite()) { "size ($size) must be at least 0 and finite" }
    }

    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        val hit = random.nextDouble() < probability
        val share = 2 * random.nextDouble() - 1
        return if (hit && input.isFinite()) inRange(input + share * size) else input
    }
}
