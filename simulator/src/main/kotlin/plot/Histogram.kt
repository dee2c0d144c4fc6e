package stillwater.plot

import org.jetbrains.letsPlot.geom.geomRect
import org.jetbrains.letsPlot.letsPlot
import org.jetbrains.letsPlot.sampling.samplingNone
import org.jetbrains.letsPlot.scale.scaleXContinuous
import org.jetbrains.letsPlot.scale.scaleYContinuous

/**
 * Counts in bins, as bars that touch.
 *
 * @param edges the bins' limits, in the unit of [valueLabel], length n + 1, ascending. Retained, not modified.
 * @param counts how many in each bin, dimensionless, length n. Retained, not modified.
 */
public class Histogram(
    title: String,
    subtitle: String = "",
    private val edges: DoubleArray,
    private val counts: LongArray,
    private val valueLabel: String,
    private val countLabel: String = "Count",
) : Drawing {
    private val sheet = Sheet(title, subtitle, WIDTH, HEIGHT)

    init {
        require(edges.size == counts.size + 1 || (edges.isEmpty() && counts.isEmpty())) {
            "${counts.size} bins need ${counts.size + 1} edges, got ${edges.size}"
        }
        require(edges.all(Double::isFinite)) { "edges must be finite" }
        require((1 until edges.size).all { edges[it] > edges[it - 1] }) { "edges must ascend" }
        require(counts.all { it >= 0 }) { "counts must not be negative" }
    }

    override fun draw(): Figure {
        if (counts.all { it == 0L }) return sheet.empty("no data")
        val bins = counts.indices
        val top = counts.max() * HEADROOM
        val x = Ticks.linear(edges.first(), edges.last(), ACROSS)
        val y = Ticks.linear(0.0, top, UP.coerceAtMost(maxOf(1, counts.max().coerceAtMost(UP.toLong()).toInt())))
        val plot = letsPlot(
            mapOf(
                "from" to bins.map { edges[it] },
                "to" to bins.map { edges[it + 1] },
                "foot" to bins.map { 0.0 },
                "count" to counts.map { it.toDouble() },
            ),
        ) +
            geomRect(fill = Palette.of(0), color = Palette.PAPER, size = 0.6, alpha = 0.85, sampling = samplingNone) {
                xmin = "from"
                xmax = "to"
                ymin = "foot"
                ymax = "count"
            } +
            scaleXContinuous(valueLabel, x.places, x.labels) +
            scaleYContinuous(countLabel, y.places, y.labels, limits = 0.0 to top, expand = listOf(0.0, 0.0))
        return sheet.figure(plot)
    }

    public companion object {
        private const val WIDTH = 860
        private const val HEIGHT = 420
        private const val ACROSS = 10
        private const val UP = 6
        private const val HEADROOM = 1.05

        /**
         * A histogram of [values], not finite ones left out, in [bins] bins of one width from the least to the
         * greatest value.
         */
        public fun of(
            title: String,
            subtitle: String = "",
            values: DoubleArray,
            bins: Int,
            valueLabel: String,
        ): Histogram {
            require(bins >= 1) { "bins ($bins) must be 1 or more" }
            val finite = values.filter(Double::isFinite)
            if (finite.isEmpty()) {
                return Histogram(title, subtitle, DoubleArray(0), LongArray(0), valueLabel)
            }
            val low = finite.min()
            val high = finite.max()
            val width = (high / bins - low / bins).takeIf { low + it > low && high - it < high }
            if (width == null) {
                val room = maxOf(Math.ulp(low) * ROOM, ROOM_AROUND_CONSTANT * Math.abs(low)).takeIf { it > 0 } ?: 1.0
                return Histogram(
                    title,
                    subtitle,
                    doubleArrayOf(low - room, high + room),
                    longArrayOf(finite.size.toLong()),
                    valueLabel,
                )
            }
            val edges = DoubleArray(bins + 1) { if (it == bins) high else low + it * width }
            val counts = LongArray(bins)
            for (value in finite) counts[((value - low) / width).toInt().coerceIn(0, bins - 1)]++
            return Histogram(title, subtitle, edges, counts, valueLabel)
        }

        private const val ROOM = 8
        private const val ROOM_AROUND_CONSTANT = 0.05
    }
}
