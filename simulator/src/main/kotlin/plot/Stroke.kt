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
        val kept = ArrayList<Int>()
        var last = Double.NaN
        for (i in x.indices) {
            if (!axes.showsX(x[i])) continue
            val place = axes.placeX(x[i])
            val needed = last.isNaN() || place - last >= Axes.SMALLEST_STEP || place < last
            if (needed || i == x.lastIndex) {
                kept += i
                last = place
            }
        }
        return Stroke(
            x = DoubleArray(kept.size) { x[kept[it]] },
            y = DoubleArray(kept.size) { k -> y[kept[k]].takeIf(axes::showsY) ?: Double.NaN },
            lower = DoubleArray(kept.size) { k -> axes.clampY(lower[kept[k]]) },
            upper = DoubleArray(kept.size) { k -> axes.clampY(upper[kept[k]]) },
            colour = colour,
            line = line,
        )
    }

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
