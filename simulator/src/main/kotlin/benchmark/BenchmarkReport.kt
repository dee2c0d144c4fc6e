package stillwater.benchmark

import stillwater.plot.Figure
import stillwater.report.HtmlReport
import stillwater.report.Program
import stillwater.report.Provenance
import stillwater.report.Table
import stillwater.run.ExperimentResult

/**
 * The page about an experiment.
 *
 * @param result what was found.
 * @param figures the figure of each field, by the field's name.
 * @param command the command as typed.
 * @param more figures of boats and their voyages.
 */
internal class BenchmarkReport(
    private val result: ExperimentResult,
    private val figures: List<Pair<String, Figure>>,
    private val command: String,
    private val more: List<Figure> = emptyList(),
) {
    private val settings = result.settings

    /** The page's text. */
    fun render(): String {
        val page = HtmlReport(
            title = "Benchmark",
            subtitle = "How wrong is the map after each move? Mean absolute error over all cells.",
            provenance = Provenance(Program.VERSION, command, settings.seed),
        )
        page.summary("Environments", "${settings.environments} of each field")
        page.summary("Sensor", settings.sensor.name)
        page.summary("Moves", "${settings.moves}, ${settings.samplesPerMove} readings each")
        SensorCautions.of(settings).forEach(page::warning)
        for ((field, figure) in figures) {
            page.section(figure.title) {
                figure(figure, CAPTION)
                table(BenchmarkTable.of(result, field), "Mean absolute error at some of the moves")
                BenchmarkTable.bounds(result, field)?.let { table(it, BOUNDS_CAPTION) }
            }
        }
        boats(page)
        val claims = ReportClaims(result).all()
        if (claims.isNotEmpty()) {
            page.section("The report's claims") {
                paragraph(
                    "Held against the curves above at the moves in results.csv. \"Below\" means by more than two " +
                        "standard errors of the difference over the environments, which all combinations share.",
                )
                table(claimsTable(claims))
            }
        }
        page.section("Where the error is left") {
            paragraph(
                "A local extreme of the field is above, or below, every cell it shares an edge with. A boat always " +
                    "enters it from one side of its value, so that a slow sensor tightens one of its bounds only.",
            )
            table(extremesTable(), "At move ${settings.checkpoints.last()}; all moves are in extremes.csv")
        }
        page.section("Settings") {
            keyValues(settingsList())
            details("The sensor as JSON") { code(settings.sensor.toJson()) }
        }
        return page.render()
    }

    /** What several boats gain, where they went, and what they used of their budget. */
    private fun boats(page: HtmlReport) {
        for (figure in more) page.section(figure.title) { figure(figure, "") }
        for (field in settings.fields.keys) {
            val table = FleetFigures.table(result, field) ?: continue
            page.section("What more boats gain, field $field") { table(table) }
        }
        val budget = BudgetTable.of(result) ?: return
        val limit = settings.budget
        page.section("Budget") { table(budget, "Of ${limit?.limit} ${limit?.kind?.unit}, by the boat that used most") }
    }

    private fun claimsTable(claims: List<Claim>) = Table.of(claims) {
        text("Verdict") { it.verdict.label }
        text("Claim") { it.text }
        text("Where") { it.detail }
    }

    private fun extremesTable() = Table.of(result.curves) {
        text("Field") { it.field }
        text("Planner") { it.planner.label }
        text("Filter") { it.filter.label }
        number("Local extremes, share of cells", digits = 2) { result.extremeCells.getValue(it.field) }
        number("Share of the error", digits = 2) { it.summaries.last().shareInExtremes }
    }

    private fun settingsList(): List<Pair<String, String>> {
        val filter = settings.boundedFilter
        val planner = settings.plannerSettings.bounded
        return listOf(
            "Grid" to "${settings.grid.columns} x ${settings.grid.rows} cells, prior ${settings.prior.lower} to " +
                "${settings.prior.upper}",
            "Bounded filter" to "median of ${filter.medianWindow}, slope over ${filter.slopeWindow} medians, epsilon " +
                "${filter.epsilon} /s, crossing bounds ${filter.crossing.name.lowercase()}, windows " +
                if (filter.clearOnEntry) "cleared on entering a cell" else "kept over cell borders",
            "Random walk" to settings.plannerSettings.walk.name.words(),
            "Lawnmower" to settings.plannerSettings.pattern.name.words(),
            "Bounded planner" to "horizon ${planner.horizon}, ${planner.expansions} expansions, largest change " +
                "${planner.maxChange}, visits on the path ${if (planner.discountVisits) "" else "not "}discounted, " +
                "moves over ${planner.neighbours.name.words()}, expands by ${planner.priority.name.words()}, " +
                "runs the ${planner.choice.name.words()} path, ${planner.execution.name.words()} before planning again",
            "Time between readings" to "${settings.period} s",
        )
    }

    private fun String.words() = lowercase().replace('_', ' ')

    private companion object {
        const val BOUNDS_CAPTION =
            "Share of the visited cells whose bounds hold the truth, and at the last move the bounds' mean width; " +
                "all moves are in bounds.csv"
        const val CAPTION =
            "The report draws this comparison as its Figure 6 (uniform field) and Figure 7 (Gaussian). " +
                "Planners by colour, filters by line, bands of one standard error of the mean either way."
    }
}
