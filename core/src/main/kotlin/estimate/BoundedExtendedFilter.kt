package stillwater.estimate

import stillwater.field.FieldMap
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.math.abs
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Settings of a [BoundedExtendedFilter].
 *
 * @property medianWindow samples in the median window, odd, at least 1; 3 or more to stand single bad readings.
 * @property slopeWindow medians in the regression window, at least 2.
 * @property learnsResponse whether distances to the truth per slope are learned from cells measured more than once. If
 *   not, bounds come from the direction of the readings alone.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class BoundedExtendedSettings(
    val medianWindow: Int = 3,
    val slopeWindow: Int = 5,
    val learnsResponse: Boolean = true,
) {
    init {
        require(medianWindow >= 1 && medianWindow % 2 == 1) {
            "medianWindow ($medianWindow samples) must be odd and at least 1"
        }
        require(slopeWindow >= 2) { "slopeWindow ($slopeWindow medians) must be at least 2" }
    }
}

/**
 * The bounded filter with what the report leaves to future work: slopes of zero count, a value better than the
 * midpoint, evidence that noise and bad readings cannot turn into wrong bounds. No sensor model and no ε is given to
 * it.
 *
 * Two kinds of evidence, both from slopes over running medians within one stay:
 *
 * - Direction. Readings that clearly rise are below the truth, readings that fall above it, by the noise at the most.
 *   "Clearly" and the noise are learned from the readings, apart for rising and falling.
 * - Distance. The sensor's own ratios k⁺ and k⁻ between its distance to the truth and its slope, and how well they hold,
 *   are learned from cells measured more than once ([BoundedExtendedSettings.learnsResponse]). Then every stay says
 *   ψ = v + k g, give or take a learned width; a slope of zero says ψ = v. This is a learned response rate.
 *
 * A cell's bounds are the intersection of both; its value is the weighted mean of what its stays say of the distance,
 * within the bounds; before the ratios are known it is L + (U − L) g_L / (g_L + g_U), or the one bound that was
 * touched.
 *
 * Direction alone is guaranteed for a sensor that moves towards the truth without passing it and has no noise, whatever
 * one reading in any four in a row says; with Gaussian noise it is credible at 95 %. Distance is credible at 95 % where
 * the end of a stay is proportional to its slope up to the learned spread. The field must be constant within a cell.
 * Dead time or a second-order response that lasts for a good part of a stay makes bounds wrong. Evidence that
 * contradicts a bound drops both and counts as a conflict.
 *
 * Source: own result, core/docs/BoundedExtendedFilter.md, from the report's sections 5 and 8. Windows are emptied on
 * entering a cell. O(windows), no allocation. Confined to one thread.
 *
 * @param grid the cells.
 * @param prior bounds of a cell before any evidence, sensor units.
 * @property settings windows, and whether the response is learned.
 */
