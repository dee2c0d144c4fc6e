package stillwater.diagnosis

import kotlin.math.abs
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * A number that residuals have, and what it would be for independent normal noise.
 *
 * @property name what it is. @property value what these residuals have. @property lower and [upper] hold it in 95 of
 * 100 cases of such noise.
 */
internal class ResidualCheck(val name: String, val value: Double, val lower: Double, val upper: Double)

/** Checks of whitened residuals against independent normal noise. */
internal object ResidualChecks {
    /** The checks of [z], in standard deviations. */
    fun of(z: DoubleArray, resolution: Double, spread: Double): List<ResidualCheck> {
        val n = z.size
        if (n < 20) return emptyList()
        val root = sqrt(n.toDouble())
        val correlations = DiagnosisFigures.correlations(z, 20)
        val portmanteau =
            n * (n + 2.0) * correlations.indices.sumOf { correlations[it] * correlations[it] / (n - it - 1) }
        val runs = 1 + (1 until n).count { (z[it] > 0) != (z[it - 1] > 0) }
        val scale = sqrt(z.sumOf { it * it } / n)
        val fourth = z.sumOf { (it / scale).let { r -> r * r * r * r } } / n - 3
        val tenth = n / 10
        val variances = (0 until 10).map { k -> (k * tenth until (k + 1) * tenth).sumOf { z[it] * z[it] } / tenth }
        val ratio = ln(variances.max() / maxOf(variances.min(), 1e-300))
        val usual = sqrt(2.0 / tenth)
        return listOf(
            ResidualCheck("correlation of neighbours", correlations[0], -1.96 / root, 1.96 / root),
            // The 2.5 % and 97.5 % points of a chi-square distribution with 20 degrees of freedom.
            ResidualCheck("whiteness (Ljung-Box over 20 rows)", portmanteau, 9.59, 34.17),
            ResidualCheck("runs of one sign", runs.toDouble(), n / 2.0 - 0.98 * root, n / 2.0 + 0.98 * root),
            ResidualCheck(
                "heaviness of the tails (excess kurtosis)",
                fourth,
                -1.96 * sqrt(24.0 / n),
                1.96 * sqrt(24.0 / n),
            ),
            // The range of ten normal numbers is 1.7 to 4.8 standard deviations in 95 of 100 cases.
            ResidualCheck("spread, largest to smallest tenth (log of variances)", ratio, 1.67 * usual, 4.79 * usual),
            ResidualCheck("resolution over the noise's spread", if (spread > 0) resolution / spread else 0.0, 0.0, 1.0),
        ).map { if (abs(it.value).isFinite()) it else ResidualCheck(it.name, Double.NaN, it.lower, it.upper) }
    }
}
