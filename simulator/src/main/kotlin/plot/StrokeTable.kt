package stillwater.plot

/**
 * Strokes as the columns that the plot library reads; a gap (NaN) in a stroke starts a new part of it.
 *
 * @param isBand whether the bands are drawn and not the lines: each has gaps of its own.
 */
internal class StrokeTable(strokes: List<Stroke>, isBand: Boolean = false) {
    val columns: Map<String, List<Any?>>

    init {
        val x = ArrayList<Double>()
        val y = ArrayList<Double?>()
        val lower = ArrayList<Double?>()
        val upper = ArrayList<Double?>()
        val colour = ArrayList<String>()
        val line = ArrayList<String>()
        val part = ArrayList<Int>()
        var parts = 0
        for (stroke in strokes) {
            parts++
            for (i in stroke.x.indices) {
                val isGap = if (isBand) stroke.lower[i].isNaN() || stroke.upper[i].isNaN() else stroke.y[i].isNaN()
                if (isGap) {
                    parts++
                    continue
                }
                x += stroke.x[i]
                y += stroke.y[i].takeUnless(Double::isNaN)
                lower += stroke.lower[i].takeUnless(Double::isNaN)
                upper += stroke.upper[i].takeUnless(Double::isNaN)
                colour += stroke.colour
                line += stroke.line
                part += parts
            }
        }
        columns = mapOf(X to x, Y to y, LOWER to lower, UPPER to upper, COLOUR to colour, LINE to line, PART to part)
    }

    internal companion object {
        const val X = "x"
        const val Y = "y"
        const val LOWER = "lower"
        const val UPPER = "upper"
        const val COLOUR = "colour"
        const val LINE = "line"
        const val PART = "part"
    }
}