public class BoundedExtendedFilter(
    grid: Grid,
    prior: Interval,
    public val settings: BoundedExtendedSettings = BoundedExtendedSettings(),
) : CellEstimator(grid, prior) {
    private val medians = MedianWindow(settings.medianWindow)
    private val slopes = SlopeWindow(settings.slopeWindow)

    /** Slope times √Σ(t − t̄)² of one step of height 1 in the middle of the window, and a margin; √(3 n) / 4. */
    private val flicker = STEP_MARGIN * sqrt(3.0 * settings.slopeWindow) / 4

    /** Slopes of a stay that its evidence is taken over: the last ones, of windows that overlap by half or more. */
    private val pooled = maxOf(1, settings.slopeWindow / 2)
    private val noise = ReadingNoise(ROUNDING * maxOf(abs(prior.lower), abs(prior.upper), prior.width))
    private val ratios = ResponseRatios()

    // Direction: bounds, the slopes at which they were set, and in how many stays such evidence came.
    private val lowers = DoubleArray(grid.size) { prior.lower }
    private val uppers = DoubleArray(grid.size) { prior.upper }
    private val lowerSlopes = DoubleArray(grid.size) { Double.NaN }
    private val upperSlopes = DoubleArray(grid.size) { Double.NaN }
    private val rises = IntArray(grid.size)
    private val falls = IntArray(grid.size)

    // Distance: weighted sums over the stays that ended.
    private val weights = DoubleArray(grid.size)
    private val squaredWeights = DoubleArray(grid.size)
    private val weightedValues = DoubleArray(grid.size)
    private val weightedRises = DoubleArray(grid.size)
    private val weightedFalls = DoubleArray(grid.size)

    private val hasEvidence = BooleanArray(grid.size)

    /** Whether a cell has shown two stays of clearly different slopes. */
    private val compared = BooleanArray(grid.size)

    // The cells that were entered, in that order.
    private val cells = grid.size
    private var visited = IntArray(minOf(cells, FIRST_CELLS))
    private var visitedCount = 0
    private var refreshed = 0

    // The stay so far.
    private var stayCell = Grid.OUTSIDE
    private var evidence = 0
    private var stayValue = 0.0
    private var staySlope = 0.0
    private var timeSpread = 0.0
    private var rising = false
    private var hasRisen = false
    private var hasFallen = false

    /** Whether the boat's cell is to be written as the last reading left it: the next one would do it anew. */
    private var isDue = false

    /** Whether cells follow what is learned of the sensor by themselves; where not, [bring] has them do it. */
    internal var refreshes: Boolean = true

    /** k⁺, the distance to the truth per slope that rising readings were found to have, s; NaN while not known. */
    public val risingRatio: Double get() = if (ratios.known) ratios.rising else Double.NaN

    /** k⁻, the same for falling readings, s; NaN while not known. */
    public val fallingRatio: Double get() = if (ratios.known) ratios.falling else Double.NaN

    override val map: FieldMap get() {
        writeDue()
        return written
    }

    override fun take(cell: Int, entered: Boolean, seconds: Double, value: Double, conditions: Conditions) {
        if (entered) enter(cell)
        refresh()
        noise.add(seconds, value, rising)
        medians.add(seconds, value)
        if (medians.full) slopes.add(medians.time, medians.median)
        if (!slopes.full) {
            // Too few readings for a slope: they are all there is to say of the cell, if nothing was said before.
            if (!hasEvidence[cell]) written.setValue(cell, value.coerceIn(written.lower(cell), written.upper(cell)))
            return
        }
        val slope = slopes.slope()
        rising = slope > 0
        timeSpread = slopes.timeSpread
        if (!slope.isFinite() || !(timeSpread > 0)) return
        direction(cell, medians.median, slope)
        evidence++
        hasEvidence[cell] = true
        val share = 1.0 / minOf(evidence, pooled)
        stayValue += share * (medians.median - stayValue)
        staySlope += share * (slope - staySlope)
        isDue = true
    }

    private fun writeDue() {
        if (!isDue) return
        isDue = false
        write(stayCell)
    }

    /** Brings [cell] up to date with what was learned of the sensor. */
    internal fun bring(cell: Int) {
        if (cell == stayCell) {
            writeDue()
        } else if (follows(cell)) {
            write(cell)
        }
    }

    private fun follows(cell: Int) = settings.learnsResponse && ratios.known && weights[cell] > 0

    /** Brings cells up to date with what was learned of the sensor since they were measured. */
    private fun refresh() {
        if (!refreshes || !settings.learnsResponse || !ratios.known) return
        repeat(REFRESHED) {
            if (++refreshed >= visitedCount) refreshed = 0
            val cell = visited[refreshed]
            if (weights[cell] > 0 && cell != stayCell) write(cell)
        }
    }

    override fun leave() {
        writeDue()
        commit()
        stayCell = Grid.OUTSIDE
    }

    private fun enter(cell: Int) {
        writeDue()
        commit()
        if (written.visits(cell) == 1) {
            if (visitedCount == visited.size) visited = visited.copyOf(minOf(2 * visitedCount, cells))
            visited[visitedCount++] = cell
        }
        stayCell = cell
        evidence = 0
        stayValue = 0.0
        staySlope = 0.0
        hasRisen = false
        hasFallen = false
        medians.clear()
        slopes.clear()
        noise.interrupt()
    }

    /** Evidence of the direction, eqs. (1) and (2). */
    private fun direction(cell: Int, value: Double, slope: Double) {
        val deviation = noise.deviation(slope > 0)
        // A single step of the resolution in the window is no slope, nor is what noise makes.
        val threshold = maxOf(CLEAR * deviation, flicker * noise.resolution) / sqrt(timeSpread)
        if (slope > threshold) {
            if (!hasRisen) rises[cell]++
            hasRisen = true
            raise(cell, value - margin(deviation, rises[cell]), slope)
        } else if (slope < -threshold) {
            if (!hasFallen) falls[cell]++
            hasFallen = true
            lower(cell, value + margin(deviation, falls[cell]), -slope)
        }
    }

    /** What noise may make of the n-th stay's evidence so that all of them together fail one time in forty, eq. (2). */
    private fun margin(deviation: Double, n: Int): Double =
        noise.besidesRounding(deviation) * sqrt(2 * ln(n.toDouble() * n / FIRST_FAILURE)) + noise.resolution / 2

    private fun raise(cell: Int, bound: Double, slope: Double) {
        if (!(bound > lowers[cell]) || !bound.isFinite()) return
        if (bound > uppers[cell]) {
            written.countConflict(cell)
            uppers[cell] = maxOf(written.prior.upper, bound)
            upperSlopes[cell] = Double.NaN
        } else {
            lowers[cell] = bound
            lowerSlopes[cell] = slope
        }
    }

    private fun lower(cell: Int, bound: Double, slope: Double) {
        if (!(bound < uppers[cell]) || !bound.isFinite()) return
        if (bound < lowers[cell]) {
            written.countConflict(cell)
            lowers[cell] = minOf(written.prior.lower, bound)
            lowerSlopes[cell] = Double.NaN
        } else {
            uppers[cell] = bound
            upperSlopes[cell] = slope
        }
    }

    /** Compares the stay that ended with those before it in its cell, and adds it to them. */
    private fun commit() {
        val cell = stayCell
        if (cell == Grid.OUTSIDE || evidence == 0) return
        val up = maxOf(staySlope, 0.0)
        val down = maxOf(-staySlope, 0.0)
        val deviation = noise.deviation(staySlope > 0)
        val sum = weights[cell]
        if (sum > 0 && settings.learnsResponse) {
            // Every further pair of a cell shares what is odd about it: cells count, not pairs.
            val difference = stayValue - weightedValues[cell] / sum
            val stays = 1 + squaredWeights[cell] / (sum * sum)
            compared[cell] = ratios.add(
                difference,
                up = weightedRises[cell] / sum - up,
                down = down - weightedFalls[cell] / sum,
                stays,
                noise = maxOf(deviation * deviation, TINY),
                slopeNoise = deviation * deviation / timeSpread,
                firstOfCell = !compared[cell],
            ) || compared[cell]
        }
        val weight = weight(deviation)
        if (!(weight * weight).isFinite() || !(weight * stayValue).isFinite()) return
        weights[cell] += weight
        squaredWeights[cell] += weight * weight
        weightedValues[cell] += weight * stayValue
        weightedRises[cell] += weight * up
        weightedFalls[cell] += weight * down
        evidence = 0
    }

    /** How much the stay counts: one over the variance of what it says, as far as that is known, eq. (7). */
    private fun weight(deviation: Double): Double {
        val flat = abs(staySlope) * sqrt(timeSpread) <= CLEAR * deviation
        if (ratios.known && !ratios.proportional && !flat) return 0.0
        val perSlope = if (ratios.known) ratios.perSlope else timeSpread
        val base = if (ratios.known) maxOf(ratios.base, deviation * deviation) else deviation * deviation
        return 1 / maxOf(base + perSlope * staySlope * staySlope, TINY)
    }

    private fun write(cell: Int) {
        val lower = lowers[cell]
        val upper = uppers[cell]
        if (settings.learnsResponse && ratios.known && writeDistance(cell, lower, upper)) return
        written.setBounds(cell, lower, upper)
        val hasLower = !lowerSlopes[cell].isNaN()
        val hasUpper = !upperSlopes[cell].isNaN()
        val value = when {
            hasLower && hasUpper ->
                lower +
                    (upper - lower) * (lowerSlopes[cell] / (lowerSlopes[cell] + upperSlopes[cell]))
            hasLower -> lower
            hasUpper -> upper
            cell == stayCell -> stayValue.coerceIn(lower, upper)
            // Nothing new: it keeps what its own stay left.
            else -> return
        }
        if (value.isFinite()) written.setValue(cell, value)
    }

    /** Value and bounds from slopes and learned ratios, eqs. (7) and (8); false where they are no numbers. */
    private fun writeDistance(cell: Int, lower: Double, upper: Double): Boolean {
        val weight = if (cell == stayCell && evidence > 0) weight(noise.deviation(staySlope > 0)) else 0.0
        val sum = weights[cell] + weight
        if (!(sum > 0)) return false
        val up = (weightedRises[cell] + weight * maxOf(staySlope, 0.0)) / sum
        val down = (weightedFalls[cell] + weight * maxOf(-staySlope, 0.0)) / sum
        val mean = (weightedValues[cell] + weight * stayValue) / sum
        val value = mean + ratios.rising * up - ratios.falling * down
        val deviation = minOf(noise.deviation(true), noise.deviation(false))
        val base = maxOf(ratios.base, deviation * deviation) * (squaredWeights[cell] + weight * weight) / (sum * sum)
        val bySlope = ratios.variance(up, down)
        if (!ratios.proportional && (up + down) * sqrt(timeSpread) > CLEAR * deviation) return false
        val reach = ratios.quantile * sqrt(base + bySlope)
        if (!value.isFinite() || !reach.isFinite()) return false
        written.setValue(cell, value.coerceIn(lower, upper))
        if (value + reach < lower || value - reach > upper) {
            written.setBounds(cell, lower, upper)
        } else {
            written.setBounds(cell, maxOf(lower, value - reach), minOf(upper, value + reach))
        }
        return true
    }

    public companion object {
        /** Cells that are brought up to date with each reading, besides the boat's. */
        public const val REFRESHED: Int = 4

        private const val FIRST_CELLS = 128

        /** Steps of this share of the prior are rounding of numbers. */
        private const val ROUNDING = 1e-9
        private const val CLEAR = 3.0
        private const val STEP_MARGIN = 1.05
        private const val FIRST_FAILURE = 0.015
        private const val TINY = 1e-300
    }
}
