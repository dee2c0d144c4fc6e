package stillwater.benchmark

import stillwater.report.Align
import stillwater.report.SignificantDigits
import stillwater.report.Table
import stillwater.report.TableColumn
import stillwater.run.Checkpoints
import stillwater.run.Curve
import stillwater.run.ErrorSummary
import stillwater.run.ExperimentResult
import java.util.Locale

/** What an experiment found, for people: a row per combination, a column per named checkpoint. */
object BenchmarkTable {
    private const val DIGITS = 3

    /** Errors of [field] in [result]; shows the last checkpoint where none of [Checkpoints.NAMED] was taken. */
    fun of(result: ExperimentResult, field: String): Table {
        val format = SignificantDigits(DIGITS)
        return table(result, result.curves.filter { it.field == field }) { format.format(it.mean) }
    }

    /**
     * Share of the visited cells whose bounds hold the truth in [field] of [result], and the bounds' mean width at the
     * last checkpoint; null where no filter gives bounds.
     */
    fun bounds(result: ExperimentResult, field: String): Table? {
        val bounding = result.curves.filter { it.field == field && it.filter.givesBounds }
        if (bounding.isEmpty()) return null
        val coverage = table(result, bounding) { "%.3f".format(Locale.ROOT, it.bounds?.coverage) }
        val format = SignificantDigits(DIGITS)
        val widths = bounding.map { curve ->
            curve.summaries.last().bounds?.let { format.format(it.meanWidth) }.orEmpty()
        }
        return Table(
            columns = coverage.columns + TableColumn("width", Align.RIGHT),
            rows = coverage.rows.zip(widths) { row, width -> row + width },
        )
    }

    private fun table(result: ExperimentResult, curves: List<Curve>, text: (ErrorSummary) -> String): Table {
        val taken = result.settings.checkpoints
        val shown = (Checkpoints.NAMED + taken.last()).filter { it in taken }.distinct()
        val isFleet = result.settings.boats != listOf(1)
        return Table(
            columns = listOf(TableColumn("planner", Align.LEFT), TableColumn("filter", Align.LEFT)) +
                (if (isFleet) listOf(TableColumn("boats", Align.RIGHT)) else emptyList()) +
                shown.map { TableColumn("$it", Align.RIGHT) },
            rows = curves.map { curve ->
                listOf(curve.planner.label, curve.filter.label) +
                    (if (isFleet) listOf("${curve.boats}") else emptyList()) + shown.map { text(curve.at(it)) }
            },
        )
    }
}
