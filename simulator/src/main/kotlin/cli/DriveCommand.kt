package stillwater.cli

import com.github.ajalt.clikt.core.Context
import com.github.ajalt.clikt.core.ProgramResult
import com.github.ajalt.clikt.core.terminal
import com.github.ajalt.clikt.parameters.arguments.argument
import com.github.ajalt.clikt.parameters.arguments.help
import com.github.ajalt.clikt.parameters.options.default
import com.github.ajalt.clikt.parameters.options.flag
import com.github.ajalt.clikt.parameters.options.option
import com.github.ajalt.clikt.parameters.options.required
import stillwater.control.Mixing
import stillwater.drive.BoardPhone
import stillwater.drive.DriveRun
import stillwater.drive.DriveStatus
import stillwater.drive.LogOnDisk
import stillwater.drive.MapCautions
import stillwater.drive.MissionDifference
import stillwater.drive.MissionMapFiles
import stillwater.drive.Phone
import stillwater.drive.PhoneChannel
import stillwater.drive.PromptWire
import stillwater.drive.Resumed
import stillwater.drive.Resumption
import stillwater.io.LogProblem
import stillwater.io.MissionFile
import stillwater.link.ReconnectingWire
import stillwater.link.WireAddress
import stillwater.link.WireProblem
import stillwater.mission.LogSink
import stillwater.mission.LogStart
import stillwater.mission.Mission
import stillwater.mission.MissionLog
import stillwater.mission.MissionSpec
import stillwater.mission.RecoveredMission
import stillwater.mission.StopReason
import stillwater.mission.readingsTaken
import stillwater.report.OutputDirectory
import stillwater.report.counted
import stillwater.run.withUnit
import stillwater.wire.ByteLink
import java.nio.file.Path
import java.time.ZonedDateTime
import java.time.format.DateTimeFormatter

/** `stillwater drive`: a mission on a real wire, with a real boat or a virtual one at its other end. */
class DriveCommand : WorkCommand("drive") {
    private val missionFile by argument("MISSION").help("mission (JSON)")
    private val port by option(
        "--port",
        metavar = "PORT",
        help = "the board: /dev/ttyACM0, COM3 or tcp:HOST:PORT",
    ).required()
    private val baud by option("--baud", metavar = "N", help = "of a serial port, bits/s; $USUAL_BAUD unless given")
        .wholeNumber("a whole number within 300..4000000") { it in SLOWEST_BAUD..FASTEST_BAUD }
    private val phoneAddress by option(
        "--phone",
        metavar = "tcp:HOST:PORT",
        help = "a virtual boat's phone channel, for time, fixes and compass; without it time is this machine's, and " +
            "fixes and heading are those of the GPS receiver and the inertial unit on the board",
    )
    private val declination by option(
        "--declination",
        metavar = "DEG",
        help = "of the magnetic from the true north where the boat is, degrees, east positive; " +
            "without --phone only; 0 unless given",
    ).number("an angle within -180..180 degrees") { it in -180.0..180.0 }
    private val vectored by vectoredFlag()
    private val out by option("--out", metavar = "DIR", help = "directory for the log and the map")
        .directory().default("stillwater-drive")
    private val resume by option("--resume", help = "go on with the unfinished mission in DIR, disarmed at first")
        .flag()
    private val yes by option("--yes", help = "begin without asking: motors will run").flag()
    private val numbersOnly by option("--numbers-only", help = "no figure").flag()
    private val quiet by option("--quiet", help = "print nothing but problems").flag()

    override fun help(context: Context) = "Sail a mission with the boat on a serial or TCP port."

    override fun helpEpilog(context: Context) = helpEnd(
        "Enter begins the mission; any line with a word in it, such as `stop`, or Ctrl-C ends it, also before it " +
            "began: the motors rest, the board is disarmed, the log is closed. DIR gets mission.txt " +
            "(mission.txt.incomplete until then), cells.csv and a figure. Exit code 0 when the mission was " +
            "completed, 1 when it ended otherwise or surveyed nothing.",
        listOf(
            "stillwater drive pond.json --port /dev/ttyACM0 --declination -14 --out pond",
            "stillwater drive pond.json --port /dev/pts/3 --phone tcp:127.0.0.1:4002 --yes",
            "stillwater drive pond.json --port /dev/ttyACM0 --out pond --resume",
        ),
    )

