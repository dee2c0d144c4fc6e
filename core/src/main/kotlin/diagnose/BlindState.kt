package stillwater.diagnose

import kotlin.math.ln

/**
 * A model of a log without a reference, with the water that suits it.
 *
 * @property model the sensor's model, whose truth is the water along the track. @property numbers its parameters.
 * @property fit the water's part. @property variances of the waves in each band over the noise's.
 * @property residuals readings less what the model shows, length n. @property left their square sum once the water has
 *   taken what it can.
 */
internal class BlindState(
    val model: ResponseModel,
    val numbers: DoubleArray,
    val fit: BlindFit,
    val variances: DoubleArray,
    val residuals: DoubleArray,
    val left: Double,
    val modes: WaterModes,
) {
    /** Twice the log-likelihood, less a constant. */
    val score: Double = fit.score(left)

    /** The noise's variance, sensor units². */
    val variance: Double get() = left / fit.rows

    /** Residuals, whitened, without what the water takes. */
    val whitened: DoubleArray by lazy { fit.residual(residuals) }

    /** What minus twice the log-likelihood has beside the square sum of residuals over their variance. */
    val spare: Double get() = fit.rows * ln(variance) + fit.design.noise.logDeterminant

    /** The lag's time, s. */
    val timeConstant: Double get() = numbers[ResponseModel.TIME_CONSTANT]

    /** The water along the track, sensor units. */
    val water: DoubleArray get() = checkNotNull(model.series.reference)

    /** Whether the finest waves are small, over the noise: where they are not, still finer ones may be there. */
    val isResolved: Boolean get() = modes.isWhole || power(modes.bands - 1) < MOST_FINEST * variance

    /** Mean square of what was found of process [band], sensor units². */
    fun power(band: Int): Double {
        val found = modes.along(DoubleArray(modes.size) { if (modes.band[it] == band) fit.heights[it] else 0.0 })
        return squares(found) / found.size
    }

    /** How fast what the model shows goes down with parameter [i] on the scale it is fitted on, length n. */
    fun derivative(i: Int): DoubleArray = BlindDescent.derivative(model, numbers, i)

    private companion object {
        /** Mean square of the finest waves over the noise's, above which there must be finer ones. */
        const val MOST_FINEST = 10.0
    }
}
