package stillwater.diagnose.blind

import stillwater.diagnose.algebra.squares
import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.evidence.LocalSpread
import stillwater.diagnose.evidence.LooseReadings
import stillwater.diagnose.evidence.Mixture
import stillwater.diagnose.evidence.Neighbours
import stillwater.diagnose.evidence.Spikes
import stillwater.diagnose.median
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.RangeEnd
import stillwater.diagnose.response.SpikeSize
import kotlin.math.abs
import kotlin.math.sqrt

/** Single readings that the model of [state] leaves far off, among all rows. */
internal class BlindOutliers(search: BlindSearch, state: BlindState) {
    private val series = state.model.series
    private val noise = state.fit.design.noise
    private val spread = sqrt(state.variance)
    private val z = DoubleArray(series.size).also { out ->
        val all = BooleanArray(series.size) { true }
        noise.over(all).whiten(state.residuals, out)
    }
    private val residuals = state.residuals
    private val resolution = state.model.scales.resolution
    private val inside = 2 * REACH until series.size - 2 * REACH

    /** Rows at an end of the range, or with such beside them: no noise moves these, and that of all others would look heavy. */
    private val isStill = BooleanArray(series.size).also { out ->
        val isAtEnd = RangeEnd.beyond(state.model, state.numbers) ?: return@also
        for (i in out.indices) if (isAtEnd[i]) out.fill(true, maxOf(0, i - REACH), minOf(out.size, i + REACH + 1))
    }

    /** Readings less what a parabola through the rows beside them says, in robust deviations of those about them. */
    private val off = series.values.let { values ->
        val hasSides = REACH until values.size - REACH
        evened(DoubleArray(values.size) { if (it in hasSides) Neighbours.off(values, it) else 0.0 })
    }

    /** The rows that stick out: single ones, off their neighbours on both sides by more than rounding makes. */
    val rows: List<Int> = (Spikes.of(z, isStill::get) + sharp()).distinct().sorted()
        .filter { it > 0 && it < residuals.size - 1 && isSingle(it) }

    /**
     * The rows that stick out of the readings themselves: a parabola through the rows beside them foretells them badly.
     * Fixes that jitter do no harm here.
     */
    private fun sharp(): List<Int> = inside.filter { abs(off[it]) > FAR }

    /** After a jump the next reading stays; after an outlier it comes back. */
    private fun isSingle(i: Int): Boolean {
        val off = abs(residuals[i] - (residuals[i - 1] + residuals[i + 1]) / 2)
        return Spikes.isSingle(residuals, i) && off > STEPS * resolution && isAlone(i) && !isJump(i) && !isCorner(i)
    }

    /** Whether the readings about [i] are off as a jump beside it makes them, which stays, more than a single one does. */
    private fun isJump(i: Int): Boolean {
        val jump = maxOf(alike(Neighbours.ABOUT_JUMP, i - REACH), alike(Neighbours.ABOUT_JUMP, i - REACH + 1))
        return jump > alike(Neighbours.ABOUT_SINGLE, i - REACH)
    }

    /** Whether the readings about [i] are off as a corner makes them, clearly more than a single one does. */
    private fun isCorner(i: Int): Boolean {
        val corner = Neighbours.ABOUT_CORNER.maxOf { alike(it, i - REACH) }
        return corner > alike(Neighbours.ABOUT_SINGLE, i - REACH) + CLEARLY
    }

    /** How much of the squares of how far readings from row [from] on are off the [shape] explains. */
    private fun alike(shape: DoubleArray, from: Int): Double {
        val product = shape.indices.sumOf { shape[it] * off.getOrElse(from + it) { 0.0 } }
        return product * product / squares(shape)
    }

    /** Whether reading [i] is off the line between its neighbours as none about it is: a sharp front is no outlier. */
    private fun isAlone(i: Int): Boolean {
        val values = series.values
        fun bend(k: Int) = abs(values[k] - (values[k - 1] + values[k + 1]) / 2)
        val about = (maxOf(1, i - WINDOW)..minOf(values.size - 2, i + WINDOW)).filter { abs(it - i) > 1 }
        return bend(i) > ALONE * median(DoubleArray(about.size) { bend(about[it]) })
    }

    /** [column] over the robust deviation of the rows about each, rounding's at least. */
    private fun evened(column: DoubleArray): DoubleArray {
        val rounded = resolution * sqrt(Neighbours.errorVariance / ROUNDED)
        fun middle(rows: List<Int>) = median(DoubleArray(rows.size) { abs(column[rows[it]]) })
        val moved = column.indices.filterNot { isStill[it] }.ifEmpty { column.indices.toList() }
        val all = middle(moved)
        // Where a logger repeats a reading nothing scatters about it.
        val least = maxOf(rounded, STUCK * all)
        return DoubleArray(column.size) { i ->
            val about = (maxOf(0, i - NEAR)..minOf(column.size - 1, i + NEAR)).filter { it != i && !isStill[it] }
            val usual = if (about.size < FEWEST) all else middle(about)
            column[i] / maxOf(NORMAL * usual, least, TINY)
        }
    }