    override fun work() {
        val spec = MissionFile.read(Path.of(missionFile)).vectoredWhere(vectored)
        val address =
            WireAddress.parse(port, baud ?: USUAL_BAUD) ?: throw BadFlag("--port", WireAddress.EXPECTED, "'$port'")
        val channel = phoneAddress?.let {
            WireAddress.parse(it, USUAL_BAUD) as? WireAddress.Tcp ?: throw BadFlag("--phone", "tcp:HOST:PORT", "'$it'")
        }
        if (baud != null &&
            address is WireAddress.Tcp
        ) {
            throw BadFlag("--baud", "a serial --port to go with it", "$address")
        }
        if (declination != null && channel != null) {
            throw BadFlag("--declination", "either --declination or --phone, whose compass needs none", "both")
        }
        val directory = Path.of(out)
        refuseOtherLogs(directory)
        val signals = Signals()
        try {
            ReconnectingWire(address.opener(), address.opener().open()).use { wire ->
                // A virtual boat's time begins with its phone: the wire is open by then.
                val phone = channel?.let { PhoneChannel.open(it) } ?: BoardPhone(declination ?: 0.0)
                phone.use { sail(spec, wire, it, directory, signals) }
            }
        } catch (problem: WireProblem) {
            throw failure(problem.message.orEmpty())
        }
    }

    private fun refuseOtherLogs(directory: Path) {
        val unfinished = LogOnDisk.unfinished(directory)
        val finished = LogOnDisk.finished(directory)
        when {
            resume && unfinished == null ->
                throw failure("--resume: expected an unfinished mission in $out, found none")
            !resume && unfinished != null ->
                throw failure("--out: $unfinished is unfinished; --resume goes on with it, another --out begins anew")
            finished != null -> throw failure("--out: expected a directory without a mission, found $finished")
        }
    }

    private fun sail(spec: MissionSpec, wire: ReconnectingWire, phone: Phone, directory: Path, signals: Signals) {
        val resumed = if (resume) recover(spec, directory) else null
        val prompt = PromptWire(wire)
        val link = (phone as? BoardPhone)?.tap(prompt) ?: prompt
        var begun: LogOnDisk? = resumed?.file
        val mission = build(spec, link, { checkNotNull(begun).line(it) }, resumed?.mission)
        // After the mission: one that cannot be built leaves no log that nobody can go on with.
        val file = begun ?: LogOnDisk.begin(directory)
        begun = file
        file.use {
            val status = DriveStatus(terminal, wire, phone, quiet)
            val run = DriveRun(mission, phone, wire, prompt, file, status)
            attendPerson(run, signals)
            val reason = run.sail()
            status.wipe()
            sayWhereTimeWasLost(phone, prompt)
            finish(mission, file, directory, reason)
        }
    }

    private fun build(spec: MissionSpec, link: ByteLink, log: LogSink, recovered: RecoveredMission?) = try {
        Mission(spec, link, MissionLog(log, now(), spec), recovered)
    } catch (unfit: IllegalArgumentException) {
        throw failure("$missionFile: expected a mission that can be sailed, found ${unfit.message}")
    }

    private fun recover(spec: MissionSpec, directory: Path): Resumed {
        val path = checkNotNull(LogOnDisk.unfinished(directory))
        val resumed = LogOnDisk.resume(path) { found ->
            if (found.spec == spec) return@resume
            throw LogProblem(path, null, null, "the mission of $missionFile", otherThan(spec, found.spec))
        }
        val found = resumed.mission
        tell(
            "recovered ${counted(found.readings, "reading")}, ${counted(found.unreadable, "line")} unreadable, " +
                "${counted(resumed.tornBytes, "byte")} of a cut line taken off; the mission was ${found.lastState}",
        )
        return resumed
    }

