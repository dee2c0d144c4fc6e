package stillwater.diagnose.evidence

import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import kotlin.math.abs
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * A sensor that began far from the water, as one let down from the air: while it settles it tells of its lag far more surely
 * than all that comes after, and what it does later hardly shows beside.
 */
internal object SettledStart {
    /** Deviations of the noise from which it began far away, and below which it has settled. */
    private const val FAR = 30.0
    private const val NEAR = 3.0

    /** Of the rows in use, that are left at the least. */
    private const val LEAST = 0.6

    /**
     * [fit] anew to the rows in which the sensor has settled, under noise with correlation times up to [longest] s; null where
     * it did not begin far away, or settles for too much of the log.
     */
    fun of(fit: ModelFit, longest: Double): ModelFit? {
        val far = abs(fit.numbers[ResponseModel.FIRST]) / sqrt(fit.variance)
        if (!(far > FAR)) return null
        val times = fit.model.series.times
        val until = times[0] + fit.numbers[ResponseModel.TIME_CONSTANT] * ln(far / NEAR)
        val rows = BooleanArray(times.size) { fit.noise.used[it] && times[it] > until }
        if (rows.count { it } < LEAST * fit.noise.rows) return null
        return Fitting.fit(fit.model, fit.numbers, fit.free, rows, longest, guess = fit.noise.over(rows))
    }
}
