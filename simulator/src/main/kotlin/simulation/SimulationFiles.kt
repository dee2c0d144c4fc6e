package stillwater.simulation

import stillwater.report.CsvTable
import stillwater.report.HtmlReport
import stillwater.report.OutputDirectory
import stillwater.report.Program
import stillwater.report.Provenance
import stillwater.report.Table
import stillwater.report.writeFigures
import stillwater.run.label
import stillwater.run.withUnit

/**
 * Writes what a [SimulationResult] gives beside the log: cells.csv, summary.json, animation.html, figures and report.html.
 *
 * @param result to write. @param command the command as typed.
 */
class SimulationFiles(private val result: SimulationResult, private val command: String) {
    private val run = result.run
    private val unit = run.spec.probe.quantity.unit
    private val quantity = run.spec.probe.quantity.withUnit

    /** The same in words. */
    val summary = SimulationSummary(result, unit)

    /** The text of summary.json. */
    fun json(): String = SimulationJson.text(result, summary.warnings)

    /** Writes all files into [directory], which the caller commits; returns warnings about the figures. */
    fun write(directory: OutputDirectory): List<String> {
        directory.retire(SimulationFigures.NAMES.flatMap { listOf("$it.svg", "$it.png") })
        cells(directory)
        directory.write("summary.json", json())
        val caption = "${run.spec.planner.label} planner, ${run.spec.estimator.label} estimator, " +
            "${run.world.settings.water.label} field, seed ${run.world.settings.seed}"
        directory.write("animation.html", Animation(run.spec, result.film, caption, quantity).page())
        val figures = SimulationFigures(result, quantity).draw()
        val drawing = directory.writeFigures(figures.map { it.name to it.figure })
        directory.write("report.html", page(figures, caption))
        return drawing
    }

    private fun cells(directory: OutputDirectory) = directory.stream("cells.csv") { out ->
        CsvTable(out, HEADER).use { table ->
            val map = result.map
            for (cell in 0 until map.grid.size) {
                table.row(
                    cell,
                    map.grid.centerX(cell),
                    map.grid.centerY(cell),
                    map.value(cell),
                    map.lower(cell),
                    map.upper(cell),
                    map.visits(cell),
                    map.readings(cell),
                    map.conflicts(cell),
                    result.centre(cell),
                    result.mean(cell),
                    result.inProcess.value(cell),
                )
            }
        }
    }

    private fun page(figures: List<SimulationFigure>, caption: String): String {
        val page = HtmlReport(
            "Simulated mission ${run.spec.name}",
            caption,
            Provenance(Program.VERSION, command, run.world.settings.seed),
        )
        summary.headline.forEach { (name, value) -> page.summary(name, value) }
        summary.warnings.forEach(page::warning)
        page.section("The run") {
            keyValues(summary.facts)
            paragraph("animation.html beside this page plays it.")
        }
        for (figure in figures) page.section(figure.figure.title) { figure(figure.figure, figure.caption) }
        page.section("States") {
            table(
                Table.of(run.history.spans) {
                    text("State") { it.label }
                    text("From") { SimulationSummary.clock(it.from) }
                    text("For") { SimulationSummary.clock(it.until - it.from) }
                },
            )
        }
        page.section("The probe") { code(run.world.sensor.toJson()) }
        page.section("The mission") { code(run.spec.toJson()) }
        page.section("How it was made") { HOW.forEach(::paragraph) }
        return page.render()
    }

    private companion object {
        val HEADER = listOf(
            "cell",
            "x_m",
            "y_m",
            "value",
            "lower",
            "upper",
            "visits",
            "readings",
            "conflicts",
            "truth_at_centre",
            "truth_mean",
            "in_process_value",
        )
        val HOW = listOf(
            "The mission that runs on the phone runs here unchanged: bytes of a virtual board come in over a " +
                "virtual link, bytes go out to its motors, ten times a second of virtual time. The board behaves " +
                "as the boats' firmware does; hull, wind, current, water, probe and position fixes are simulated " +
                "behind it.",
            "In process means: the readings that the mission took, put straight into the same estimator with the " +
                "places where the boat really was. What the mission's map is worse by is the stack's own part.",
            "mission.txt is the mission's log, a superset of the Platypus 4.2 format: map, diagnose and correct " +
                "read it. It begins on 1 January 2026 whatever the day, so that the same seed gives the same bytes.",
        )
    }
}
