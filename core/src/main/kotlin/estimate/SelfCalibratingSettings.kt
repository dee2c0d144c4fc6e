package stillwater.estimate

import kotlin.math.ln

/**
 * What a [SelfCalibratingEstimator] believes of the sensor beforehand.
 *
 * @property timeConstant the median of what is believed of τ, s, above 0 and finite.
 * @property factor how sure that is: two times in three τ is within this factor of [timeConstant], either way; above 1
 *   and finite. The belief is lognormal, with standard deviation ln [factor].
 * @property recalled how many of the first readings are kept to start over with a better time constant, at least 16.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class SelfCalibratingSettings(
    val timeConstant: Double = 20.0,
    val factor: Double = 10.0,
    val recalled: Int = 2048,
) {
    init {
        require(timeConstant > 0 && timeConstant.isFinite()) {
            "timeConstant ($timeConstant s) must be above 0 and finite"
        }
        require(factor > 1 && factor.isFinite()) { "factor ($factor) must be above 1 and finite" }
        require(recalled >= 16) { "recalled ($recalled readings) must be at least 16" }
    }

    internal val mean: Double get() = ln(timeConstant)
    internal val spread: Double get() = ln(factor)
}