    /** In what [found] is not [wanted]. */
    private fun otherThan(wanted: MissionSpec, found: MissionSpec): String {
        val mixing = found.boat.mixing
        if (found != wanted.copy(boat = wanted.boat.copy(mixing = mixing))) {
            if (found.name != wanted.name) return "another one, ${found.name}"
            return "another one of the same name, in which ${MissionDifference.words(wanted, found)}"
        }
        // Older versions did not write down that a boat was vectored.
        val then = if (mixing == Mixing.VECTORED) {
            "add --vectored"
        } else {
            "leave --vectored and boat.mixing out if the boat has two fixed thrusters; if it has one that swivels, " +
                "the log is of an older version, which did not note it, and cannot be gone on with: take another --out"
        }
        return "it with boat.mixing ${mixing.name.lowercase()}; $then"
    }

    private fun attendPerson(run: DriveRun, signals: Signals) {
        signals.attend { run.stop() }
        if (yes) return run.start()
        tell("Enter begins the mission: motors will run. Any other line, such as stop, or Ctrl-C ends it, also before")
        val listener = Thread({
            generateSequence { readlnOrNull() }.forEach(run::heed)
            val isNobodyThere = run.heedSilence()
            if (isNobodyThere) echo("standard input has ended: nobody can begin the mission; --yes does", err = true)
        }, "hear the person")
        listener.isDaemon = true
        listener.start()
    }

    private fun finish(mission: Mission, file: LogOnDisk, directory: Path, reason: StopReason?) {
        file.missing()?.let { echo("warning: $it", err = true) }
        // The map comes first: a log that claims to be complete without it would not be gone on with.
        val warnings = OutputDirectory(directory).use {
            val missing = MissionMapFiles.write(it, mission.spec, mission.map, !numbersOnly)
            it.commit()
            MapCautions.of(mission) + missing
        }
        // A mission that was taken up again and not begun is as unfinished as it was.
        val isUnfinished = reason == null && resume
        val log = if (isUnfinished) LogOnDisk.unfinished(directory) else file.complete()
        for (warning in warnings) echo("warning: $warning", err = true)
        val still = if (isUnfinished) ", still to be resumed" else ""
        val why = reason?.name?.lowercase() ?: "stopped before it began$still"
        val borders = if (mission.unplaced > 0) " (${mission.unplaced} at borders, of no cell)" else ""
        val quantity = mission.spec.probe.quantity.withUnit
        val readings = "${counted(mission.readingsTaken, "reading")} of $quantity${Resumption.of(mission)}$borders"
        tell("$why; $readings, ${mission.readings.leftOut} left out; log $log")
        if (reason != StopReason.COMPLETED || MapCautions.hasSurveyedNothing(mission)) throw ProgramResult(1)
    }

    /** Readings that the mission took for earlier or later than they were make its map worse. */
    private fun sayWhereTimeWasLost(phone: Phone, prompt: PromptWire) {
        if (phone.timesAlone > 0) {
            val said = "the phone's channel was silent or lost ${counted(phone.timesAlone, "time")}"
            echo("warning: $said; the mission's time went on by itself, and the map may be wrong there", err = true)
        }
        if (prompt.timesLate > 0) {
            val said = "what the board sent came late or not at all ${counted(prompt.timesLate, "time")}"
            echo("warning: $said; the map may be wrong there", err = true)
        }
    }

    private fun tell(text: String) {
        if (!quiet) echo(text)
    }

    private fun now() = ZonedDateTime.now().let {
        LogStart(it.toInstant().toEpochMilli(), it.format(DateTimeFormatter.ofPattern("yyyy-MM-dd HH:mm:ss ZZZZZ")))
    }

    private companion object {
        const val USUAL_BAUD = 115_200
        const val SLOWEST_BAUD = 300
        const val FASTEST_BAUD = 4_000_000
    }
}
