package stillwater.estimate

import kotlin.math.PI
import kotlin.math.exp

/**
 * Variance of what rounding to steps of [resolution] hides of readings whose noise, rounding included, has the variance
 * [noise]; 0 where they are not rounded. Eq. (17a) of core/docs/SelfCalibratingEstimator.md.
 */
internal fun hiddenByRounding(noise: Double, resolution: Double): Double {
    if (resolution == 0.0) return 0.0
    val before = maxOf(0.0, noise / (resolution * resolution) - 1.0 / 12)
    return resolution * resolution / (2 * PI * PI) * exp(-4 * PI * PI * before)
}
