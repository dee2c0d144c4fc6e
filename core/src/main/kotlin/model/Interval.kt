package stillwater.model

/**
 * A closed range of values, sensor units unless said otherwise.
 *
 * @property lower lower end, finite.
 * @property upper upper end, finite, not below [lower].
 * @throws IllegalArgumentException if an end is not finite or they are the wrong way round.
 */
public data class Interval(val lower: Double, val upper: Double) {
    init {
        require(lower.isFinite() && upper.isFinite()) { "interval ends ($lower, $upper) must be finite" }
        require(lower <= upper) { "interval's lower end ($lower) must not be above its upper end ($upper)" }
    }

    /** Half way between the ends. */
    public val midpoint: Double get() = lower / 2 + upper / 2

    /** Distance between the ends, never negative; infinite where it exceeds the largest number. */
    public val width: Double get() = upper - lower

    /** Whether [value] lies in the range, ends included. */
    public operator fun contains(value: Double): Boolean = value in lower..upper

    public companion object {
        /** The range [0, 1], in which the report's simulated fields lie. */
        public val UNIT: Interval = Interval(0.0, 1.0)
    }
}
