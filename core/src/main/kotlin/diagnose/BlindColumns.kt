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
        val isSame = shownAs != null && shownAs == listOf(terms, numbers.toList(), modes, held)
        if (last != null && isSame) return last
        val fading =
            DoubleArray(n) { exp(-(series.times[it] - series.times[0]) / numbers[ResponseModel.TIME_CONSTANT]) }
        return (seen(terms, numbers, modes.columns, held) + fading).also {
            shownLast = it
            shownAs = listOf(terms, numbers.toList(), modes, held)
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
        val whole = ResponseModel(series.withReference(waters[0]), terms, held, scales)
        val linear = terms.filter { it.cause in BlindSearch.LINEAR }
        val own = doubleArrayOf(numbers[ResponseModel.TIME_CONSTANT], 1.0, 0.0, 0.0) + linear.flatMap { term ->
            List(whole.width(term)) { numbers[whole.slot(term) + it] }
        }
        val columns = arrayOfNulls<DoubleArray>(waters.size)
        // A model has working space of its own, which tasks cannot share.
        loops.each(PARTS) { part ->
            val truth = DoubleArray(n)
            val model = ResponseModel(series.withReference(truth), linear, held, scales)
            for (k in part until waters.size step PARTS) {
                waters[k].copyInto(truth)
                model.truthChanged()
                columns[k] = DoubleArray(n).also { model.predict(own, it) }
            }
        }
        return columns.requireNoNulls()
    }

    private companion object {
        /** Parts of the work that may be done at the same time. */
        const val PARTS = 4
    }
}
