package stillwater.estimate

import stillwater.field.FieldMap
import stillwater.field.SpatialCorrelation
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.math.abs
import kotlin.math.sqrt

/**
 * Maps the field through a slow sensor, cells unseen included: a Gaussian process over the cells, on top of an
 * estimator that reads every cell by itself and says how sure it is.
 *
 * Model: ψ = level + smooth part + part of each cell alone, Gaussian; the smooth part of one of three families. Family,
 * correlation length, amplitude and the share of the part alone are learned by marginal likelihood and averaged over; a
 * field without any correlation is one of the candidates. What [cells] says of a visited cell counts as a measurement
 * of it, with a quarter of its bounds' width, about, as standard deviation and independent of the others; so whatever
 * [cells] learns of the sensor (time constant, noise, kind) holds here. A cell's value is its posterior's median, its
 * bounds are credible at 95 %, both cut to the prior. Where [cells] finds that its own model of the sensor does not
 * explain the readings, or gives most visited cells the prior's bounds, its errors are not independent: then its values
 * and bounds are taken as they are, cells not visited are interpolated, and their bounds are on average about as wide as
 * those of the visited ones near them, at most 95 % of the prior or as far as their value; see [isExplained].
 *
 * The posterior is worked on when [map] is asked for, not at a reading: ask for it after updates rather than keeping
 * it. When it was asked for before matters a little. A look at every visited cell apart, it does [work] for each
 * reading since the last time and leaves the rest for later times: first the learning of the covariance, which begins
 * anew each time a quarter more cells are visited and takes half of the work at most, then predictions. Grids of more
 * than 144 cells are predicted in blocks of 8 x 8, each from the 96 visited cells nearest, the boat's own block first
 * among others; a block's cells change together, when its prediction is complete. Memory: O(cells), whatever the
 * readings. No call allocates once tables of correlations are there. Confined to one thread.
 *
 * Source: own composition, core/docs/BayesianMap.md; Rasmussen and Williams 2006, Gaussian Processes for Machine
 * Learning.
 *
 * @param grid the cells.
 * @param prior the range of the field, sensor units.
 * @property cells reads the visited cells; over the same grid and prior, used by nobody else. Retained.
 * @property work most to be done for a reading, multiplications and additions, above 0; but one covariance's look at
 *   one block, up to a million, is not cut. By default [AT_ONCE] for grids of up to 144 cells, else [ASHORE].
 * @throws IllegalArgumentException if [cells] has another grid or prior, or [work] is not above 0.
 */
