package stillwater.diagnose

import kotlin.math.exp

/**
 * Waters along the track as a sensor shows them, whitened; what was asked for last is kept.
 *
 * @param loops how columns are gone through.
 */
internal class BlindColumns(private val series: MeasuredSeries, private val scales: Scales, private val loops: Loops) {
    private val n = series.size

    /** Waves as the linear parts of the sensor show them, then the fading of what was before the log. */
    fun shown(terms: List<Term>, numbers: DoubleArray, modes: WaterModes, held: Boolean): Array<DoubleArray> {
        val last = shownLast
        val linear = linear(terms, numbers)
        val isSame = shownAs != null && shownAs == listOf(linear, modes, held)
        if (last != null && isSame) return last
        val fading =
            DoubleArray(n) { exp(-(series.times[it] - series.times[0]) / numbers[ResponseModel.TIME_CONSTANT]) }
        return (seen(terms, numbers, modes.columns, held) + fading).also {
            shownLast = it
            shownAs = listOf(linear, modes, held)
        }
    }

    private var shownLast: Array<DoubleArray>? = null
    private var shownAs: List<Any>? = null

    /**
     * The design of [columns], which is kept for the next that asks for the same; rows that are [hidden] say nothing of
     * the water.
     */
    fun designed(columns: Array<DoubleArray>, hidden: BooleanArray?, noise: BlindNoise): BlindDesign {
        val last = designLast
        val isSame = designOf === columns && designHidden.contentEquals(hidden)
        if (last != null && isSame && last.noise === noise) return last
        fun seen(column: DoubleArray) =
            if (hidden == null) column else DoubleArray(n) { if (hidden[it]) 0.0 else column[it] }
        return BlindDesign(Array(columns.size) { seen(columns[it]) }, noise, loops).also {
            designLast = it
            designOf = columns
            designHidden = hidden
        }
    }

    private var designLast: BlindDesign? = null
    private var designOf: Array<DoubleArray>? = null
    private var designHidden: BooleanArray? = null

    /** [waters] along the track as the linear parts of the sensor show them. */
    fun seen(terms: List<Term>, numbers: DoubleArray, waters: Array<DoubleArray>, held: Boolean): Array<DoubleArray> {
        val (linear, own) = linear(terms, numbers)
        val model = ResponseModel(series.withReference(waters[0]), linear, held, scales)
        return model.linear(own.toDoubleArray()).of(waters, loops)
    }

    /** Those of [terms] that are linear in the water, and what of [numbers] tells what the sensor shows of it. */
    private fun linear(terms: List<Term>, numbers: DoubleArray): Pair<List<Term>, List<Double>> {
        val whole = ParameterLayout(series, terms, scales)
        val linear = terms.filter { it.cause in BlindSearch.LINEAR }
        val own = linear.flatMap { term ->
            List(whole.widths.getValue(term.key)) { numbers[whole.slots.getValue(term.key) + it] }
        }
        return linear to listOf(numbers[ResponseModel.TIME_CONSTANT], 1.0, 0.0, 0.0) + own
    }
}
