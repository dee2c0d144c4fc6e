package stillwater.benchmark

import stillwater.plot.Figure
import stillwater.plot.drawAll
import stillwater.report.CsvTable
import stillwater.report.OutputDirectory
import stillwater.report.counted
import stillwater.report.writeFigures
import stillwater.run.ExperimentResult

/**
 * Writes what an experiment found: results.csv, extremes.csv, bounds.csv, sensor.json, figures (SVG and PNG) and
 * report.html; with a budget budget.csv too.
 *
 * @param result what was found.
 * @param command the command as typed, for the report.
 */
class BenchmarkFiles(private val result: ExperimentResult, private val command: String) {
    /**
     * Writes all files into [directory], which the caller commits.
     *
     * @return warnings for the user, one line each.
     */
    fun write(directory: OutputDirectory): List<String> {
        directory.stream("results.csv") { out -> CsvTable(out, COLUMNS).use(::rows) }
        directory.stream("extremes.csv") { out -> CsvTable(out, EXTREMES_COLUMNS).use(::extremes) }
        directory.stream("bounds.csv") { out -> CsvTable(out, BOUNDS_COLUMNS).use(::bounds) }
        directory.write("sensor.json", result.settings.sensor.toJson() + "\n")
        val budgets = BudgetTable.rows(result)
        if (budgets.isNotEmpty()) {
            directory.stream("budget.csv") { out ->
                CsvTable(out, BudgetTable.COLUMNS).use { table -> for (row in budgets) table.row(*row.toTypedArray()) }
            }
        }
        val names = BenchmarkFigures.names + FleetFigures.names + VoyageFigures.names
        directory.retire(names.flatMap { listOf("$it.svg", "$it.png") } + "budget.csv")
        val figures = BenchmarkFigures.of(result)
        val more = FleetFigures.of(result) + VoyageFigures.of(result)
        val drawn: List<Figure> = (figures.map { it.drawing } + more.map { it.second }).drawAll()
        val warnings = directory.writeFigures((figures.map { it.name } + more.map { it.first }).zip(drawn))
        val ofFields = figures.map { it.field }.zip(drawn)
        directory.write("report.html", BenchmarkReport(result, ofFields, command, drawn.drop(figures.size)).render())
        return SensorCautions.of(result.settings) + warnings + listOfNotNull(beyond()) + BudgetTable.warnings(result)
    }

    /** A warning where errors are beyond all numbers, as with a sensor of enormous gain; null where none is. */
    private fun beyond(): String? {
        val errors = result.curves.flatMap { it.summaries }
        val lost = errors.count { !it.mean.isFinite() }
        if (lost == 0) return null
        return "$lost of ${counted(
            errors.size,
            "mean error",
        )} are larger than any number and left empty: the sensor's " +
            "readings grow out of bounds; see what gain, drift, noise or outliers it has"
    }

    private fun rows(table: CsvTable) {
        for (curve in result.curves) {
            curve.checkpoints.zip(curve.summaries) { move, summary ->
                table.row(
                    curve.field,
                    curve.filter.label,
                    curve.planner.label,
                    result.settings.sensor.name,
                    move,
                    result.settings.environments,
                    summary.mean,
                    summary.standardError,
                    summary.p10,
                    summary.p90,
                    curve.boats,
                )
            }
        }
    }

    private fun extremes(table: CsvTable) {
        for (curve in result.curves) {
            curve.checkpoints.zip(curve.summaries) { move, summary ->
                table.row(
                    curve.field,
                    curve.filter.label,
                    curve.planner.label,
                    move,
                    result.extremeCells.getValue(curve.field),
                    summary.shareInExtremes,
                    curve.boats,
                )
            }
        }
    }

    private fun bounds(table: CsvTable) {
        for (curve in result.curves) {
            curve.checkpoints.zip(curve.summaries) { move, summary ->
                val bounds = summary.bounds ?: return@zip
                table.row(
                    curve.field,
                    curve.filter.label,
                    curve.planner.label,
                    move,
                    bounds.coverage,
                    bounds.standardError,
                    bounds.meanWidth,
                    curve.boats,
                )
            }
        }
    }

    private companion object {
        val BOUNDS_COLUMNS =
            listOf("field", "filter", "planner", "move", "coverage", "standard_error", "mean_width", "boats")
        val EXTREMES_COLUMNS =
            listOf("field", "filter", "planner", "move", "share_of_cells", "share_of_error", "boats")
        val COLUMNS = listOf(
            "field",
            "filter",
            "planner",
            "sensor",
            "move",
            "environments",
            "mean_abs_error",
            "standard_error",
            "p10",
            "p90",
            "boats",
        )
    }
}
