package stillwater.diagnosis

import stillwater.diagnose.ChannelLags
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.MeasuredSeries
import stillwater.io.LogPass
import stillwater.io.LogProblem
import stillwater.io.SquareReach
import stillwater.io.SurveyLog
import stillwater.model.Conditions
import stillwater.model.LocalFrame
import stillwater.report.counted
import java.nio.file.Path

/**
 * A log as the diagnosis takes it.
 *
 * @property file the log. @property quantity the column that is diagnosed. @property reference the column with the
 * truth, or null. @property series its columns. @property columns the rows that were used. @property pass what was read.
 * @property steps rows with a reference among all. @property bridged what was done where numbers are missing or stand
 * for none, one sentence each.
 * @property cut rows at the end that were not looked at. @property frame frame of its places, or null
 * where the log has metres. @property heading what its headings are in, or null where none were given.
 */
class DiagnosisLog private constructor(
    val file: Path,
    val format: String,
    val quantity: String,
    val reference: String?,
    val series: MeasuredSeries,
    val columns: LogColumns,
    val pass: LogPass,
    internal val steps: ReferenceSteps,
    val cut: Long,
    val frame: LocalFrame?,
    internal val heading: HeadingUnit?,
    internal val bridged: List<String>,
    private val compare: List<String> = emptyList(),
) {
    /** Whether there are columns to compare. */
    val isCompared: Boolean get() = compare.isNotEmpty()

    /**
     * The lags of the readings, which [result] has found already where it has no reference, and of the columns to
     * compare; null where there are none. [progress] is told how much is done, a share within 0..1.
     */
    fun channels(result: DiagnosisResult, progress: (Double) -> Unit = {}): ChannelLags? = if (compare.isEmpty()) {
        null
    } else {
        val others = compare.associateWith { checkNotNull(columns.condition(compared(it))) }
        ChannelLags.of(series, quantity, others, result, AT_ONCE, progress)
    }

    companion object {
        /** Key under which the reader keeps the reference: no name of a condition. */
        const val REFERENCE = "(reference)"

        /** Key under which the reader keeps a [column] that is compared: no name of a condition. */
        fun compared(column: String) = "(compared) $column"

        /** More rows than this are not looked at. */
        const val MOST_ROWS = 20_000

        /** Fewer rows are no log. */
        private const val FEWEST_ROWS = 5

        private fun tooFew(log: SurveyLog, rows: Int, reference: String?, left: Map<String, Long>): LogProblem {
            val columns = listOfNotNull(log.quantity, reference).joinToString(" and ")
            val why = left.map { (reason, count) -> "${counted(count, "row")} left out: $reason" }
            val found = (listOf("$rows") + why).joinToString("; ")
            return LogProblem(log.file, null, null, "at least $FEWEST_ROWS usable rows, with $columns", found)
        }

        /**
         * Reads [log], whose conditions hold the [reference] under [REFERENCE] where there is one.
         *
         * @param conditions column of each further quantity, by its name.
         * @throws LogProblem if the log cannot be used, or a condition has too few numbers.
         */
        fun of(
            log: SurveyLog,
            conditions: Map<String, String>,
            reference: String?,
            compare: List<String> = emptyList(),
        ): DiagnosisLog {
            val names = conditions.keys + compare.map { compared(it) }
            val read = LogColumns(names)
            // With the rows whose readings or references are missing: what the sensor has seen there shows later.
            val all = LogColumns(names)
            val steps = ReferenceSteps()
            var cut = 0L
            val pass = log.read { time, x, y, value, others ->
                if (read.size < MOST_ROWS) all.add(time.seconds, x, y, value, others)
                when {
                    value.isNaN() -> Unit
                    read.size >= MOST_ROWS -> cut++
                    reference != null && others[REFERENCE].isNaN() -> steps.add(time.seconds, isKnown = false)
                    else -> {
                        if (reference != null) steps.add(time.seconds, isKnown = true)
                        read.add(time.seconds, x, y, value, others)
                    }
                }
            }
            val heading = conditions[Conditions.HEADING]?.let { column ->
                HeadingUnit(column, checkNotNull(read.condition(Conditions.HEADING)))
            }
            if (heading?.inDegrees == true) listOf(read, all).forEach { it.toRadians(Conditions.HEADING) }
            val asked = ConditionColumns(log, conditions, read.times) { checkNotNull(read.condition(it)) }
            val codes = CodedRows(read, log.quantity, reference)
            val columns = read.without(BooleanArray(read.size) { asked.unknown[it] || codes.isIn(it) })
            if (columns.size < FEWEST_ROWS) {
                val unknown = mapOf(
                    "no number in the column $reference" to steps.missing.toLong(),
                    "a number that stands for none" to codes.rows.toLong(),
                    "a condition that is not known" to (read.size - columns.size - codes.rows).toLong(),
                )
                throw tooFew(log, columns.size, reference, pass.skipped + unknown.filterValues { it > 0 })
            }
            all.unread(read.times.filterIndexed { i, _ -> asked.unknown[i] || codes.isRead[i] }.toSet())
            all.untold(read.times.filterIndexed { i, _ -> codes.isTold[i] }.toSet())
            val others = names.mapNotNull { columns.condition(it) }.toTypedArray()
            SquareReach.require(log, columns.values, columns.reference, *others)
            return DiagnosisLog(
                log.file,
                log.format,
                log.quantity,
                reference,
                // Where most references are missing how the truth went is not to be guessed.
                if (all.size == columns.size || reference == null || steps.isSparse || compare.isNotEmpty()) {
                    columns.series(reference != null, steps.isSparse, conditions.keys)
                } else {
                    all.missing(conditions.keys)
                },
                columns,
                pass,
                steps,
                cut,
                log.frame,
                heading,
                asked.bridged("left out") + codes.notes,
                compare,
            )
        }
    }
}
