package stillwater.sensor

import stillwater.model.Conditions
import kotlin.math.exp
import kotlin.math.expm1
import kotlin.math.sqrt
import kotlin.random.Random

/**
 * Adds Gaussian noise that wanders: of mean 0, always the same variance, and the correlation exp(−Δt/T) between two outputs
 * Δt apart, a first-order Gauss–Markov (Ornstein–Uhlenbeck) process. What is not finite passes unchanged.
 *
 * @property standardDeviation σ, sensor units, at least 0 and finite. @property correlationTime T, s, above 0 and finite.
 * @param random where the noise comes from. Retained.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class CorrelatedNoise(
    public val standardDeviation: Double,
    public val correlationTime: Double,
    random: Random,
) : SensorModel {
    init {
        require(standardDeviation >= 0 && standardDeviation.isFinite()) {
            "standardDeviation ($standardDeviation) must be at least 0 and finite"
        }
        require(correlationTime > 0 && correlationTime.isFinite()) {
            "correlationTime ($correlationTime s) must be above 0 and finite"
        }
    }

    private val normal = GaussianNoise(1.0, random)
    private var now = draw()

    private fun draw() = normal.step(0.0, 0.0, Conditions.NONE)

    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        if (dt > 0 && dt.isFinite()) {
            val steps = dt / correlationTime
            now = exp(-steps) * now + sqrt(-expm1(-2 * steps)) * draw()
        }
        return if (input.isFinite()) inRange(input + standardDeviation * now) else input
    }
}
