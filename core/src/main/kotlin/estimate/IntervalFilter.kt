package stillwater.estimate

import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.math.abs
import kotlin.math.expm1
import kotlin.math.ulp

/**
 * What an [IntervalFilter] may assume of the sensor.
 *
 * @property longestTimeConstant the slowest response that is possible, s, above 0 and finite.
 * @property readingError ε, the most a reading can differ from the sensor's state: noise, and half a quantum; sensor
 *   units, at least 0 and finite.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class IntervalFilterSettings(val longestTimeConstant: Double, val readingError: Double = 0.0) {
    init {
        require(longestTimeConstant > 0 && longestTimeConstant.isFinite()) {
            "longestTimeConstant ($longestTimeConstant s) must be above 0 and finite"
        }
        require(readingError >= 0 && readingError.isFinite()) {
            "readingError ($readingError sensor units) must be at least 0 and finite"
        }
    }
}

/**
 * Bounds the field in each cell, knowing of the sensor only that it responds no slower than a limit.
 *
 * Model: ṡ = r (ψ − s) with any r(t) ≥ 1/τmax, |z − s| ≤ ε. Two readings z₁, z₂ of one stay, Δ apart, with
 * c = 1 / (exp(Δ/τmax) − 1), give
 *
 * z₂ − ε − c max(0, z₁ − z₂ + 2ε) ≤ ψ ≤ z₂ + ε + c max(0, z₂ − z₁ + 2ε).
 *
 * The first terms are the bounded filter's; the second bound how far a sensor that still moves can have to go, so that
 * one that stands still for long is bounded on both sides. A cell's bounds are the intersection over all its stays; its
 * value is their midpoint.
 *
 * Guaranteed to contain the truth while the model holds, the field is constant within a cell and inside the prior, and
 * every cell passed gave a reading, be it without a value. r may change with time, state and direction: an asymmetric
 * sensor is covered. Dead time, a second-order response, a slew limit or an ε too small are not; what the caller then
 * sees is conflicts: the cell's bounds start again from the newest pair alone.
 *
 * Source: own result, core/docs/IntervalFilter.md. Confined to one thread. O([ANCHORS]), no allocation.
 *
 * @param grid the cells.
 * @param prior bounds of a cell before any evidence, sensor units.
 * @property settings τmax and ε.
 */
public class IntervalFilter(
    grid: Grid,
    prior: Interval,
    public val settings: IntervalFilterSettings,
) : CellEstimator(grid, prior) {
    private val anchorTimes = DoubleArray(ANCHORS)
    private val anchorValues = DoubleArray(ANCHORS)
    private var anchors = 0
    private var spacing = 1L
    private var seen = 0L

    override fun take(cell: Int, entered: Boolean, seconds: Double, value: Double, conditions: Conditions) {
        if (entered) {
            anchors = 0
            spacing = 1
            seen = 0
        }
        // The numbers' own rounding is a reading error too.
        val error = settings.readingError + ROUNDINGS * abs(value).ulp
        var lower = Double.NEGATIVE_INFINITY
        var upper = Double.POSITIVE_INFINITY
        for (i in 0 until anchors) {
            // At least so much time has passed: stamps are rounded. No time between them says nothing.
            val elapsed = seconds - anchorTimes[i] - seconds.ulp
            if (!(elapsed > 0)) continue
            val reach = 1 / expm1(elapsed / settings.longestTimeConstant)
            val rise = value - anchorValues[i]
            upper = minOf(upper, value + error + reach * maxOf(0.0, rise + 2 * error))
            lower = maxOf(lower, value - error - reach * maxOf(0.0, 2 * error - rise))
        }
        remember(seconds, value)
        // What is not a number here came of readings that no water has.
        if (lower.isFinite() && upper.isFinite()) intersect(cell, lower, upper)
    }

    private fun intersect(cell: Int, lower: Double, upper: Double) {
        val newLower = maxOf(lower, map.lower(cell))
        val newUpper = minOf(upper, map.upper(cell))
        if (newLower <= newUpper) {
            believe(cell, newLower, newUpper)
        } else {
            map.countConflict(cell)
            believe(cell, minOf(lower, upper), maxOf(lower, upper))
        }
    }

    private fun believe(cell: Int, lower: Double, upper: Double) {
        map.setBounds(cell, lower, upper)
        map.setValue(cell, lower / 2 + upper / 2)
    }

    /** Keeps every [spacing]th reading of the stay; when there is no more room, every second of those kept. */
    private fun remember(seconds: Double, value: Double) {
        if (seen++ % spacing != 0L) return
        if (anchors == ANCHORS) {
            anchors = ANCHORS / 2
            for (i in 0 until anchors) {
                anchorTimes[i] = anchorTimes[2 * i]
                anchorValues[i] = anchorValues[2 * i]
            }
            spacing *= 2
        }
        anchorTimes[anchors] = seconds
        anchorValues[anchors++] = value
    }

    public companion object {
        /** Earlier readings of a stay that a new one is compared with. */
        public const val ANCHORS: Int = 16

        /** Steps of rounding in the last digit that a reading may be off. */
        private const val ROUNDINGS = 64
    }
}
