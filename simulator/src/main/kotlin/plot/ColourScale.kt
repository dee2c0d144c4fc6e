package stillwater.plot

import org.jetbrains.letsPlot.intern.Feature
import org.jetbrains.letsPlot.scale.guideColorbar
import org.jetbrains.letsPlot.scale.scaleColorGradient2
import org.jetbrains.letsPlot.scale.scaleColorViridis
import org.jetbrains.letsPlot.scale.scaleFillGradient2
import org.jetbrains.letsPlot.scale.scaleFillViridis
import kotlin.math.abs

/**
 * A continuous, perceptually even colour scale from [from] to [to], in the figure's unit: viridis, or for differences
 * blue below zero, white at it and red above.
 *
 * @param isDifference whether the sign is what matters; the ends are then equally far from zero.
 * @param limits what the plot library is told, not within [from] to [to].
 */
internal class ColourScale private constructor(
    private val from: Double,
    private val to: Double,
    private val isDifference: Boolean = false,
    private val limits: Pair<Double, Double> = from to to,
) {
    /** [value] on the scale: moved to the nearer end if beyond, null (drawn grey) if there is none. */
    fun place(value: Double): Double? = if (value.isNaN()) null else value.coerceIn(from, to)

    /** A sentence on how many of the [things] with [values] lie beyond the ends; empty without any. */
    fun note(values: List<Double>, things: String): String {
        val beyond = values.count { it < from || it > to }
        return if (beyond == 0) "" else "$beyond of ${values.size} $things lie beyond the colours' ends"
    }

    /** The scale for areas; its bar lies flat if the legend stands below the figure. */
    fun fill(unit: String, flat: Boolean): Feature {
        val ticks = ticks()
        if (isDifference) {
            return scaleFillGradient2(
                low = Palette.BELOW,
                mid = Palette.LEVEL,
                high = Palette.ABOVE,
                name = unit,
                limits = limits,
                breaks = ticks.places,
                labels = ticks.labels,
                naValue = Palette.ABSENT,
                guide = bar(flat),
            )
        }
        return scaleFillViridis(
            name = unit,
            limits = limits,
            breaks = ticks.places,
            labels = ticks.labels,
            naValue = Palette.ABSENT,
            guide = bar(flat),
        )
    }

    /** The scale for lines and points; without a bar of its own if [flat] is null. */
    fun colour(unit: String, flat: Boolean?): Feature {
        val ticks = ticks()
        if (isDifference) {
            return scaleColorGradient2(
                low = Palette.BELOW,
                mid = Palette.LEVEL,
                high = Palette.ABOVE,
                name = unit,
                limits = limits,
                breaks = ticks.places,
                labels = ticks.labels,
                naValue = Palette.ABSENT,
                guide = flat?.let(::bar) ?: "none",
            )
        }
        return scaleColorViridis(
            name = unit,
            limits = limits,
            breaks = ticks.places,
            labels = ticks.labels,
            naValue = Palette.ABSENT,
            guide = flat?.let(::bar) ?: "none",
        )
    }

    private fun ticks() = Ticks.linear(limits.first, limits.second, TICKS)

    private fun bar(flat: Boolean) = guideColorbar(
        barWidth = if (flat) BAR_LENGTH else BAR_BREADTH,
        barHeight = if (flat) BAR_BREADTH else BAR_LENGTH,
        nbin = SHADES,
    )

    internal companion object {
        private const val BAR_BREADTH = 20
        private const val BAR_LENGTH = 220
        private const val SHADES = 64
        private const val TICKS = 6
        private const val LARGEST = 1e300
        private const val SMALLEST_SHARE = 1e-9
        private const val CONSTANT_MARGIN = 0.501

        /** The scale for [values], with ends [wanted] if given. A constant stands in the middle of the scale. */
        fun of(values: List<Double>, wanted: ClosedFloatingPointRange<Double>?): ColourScale {
            val finite = values.filter { abs(it) <= LARGEST }
            if (wanted != null) {
                require(wanted.start < wanted.endInclusive && (wanted.endInclusive - wanted.start).isFinite()) {
                    "colours ($wanted) must go from a lower to a higher finite value"
                }
                return ColourScale(wanted.start, wanted.endInclusive).aroundConstant(finite)
            }
            if (finite.isEmpty()) return ColourScale(0.0, 1.0)
            val low = finite.min()
            val high = finite.max()
            val size = maxOf(abs(low), abs(high))
            return when {
                high - low > size * SMALLEST_SHARE -> ColourScale(low, high)
                size > 0 -> ColourScale(low - size / 2, high + size / 2).aroundConstant(finite)
                else -> ColourScale(-1.0, 1.0)
            }
        }

        /** The scale for [values] that are differences, to the largest of them either way. */
        fun ofDifferences(values: List<Double>): ColourScale {
            val finite = values.filter { abs(it) <= LARGEST }
            val largest = finite.maxOfOrNull { abs(it) } ?: 0.0
            // The plot library's constants: see aroundConstant.
            val isConstant = finite.isEmpty() || finite.max() - finite.min() <= largest * SMALLEST_SHARE
            val end = if (isConstant) largest + CONSTANT_MARGIN else largest
            return ColourScale(-end, end, isDifference = true)
        }

        /**
         * This scale, wide enough for the plot library: it takes a constant c for the range c - 0.5 to c + 0.5, and
         * fails where a scale does not hold all of that.
         */
        private fun ColourScale.aroundConstant(values: List<Double>): ColourScale {
            val shown = values.map { it.coerceIn(from, to) }
            val low = shown.minOrNull() ?: return this
            val high = shown.max()
            if (high - low > abs(high) * SMALLEST_SHARE) return this
            // Values stay where they are: moved to the wider ends they would be another constant.
            val wider = minOf(from, low - CONSTANT_MARGIN) to maxOf(to, high + CONSTANT_MARGIN)
            return ColourScale(from, to, limits = wider)
        }
    }
}
