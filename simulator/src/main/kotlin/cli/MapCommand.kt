package stillwater.cli

import com.github.ajalt.clikt.core.Context
import com.github.ajalt.clikt.core.terminal
import com.github.ajalt.clikt.parameters.arguments.argument
import com.github.ajalt.clikt.parameters.arguments.help
import com.github.ajalt.clikt.parameters.groups.provideDelegate
import com.github.ajalt.clikt.parameters.options.convert
import com.github.ajalt.clikt.parameters.options.default
import com.github.ajalt.clikt.parameters.options.flag
import com.github.ajalt.clikt.parameters.options.option
import stillwater.correct.CorrectCautions
import stillwater.correct.CorrectedLog
import stillwater.correct.SensorStages
import stillwater.io.DecimalText
import stillwater.io.SurveyLog
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.plot.Rehearsal
import stillwater.report.EarlierResults
import stillwater.report.OutputDirectory
import stillwater.run.FilterKind
import stillwater.run.LagFilterSettings
import stillwater.sensor.SensorSpec
import stillwater.survey.GivenCorrection
import stillwater.survey.GridWish
import stillwater.survey.MapFiles
import stillwater.survey.MapJson
import stillwater.survey.MapSettings
import stillwater.survey.MapSummary
import stillwater.survey.Stretch
import stillwater.survey.SurveyMap
import stillwater.survey.UnfitGrid
import java.nio.file.Files
import java.nio.file.Path

/** `stillwater map`: a real log becomes a map, figures and a report. */
class MapCommand : WorkCommand("map") {
    private val log by argument("LOG").help("survey CSV, Sea-Bird .cnv or Platypus log")
    private val out by option("--out", metavar = "DIR", help = "directory for the results")
        .directory().default("stillwater-map")
    private val logOptions by LogOptions()
    private val filterOptions by BoundedFilterOptions()
    private val lagOptions by LagFilterOptions()
    private val sensor by option(
        "--sensor",
        metavar = "FILE",
        help = "sensor spec (JSON): its response is undone, as by correct, and the corrected readings are mapped",
    )
    private val conditions by conditions(
        "quantity on which that sensor depends, such as temperature (degrees Celsius). Repeatable",
    )
    private val filters by option(
        "--filter",
        metavar = "NAMES",
        help = "filters to run: ${FilterKind.entries.joinToString(", ") { it.label }}; averaging,bounded unless " +
            "given, averaging alone with --sensor: what is corrected has no lag for the others to undo",
    ).someOf(FilterKind.entries.associateBy { it.label })
    private val cell by option("--cell", metavar = "METRES", help = "side of a cell; chosen from the log without it")
        .number("a length in metres above 0, and at most 1000000000") { it > 0 && it <= LARGEST_CELL }
    private val gridSize by option("--grid", metavar = "COLSxROWS", help = "number of cells instead of their size")
        .numberPair('x', GRID) { cols, rows ->
            cols >= 1 && rows >= 1 && cols % 1 == 0.0 && rows % 1 == 0.0 && cols * rows <= Grid.MAX_CELLS
        }
    private val rotation by option(
        "--rotation",
        metavar = "DEG",
        help = "angle of the grid's columns axis, degrees counter-clockwise from east",
    ).number("an angle within -180..180 degrees") { it in -180.0..180.0 }.default(0.0)
    private val range by option(
        "--range",
        metavar = "LOW:HIGH",
        help = "range of the water's values; without it the readings' range and a tenth more either way, or what a " +
            "lag that was learned shows",
    ).numberPair(':', "LOW:HIGH, two numbers, the first below the second") { low, high -> low < high }
    private val epsilon by option(
        "--epsilon",
        metavar = "auto|NUMBER",
        help =
        "slope per second that the bounded filter takes for noise; auto, which it is unless given, finds it on " +
            "a stretch of the log",
    ).convert { text ->
        val number = DecimalText.parse(text)
        if (text == AUTO) return@convert Double.NaN
        if (!number.isFinite() || number < 0) throw BadFlag(name, "auto or a number of at least 0", "'$text'")
        number
    }
    private val calibrate by option(
        "--calibrate",
        metavar = "FROM:TO",
        help = "stretch for --epsilon auto, seconds after the first reading; without it the quietest",
    ).numberPair(':', "FROM:TO, two times in seconds, the first below the second") { from, to -> from < to }
    private val unit by option("--unit", metavar = "TEXT", help = "unit of the readings, for legends and tables").unit()
    private val quiet by option(
        "--quiet",
        help = "no progress bar, no table and no warnings; the report has these",
    ).flag()
    private val json by option("--json", help = "print a summary as JSON instead of a table").flag()

    override fun help(context: Context) =
        "Make a map, figures and a report out of a boat's log."

    override fun helpEpilog(context: Context) = helpEnd(
        "Writes cells.csv (every cell of every filter), cells.geojson (visited cells), figures as SVG and PNG, and " +
            "report.html into DIR; nothing at all when something is wrong with the log.",
        listOf(
            "stillwater map survey.csv --value odo_percent_sat --unit %sat --out map",
            "stillwater map platypus_20160519.txt --value ATLAS_DO --cell 2",
            "stillwater map profiles.csv --x pres_dbar --value doxy_umol",
            "stillwater map survey.csv --value odo --sensor sensor.json",
            "stillwater map survey.csv --value temp_c --filter bounded --calibrate 0:120",
        ),
    )

