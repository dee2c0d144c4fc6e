package stillwater.diagnosis

import stillwater.diagnose.ConditionGaps
import stillwater.io.LogChoice
import stillwater.io.LogPass
import stillwater.io.ReadingSink
import stillwater.io.SurveyLog
import stillwater.io.completedBy
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.report.counted

/**
 * A log whose logger gives each sensor a row of its own, so that what belongs together hardly ever stands in one: at the
 * time of a reading the other columns are what lies straight between their numbers before and after ([ConditionGaps]).
 *
 * A row farther from the nearest number than [ConditionGaps.reach] has none.
 *
 * @param log the log, which hands on rows without a reading. @param choice what was taken from it.
 * @param apart names of the conditions that stand in rows of their own. @param reference name of that which is the truth.
 */
internal class RowsOfTheirOwn private constructor(
    private val log: SurveyLog,
    choice: LogChoice,
    private val apart: Set<String>,
    reference: String,
) : SurveyLog by log {
    private val columns = choice.conditions

    /** Rows without a reading say what the truth was; where it stands in such rows alone the readings have it already. */
    private val keepsUnread = choice.keepsUnread && reference !in apart

    private class Row(val time: BoatTime, val x: Double, val y: Double, val value: Double, val conditions: Conditions)

    override fun read(progress: (Long) -> Unit, sink: ReadingSink): LogPass {
        val rows = ArrayList<Row>()
        val pass = log.read(progress) { time, x, y, value, conditions -> rows += Row(time, x, y, value, conditions) }
        val times = DoubleArray(rows.size) { rows[it].time.seconds }
        val bridged = apart.associateWith { name ->
            bridged(name, times, DoubleArray(rows.size) { rows[it].conditions[name] })
        }
        rows.forEachIndexed { i, row ->
            if (row.value.isNaN() && !keepsUnread) return@forEachIndexed
            val others = if (row.value.isNaN()) emptyMap() else bridged.mapValues { (_, numbers) -> numbers[i] }
            val conditions = row.conditions.completedBy(Conditions(others.filterValues { it.isFinite() }))
            sink.take(row.time, row.x, row.y, row.value, conditions)
        }
        return pass.copy(warnings = pass.warnings + apart.map { note(it, rows) }.distinct())
    }

    /** [numbers] of [name] at [times], s, with those that are missing but near enough to others. */
    private fun bridged(name: String, times: DoubleArray, numbers: DoubleArray): DoubleArray {
        val isDegrees = name == Conditions.HEADING && HeadingUnit(columns.getValue(name), numbers).inDegrees
        val own = if (isDegrees) DoubleArray(numbers.size) { Math.toRadians(numbers[it]) } else numbers
        val gaps = ConditionGaps(times, own, isCircular = name == Conditions.HEADING)
        val bridged = gaps.bridged
        return DoubleArray(times.size) { i ->
            val number = if (isDegrees) Math.toDegrees(bridged[i]) else bridged[i]
            if (gaps.isFar[i]) Double.NaN else number
        }
    }

    private fun note(name: String, rows: List<Row>): String {
        val own = rows.count { it.value.isNaN() && it.conditions[name].isFinite() }.toLong()
        return "the column ${columns.getValue(name)} stands in rows of its own (${counted(own, "row")}): at the " +
            "readings' times it was taken from the numbers before and after, in proportion to time"
    }

    /** How the rows with a number of one column and those with a reading meet. */
    private class Meeting {
        private var together = 0
        private val times = ArrayList<Double>()

        fun take(time: Double, isRead: Boolean) {
            if (isRead) together++
            times += time
        }

        /** Whether they hardly ever meet the [readings], at times in s, and a reference is about as frequent as these. */
        fun isApart(readings: List<Double>, isReference: Boolean): Boolean {
            val isSparse = ReferenceSteps.isSparse(ReferenceSteps.usual(times), ReferenceSteps.usual(readings))
            if (times.size < 2 || (isReference && isSparse)) return false
            return together < SELDOM * minOf(readings.size, times.size - together)
        }
    }

    companion object {
        /** Share of the rows in which a column that stands in rows of its own may stand beside a reading. */
        private const val SELDOM = 0.1

        /**
         * [log], or the same read as one with such rows where it has some.
         *
         * @param choice what was taken from it, with the column of each condition. @param reference name of that which is
         *   the truth: where it is rarer than the readings it is not known between its rows.
         */
        fun of(log: SurveyLog, choice: LogChoice, reference: String): SurveyLog {
            val columns = choice.conditions
            if (columns.isEmpty()) return log
            val whole = if (choice.keepsUnread) log else SurveyLog.open(log.file, choice.copy(keepsUnread = true))
            val meetings = columns.keys.associateWith { Meeting() }
            val times = ArrayList<Double>()
            whole.read { time, _, _, value, conditions ->
                if (!value.isNaN()) times += time.seconds
                for ((name, meeting) in meetings) {
                    if (conditions[name].isFinite()) meeting.take(time.seconds, isRead = !value.isNaN())
                }
            }
            val apart = meetings.filter { (name, meeting) -> meeting.isApart(times, name == reference) }.keys
            return if (apart.isEmpty()) log else RowsOfTheirOwn(whole, choice, apart, reference)
        }
    }
}
