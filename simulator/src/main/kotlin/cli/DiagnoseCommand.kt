package stillwater.cli

import com.github.ajalt.clikt.core.Context
import com.github.ajalt.clikt.core.terminal
import com.github.ajalt.clikt.parameters.arguments.argument
import com.github.ajalt.clikt.parameters.arguments.help
import com.github.ajalt.clikt.parameters.groups.provideDelegate
import com.github.ajalt.clikt.parameters.options.default
import com.github.ajalt.clikt.parameters.options.flag
import com.github.ajalt.clikt.parameters.options.multiple
import com.github.ajalt.clikt.parameters.options.option
import kotlinx.coroutines.runBlocking
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnosis.AT_ONCE
import stillwater.diagnosis.Diagnosed
import stillwater.diagnosis.DiagnosisFiles
import stillwater.diagnosis.DiagnosisJson
import stillwater.diagnosis.DiagnosisLog
import stillwater.diagnosis.MapWorth
import stillwater.diagnosis.RowsOfTheirOwn
import stillwater.io.SurveyLog
import stillwater.report.EarlierResults
import stillwater.report.OutputDirectory
import stillwater.sensor.SensorSpec
import java.nio.file.Path

/** `stillwater diagnose`: what the simulation gets wrong about a log, by name, with an extended sensor and the gain. */
class DiagnoseCommand : WorkCommand("diagnose") {
    private val log by argument("LOG").help("survey CSV, Sea-Bird .cnv or Platypus log")
    private val out by option("--out", metavar = "DIR", help = "directory for the results")
        .directory().default("stillwater-diagnosis")
    private val logOptions by LogOptions()
    private val reference by option(
        "--reference",
        metavar = "COLUMN",
        help = "column with the truth up to noise: a fast sensor, or known samples on a bench",
    )
    private val conditions by conditions(
        "further quantity; speed (m/s), temperature (degrees Celsius) and heading are looked at as such. Headings " +
            "are degrees if the column's name says so (heading_deg) or one is beyond a full turn of radians, and " +
            "radians if not. Repeatable",
    )
    private val compare by option(
        "--compare",
        metavar = "COLUMN",
        help = "another channel of the same boat: what it and the readings lag alike is antenna, receiver or clock, " +
            "not the sensor. Repeatable; costs as much again for each",
    ).multiple()
    private val sensor by option(
        "--sensor",
        metavar = "FILE",
        help = "sensor spec (JSON) as it is believed to be, taken as given; without a --reference its time constant " +
            "alone is looked at. Without this a first-order lag is fitted",
    )
    private val unit by option("--unit", metavar = "TEXT", help = "unit of the readings, for figures and tables").unit()
    private val numbersOnly by option(
        "--numbers-only",
        help = "no figures, no report and no comparison of maps",
    ).flag()
    private val quiet by option(
        "--quiet",
        help = "no progress bar, no summary and no warnings; the report has these",
    ).flag()
    private val json by option("--json", help = "print diagnosis.json instead of a summary").flag()

    override fun help(context: Context) = "Find out what the simulation gets wrong about a log, and name the cause."

    override fun helpEpilog(context: Context) = helpEnd(
        "Writes diagnosis.json, extended-sensor.json (where something was named), residuals.csv, figures as SVG and " +
            "PNG, and report.html into DIR. Any honest verdict ends with exit code 0.",
        listOf(
            "stillwater diagnose a.csv --value slow --reference fast --condition speed=mps",
            "stillwater diagnose a.csv --value probe --reference sample --sensor b.json",
            "stillwater diagnose survey.csv --value odo_percent_sat --out lake --json",
            "stillwater diagnose survey.csv --value odo_percent_sat --compare temp_c",
        ),
    )