    override fun work() {
        if (cell != null && gridSize != null) throw failure("--grid: expected either --grid or --cell, found both")
        val isContrary = calibrate != null && wantedEpsilon != null
        if (isContrary) throw failure("--calibrate: expected --epsilon auto, found a number")
        requireUsed()
        val file = Path.of(log)
        val spec = sensor?.let { file -> SensorFile.readUndoable(file).also { requireNeeded(conditions, file, it) } }
        val opened = SurveyLog.open(file, logOptions.choice().copy(conditions = conditions.toMap()))
        // Opened first: where results cannot be written, nobody wants to wait for them.
        requireNoMission(Path.of(out))
        OutputDirectory(
            Path.of(out),
            listOfNotNull(file, sensor?.let(Path::of)),
            EarlierResults(commandName),
        ).use { directory ->
            val map = read(opened, file, spec?.let { correction(opened, it) })
            val summary = MapSummary(map)
            val drawing = MapFiles(map, summary, commandLine()).write(directory)
            val written = directory.commit()
            when {
                json -> echo(MapJson.text(map, summary.warnings + drawing, written))
                !quiet -> {
                    echo("Map of ${summary.quantity}")
                    echo(summary.text())
                    for (warning in summary.warnings + drawing) echo("warning: $warning", err = true)
                    echo(wrote(written, out, "report.html"))
                }
            }
        }
    }

    private val usedFilters
        get() = filters ?: listOfNotNull(FilterKind.AVERAGING, FilterKind.BOUNDED.takeIf { sensor == null })

    /** The number that was given; null where the log is to show it. */
    private val wantedEpsilon get() = epsilon?.takeIf { !it.isNaN() }

    private fun requireUsed() {
        val own = listOf(
            "--epsilon" to epsilon,
            "--calibrate" to calibrate,
            "--condition" to conditions.ifEmpty { null },
        )
        val users = filterOptions.users + lagOptions.users + OptionUsers(
            mapOf(
                "--calibrate" to OptionUser.filters(listOf(FilterKind.BOUNDED)),
                "--condition" to OptionUser.option("--sensor"),
            ),
        )
        val sensors = if (sensor == null) emptyList() else OptionUser.option("--sensor")
        users.require(
            own + filterOptions.flags() + lagOptions.flags(),
            OptionUser.filters(usedFilters) + sensors,
            listOfNotNull("--filter".takeIf { filters == null }),
        )
    }

    private fun correction(opened: SurveyLog, spec: SensorSpec): GivenCorrection = try {
        val corrected = CorrectedLog.of(opened, spec, hasReference = false, conditions.toMap())
        val cautions = CorrectCautions(corrected, unit?.let { " $it" }.orEmpty())
        GivenCorrection(
            spec,
            SensorStages.words(spec),
            corrected.track,
            corrected.told,
            listOfNotNull(cautions.ofLearning) + cautions.ofSensor + cautions.lines,
        )
    } catch (wrong: IllegalArgumentException) {
        throw SensorFile.unfit(sensor, wrong)
    }

    private fun read(opened: SurveyLog, file: Path, correction: GivenCorrection?): SurveyMap {
        // Every byte is read twice.
        val bytes = 2 * Files.size(file)
        val isLong = bytes >= LONG
        val rehearsal = if (isLong) Rehearsal() else null
        val shown = !quiet && isLong
        return WorkProgress(terminal, "reading", unit = "B", bytes, shown).use { progress ->
            try {
                SurveyMap.of(opened, settings().copy(correction = correction), progress::advance)
            } catch (unfit: UnfitGrid) {
                throw failure("${if (gridSize == null) "--cell" else "--grid"}: ${unfit.message}")
            } finally {
                rehearsal?.close()
            }
        }
    }

    private fun settings() = MapSettings(
        filters = usedFilters,
        grid = GridWish(
            cell = cell,
            columns = gridSize?.first?.toInt(),
            rows = gridSize?.second?.toInt(),
            rotation = Math.toRadians(rotation),
        ),
        prior = range?.let { (low, high) -> Interval(low, high) },
        epsilon = wantedEpsilon,
        calibrate = calibrate?.let { (from, to) -> Stretch(from, to) },
        boundedFilter = filterOptions.applied(MapSettings().boundedFilter),
        unit = unit,
        lagFilters = lagOptions.applied(LagFilterSettings()),
        slowestGiven = lagOptions.slowestGiven,
        readingErrorGiven = lagOptions.readingErrorGiven,
    )

    private fun commandLine(): String {
        val own = listOf(
            "--out" to out,
            "--filter" to usedFilters.joinToString(",") { it.label },
            "--cell" to cell,
            "--grid" to gridSize?.let { (columns, rows) -> "${columns.toInt()}x${rows.toInt()}" },
            "--rotation" to rotation.takeIf { it != 0.0 },
            "--range" to range?.let { (low, high) -> "$low:$high" },
            "--epsilon" to wantedEpsilon,
            "--calibrate" to calibrate?.let { (from, to) -> "$from:$to" },
            "--unit" to unit,
            "--sensor" to sensor,
        ) + conditions.map { (name, column) -> "--condition" to "$name=$column" }
        return commandLineText(
            "stillwater map",
            log,
            logOptions.flags() + own + filterOptions.flags() + lagOptions.flags(),
        )
    }

    private companion object {
        const val AUTO = "auto"

        /** Smaller files are done before a bar can be read or a figure be drawn beside, bytes, twice the file's. */
        const val LONG = 8_000_000L

        /** As large as the places of a log without latitudes may be, m. */
        const val LARGEST_CELL = 1e9
        const val GRID = "COLSxROWS such as 10x10, whole numbers above 0, ${Grid.MAX_CELLS} cells at most"
    }
}
