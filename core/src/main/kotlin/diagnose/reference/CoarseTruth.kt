package stillwater.diagnose.reference

import stillwater.diagnose.evidence.FitReport
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ReferenceGaps
import stillwater.diagnose.response.Resolution
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.three
import kotlin.math.abs
import kotlin.math.sqrt

/**
 * What a reference leaves open that is written in coarse steps or seldom, against what the models [base] and [last], with all
 * that was chosen, leave of the readings.
 */
internal class CoarseTruth(private val base: ModelFit, private val last: ModelFit, private val report: FitReport) {
    private val series = last.model.series
    private val step = series.written.reference?.let(Resolution::of) ?: 0.0

    /**
     * What the reference's rounding makes of the readings, sensor units: evened out by the lag, unless the truth stays on each of
     * its numbers for longer.
     */
    private val rounding: Double by lazy {
        val truth = series.reference
        if (truth == null || step == 0.0) return@lazy 0.0
        val travelled = (1 until truth.size).sumOf { abs(truth[it] - truth[it - 1]) }
        val stay = maxOf(series.period, if (travelled > 0) series.duration * step / travelled else series.duration)
        val evened = sqrt(minOf(1.0, stay / (2 * last.numbers[ResponseModel.TIME_CONSTANT])))
        abs(last.numbers[ResponseModel.GAIN]) * step / sqrt(12.0) * evened
    }

    /** Why what [last] leaves may be how the truth went; null where it is not. */
    fun left(): String? = when {
        rounding > LEFT * report.rmse(last) ->
            "the reference is written in steps of ${three(step)}, which might explain what is left"
        last.model.scales.unknown?.isSharp != true &&
            ReferenceGaps.reach(last) > LEFT_BETWEEN * sqrt(series.size.toDouble()) ->
            "rows are so far apart that how the truth went in between might explain what is left"
        else -> null
    }

    /** Why what was chosen may be how the truth went; null where it does more. */
    val chosen: String? by lazy {
        val before = report.rmse(base)
        val after = report.rmse(last)
        val gained = before * before - after * after
        "the reference is written in steps of ${three(step)}, which might do what a cause would explain"
            .takeIf { gained < rounding * rounding && rounding > LEFT * after }
    }

    private companion object {
        /** Of what is left, what rounding of the reference may make of it; both as deviations of a reading. */
        const val LEFT = 0.25

        /** The same of what is not known between rows. */
        const val LEFT_BETWEEN = 0.2
    }
}
