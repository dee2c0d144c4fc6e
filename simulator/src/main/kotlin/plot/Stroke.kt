package stillwater.plot

/**
 * One line of a figure as data: points in order, with a band where there is one, and the groups it belongs to.
 *
 * @property x abscissae, length n. @property y ordinates, length n, NaN where there is none.
 * @property lower lower end of the band, length n, NaN without band. @property upper upper end, likewise.
 * @property colour name of the colour group. @property line name of the line type's group.
 */
internal class Stroke(
    val x: DoubleArray,
    val y: DoubleArray,
    val lower: DoubleArray,
    val upper: DoubleArray,
    val colour: String,
    val line: String,
) {
    /** What of this stroke can be drawn on [axes], thinned to what the eye can tell apart. */
    fun on(axes: Axes): Stroke {
        val kept = thinned(axes)
        return Stroke(
            x = DoubleArray(kept.size) { x[kept[it]] },
            y = DoubleArray(kept.size) { k -> y[kept[k]].takeIf(axes::showsY) ?: Double.NaN },
            lower = DoubleArray(kept.size) { k -> axes.clampY(lower[kept[k]]) },
            upper = DoubleArray(kept.size) { k -> axes.clampY(upper[kept[k]]) },
            colour = colour,
            line = line,
        )
    }

    /** Of the points that fall on one half pixel: the first, the lowest, the highest; and the last of all. */
    private fun thinned(axes: Axes): List<Int> {
        val kept = ArrayList<Int>()
        var first = -1
        var lowest = -1
        var highest = -1
        var last = -1
        fun keep() = listOf(first, lowest, highest).filter { it >= 0 }.distinct().sorted().forEach { kept += it }
        for (i in x.indices) {
            if (!axes.showsX(x[i])) continue
            val step = if (first < 0) Double.NaN else axes.placeX(x[i]) - axes.placeX(x[first])
            // A gap of the line or the band is never thinned away: it ends a step and begins one.
            val isAlike = first >= 0 && axes.showsY(y[i]) == axes.showsY(y[first]) &&
                lower[i].isNaN() == lower[first].isNaN()
            if (isAlike && step >= 0 && step < Axes.SMALLEST_STEP) {
                if (foot(i) < foot(lowest)) lowest = i
                if (top(i) > top(highest)) highest = i
            } else {
                keep()
                first = i
                lowest = i
                highest = i
            }
            last = i
        }
        keep()
        if (last >= 0 && kept.last() < last) kept += last
        return kept
    }

    /** What a band without a line reaches down to, and any other its line. */
    private fun foot(i: Int) = if (y[i].isNaN()) lower[i] else y[i]

    private fun top(i: Int) = if (y[i].isNaN()) upper[i] else y[i]

    /** The points of this stroke that can be drawn on [axes], all of them. */
    fun visible(axes: Axes): Stroke {
        val kept = x.indices.filter { axes.showsX(x[it]) && axes.showsY(y[it]) }
        return Stroke(
            x = DoubleArray(kept.size) { x[kept[it]] },
            y = DoubleArray(kept.size) { y[kept[it]] },
            lower = absent(kept.size),
            upper = absent(kept.size),
            colour = colour,
            line = line,
        )
    }

    internal companion object {
        fun of(x: DoubleArray, y: DoubleArray, lower: DoubleArray?, upper: DoubleArray?, colour: String, line: String) =
            Stroke(x, y, lower ?: absent(x.size), upper ?: absent(x.size), colour, line)

        private fun absent(size: Int) = DoubleArray(size) { Double.NaN }
    }
}
