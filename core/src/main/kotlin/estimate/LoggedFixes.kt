package stillwater.estimate

/**
 * Fixes of a log, with the headings that the boat had.
 *
 * @property times of the fixes, s, strictly growing, length n, at least 1. @property x metres east, length n.
 * @property y metres north, length n.
 * @property headingTimes of the headings, s, strictly growing, length m; empty where there are none.
 * @property headings rad, counter-clockwise from east, length m.
 * @throws IllegalArgumentException if lengths differ, a number is not finite or times do not grow.
 */
public class LoggedFixes(
    public val times: DoubleArray,
    public val x: DoubleArray,
    public val y: DoubleArray,
    public val headingTimes: DoubleArray = DoubleArray(0),
    public val headings: DoubleArray = DoubleArray(0),
) {
    init {
        require(times.isNotEmpty()) { "there must be at least 1 fix" }
        require(x.size == times.size && y.size == times.size) {
            "x (${x.size}) and y (${y.size}) must be as many as times (${times.size})"
        }
        require(headings.size == headingTimes.size) {
            "headings (${headings.size}) must be as many as headingTimes (${headingTimes.size})"
        }
        for ((name, column) in listOf("x" to x, "y" to y, "headings" to headings)) {
            require(column.all { it.isFinite() }) { "$name must be finite" }
        }
        for ((name, column) in listOf("times" to times, "headingTimes" to headingTimes)) {
            val isGrowing = (1 until column.size).all { column[it] > column[it - 1] }
            require(column.all { it.isFinite() } && isGrowing) { "$name must be finite and strictly growing" }
        }
    }
}
