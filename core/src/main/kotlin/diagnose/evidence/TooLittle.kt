package stillwater.diagnose.evidence

import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.ModelAssessment
import stillwater.diagnose.Verdict
import stillwater.diagnose.independentResiduals
import stillwater.diagnose.isFlat
import stillwater.sensor.SensorSpec

/** Logs that nothing can be told from, however they are looked at. */
internal object TooLittle {
    private const val FEWEST_ROWS = 60
    private const val SMALLEST_RANGE = 1e-100

    /** Of the squares of all the truth's steps: with less of them outside gaps it moves in gaps alone. */
    private const val STANDING = 0.005

    /**
     * Why the reference of [series], which has one, cannot show how the readings follow it: it moves in gaps alone
     * ([isGap], before each row), so that when it did is not known. Null where it may.
     */
    fun inGaps(series: MeasuredSeries, isGap: BooleanArray): String? {
        val truth = series.reference ?: return null
        fun moves(inGap: Boolean) =
            (1 until truth.size).filter { isGap[it] == inGap }.map { truth[it] - truth[it - 1] }
        val within = moves(inGap = true)
        if (!(moves(inGap = false).sumOf { it * it } < STANDING * within.sumOf { it * it })) return null
        return "the reference moves only where rows of it are missing (${within.size} gaps): when it did is not " +
            "known, so that no cause can be told from it; it is needed from before each move on"
    }

    /**
     * Why [series], which has a reference, cannot show anything: its readings never change, or are the reference's own. Null
     * where it may.
     */
    fun still(series: MeasuredSeries): String? {
        val truth = series.reference ?: return null
        val readings = series.shown(series.values)
        return when {
            readings.size < FEWEST_ROWS -> null
            isFlat(readings) && isFlat(truth) -> "neither the readings nor the truth ever change"
            series.shown(truth).contentEquals(readings) ->
                "the reference has the readings' own number in every row: it is the same column, and no other instrument's"
            !isFlat(readings) -> null
            else ->
                "the readings never change, though the reference does: the sensor or the logger hung, or what the " +
                    "reference does is beyond the sensor's range"
        }
    }

    /** Why [series], which has no reference, cannot show anything, or null where it may. */
    fun why(series: MeasuredSeries): String? = when {
        series.size < FEWEST_ROWS -> "there are ${series.size} rows only, and $FEWEST_ROWS are needed"
        isFlat(series.values) -> "the readings never change"
        series.values.max() - series.values.min() < SMALLEST_RANGE ->
            "the readings change by less than can be reckoned with"
        !series.hasPlaces ->
            "the boat never moves, so that no pass comes back to the same water"
        else -> null
    }

    /**
     * The result for a log that cannot show anything, because of [why], but that the rows [off] are far off, and what
     * [warnings] say.
     */
    fun answer(
        series: MeasuredSeries,
        why: String,
        off: List<Int> = emptyList(),
        warnings: List<String> = emptyList(),
    ): DiagnosisResult {
        val nothing = ModelAssessment(
            emptyList(),
            0.0,
            Double.NaN,
            Double.NaN,
            series.values.copyOf(),
            0.0,
            0.0,
            0.0,
            DoubleArray(series.size),
            independentResiduals(series.readRows()),
        )
        return DiagnosisResult(
            Verdict.InsufficientData(why),
            emptyList(),
            nothing,
            null,
            SensorSpec("base", emptyList()),
            null,
            null,
            emptyList(),
            off,
            listOfNotNull("${Spikes.words(off.size)} the readings beside.".takeIf { off.isNotEmpty() }) + warnings,
        )
    }
}
