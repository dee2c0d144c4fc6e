package stillwater.io

import kotlin.math.abs

/** Numbers that estimation can take: their squares, and products of some of these, are still numbers. */
internal object SquareReach {
    private const val LARGEST = 1e60

    /**
     * Refuses [log] if one of [columns] holds a larger number; NaN stands for none.
     *
     * @throws LogProblem if so.
     */
    fun require(log: SurveyLog, vararg columns: DoubleArray) {
        val found = columns.firstNotNullOfOrNull { column -> column.firstOrNull { abs(it) > LARGEST } } ?: return
        throw LogProblem(log.file, null, null, "readings within -$LARGEST..$LARGEST", "$found")
    }
}
