package stillwater.cli

import com.github.ajalt.clikt.core.Context
import com.github.ajalt.clikt.core.terminal
import com.github.ajalt.clikt.parameters.groups.provideDelegate
import com.github.ajalt.clikt.parameters.options.convert
import com.github.ajalt.clikt.parameters.options.default
import com.github.ajalt.clikt.parameters.options.flag
import com.github.ajalt.clikt.parameters.options.option
import kotlinx.coroutines.runBlocking
import stillwater.benchmark.BenchmarkFiles
import stillwater.benchmark.BenchmarkJson
import stillwater.benchmark.BenchmarkTable
import stillwater.benchmark.BudgetTable
import stillwater.benchmark.FleetFigures
import stillwater.benchmark.ReportClaims
import stillwater.model.Grid
import stillwater.model.WaterArea
import stillwater.plan.Lawnmower
import stillwater.report.EarlierResults
import stillwater.report.OutputDirectory
import stillwater.report.toTerminal
import stillwater.run.BudgetKind
import stillwater.run.Checkpoints
import stillwater.run.Experiment
import stillwater.run.ExperimentResult
import stillwater.run.ExperimentSettings
import stillwater.run.FilterKind
import stillwater.run.PlannerKind
import stillwater.run.Preset
import java.nio.file.Path
import java.util.concurrent.atomic.AtomicLong

/** `stillwater benchmark`: the report's comparison of filters and planners in simulated fields. */
class BenchmarkCommand : WorkCommand("benchmark") {
    private val preset by option(
        "--preset",
        metavar = "NAME",
        help = Preset.entries.joinToString("; ") { "${it.label}: ${it.describes}" },
    ).oneOf(Preset.entries.associateBy { it.label }).default(Preset.REPORT, defaultForHelp = Preset.REPORT.label)
    private val out by option(
        "--out",
        metavar = "DIR",
        help = "directory for the results",
    ).directory().default("stillwater-benchmark")
    private val fields by option("--field", metavar = "NAMES", help = "fields to draw: uniform, gaussian")
        .someOf(listOf(Preset.UNIFORM, Preset.GAUSSIAN).associateWith { it })
    private val filters by option(
        "--filter",
        metavar = "NAMES",
        help = "filters to compare: ${FilterKind.entries.joinToString(", ") { it.label }}",
    ).someOf(FilterKind.entries.associateBy { it.label })
    private val planners by option(
        "--planner",
        metavar = "NAMES",
        help = "planners to compare: ${PlannerKind.entries.joinToString(", ") { it.label }}",
    ).someOf(PlannerKind.entries.associateBy { it.label })
    private val environments by option(
        "--environments",
        metavar = "N",
        help = "random fields of each kind; 100 unless given",
    )
        .wholeNumber("a whole number within 1..1000000") { it in 1..MILLION }
    private val moves by option(
        "--moves",
        metavar = "N",
        help = "moves in a trial, the first is the start cell; 2000 unless given, original 500",
    )
        .wholeNumber("a whole number within 1..100000000") { it in 1..MOST_MOVES }
    private val checkpoints by option(
        "--checkpoints",
        metavar = "MOVES",
        help = "moves at which errors are taken, such as 50,100,200, the last of which sets --moves unless that is " +
            "given; without it about a dozen in every decade",
    ).convert { text ->
        val moves = text.split(',').map { it.trim().toIntOrNull() ?: 0 }
        val ascend = moves.zipWithNext().all { (before, after) -> before < after }
        if (moves.first() < 1 || moves.last() > MOST_MOVES || !ascend) {
            throw BadFlag(name, "ascending moves above 0 such as 50,100,200", "'$text'")
        }
        moves
    }
    private val grid by option(
        "--grid",
        metavar = "COLSxROWS",
        help = "size of the fields in cells; 10x10 unless given",
    )
        .numberPair('x', "COLSxROWS such as 10x10, whole numbers above 0, $MILLION cells at most") { columns, rows ->
            columns >= 1 && rows >= 1 && columns % 1 == 0.0 && rows % 1 == 0.0 && columns * rows <= MILLION
        }
    private val samples by option(
        "--samples",
        metavar = "N",
        help = "readings in a cell before the boat moves on; 10 unless given",
    )
        .wholeNumber("a whole number within 1..1000000") { it in 1..MILLION }
    private val epsilon by option(
        "--epsilon",
        metavar = "NUMBER",
        help = "slope per second that the bounded filter takes for noise; 0.0005 unless given, noisy 0.002, original 0",
    ).number("a number of at least 0") { it >= 0 }
    private val period by option("--period", metavar = "SECONDS", help = "time between readings; 1 unless given")
        .number("a number of seconds above 0") { it > 0 }
    private val sensorOptions by SensorOptions()
    private val filterOptions by BoundedFilterOptions()
    private val lagOptions by LagFilterOptions()
    private val plannerOptions by PlannerOptions()
    private val fleetOptions by FleetOptions()
    private val seed by option(
        "--seed",
        metavar = "N",
        help = "where all chance comes from; the same seed, the same bytes",
    )
        .convert { text -> text.toLongOrNull() ?: throw BadFlag(name, "a whole number", "'$text'") }.default(1L)
    private val threads by option(
        "--threads",
        metavar = "N",
        help = "environments at once; does not change the results",
    )
        .wholeNumber("a whole number within 1..1024") { it in 1..MOST_THREADS }
        .default(Runtime.getRuntime().availableProcessors(), defaultForHelp = "all cores")
    private val quiet by option("--quiet", help = "no progress bar, no table and no warnings").flag()
    private val json by option("--json", help = "print the results as JSON instead of tables").flag()

