package stillwater.diagnose.blind

import stillwater.diagnose.Loops
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.Combination
import stillwater.diagnose.response.LinearResponse
import stillwater.diagnose.response.ParameterLayout
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.Term
import stillwater.diagnose.water.WaterModes
import kotlin.math.exp

/**
 * Waters along the track as a sensor shows them, whitened. The designs asked for last are kept. May be asked on several
 * threads at once.
 *
 * @param loops how columns are gone through.
 */
internal class BlindColumns(private val series: MeasuredSeries, private val scales: Scales, private val loops: Loops) {
    private val n = series.size
    private val memory = BlindMemory(n)

    /** Water as the linear parts of a sensor show it: equal where that is the same. */
    inner class Shown(
        private val terms: List<Term>,
        private val numbers: List<Double>,
        private val modes: WaterModes,
        private val steps: Steps,
    ) {
        /** Number of columns. */
        val size: Int get() = modes.size + 1

        /**
         * Writes waves as the linear parts of the sensor show them into [out], then the fading of what was before the
         * log. Whenever some columns are there, [then] is told the first of them and the one behind the last.
         */
        fun write(out: List<DoubleArray>, then: (Int, Int) -> Unit) {
            val response = response(terms, numbers, modes.columns, steps, modes.behind)
            response.of(modes.columns, loops, out, bends(modes), then)
            val timeConstant = numbers[ResponseModel.TIME_CONSTANT]
            for (i in 0 until n) out[size - 1][i] = exp(-(series.times[i] - series.times[0]) / timeConstant)
            then(size - 1, size)
        }

        fun isSame(other: Shown): Boolean =
            modes === other.modes && steps == other.steps && numbers == other.numbers && terms == other.terms
    }

    /** Water of [modes] as the linear parts of the sensor with [terms] and [numbers] show it. */
    fun shown(terms: List<Term>, numbers: DoubleArray, modes: WaterModes, steps: Steps): Shown {
        val (linear, own) = linear(terms, numbers)
        return Shown(linear, own, modes, steps)
    }

    /** The bends of the water that was shown last; null for more of them than are worth their memory. */
    private fun bends(modes: WaterModes): LinearResponse.Bends? {
        if (n.toLong() * modes.size > MOST_BENDS) return null
        val known = bent
        if (known != null && known.first === modes) return known.second
        return LinearResponse.Bends(modes.size).also { bent = modes to it }
    }

    @Volatile
    private var bent: Pair<WaterModes, LinearResponse.Bends>? = null

    private class Kept(val design: BlindDesign, val shown: Shown, val rows: ShownRows?) {
        fun isOf(shown: Shown, rows: ShownRows?, noise: BlindNoise) = this.shown.isSame(shown) &&
            (this.rows?.isSame(rows) ?: (rows == null)) && design.noise.isSame(noise)
    }

    /** The newest last. */
    private val kept = ArrayList<Kept>()

    /**
     * The design of [shown], which is kept for those who soon ask for the same; [rows] are those whose water is seen, null
     * where each row shows its own.
     */
    fun designed(shown: Shown, rows: ShownRows?, noise: BlindNoise): BlindDesign {
        known(shown, rows, noise)?.let { return it }
        val design = BlindDesign(shown.size, noise, loops, memory) { out ->
            shown.write(out) { from, to ->
                if (rows != null) for (k in from until to) rows.showIn(out[k])
                noise.whiten(out, from, to)
            }
        }
        keep(Kept(design, shown, rows))
        return design
    }

    @Synchronized
    private fun known(shown: Shown, rows: ShownRows?, noise: BlindNoise): BlindDesign? {
        val known = kept.indexOfLast { it.isOf(shown, rows, noise) }
        return if (known < 0) null else kept.removeAt(known).also { kept += it }.design
    }

    /** How many designs were made, each about a tenth of a second's work for 5000 rows. */
    var made: Int = 0
        private set

    @Synchronized
    private fun keep(newest: Kept) {
        made++
        kept += newest
        if (kept.size > KEPT) kept.removeAt(0)
    }

    /** The water of [modes] with [heights] along the track. */
    fun along(modes: WaterModes, heights: DoubleArray): DoubleArray =
        Combination.of(modes.columns.asList(), heights, n, loops)

    /** The waters of [modes] with each of [heights] along the track. */
    fun along(modes: WaterModes, heights: Array<DoubleArray>): Array<DoubleArray> =
        Combination.of(modes.columns.asList(), heights, n, loops)

    /**
     * [waters], so far [behind] the fixes, m, as the linear parts of the sensor show them; their [bends] where they are
     * kept.
     */
    fun seen(
        terms: List<Term>,
        numbers: DoubleArray,
        waters: Array<DoubleArray>,
        steps: Steps,
        behind: Double,
        bends: LinearResponse.Bends?,
    ): Array<DoubleArray> {
        val (linear, own) = linear(terms, numbers)
        val out = Array(waters.size) { DoubleArray(n) }
        response(linear, own, waters, steps, behind).of(waters, loops, out.asList(), bends)
        return out
    }

    private fun response(
        linear: List<Term>,
        numbers: List<Double>,
        waters: Array<DoubleArray>,
        steps: Steps,
        behind: Double,
    ) = ResponseModel(series.withReference(waters[0]), linear, steps, scales, behind).linear(numbers.toDoubleArray())

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
        const val KEPT = 32

        /** Numbers in the bends that are kept: thirty-two megabytes. */
        const val MOST_BENDS = 4_000_000L
    }
}
