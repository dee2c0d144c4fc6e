package stillwater.diagnosis

import stillwater.io.GlobeColumns
import stillwater.io.SurveyLog
import stillwater.report.CsvTable
import stillwater.report.OutputDirectory
import stillwater.report.writeFigures

/**
 * Writes a [Diagnosed] log: diagnosis.json, extended-sensor.json, residuals.csv, the figures and report.html.
 *
 * extended-sensor.json is written where something was named; without it the base sensor is the best there is, and
 * stands in diagnosis.json. Where nothing was fitted there are no figures, and residuals.csv has no model's columns.
 *
 * @param diagnosed what to write. @param command the command as typed, for the report. @param survey the log as it was
 * read. @param numbersOnly whether figures and report are left out.
 */
internal class DiagnosisFiles(
    private val diagnosed: Diagnosed,
    private val command: String,
    private val survey: SurveyLog,
    private val numbersOnly: Boolean = false,
) {
    /**
     * Writes all files into [directory], which the caller commits.
     *
     * @return warnings for the user, one line each.
     */
    fun write(directory: OutputDirectory): List<String> {
        directory.retire(
            DiagnosisFigures.NAMES.flatMap {
                listOf("$it.svg", "$it.png")
            } + "extended-sensor.json" + "report.html",
        )
        directory.write("diagnosis.json", DiagnosisJson.text(diagnosed))
        diagnosed.result.extendedSensor?.let { directory.write("extended-sensor.json", it.toJson() + "\n") }
        directory.stream("residuals.csv") { out ->
            val globe = GlobeColumns(diagnosed.log.frame)
            val table = CsvTable(out, listOf("time_s") + globe.names + COLUMNS)
            rows(table, globe)
            // Closing it writes what it has buffered.
            table.close()
        }
        if (numbersOnly) return emptyList()
        val figures = DiagnosisFigures(diagnosed, survey).draw()
        val warnings = directory.writeFigures(figures.map { it.name to it.figure })
        directory.write("report.html", DiagnosisReport(diagnosed, figures, command).render())
        return warnings
    }

    private fun rows(table: CsvTable, globe: GlobeColumns) {
        val columns = diagnosed.log.columns
        val base = diagnosed.result.baseline.takeIf { diagnosed.isFitted }
        val extended = diagnosed.result.extended
        for (i in 0 until columns.size) {
            table.row(
                columns.times[i],
                *globe.cells(columns.x[i], columns.y[i]).toTypedArray(),
                columns.x[i],
                columns.y[i],
                columns.values[i],
                columns.reference[i],
                base?.predicted?.get(i),
                base?.let { columns.values[i] - it.predicted[i] },
                base?.whitened?.get(i),
                extended?.predicted?.get(i),
                extended?.let { columns.values[i] - it.predicted[i] },
                extended?.whitened?.get(i),
            )
        }
    }

    private companion object {
        val COLUMNS = listOf(
            "x_m",
            "y_m",
            "measured",
            "reference",
            "baseline",
            "baseline_residual",
            "baseline_whitened",
            "extended",
            "extended_residual",
            "extended_whitened",
        )
    }
}
