package stillwater.io

import kotlin.math.abs

/**
 * Numbers that estimation can take: their squares, and products of some of these, are still numbers, neither too large
 * nor, where a column holds nothing larger, so small that they vanish, or that no axis can be drawn of them.
 */
internal object SquareReach {
    /** The largest number that any log may hold. */
    const val LARGEST = 1e60
    private const val SMALLEST = 1e-30

    /** What a range from [low] to [high] should be, and is not; null where it can be estimated in and drawn. */
    fun rangeProblem(low: Double, high: Double): String? {
        val largest = maxOf(abs(low), abs(high))
        return when {
            largest > LARGEST -> "numbers within -$LARGEST..$LARGEST"
            largest < SMALLEST -> "a range with an end beyond ±$SMALLEST"
            else -> null
        }
    }

    /**
     * Refuses [log] if one of [columns] holds a larger number, or none but smaller ones beside 0; NaN stands for none.
     *
     * @throws LogProblem if so.
     */
    fun require(log: SurveyLog, vararg columns: DoubleArray) {
        val large = columns.firstNotNullOfOrNull { column -> column.firstOrNull { abs(it) > LARGEST } }
        if (large != null) throw LogProblem(log.file, null, null, "readings within -$LARGEST..$LARGEST", "$large")
        val small = columns.firstNotNullOfOrNull { column ->
            column.filter { it.isFinite() }.maxOfOrNull { abs(it) }?.takeIf { it > 0 && it < SMALLEST }
        } ?: return
        throw LogProblem(log.file, null, null, "readings of which some are beyond ±$SMALLEST", "none beyond $small")
    }
}