    override fun help(context: Context) =
        "Compare filters and planners in simulated fields, as the report does in its Figures 6 and 7."

    override fun helpEpilog(context: Context) = helpEnd(
        "Writes results.csv, extremes.csv (how much of the error lies in the field's local extremes), bounds.csv " +
            "(how often bounds hold the truth, how wide they are), figure-6 and figure-7 (SVG and PNG), sensor.json " +
            "and report.html into DIR; with several --boats boats-FIELD, with an --area or polygon-rrt voyage-FIELD " +
            "or voyage-FIELD-PLANNER (SVG and PNG), with a budget budget.csv; nothing at all when something is wrong.",
        listOf(
            "stillwater benchmark",
            "stillwater benchmark --preset noisy --out noisy",
            "stillwater benchmark --field uniform --filter bounded --moves 6000",
            "stillwater benchmark --preset original --choice best --seed 7",
            "stillwater benchmark --sensor my-probe.json --environments 20 --json",
            "stillwater benchmark --planner lawnmower --filter interval --boats 1,2,4,8",
            "stillwater benchmark --filter bounded --area my-lake.geojson --boats 2",
        ),
    )

    override fun work() {
        val settings = settings()
        // Opened first: where results cannot be written, nobody wants to wait for them.
        requireNoMission(Path.of(out))
        OutputDirectory(Path.of(out), earlier = EarlierResults(commandName)).use { directory ->
            val result = measure(experiment(settings))
            val warnings = BenchmarkFiles(result, commandLine()).write(directory)
            val written = directory.commit()
            when {
                json -> echo(BenchmarkJson.text(result, written))
                !quiet -> show(result)
            }
            if (!quiet) for (warning in warnings) echo("warning: $warning", err = true)
            if (!quiet && !json) echo(wrote(written, out, "report.html"))
        }
    }

    /** Only now it shows whether boats find a way through the water of an area. */
    private fun experiment(settings: ExperimentSettings) = try {
        Experiment(settings)
    } catch (unfit: IllegalArgumentException) {
        val expected = "water on which boats find ways with this --cell, --margin and --resolution"
        throw BadFlag("--area", expected, "that ${unfit.message}")
    }

    private fun measure(experiment: Experiment): ExperimentResult {
        val done = AtomicLong()
        return WorkProgress(terminal, "environments", "", experiment.size.toLong(), shown = !quiet).use { progress ->
            runBlocking { experiment.run(threads) { progress.advance(done.incrementAndGet()) } }
        }
    }

    private fun show(result: ExperimentResult) {
        for (field in result.settings.fields.keys) {
            terminal.println(BenchmarkTable.of(result, field).toTerminal("Mean absolute error, field $field, by moves"))
            terminal.println()
            val bounds = BenchmarkTable.bounds(result, field) ?: continue
            terminal.println(bounds.toTerminal("Share of cells whose bounds hold the truth, field $field, by moves"))
            terminal.println()
        }
        for (field in result.settings.fields.keys) {
            val table = FleetFigures.table(result, field) ?: continue
            terminal.println(table.toTerminal("What more boats gain, field $field"))
            terminal.println()
        }
        BudgetTable.of(result)?.let {
            terminal.println(it.toTerminal("Used of the budget, ${result.settings.budget?.limit}"))
            terminal.println()
        }
        for (claim in ReportClaims(result).all()) {
            echo("${claim.verdict.label}: ${claim.text} (${claim.detail})")
        }
    }