    /** Rows about a jump or a corner: there neither the rows beside nor the model foretell a single reading. */
    private val isAboutFront = BooleanArray(series.size).also { out ->
        for (i in inside) {
            val isFarthest = abs(off[i]) >= maxOf(abs(off[i - 1]), abs(off[i + 1]))
            if (isFarthest && abs(off[i]) > TAIL && (isJump(i) || isCorner(i))) out.fill(true, i - REACH, i + REACH + 1)
        }
    }

    private val columns = inside.filterNot { isAboutFront[it] || isStill[it] }.let { rows ->
        listOf(off, evened(z)).map { column -> DoubleArray(rows.size) { column[rows[it]] } }
    }

    /**
     * Noise with single wrong readings against noise without, of the readings about the rows beside them and of what the
     * model leaves.
     */
    private val both = columns.map(Spikes::ratio)

    /**
     * Whether noise with heavy tails is about as likely, or likelier, of what the model leaves: how far readings are off
     * those beside them has tails wherever single ones are wild, since each moves what is said of all about it.
     */
    private val isTailed = both[1].ratio < Spikes.student(columns[1], noise.noise).ratio + TAILED

    /** Whether the farthest reading is off by more than noise that is somewhat uneven brings about, as with a reference. */
    private val isFar = both[1].size > LooseReadings.FARTHEST

    /**
     * The two in one; null where the noise has heavy tails, as that of coarse rounding, where no reading is far off, where
     * the far ones are gathered where it is larger, or where the water lacks waves, which leave much in few rows.
     * The rows beside say less of each reading, what the model leaves holds what the model gets wrong: the ratio is the
     * geometric mean of both, and half as much again as the less at most.
     */
    private val mixture: Mixture? = if (isTailed || !isFar || resolution > spread || isGathered(state)) {
        null
    } else {
        val (less, more) = both.sortedBy { it.ratio }
        val told = less.copy(ratio = minOf(sqrt(less.ratio * more.ratio), MOST_TIMES * less.ratio))
        // Missing waves are looked for, which takes long, only where it would say something.
        told.takeUnless { chance(it) < 1 && FinerWaves.areMissing(state, search) }
    }

    private fun chance(mixture: Mixture) = minOf(1.0, DOUBT * Evidence.pValue(mixture.ratio, MIXED))

    private fun isGathered(state: BlindState): Boolean {
        val free = BooleanArray(state.numbers.size)
        val fit = ModelFit(state.model, state.numbers, free, noise.noise, state.residuals, z, state.score)
        return LocalSpread.isConcentrated(fit, inside.filter { abs(off[it]) > TAIL && !isAboutFront[it] })
    }

    /**
     * Of there being as many far ones, or such tails: less sure than it seems by [DOUBT], because the spread about a
     * row is told by few rows.
     */
    val pValue: Double = minOf(
        Evidence.poissonTail(rows.size, series.size * if (isTailed) BEYOND_TAILED else BEYOND),
        mixture?.let(::chance) ?: 1.0,
    )

    /** How many and how far; null where there are none. */
    fun size(): SpikeSize? =
        SpikeSize.of(rows, residuals, spread) ?: mixture?.let { SpikeSize(it.share, it.size * spread) }

    private companion object {
        /** Share of rows that stick out of their neighbours as far where the noise's tails are somewhat heavy. */
        const val BEYOND = 1.5e-4

        /** The same of noise with heavy tails: Student's t with five degrees of freedom, five robust deviations. */
        const val BEYOND_TAILED = 3e-3
        const val WINDOW = 12
        const val REACH = Neighbours.REACH
        const val NEAR = 30

        /** Rows about one that tell how far readings scatter there. */
        const val FEWEST = 10
        const val FAR = 5.0
        const val NORMAL = 1.4826
        const val ROUNDED = 12.0

        /** Of how far the readings of the whole log are off at the median. */
        const val STUCK = 1e-3
        const val TINY = 1e-290
        const val DOUBT = 10.0

        /**
         * Twice a log-likelihood ratio that is no evidence, as with a reference ([LooseReadings]). Of 16 hidden logs with
         * outliers of 1.2 to 3.7 times the detectable size that were named none is nearer than 6; of five with tails and
         * without outliers that were named all are nearer than 3.
         */
        const val TAILED = 4.0

        /** How much surer than the less sure of the two both together may be: what the model gets wrong is in one of them. */
        const val MOST_TIMES = 1.5

        /** Numbers of a mixture: share, size and spread. */
        const val MIXED = 3

        /** Twice a log-likelihood, by readings' robust deviations, that is no chance. */
        const val CLEARLY = 4.0

        /** Of these only one in two thousand is no outlier. */
        const val TAIL = 3.5

        /** Seven median bends are 4.7 normal standard deviations. */
        const val ALONE = 7.0
        const val STEPS = 4
    }
}