    override fun work() {
        val given = sensor?.let { SensorFile.read(it) }
        val wanted = conditions.toMap() + listOfNotNull(reference?.let { DiagnosisLog.REFERENCE to it }) +
            compare.map { DiagnosisLog.compared(it) to it }
        // What the sensor has seen where its reading is missing a reference knows.
        // Beside a reference the probe need not have been anywhere: on a bench it is put from one sample into another.
        val choice = logOptions.choice().copy(
            conditions = wanted,
            needsPlace = reference == null,
            keepsUnread = reference != null,
        )
        val opened = SurveyLog.open(Path.of(log), choice)
        val others = compare.map { Triple("--compare", it, it) } +
            conditions.map { (name, column) -> Triple("--condition", column, "$name=$column") } +
            listOfNotNull(reference).map { Triple("--reference", it, it) }
        others.firstOrNull { it.second == opened.quantity }?.let { (flag, _, given) ->
            throw BadFlag(flag, "another column than the readings'", "'$given'")
        }
        requireNoMission(Path.of(out))
        val earlier = EarlierResults(commandName, mark = "diagnosis.json" to "verdict")
        OutputDirectory(Path.of(out), listOfNotNull(log, sensor).map { Path.of(it) }, earlier).use { directory ->
            val own = RowsOfTheirOwn.of(opened, choice, DiagnosisLog.REFERENCE)
            val read = DiagnosisLog.of(own, conditions.toMap(), reference, compare.distinct())
            val shown = !quiet && !json
            val result = WorkProgress(terminal, "weighing causes", unit = "%", WHOLE, shown).use { progress ->
                diagnosis(read, given) { progress.advance((it * WHOLE).toLong()) }.run()
            }
            val isShown = shown && read.isCompared
            val channels = WorkProgress(terminal, "comparing channels", unit = "%", WHOLE, isShown).use { progress ->
                read.channels(result) { progress.advance((it * WHOLE).toLong()) }
            }
            val diagnosed = Diagnosed(read, result, worth(read, result), isGiven(given, result), channels, unit)
            val drawing = DiagnosisFiles(diagnosed, commandLine(), own, numbersOnly).write(directory)
            val written = directory.commit()
            when {
                json -> echo(DiagnosisJson.text(diagnosed).trimEnd())
                !quiet -> {
                    diagnosed.lines().forEach { echo(it) }
                    for (warning in diagnosed.warnings + drawing) echo("warning: $warning", err = true)
                    echo(wrote(written, out, if (numbersOnly) "diagnosis.json" else "report.html"), err = true)
                }
            }
        }
    }

    private fun diagnosis(read: DiagnosisLog, given: SensorSpec?, progress: (Double) -> Unit) = try {
        Diagnosis(read.series, DiagnosisSettings(base = given), AT_ONCE, progress)
    } catch (wrong: IllegalArgumentException) {
        throw failure("--sensor $sensor: ${wrong.message}")
    }

    /** Whether the base is the sensor given: one that could not be used stands for nothing. */
    private fun isGiven(given: SensorSpec?, result: DiagnosisResult) = given != null && result.baseSensor == given

    private fun worth(read: DiagnosisLog, result: DiagnosisResult): MapWorth? {
        // Where the base itself was named there are no two models to compare.
        val isOther = result.extended !== result.baseline
        val extended = result.extendedSensor?.takeIf { isOther && !numbersOnly } ?: return null
        val truth = if (reference != null) read.columns.reference else read.columns.values
        val threads = Runtime.getRuntime().availableProcessors()
        return runBlocking { MapWorth.of(result.baseSensor, extended, truth.min(), truth.max(), threads) }
    }

    private fun commandLine(): String {
        val own = listOf("--reference" to reference) +
            conditions.map { (name, column) -> "--condition" to "$name=$column" } +
            compare.map { "--compare" to it } +
            listOf("--sensor" to sensor, "--unit" to unit, "--out" to out, "--numbers-only" to numbersOnly)
        return commandLineText("stillwater diagnose", log, logOptions.flags() + own)
    }

    private companion object {
        /** Progress is told in per cent. */
        const val WHOLE = 100L
    }
}
