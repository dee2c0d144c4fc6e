package stillwater.benchmark

import stillwater.report.Align
import stillwater.report.SignificantDigits
import stillwater.report.Table
import stillwater.report.TableColumn
import stillwater.run.Checkpoints
import stillwater.run.ExperimentResult

/** Mean errors of an experiment for people: a row per combination, a column per named checkpoint. */
object BenchmarkTable {
    private const val DIGITS = 3

    /** The table of [field] in [result]; it shows the last checkpoint where none of [Checkpoints.NAMED] was taken. */
    fun of(result: ExperimentResult, field: String): Table {
        val taken = result.settings.checkpoints
        val shown = (Checkpoints.NAMED + taken.last()).filter { it in taken }.distinct()
        val format = SignificantDigits(DIGITS)
        return Table(
            columns = listOf(TableColumn("planner", Align.LEFT), TableColumn("filter", Align.LEFT)) +
                shown.map { TableColumn("$it", Align.RIGHT) },
            rows = result.curves.filter { it.field == field }.map { curve ->
                listOf(curve.planner.label, curve.filter.label) + shown.map { format.format(curve.at(it).mean) }
            },
        )
    }
}
