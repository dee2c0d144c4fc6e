package stillwater.sensor

import stillwater.model.Conditions
import kotlin.math.ln
import kotlin.math.sqrt
import kotlin.random.Random

/**
 * Adds independent Gaussian noise of mean 0 to every output. What is not finite passes unchanged.
 *
 * @property standardDeviation σ, sensor units, at least 0 and finite.
 * @param random where the noise comes from; two numbers or more are drawn for every two steps. Retained.
 * @throws IllegalArgumentException if [standardDeviation] is out of its range.
 */
public class GaussianNoise(public val standardDeviation: Double, private val random: Random) : SensorModel {
    init {
        require(standardDeviation >= 0 && standardDeviation.isFinite()) {
            "standardDeviation ($standardDeviation) must be at least 0 and finite"
        }
    }

    private var spare = Double.NaN

    override fun step(input: Double, dt: Double, conditions: Conditions): Double =
        input + standardDeviation * standardNormal()

    /** Marsaglia's polar method, doi:10.1137/1006063: two independent normal numbers from a point in the unit disc. */
    private fun standardNormal(): Double {
        if (!spare.isNaN()) return spare.also { spare = Double.NaN }
        while (true) {
            val u = 2 * random.nextDouble() - 1
            val v = 2 * random.nextDouble() - 1
            val squared = u * u + v * v
            if (squared < 1 && squared > 0) {
                val factor = sqrt(-2 * ln(squared) / squared)
                spare = v * factor
                return u * factor
            }
        }
    }
}
