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
 * @property boats number of boats, which share one map.
 * @property budgets what the boats used of their budget in each environment; empty where they had none.
 */
class Curve(
    val field: String,
    val filter: FilterKind,
    val planner: PlannerKind,
    val checkpoints: List<Int>,
    private val errors: List<TrialErrors>,
    val boats: Int = 1,
    val budgets: List<BudgetUse> = emptyList(),
) {
    /** Summary over the environments at each of [checkpoints]. */
    val summaries: List<ErrorSummary> by lazy { checkpoints.indices.map { summary(it) } }

    /** Summary at [move], which must be one of [checkpoints]. */
    fun at(move: Int): ErrorSummary {
        val index = checkpoints.indexOf(move)
        require(index >= 0) { "move ($move) must be one of the checkpoints $checkpoints" }
        return summaries[index]
    }

    /**
     * How much larger this curve's error is than [other]'s at [move], environment by environment; both met the same
     * fields, so that what the fields have in common cancels.
     */
    fun excessOver(other: Curve, move: Int): ErrorDifference {
        val index = checkpoints.indexOf(move)
        require(index >= 0 && other.checkpoints == checkpoints) { "move ($move) must be a checkpoint of both curves" }
        val differences = DoubleArray(errors.size) { errors[it].mean[index] - other.errors[it].mean[index] }
        val statistics = DescriptiveStatistics(differences)
        val spread = statistics.standardDeviation / sqrt(errors.size.toDouble())
        return ErrorDifference(statistics.mean, if (errors.size < 2) Double.NaN else spread)
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
            bounds = if (filter.givesBounds) bounds(checkpoint) else null,
        )
    }

    private fun bounds(checkpoint: Int): BoundsSummary {
        val coverage = DescriptiveStatistics(DoubleArray(errors.size) { errors[it].coverage[checkpoint] })
        val spread = coverage.standardDeviation / sqrt(errors.size.toDouble())
        return BoundsSummary(
            coverage = coverage.mean,
            standardError = if (errors.size < 2) Double.NaN else spread,
            meanWidth = errors.sumOf { it.width[checkpoint] } / errors.size,
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
 * @property bounds what the bounds are worth; null for a filter that gives none.
 */
data class ErrorSummary(
    val mean: Double,
    val standardError: Double,
    val p10: Double,
    val p90: Double,
    val shareInExtremes: Double,
    val bounds: BoundsSummary?,
)

/**
 * What the bounds of a combination are worth at one checkpoint.
 *
 * @property coverage mean over the environments of the share of visited cells whose bounds hold the truth,
 *   dimensionless: 1 where they are sound, the credible level where they are credible.
 * @property standardError standard error of [coverage], dimensionless; NaN for one environment.
 * @property meanWidth mean width of the visited cells' bounds, sensor units.
 */
data class BoundsSummary(val coverage: Double, val standardError: Double, val meanWidth: Double)

/**
 * How far apart two combinations are at one checkpoint.
 *
 * @property mean mean over the environments of the difference of their mean absolute errors, sensor units.
 * @property standardError standard error of [mean], sensor units; NaN for one environment.
 */
data class ErrorDifference(val mean: Double, val standardError: Double) {
    /** Whether the difference is positive by more than two standard errors. */
    val clearlyPositive: Boolean get() = mean > CLEAR * standardError

    /** Whether the difference is negative by more than two standard errors. */
    val clearlyNegative: Boolean get() = mean < -CLEAR * standardError

    private companion object {
        const val CLEAR = 2.0
    }
}

/**
 * What an [Experiment] found.
 *
 * @property settings what was compared.
 * @property curves one per field, planner, number of boats and filter, in that order.
 * @property extremeCells share of the cells that are local extremes, by field, dimensionless.
 * @property voyages where boats went in the plane in the first environment.
 */
class ExperimentResult(
    val settings: ExperimentSettings,
    val curves: List<Curve>,
    val extremeCells: Map<String, Double>,
    val voyages: List<Voyage> = emptyList(),
) {
    /** The curve of a combination, of the first number of boats unless one is given, or null where it was not run. */
    fun curve(field: String, planner: PlannerKind, filter: FilterKind, boats: Int = settings.boats.first()): Curve? =
        curves.find { it.field == field && it.planner == planner && it.filter == filter && it.boats == boats }
}
