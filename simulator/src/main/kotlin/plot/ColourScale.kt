package stillwater.plot

import org.jetbrains.letsPlot.intern.Feature
import org.jetbrains.letsPlot.scale.guideColorbar
import org.jetbrains.letsPlot.scale.scaleColorViridis
import org.jetbrains.letsPlot.scale.scaleFillViridis
import kotlin.math.abs

/** A continuous, perceptually even colour scale (viridis) from [from] to [to], in the figure's unit. */
internal class ColourScale private constructor(private val from: Double, private val to: Double) {
    /** [value] on the scale: moved to the nearer end if beyond, null (drawn grey) if there is none. */
    fun place(value: Double): Double? = if (value.isNaN()) null else value.coerceIn(from, to)

    fun fill(unit: String): Feature =
        scaleFillViridis(name = unit, limits = from to to, naValue = Palette.ABSENT, format = format(), guide = bar())

    fun colour(unit: String, shown: Boolean): Feature = scaleColorViridis(
        name = unit,
        limits = from to to,
        naValue = Palette.ABSENT,
        format = format(),
        guide = if (shown) bar() else "none",
    )

    private fun bar() = guideColorbar(barWidth = BAR_WIDTH, barHeight = BAR_HEIGHT)

    private fun format() = Ticks.format(from, to)

    internal companion object {
        private const val BAR_WIDTH = 22
        private const val BAR_HEIGHT = 220
        private const val LARGEST = 1e300
        private const val SMALLEST_SHARE = 1e-9

        /** The scale for [values], with ends [wanted] if given. A constant stands in the middle of the scale. */
        fun of(values: List<Double>, wanted: ClosedFloatingPointRange<Double>?): ColourScale {
            if (wanted != null) {
                require(wanted.start < wanted.endInclusive && (wanted.endInclusive - wanted.start).isFinite()) {
                    "colours ($wanted) must go from a lower to a higher finite value"
                }
                return ColourScale(wanted.start, wanted.endInclusive)
            }
            val finite = values.filter { abs(it) <= LARGEST }
            if (finite.isEmpty()) return ColourScale(0.0, 1.0)
            val low = finite.min()
            val high = finite.max()
            val size = maxOf(abs(low), abs(high))
            return when {
                high - low > size * SMALLEST_SHARE -> ColourScale(low, high)
                size > 0 -> ColourScale(low - size / 2, high + size / 2)
                else -> ColourScale(-1.0, 1.0)
            }
        }
    }
}