    private fun settings(): ExperimentSettings {
        val base = preset.settings()
        val budget = fleetOptions.budget()
        val budgetMoves = budget?.takeIf { it.kind == BudgetKind.MOVES }?.limit?.toInt()?.takeIf { it <= MOST_MOVES }
        val trialMoves = moves ?: checkpoints?.last() ?: budgetMoves ?: base.moves
        checkpoints?.last()?.let {
            if (it > trialMoves) throw BadFlag("--checkpoints", "moves within 1..$trialMoves", "$it")
        }
        val area = fleetOptions.area()
        val cells = grid(area) ?: base.grid
        val comparedPlanners = comparedPlanners(base.planners)
        val chosenPlanners = plannerOptions.applied(base.plannerSettings)
        if (PlannerKind.LAWNMOWER in comparedPlanners && !Lawnmower.fits(cells, chosenPlanners.pattern)) {
            throw BadFlag(
                "--grid",
                "an even number of rows or columns and two of each at least for the lawnmower's hamiltonian-cycle, " +
                    "or another --pattern",
                "${cells.columns}x${cells.rows}",
            )
        }
        val chosenBoats = fleetOptions.boats() ?: base.boats
        if (chosenBoats.max() >
            cells.size
        ) {
            throw BadFlag("--boats", "at most ${cells.size}, one a cell", "${chosenBoats.max()}")
        }
        val settings = try {
            base.copy(
                fields = fields?.associateWith { base.fields.getValue(it) } ?: base.fields,
                filters = filters ?: base.filters,
                planners = comparedPlanners,
                sensor = sensorOptions.applied(base.sensor, period ?: base.period),
                boundedFilter = filterOptions.applied(
                    base.boundedFilter.copy(epsilon = epsilon ?: base.boundedFilter.epsilon),
                ),
                lagFilters = lagOptions.applied(base.lagFilters),
                plannerSettings = chosenPlanners,
                grid = cells,
                environments = environments ?: base.environments,
                moves = trialMoves,
                checkpoints = checkpoints ?: Checkpoints.upTo(trialMoves),
                samplesPerMove = samples ?: base.samplesPerMove,
                period = period ?: base.period,
                seed = seed,
                boats = chosenBoats,
                budget = budget,
                area = area,
                speed = fleetOptions.speed(),
            )
        } catch (unfit: IllegalArgumentException) {
            throw failure(unfit.message.orEmpty())
        }
        requireUsed(settings)
        return settings
    }

    private fun requireUsed(settings: ExperimentSettings) {
        val users = filterOptions.users + lagOptions.users + plannerOptions.users + fleetOptions.users
        val water = if (fleetOptions.hasArea) OptionUser.option("--area") else emptyList()
        users.require(
            listOf("--epsilon" to epsilon) + groupedFlags(),
            OptionUser.filters(settings.running) + OptionUser.planners(settings.planners) + water,
            listOfNotNull("--filter".takeIf { filters == null }, "--planner".takeIf { planners == null }),
        )
    }

    private fun grid(area: WaterArea?): Grid? {
        val size = grid
        if (area != null && size != null) throw BadFlag("--grid", "--cell with --area", "--grid")
        return area?.let { fleetOptions.grid(it) }
            ?: size?.let { (columns, rows) -> Grid.unit(columns.toInt(), rows.toInt()) }
    }

    /** With an area those that plan in the plane, unless some are named. */
    private fun comparedPlanners(ofPreset: List<PlannerKind>): List<PlannerKind> =
        planners ?: if (fleetOptions.hasArea) PlannerKind.entries.filter { it.inPlane } else ofPreset

    private fun commandLine(): String {
        val own = listOf(
            "--preset" to preset.label,
            "--out" to out,
            "--field" to fields?.joinToString(","),
            "--filter" to filters?.joinToString(",") { it.label },
            "--planner" to planners?.joinToString(",") { it.label },
            "--environments" to environments,
            "--moves" to moves,
            "--checkpoints" to checkpoints?.joinToString(","),
            "--grid" to grid?.let { (columns, rows) -> "${columns.toInt()}x${rows.toInt()}" },
            "--samples" to samples,
            "--epsilon" to epsilon,
            "--period" to period,
            "--seed" to seed,
        )
        return commandLineText("stillwater benchmark", null, own + groupedFlags())
    }

    private fun groupedFlags() = sensorOptions.flags() + filterOptions.flags() + lagOptions.flags() +
        plannerOptions.flags() + fleetOptions.flags()

    private companion object {
        const val MILLION = 1_000_000
        const val MOST_MOVES = 100_000_000
        const val MOST_THREADS = 1024
    }
}
