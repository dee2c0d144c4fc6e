package stillwater.cli

import com.github.ajalt.clikt.core.Context
import com.github.ajalt.clikt.core.terminal
import com.github.ajalt.clikt.parameters.arguments.argument
import com.github.ajalt.clikt.parameters.arguments.help
import com.github.ajalt.clikt.parameters.groups.provideDelegate
import com.github.ajalt.clikt.parameters.options.convert
import com.github.ajalt.clikt.parameters.options.default
import com.github.ajalt.clikt.parameters.options.flag
import com.github.ajalt.clikt.parameters.options.multiple
import com.github.ajalt.clikt.parameters.options.option
import stillwater.correct.CorrectFiles
import stillwater.correct.CorrectOutput
import stillwater.correct.CorrectedLog
import stillwater.diagnosis.RowsOfTheirOwn
import stillwater.io.LogChoice
import stillwater.io.SurveyLog
import stillwater.report.EarlierResults
import stillwater.report.OutputDirectory
import stillwater.sensor.SensorSpec
import java.nio.file.Files
import java.nio.file.Path

/** `stillwater correct`: a log with its sensor's response undone, row by row. */
class CorrectCommand : WorkCommand("correct") {
    private val log by argument("LOG").help("survey CSV, Sea-Bird .cnv or Platypus log")
    private val out by option(
        "--out",
        metavar = "DIR",
        help = "directory for the results",
    ).directory().default("stillwater-correct")
    private val logOptions by LogOptions()
    private val reference by option(
        "--reference",
        metavar = "COLUMN",
        help = "column with a fast sensor of the same quantity, or the known truth, to learn the sensor from; CSV only",
    )
    private val sensor by option(
        "--sensor",
        metavar = "FILE",
        help = "sensor spec (JSON), taken as given; without it the sensor is learned from the log",
    )
    private val conditions by conditions(
        "quantity on which a given sensor depends: temperature (degrees Celsius), salinity or what its file names; " +
            "speed (m/s) is taken from the positions without it. Repeatable",
    )
    private val units by option(
        "--unit",
        metavar = "TEXT",
        help = "unit of the readings, for figures and tables; with several --value one for each, in their order",
    ).unit().multiple()
    private val heldOut by option(
        "--held-out",
        help = "also learn on some legs and score the correction on the others; takes five times as long; " +
            "without --sensor and --reference only",
    ).flag()
    private val between by option(
        "--between",
        metavar = "FROM:TO",
        help = "with --held-out on a transect (--x alone): compare successive passes between these places only",
    ).convert { text ->
        val ends = text.split(':').map { it.trim().toDoubleOrNull() ?: Double.NaN }
        if (ends.size != 2 || !ends.all { it.isFinite() } || !(ends[0] < ends[1])) {
            throw BadFlag(name, "two growing numbers such as 20:180", "'$text'")
        }
        ends[0]..ends[1]
    }
    private val quiet by option(
        "--quiet",
        help = "no progress bar, no summary and no warnings; the report has these",
    ).flag()
    private val json by option("--json", help = "print the summary as JSON").flag()

    override fun help(context: Context) = "Undo a sensor's lag in a boat's log, with a 95 % interval for every row."

    override fun helpEpilog(context: Context) = helpEnd(
        "Writes corrected.csv (every row of the log and corrected, corrected_low, corrected_high), sensor.json " +
            "(the sensor, for --sensor), summary.json, figures as SVG and PNG, and report.html into DIR; nothing at " +
            "all when something is wrong with the log. With --value several times each column is corrected by " +
            "itself: corrected.csv has COLUMN_corrected, COLUMN_corrected_low and COLUMN_corrected_high of each, " +
            "the other files of each are in DIR/COLUMN.",
        listOf(
            "stillwater correct survey.csv --value odo_percent_sat --unit %sat",
            "stillwater correct survey.csv --value odo_percent_sat --value temp_c",
            "stillwater correct profiles.csv --x pres_dbar --value doxy_umol",
            "stillwater correct survey.csv --value slow --reference fast --out corrected",
            "stillwater correct survey.csv --value odo_percent_sat --sensor sensor.json",
            "stillwater correct a.csv --value do --sensor b.json --condition speed=mps",
        ),
    )

