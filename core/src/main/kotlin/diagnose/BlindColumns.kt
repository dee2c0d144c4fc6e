package stillwater.diagnose

import kotlin.math.exp

/**
 * Waters along the track as a sensor shows them, whitened. The designs asked for last are kept, and the columns of
 * the newest of them are in memory.
 *
 * @param loops how columns are gone through.
 */
internal class BlindColumns(private val series: MeasuredSeries, private val scales: Scales, private val loops: Loops) {
    private val n = series.size

    /** Water as the linear parts of a sensor show it: equal where that is the same. */
    inner class Shown(
        private val terms: List<Term>,
        private val numbers: List<Double>,
        private val modes: WaterModes,
        private val held: Boolean,
    ) {
        /** Number of columns. */
        val size: Int get() = modes.size + 1

        /** Waves as the linear parts of the sensor show them, then the fading of what was before the log. */
        fun columns(): Array<DoubleArray> {
            shownLast?.let { (last, columns) -> if (last.isSame(this)) return columns }
            // Nobody keeps what is shown: its place is taken by the next.
            val space = shownLast?.second?.takeIf { it.size == size } ?: Array(size) { DoubleArray(n) }
            val timeConstant = numbers[ResponseModel.TIME_CONSTANT]
            response(terms, numbers, modes.columns, held).of(modes.columns, loops, space)
            for (i in 0 until n) space[size - 1][i] = exp(-(series.times[i] - series.times[0]) / timeConstant)
            shownLast = this to space
            return space
        }

        fun isSame(other: Shown): Boolean =
            modes === other.modes && held == other.held && numbers == other.numbers && terms == other.terms
    }

    private var shownLast: Pair<Shown, Array<DoubleArray>>? = null

    /** Water of [modes] as the linear parts of the sensor with [terms] and [numbers] show it. */
    fun shown(terms: List<Term>, numbers: DoubleArray, modes: WaterModes, held: Boolean): Shown {
        val (linear, own) = linear(terms, numbers)
        return Shown(linear, own, modes, held)
    }

    private class Kept(val design: BlindDesign, val shown: Shown, val hidden: BooleanArray?) {
        fun isOf(shown: Shown, hidden: BooleanArray?, noise: BlindNoise) =
            this.shown.isSame(shown) && this.hidden.contentEquals(hidden) && design.noise.isSame(noise)
    }

    /** The newest last. */
    private val kept = ArrayList<Kept>()

    /**
     * The design of [shown], which is kept for those who soon ask for the same; rows that are [hidden] say nothing of
     * the water.
     */
    fun designed(shown: Shown, hidden: BooleanArray?, noise: BlindNoise): BlindDesign {
        val known = kept.indexOfLast { it.isOf(shown, hidden, noise) }
        if (known >= 0) return kept.removeAt(known).also { kept += it }.design
        fun seen(column: DoubleArray) =
            if (hidden == null) column else DoubleArray(n) { if (hidden[it]) 0.0 else column[it] }
        val design = BlindDesign(shown.size, noise, loops, ::use) {
            shown.columns().let { all -> Array(all.size) { seen(all[it]) } }
        }
        kept += Kept(design, shown, hidden)
        if (kept.size > KEPT) kept.removeAt(0)
        return design
    }

    /** The designs whose columns are in memory, the newest last. */
    private val inMemory = ArrayList<BlindDesign>()

    /** Says that [design] is in use, and returns the space of one that is not any more. */
    private fun use(design: BlindDesign): List<DoubleArray>? {
        if (inMemory.lastOrNull() === design) return null
        inMemory -= design
        inMemory += design
        val most = (MOST_NUMBERS / (n.toLong() * design.size)).coerceIn(2, IN_MEMORY)
        var space: List<DoubleArray>? = null
        while (inMemory.size > most) space = inMemory.removeAt(0).forget() ?: space
        return space?.takeIf { it.size == design.size }
    }

    /** The water of [modes] with [heights] along the track. */
    fun along(modes: WaterModes, heights: DoubleArray): DoubleArray =
        Combination.of(modes.columns.asList(), heights, n, loops)

    /** [waters] along the track as the linear parts of the sensor show them. */
    fun seen(terms: List<Term>, numbers: DoubleArray, waters: Array<DoubleArray>, held: Boolean): Array<DoubleArray> {
        val (linear, own) = linear(terms, numbers)
        val out = Array(waters.size) { DoubleArray(n) }
        response(linear, own, waters, held).of(waters, loops, out)
        return out
    }

    private fun response(linear: List<Term>, numbers: List<Double>, waters: Array<DoubleArray>, held: Boolean) =
        ResponseModel(series.withReference(waters[0]), linear, held, scales).linear(numbers.toDoubleArray())

    /** Those of [terms] that are linear in the water, and what of [numbers] tells what the sensor shows of it. */
    private fun linear(terms: List<Term>, numbers: DoubleArray): Pair<List<Term>, List<Double>> {
        val whole = ParameterLayout(series, terms, scales)
        val linear = terms.filter { it.cause in BlindSearch.LINEAR }
        val own = linear.flatMap { term ->
            List(whole.widths.getValue(term.key)) { numbers[whole.slots.getValue(term.key) + it] }
        }
        return linear to listOf(numbers[ResponseModel.TIME_CONSTANT], 1.0, 0.0, 0.0) + own
    }

    private companion object {
        /** Designs that may be asked for again. */
        const val KEPT = 8

        /** Designs whose columns are in memory: two models that are compared, and what is tried on top of them. */
        const val IN_MEMORY = 4L

        /** Numbers in their columns, where more than two of them have so many: a hundred megabytes. */
        const val MOST_NUMBERS = 13_000_000L
    }
}
