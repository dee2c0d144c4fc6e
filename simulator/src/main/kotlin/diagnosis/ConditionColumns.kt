package stillwater.diagnosis

import stillwater.diagnose.ConditionGaps
import stillwater.io.LogProblem
import stillwater.io.SurveyLog
import stillwater.model.Conditions
import stillwater.report.SignificantDigits

/**
 * The conditions that were asked for of [log], and what is said where their numbers are missing.
 *
 * @param conditions column of each, by its name.
 */
internal class ConditionColumns(private val log: SurveyLog, private val conditions: Map<String, String>) {
    /**
     * What was done where numbers are missing in rows at [times], s, one sentence for each condition with such rows,
     * without a full stop.
     *
     * @param numbers the numbers of a condition, NaN where missing, each as many as [times].
     * @throws LogProblem if a condition has too few numbers for its gaps to be bridged.
     */
    fun bridged(times: DoubleArray, numbers: (String) -> DoubleArray): List<String> =
        conditions.mapNotNull { (name, column) ->
            val gaps = ConditionGaps(times, numbers(name), isCircular = name == Conditions.HEADING)
            if (!gaps.isBridged) throw tooFew(name, column, gaps, times.size)
            if (gaps.missing == 0) {
                null
            } else {
                "the column $column has no number in ${gaps.missing} of ${times.size} rows: $name was taken there " +
                    "from the numbers before and after, in proportion to time"
            }
        }

    private fun tooFew(name: String, column: String, gaps: ConditionGaps, rows: Int): LogProblem {
        val expected = "a number for $name in at least half of the rows, and none of the others more than " +
            "${seconds(gaps.reach)} from one"
        val far = if (gaps.farthest.isFinite()) ", the farthest row ${seconds(gaps.farthest)} from one" else ""
        return LogProblem(log.file, null, column, expected, "numbers in ${rows - gaps.missing} of $rows rows$far")
    }

    private fun seconds(duration: Double) = "${SignificantDigits(3).format(duration)} s"
}
