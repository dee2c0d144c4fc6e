package stillwater.diagnosis

import stillwater.diagnose.ConditionGaps
import stillwater.io.LogProblem
import stillwater.io.SurveyLog
import stillwater.model.Conditions
import stillwater.report.SignificantDigits
import stillwater.report.counted

/**
 * The conditions that were asked for of [log], and what is said where their numbers are missing in rows at [times], s.
 *
 * @param conditions column of each, by its name.
 * @param numbers the numbers of a condition, NaN where missing, each as many as [times].
 * @throws LogProblem if less than half of the rows have a number of one.
 */
internal class ConditionColumns(
    private val log: SurveyLog,
    private val conditions: Map<String, String>,
    private val times: DoubleArray,
    numbers: (String) -> DoubleArray,
) {
    private val gaps = conditions.keys.associateWith { name ->
        val gaps = ConditionGaps(times, numbers(name), isCircular = name == Conditions.HEADING)
        if (!gaps.isMostlyKnown) throw tooFew(name, gaps)
        gaps
    }

    /** Rows in which one of the conditions is not known, and no number near enough in time to say what it was. */
    val unknown: BooleanArray = BooleanArray(times.size) { i -> gaps.values.any { it.isFar[i] } }

    /**
     * What was done where numbers are missing, one sentence for each condition with such rows, without a full stop.
     *
     * @param unknown what was done with rows of which a condition is [unknown], a participle.
     */
    fun bridged(unknown: String): List<String> = gaps.filterValues { it.missing > 0 }.map { (name, gaps) ->
        val far = gaps.isFar.count { it }
        val near = gaps.missing - far
        val where = if (far > 0) "in $near of them $name was taken" else "$name was taken there"
        val parts = listOf(
            near to "$where from the numbers before and after, in proportion to time",
            far to "${counted(far, "row")} $unknown: more than ${seconds(gaps.reach)} from a number",
        )
        "the column ${conditions[name]} has no number in ${gaps.missing} of ${times.size} rows: " +
            parts.filter { (rows, _) -> rows > 0 }.joinToString("; ") { it.second }
    }

    private fun tooFew(name: String, gaps: ConditionGaps): LogProblem {
        val known = times.size - gaps.missing
        val expected = "a number for $name in at least half of the rows"
        return LogProblem(log.file, null, conditions[name], expected, "numbers in $known of ${times.size} rows")
    }

    private fun seconds(duration: Double) = "${SignificantDigits(3).format(duration)} s"
}
