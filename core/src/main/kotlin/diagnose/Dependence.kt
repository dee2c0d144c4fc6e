package stillwater.diagnose

/**
 * A way in which residuals depend on something that they should not depend on.
 *
 * @property description what they depend on, in words. @property ratio likelihood ratio, corrected for correlation.
 * @property degrees of freedom. @property pValue of it. @property adjusted p-value for all looks taken, after Holm.
 */
public data class Dependence(
    val description: String,
    val ratio: Double,
    val degrees: Int,
    val pValue: Double,
    val adjusted: Double = pValue,
)