    override fun work() {
        if (sensor != null && reference != null) {
            throw failure("--sensor: expected either --sensor or --reference, found both")
        }
        requireUsed()
        val choices = logOptions.choices()
        requireFitting(choices.size)
        val spec = sensor?.let { file -> SensorFile.readUndoable(file).also { requireNeeded(conditions, file, it) } }
        val file = Path.of(log)
        val logs = choices.map { open(file, it) }
        if (logs.size > 1 && logs[0].format.startsWith("Platypus")) {
            val why = "one sensor of a Platypus log, whose sensors each have lines and times of their own"
            throw BadFlag("--value", why, "${logs.size}")
        }
        if (between != null && !(heldOut && logs[0].oneDimensional)) {
            throw failure("--between: expected --held-out and a transect (--x without --y), found none")
        }
        for (opened in logs) CorrectFiles.requireNewColumns(opened, logs.size == 1)
        requireNoMission(Path.of(out))
        OutputDirectory(
            Path.of(out),
            listOfNotNull(file, sensor?.let(Path::of)),
            EarlierResults(commandName, mark = "corrected.csv" to "corrected_low"),
        ).use { directory ->
            val places = CorrectFiles.places(logs.map { it.quantity })
            val files = CorrectOutput(
                logs.mapIndexed { i, opened ->
                    val result = corrected(opened, spec)
                    val scores = if (heldOut) result.heldOut(between) else null
                    CorrectFiles(result, units.getOrNull(i), commandLine(), scores, places[i])
                },
            )
            files.write(directory)
            val written = directory.commit()
            when {
                json -> echo(files.json())
                !quiet -> {
                    files.lines().forEach { echo(it) }
                    for (warning in files.warnings) echo("warning: $warning", err = true)
                    echo(wrote(written, out, if (logs.size == 1) "report.html" else "corrected.csv"))
                }
            }
        }
    }

    /** Refuses what would change nothing. */
    private fun requireUsed() {
        OptionUsers(mapOf("--condition" to OptionUser.option("--sensor"))).require(
            listOf("--condition" to conditions.ifEmpty { null }),
            if (sensor == null) emptyList() else OptionUser.option("--sensor"),
        )
        if (heldOut && (sensor != null || reference != null)) {
            val other = if (sensor != null) "--sensor" else "--reference"
            throw failure("--held-out: expected a sensor learned from passes through the same water, found $other")
        }
    }

    /** Refuses what cannot be said of [count] columns of readings at once. */
    private fun requireFitting(count: Int) {
        if (units.isNotEmpty() && units.size != count) {
            throw BadFlag("--unit", "one unit for each --value, in their order", "${units.size} for $count")
        }
        for ((flag, given) in listOf("--sensor" to sensor, "--reference" to reference)) {
            if (given != null && count > 1) throw BadFlag(flag, "one --value to go with it", "$count")
        }
    }

    private fun open(file: Path, choice: LogChoice): SurveyLog {
        val wanted = conditions.toMap() + reference?.let { mapOf(CorrectedLog.REFERENCE to it) }.orEmpty()
        // A sensor that is given or shown by a reference is undone in time: passes alone need places.
        val needsPlace = sensor == null && reference == null
        val own = choice.copy(conditions = wanted, needsPlace = needsPlace)
        val opened = SurveyLog.open(file, own)
        if (reference != null && opened.format.startsWith("Platypus")) {
            throw failure("--reference: expected a CSV log, found a Platypus log")
        }
        if (reference == opened.quantity) {
            throw BadFlag("--reference", "another column than the readings'", "'$reference'")
        }
        return RowsOfTheirOwn.of(opened, own, CorrectedLog.REFERENCE)
    }

    private fun corrected(opened: SurveyLog, spec: SensorSpec?): CorrectedLog {
        val bytes = Files.size(opened.file)
        val shown = !quiet && bytes >= WORTH_SHOWING
        return WorkProgress(terminal, "reading", unit = "B", bytes, shown).use { progress ->
            try {
                CorrectedLog.of(opened, spec, reference != null, conditions.toMap(), progress::advance)
            } catch (wrong: IllegalArgumentException) {
                if (spec == null) throw wrong
                throw SensorFile.unfit(sensor, wrong)
            }
        }
    }

    private fun commandLine(): String = commandLineText(
        "stillwater correct",
        log,
        logOptions.flags() + conditions.map { (name, column) -> "--condition" to "$name=$column" } +
            units.map { "--unit" to it } +
            listOf(
                "--out" to out,
                "--reference" to reference,
                "--sensor" to sensor,
                "--held-out" to heldOut,
                "--between" to between?.let { "${it.start}:${it.endInclusive}" },
            ),
    )

    private companion object {
        /** Smaller files are done before a bar can be read, bytes. */
        const val WORTH_SHOWING = 8_000_000L
    }
}
