package stillwater.run

import org.hipparchus.stat.descriptive.DescriptiveStatistics
import kotlin.math.sqrt

/**
 * Errors of one combination in every environment.
 *
 * @property field kind of field.
 * @property filter the estimator.
 * @property planner the planner.
 * @property checkpoints moves at which the errors were taken.
 * @param errors errors in each environment. Retained.
 */
class Curve(
    val field: String,
    val filter: FilterKind,
    val planner: PlannerKind,
    val checkpoints: List<Int>,
    private val errors: List<TrialErrors>,
) {
    /** Summary over the environments at each of [checkpoints]. */
    val summaries: List<ErrorSummary> by lazy { checkpoints.indices.map { summary(it) } }

    /** Summary at [move], which must be one of [checkpoints]. */
    fun at(move: Int): ErrorSummary {
        val index = checkpoints.indexOf(move)
        require(index >= 0) { "move ($move) must be one of the checkpoints $checkpoints" }
        return summaries[index]
    }

    private fun summary(checkpoint: Int): ErrorSummary {
        val statistics = DescriptiveStatistics(DoubleArray(errors.size) { errors[it].mean[checkpoint] })
        val spread = statistics.standardDeviation / sqrt(errors.size.toDouble())
        return ErrorSummary(
            mean = statistics.mean,
            // One environment shows no spread.
            standardError = if (errors.size < 2) Double.NaN else spread,
            p10 = statistics.getPercentile(10.0),
            p90 = statistics.getPercentile(90.0),
            shareInExtremes = errors.sumOf { it.inExtremes[checkpoint] } / errors.sumOf { it.mean[checkpoint] },
        )
    }
}

/**
 * The error of a combination at one checkpoint.
 *
 * @property mean mean over the environments of the mean absolute error over the cells, sensor units.
 * @property standardError standard error of [mean], sensor units; NaN for one environment.
 * @property p10 10th percentile over the environments, sensor units.
 * @property p90 90th percentile over the environments, sensor units.
 * @property shareInExtremes share of all error that lies in local extremes of the field, dimensionless; NaN where
 *   there is no error.
 */
data class ErrorSummary(
    val mean: Double,
    val standardError: Double,
    val p10: Double,
    val p90: Double,
    val shareInExtremes: Double,
)

/**
 * What an [Experiment] found.
 *
 * @property settings what was compared.
 * @property curves one per field, planner and filter, in that order.
 * @property extremeCells share of the cells that are local extremes, by field, dimensionless.
 */
class ExperimentResult(
    val settings: ExperimentSettings,
    val curves: List<Curve>,
    val extremeCells: Map<String, Double>,
) {
    /** The curve of a combination, or null where it was not run. */
    fun curve(field: String, planner: PlannerKind, filter: FilterKind): Curve? =
        curves.find { it.field == field && it.planner == planner && it.filter == filter }
}