public class BayesianMap(
    private val grid: Grid,
    prior: Interval,
    public val cells: FieldEstimator = SelfCalibratingEstimator(grid, prior),
    public val work: Double = if (grid.size <= CellBlocks.WHOLE) AT_ONCE else ASHORE,
) : FieldEstimator {
    private val middle = prior.midpoint
    private val scale = if (prior.width > 0 && prior.width.isFinite()) prior.width else 1.0
    private val believed = FieldMap(grid, prior)
    private val source: FieldMap = cells.map
    private val covariances = FieldCovariances(grid)
    private val blocks = CellBlocks(grid)
    private val prediction = BlockPrediction(grid, covariances, blocks)
    private val fit = CovarianceFit(grid, covariances, blocks)
    private val cut = TruncatedNormal()

    private var visited = IntArray(FIRST_CELLS)
    private var visitedCount = 0

    /** What is known of visited cells by themselves, scaled; [variances] is NaN before a cell is measured. */
    private val values = DoubleArray(grid.size)
    private val variances = DoubleArray(grid.size) { Double.NaN }

    /** The same as it was when the neighbours last took note of it; NaN before. */
    private val noted = DoubleArray(grid.size) { Double.NaN }
    private val notedVariances = DoubleArray(grid.size)

    /** What the other cells say of each cell, scaled. */
    private val outer = DoubleArray(grid.size)
    private val outerVariances = DoubleArray(grid.size) { Double.NaN }

    /** The variance of that if the field varied alike everywhere. */
    private val raw = DoubleArray(grid.size)
    private val surprises = DoubleArray(grid.size)
    private val tellings = DoubleArray(grid.size)

    /** Whether the map has what is known of a visited cell. */
    private val isWritten = BooleanArray(grid.size)

    private var lastCell = 0
    private var fresh = 0
    private var isCurrent = true

    init {
        require(work > 0) { "work ($work multiplications and additions a reading) must be above 0" }
        require(source.grid == grid) { "cells' grid (${source.grid}) must be the same as grid ($grid)" }
        require(source.prior == prior) { "cells' prior (${source.prior}) must be the same as prior ($prior)" }
        believed.correlation = SpatialCorrelation { columns, rows -> correlation(columns, rows) }
    }

    override val map: FieldMap get() {
        if (!isCurrent) refresh()
        return believed
    }

    /** Whether errors of [cells] are independent; where not, nothing is pooled with its bounds. As [map] last had it. */
    public var isExplained: Boolean = true
        private set

    /** Most likely correlation length of the smooth part, m. */
    public val correlationLength: Double get() =
        covariances.length(covariances.kept[0]) * sqrt(grid.cellWidth) * sqrt(grid.cellHeight)

    /** Expected share of a cell's variance that is its own, 0 to 1, dimensionless: 1 where cells tell nothing of others. */
    public val ownShare: Double get() {
        var share = 0.0
        for (k in 0 until covariances.keptCount) {
            share += covariances.weights[covariances.kept[k]] * covariances.nugget(covariances.kept[k])
        }
        return share
    }

    private fun correlation(columns: Int, rows: Int): Double {
        if (columns == 0 && rows == 0) return 1.0
        var sum = 0.0
        for (k in 0 until covariances.keptCount) {
            val candidate = covariances.kept[k]
            val smooth = covariances.smooth(covariances.table(candidate), columns, rows)
            sum += covariances.weights[candidate] * (1 - covariances.nugget(candidate)) * smooth
        }
        return sum
    }

    override fun update(
        time: BoatTime,
        x: Double,
        y: Double,
        value: Double,
        conditions: Conditions,
    ): ReadingUse {
        val use = cells.update(time, x, y, value, conditions)
        when (use) {
            ReadingUse.USED -> count(grid.cellAt(x, y))
            ReadingUse.OUTSIDE -> believed.countOutside()
            ReadingUse.NOT_FINITE, ReadingUse.OUT_OF_ORDER -> believed.countRejected()
        }
        return use
    }

    private fun count(cell: Int) {
        isCurrent = false
        fresh++
        lastCell = cell
        if (believed.readings(cell) == 0) {
            if (visitedCount == visited.size) visited = visited.copyOf(minOf(2 * visitedCount, grid.size))
            visited[visitedCount++] = cell
        }
        believed.countReading(cell)
        if (source.visits(cell) > believed.visits(cell)) believed.countVisit(cell)
    }

    private fun refresh() {
        // Asked for, so that it is up to date.
        cells.map
        explain()
        for (k in 0 until visitedCount) {
            val cell = visited[k]
            read(cell)
            while (source.conflicts(cell) > believed.conflicts(cell)) believed.countConflict(cell)
        }
        val most = work * maxOf(1, fresh)
        fresh = 0
        var done = learn(most / 2)
        val reach = 1 + (covariances.length(covariances.kept[0]) / REACH).toInt()
        for (k in 0 until visitedCount) note(visited[k], reach)
        while (done < most) {
            if (prediction.block < 0 && !begin()) break
            if (!prediction.isComplete) done += prediction.go()
            if (prediction.isComplete) install()
        }
        isCurrent = blocks.staleCount == 0 && prediction.block < 0 && fit.isComplete
        for (k in 0 until visitedCount) write(visited[k])
    }

    /** Learns the covariance where it is time, [most] of it. Answers how much. */
    private fun learn(most: Double): Double {
        fit.beginIfDue(visitedCount)
        if (fit.isComplete) return 0.0
        var done = 0.0
        while (!fit.isComplete && done < most) done += fit.go(visited, visitedCount, values, variances)
        if (fit.isComplete) forget()
        return done
    }

    /** Nothing that was predicted holds any longer. */
    private fun forget() {
        blocks.allStale()
        prediction.drop()
    }

    /** Begins the next block that is out of date; answers whether there was one. */
    private fun begin(): Boolean {
        val block = blocks.take(lastCell)
        if (block < 0) return false
        prediction.begin(block, visited, visitedCount, values, variances)
        return true
    }

    private fun explain() {
        var open = 0
        for (k in 0 until visitedCount) if (isOpen(visited[k])) open++
        val isSo = (cells as? SelfCalibratingEstimator)?.isExplained != false && 2 * open <= visitedCount
        if (isSo != isExplained) forget()
        isExplained = isSo
    }

    /** Reads what [cells] says of [cell]. */
    private fun read(cell: Int) {
        val value = (source.value(cell) - middle) / scale
        val deviation = deviation(cell)
        if (!value.isFinite() || !deviation.isFinite()) return
        val scaled = value.coerceIn(-LARGEST, LARGEST)
        val variance = if (!isExplained) 0.0 else minOf(deviation * deviation, LARGEST)
        if (scaled == values[cell] && variance == variances[cell]) return
        values[cell] = scaled
        variances[cell] = variance
        isWritten[cell] = false
    }

    /** What the bounds of [cell] by itself have for standard deviation, scaled. */
    private fun deviation(cell: Int): Double {
        val reach = maxOf(source.upper(cell) - source.value(cell), source.value(cell) - source.lower(cell))
        return reach / scale / TruncatedNormal.NORMAL
    }

    /** Whether the bounds of [cell] by itself are the prior's. */
    private fun isOpen(cell: Int) =
        source.lower(cell) <= source.prior.lower && source.upper(cell) >= source.prior.upper

    /** Lets the blocks around [cell] take note of it, if it changed so much that it matters to them. */
    private fun note(cell: Int, reach: Int) {
        val variance = variances[cell]
        if (variance.isNaN()) return
        val change = values[cell] - noted[cell]
        val before = notedVariances[cell]
        val isKnown = !outerVariances[cell].isNaN()
        val counts = before > COUNTS * outerVariances[cell] && (variance < before / 2 || variance > 2 * before)
        if (isKnown && !counts && change * change <= maxOf(before, COUNTS * COUNTS * outerVariances[cell])) return
        noted[cell] = values[cell]
        notedVariances[cell] = variance
        blocks.stale(cell, reach)
    }

    /** The prediction is complete: what the cells with data near its block say of each of its cells. */
    private fun install() {
        val block = prediction.block
        blocks.forEachCell(block) { cell, place ->
            val mean = prediction.mean(place)
            outer[cell] = mean
            raw[cell] = maxOf(prediction.variance(place, mean), LEAST_VARIANCE) * fit.widening * fit.widening
            judge(cell)
        }
        blocks.forEachCell(block) { cell, _ ->
            outerVariances[cell] = raw[cell] * unevenness(cell)
            isWritten[cell] = false
            if (variances[cell].isNaN()) write(cell, outer[cell], outerVariances[cell])
        }
        prediction.drop()
    }

    /** How far off the others' word on a visited cell was: its square over its variance, and how much that says. */
    private fun judge(cell: Int) {
        val own = variances[cell]
        if (own.isNaN() || !raw[cell].isFinite()) return
        val share = raw[cell] / (raw[cell] + own)
        val gap = outer[cell] - values[cell]
        tellings[cell] = share * share
        surprises[cell] = minOf(gap * gap / (raw[cell] + own), MOST_SURPRISE) * tellings[cell]
    }

    /** By how much the field varies more or less around [cell] than elsewhere, as a factor on variances; eq. (7). */
    private fun unevenness(cell: Int): Double {
        val column = cell % grid.columns
        val row = cell / grid.columns
        var sum = UNSURPRISED
        var count = UNSURPRISED
        for (r in maxOf(0, row - AROUND)..minOf(grid.rows - 1, row + AROUND)) {
            for (c in maxOf(0, column - AROUND)..minOf(grid.columns - 1, column + AROUND)) {
                val other = r * grid.columns + c
                sum += surprises[other]
                count += tellings[other]
            }
        }
        // A cell that nobody looked into may be where the bump is.
        return if (variances[cell].isNaN()) maxOf(1.0, sum / count) else sum / count
    }

    /** Writes what is believed of a visited cell: its own data and what the others say of it, eq. (2). */
    private fun write(cell: Int) {
        val own = variances[cell]
        val other = outerVariances[cell]
        val isPlain = !(abs(values[cell]) < LARGEST) || !(own < LARGEST) || !other.isFinite()
        if (!isExplained || isPlain) {
            isWritten[cell] = false
            believed.setValue(cell, source.value(cell))
            believed.setBounds(cell, source.lower(cell), source.upper(cell))
        } else if (!isWritten[cell]) {
            isWritten[cell] = true
            val mean = (other * values[cell] + own * outer[cell]) / (other + own)
            write(cell, mean, maxOf(other * own / (other + own), LEAST_VARIANCE))
        }
    }

    private fun write(cell: Int, mean: Double, variance: Double) {
        if (!mean.isFinite() || !variance.isFinite()) return
        val prior = believed.prior
        shape(mean, variance, prior)
        val median = cut.median
        // A doubt about all cells near by is none about where between them the value is.
        if (!isExplained) shape(mean, variance + doubt(cell), prior)
        if (!median.isFinite() || !cut.lower.isFinite() || !cut.upper.isFinite()) return
        believed.setValue(cell, median)
        believed.setBounds(cell, minOf(cut.lower, median), maxOf(cut.upper, median))
    }

    /** Of all distributions on [range] with that mean and variance, scaled, the least committed. */
    private fun shape(mean: Double, variance: Double, range: Interval) {
        // It is a cut normal one whose own variance is greater: without end where it is that of the range itself, 1/12,
        // eq. (6).
        val uncut = variance / maxOf(1 - RANGE * variance, LEAST_PRECISION)
        cut.cut(middle + scale * mean, scale * sqrt(uncut), range.lower, range.upper)
    }

    /**
     * What the bounds of visited cells near [cell] have for variance on average, scaled: an error that all of them share
     * is the interpolated value's, too. Without any near by that of the whole range.
     */
    private fun doubt(cell: Int): Double {
        val column = cell % grid.columns
        val row = cell / grid.columns
        var sum = 0.0
        var count = 0
        for (r in maxOf(0, row - AROUND)..minOf(grid.rows - 1, row + AROUND)) {
            for (c in maxOf(0, column - AROUND)..minOf(grid.columns - 1, column + AROUND)) {
                val other = r * grid.columns + c
                if (variances[other].isNaN()) continue
                sum += deviation(other) * deviation(other)
                count++
            }
        }
        return if (count == 0) 1 / RANGE else sum / count
    }

    public companion object {
        /** [work] of a map that is always up to date. */
        public const val AT_ONCE: Double = Double.POSITIVE_INFINITY

        /** [work] of large grids where nobody is waiting: some 30 ms on a desk's core for a move of ten readings. */
        public const val ASHORE: Double = 3e6

        /** [work] of about a millisecond on a desk's core. */
        public const val AFLOAT: Double = 1e6

        private const val FIRST_CELLS = 128

        /** Correlation length, sides of a cell, for which data matter one block farther. */
        private const val REACH = 4.0

        /** A cell's error matters to others where its variance is above this part of what they say of it themselves. */
        private const val COUNTS = 0.01

        /** Scaled numbers that no sensor gives: nothing is computed with them. */
        private const val LARGEST = 1e6
        private const val LEAST_VARIANCE = 1e-16

        /** Cells either way that tell how much the field varies around a cell, and for how many the average counts. */
        private const val AROUND = 2
        private const val UNSURPRISED = 2.0
        private const val MOST_SURPRISE = 1e3

        /** One over the variance of a value that may be anywhere in the prior's range, scaled. */
        private const val RANGE = 12.0

        /** Least precision of what is left, in parts of the variance's own: a width of 10 ranges. */
        private const val LEAST_PRECISION = 1e-3
    }
}
