package stillwater.cli

import com.github.ajalt.clikt.core.Context
import com.github.ajalt.clikt.parameters.arguments.argument
import com.github.ajalt.clikt.parameters.arguments.help
import com.github.ajalt.clikt.parameters.options.convert
import com.github.ajalt.clikt.parameters.options.default
import com.github.ajalt.clikt.parameters.options.flag
import com.github.ajalt.clikt.parameters.options.option
import stillwater.io.LogContent
import stillwater.io.LogProblem
import stillwater.io.MissionFile
import stillwater.io.PlatypusVersion
import stillwater.io.SensorChoice
import stillwater.replay.LineSpool
import stillwater.replay.OwnLogReplay
import stillwater.replay.PlatypusReplay
import stillwater.replay.ReplayFiles
import stillwater.replay.Replayed
import stillwater.report.EarlierResults
import stillwater.report.OutputDirectory
import java.nio.file.Path

/** `stillwater replay`: a recorded log through the mission once more. */
class ReplayCommand : WorkCommand("replay") {
    private val log by argument("LOG").help("log of a mission, or a Platypus log (4.0.0, 4.1.0, 4.2.0)")
    private val mission by option(
        "--mission",
        metavar = "FILE",
        help = "mission (JSON) to replay in place of the log's own; a Platypus log has none, and without this flag " +
            "one is made around it",
    )
    private val value by option(
        "--value",
        metavar = "SENSOR",
        help = "Platypus logs: the sensor whose readings become the map, TYPE[#CHANNEL][.FIELD], such as ATLAS_DO or " +
            "ES2.temp; the one with the most without it",
    ).convert { text -> SensorChoice.parse(text) ?: throw BadFlag(name, "TYPE[#CHANNEL][.FIELD]", "'$text'") }
    private val out by option("--out", metavar = "DIR", help = "directory for the results")
        .directory().default("stillwater-replay")
    private val numbersOnly by option("--numbers-only", help = "no figure").flag()
    private val quiet by option("--quiet", help = "no summary and no warnings").flag()
    private val json by option("--json", help = "print replay.json instead of a summary").flag()

    override fun help(context: Context) = "Feed a recorded log through the mission: same estimator, same safety gate."

    override fun helpEpilog(context: Context) = helpEnd(
        "Writes cells.csv (the map, exact), decisions.csv (every change of state), replay.json (with a count of " +
            "every line not understood), mission.json (what was replayed), mission.txt (the replay's own log) and a " +
            "figure. A mission's own log is replayed bit for bit.",
        listOf(
            "stillwater replay stillwater-drive/mission.txt",
            "stillwater replay pond/mission.txt --mission other-estimator.json --out what-if",
            "stillwater replay platypus_20160519_013623.txt --out platypus",
            "stillwater replay platypus_20160519_013623.txt --value ES2.temp",
        ),
    )

    override fun work() {
        val spec = mission?.let { MissionFile.read(Path.of(it)) }
        val content = LogContent.of(Path.of(log))
        val version = content.platypus ?: throw LogProblem(
            content.file,
            null,
            null,
            "a mission's log or a Platypus log",
            "neither",
        )
        val isOwn = version == PlatypusVersion.LEVEL_JSON && content.head.any { SPEC in it }
        if (value != null && (isOwn || spec != null)) {
            throw BadFlag("--value", "it with a Platypus log and without --mission, whose probe counts", "'$value'")
        }
        requireNoOtherMission(Path.of(out), MARK)
        val earlier = EarlierResults(commandName, mark = MARK to "steps_with_motors_running")
        OutputDirectory(Path.of(out), listOfNotNull(log, mission).map { Path.of(it) }, earlier).use { directory ->
            LineSpool().use { own ->
                val replayed = if (isOwn) {
                    OwnLogReplay(content, spec, own).run()
                } else {
                    PlatypusReplay(content, version, spec, own, value).run()
                }
                write(replayed, directory)
            }
        }
    }

    private fun write(replayed: Replayed, directory: OutputDirectory) {
        val files = ReplayFiles(replayed)
        val warnings = files.warnings + files.write(directory, !numbersOnly)
        val written = directory.commit()
        when {
            json -> echo(files.json().trimEnd())
            !quiet -> {
                files.lines().forEach { echo(it) }
                for (warning in warnings) echo("warning: $warning", err = true)
                echo(wrote(written, out), err = true)
            }
        }
    }

    private companion object {
        /** File of results that no other command writes. */
        const val MARK = "replay.json"

        /** In the first line of a mission's own log. */
        const val SPEC = "\"spec\":{"
    }
}
