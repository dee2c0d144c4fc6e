package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.response.RangeEnd
import stillwater.diagnose.response.ResponseModel

/**
 * The row whose water each row of a log shows: an earlier one while a dead band holds the reading or a rate limit leads it,
 * none at an end of the range. So the water that is passed meanwhile is not taken to be known.
 *
 * @param rows that row, by row; [NONE] for none.
 */
internal class ShownRows(private val rows: IntArray) {
    /** Makes [column], what would be seen of a water in each row, what is seen of it. */
    fun showIn(column: DoubleArray) {
        // From the end on: none shows a later row, so that what is seen of an earlier one is still there.
        for (i in rows.lastIndex downTo 0) column[i] = if (rows[i] == NONE) 0.0 else column[rows[i]]
    }

    /** Whether [other] is the same. */
    fun isSame(other: ShownRows?): Boolean = other != null && rows.contentEquals(other.rows)

    companion object {
        /** For a row that shows no water. */
        const val NONE = -1

        /** Those of [model] at [numbers]; null where each row shows its own water. */
        fun of(model: ResponseModel, numbers: DoubleArray): ShownRows? {
            val causes = model.terms.map { it.cause }
            val beyond = RangeEnd.beyond(model, numbers)
            if (beyond == null && Cause.SLEW_LIMIT !in causes && Cause.HYSTERESIS !in causes) return null
            val rows = IntArray(model.series.size) { it }
            if (Cause.SLEW_LIMIT in causes) {
                val free = shown(model, numbers, LAGS)
                val limited = shown(model, numbers, LAGS + Cause.SLEW_LIMIT)
                for (i in 1 until rows.size) if (limited[i] != free[i]) rows[i] = rows[i - 1]
            }
            if (Cause.HYSTERESIS in causes) {
                val held = shown(model, numbers, LAGS + Cause.SLEW_LIMIT + Cause.HYSTERESIS)
                for (i in 1 until rows.size) if (held[i] == held[i - 1]) rows[i] = rows[i - 1]
            }
            if (beyond != null) for (i in rows.indices) if (beyond[i]) rows[i] = NONE
            return ShownRows(rows)
        }

        /** What [model] shows at [numbers] with those of its terms alone that are among [causes], sensor units, length n. */
        private fun shown(model: ResponseModel, numbers: DoubleArray, causes: Set<Cause>): DoubleArray {
            val terms = model.terms.filter { it.cause in causes }
            val part = ResponseModel(model.series, terms, model.steps, model.scales, model.behind)
            return DoubleArray(model.series.size).also { part.predict(part.carried(model, numbers), it) }
        }

        /** Causes of how the sensor follows the water, before a rate limit and a dead band. */
        private val LAGS = BlindSearch.LINEAR + Cause.ASYMMETRIC_RESPONSE
    }
}
