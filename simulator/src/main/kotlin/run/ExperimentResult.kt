package stillwater.run

import org.hipparchus.stat.descriptive.DescriptiveStatistics
import kotlin.math.sqrt

/**
 * Errors of one combination in every environment.
 *
 * @property field kind of field.
 * @property filter the estimator.
 * @property planner the planner.
 * @property errors mean absolute error over the cells: one array per environment, one number per checkpoint.
 */
class Curve(val field: String, val filter: String, val planner: String, val errors: List<DoubleArray>) {
    /** The errors at a checkpoint, over the environments. */
    fun at(checkpoint: Int): ErrorSummary {
        val statistics = DescriptiveStatistics(DoubleArray(errors.size) { errors[it][checkpoint] })
        return ErrorSummary(
            mean = statistics.mean,
            // One environment shows no spread.
            standardError = if (errors.size >
                1
            ) {
                statistics.standardDeviation / sqrt(errors.size.toDouble())
            } else {
                Double.NaN
            },
            p10 = statistics.getPercentile(10.0),
            p90 = statistics.getPercentile(90.0),
        )
    }
}

/**
 * The error of a combination at one checkpoint.
 *
 * @property mean mean over the environments of the mean absolute error over the cells, sensor units.
 * @property standardError standard error of [mean]; NaN for one environment.
 * @property p10 10th percentile over the environments.
 * @property p90 90th percentile over the environments.
 */
data class ErrorSummary(val mean: Double, val standardError: Double, val p10: Double, val p90: Double)

/**
 * What an [Experiment] found.
 *
 * @property curves one per field, planner and filter, in that order.
 * @property sensor name of the sensor.
 * @property checkpoints moves at which errors were taken.
 * @property environments fields of each kind.
 */
class ExperimentResult(
    val curves: List<Curve>,
    val sensor: String,
    val checkpoints: List<Int>,
    val environments: Int,
)
