package stillwater.cli

import com.github.ajalt.clikt.core.Context
import com.github.ajalt.clikt.core.terminal
import com.github.ajalt.clikt.parameters.arguments.argument
import com.github.ajalt.clikt.parameters.arguments.help
import com.github.ajalt.clikt.parameters.groups.provideDelegate
import com.github.ajalt.clikt.parameters.options.default
import com.github.ajalt.clikt.parameters.options.flag
import com.github.ajalt.clikt.parameters.options.option
import stillwater.io.MissionFile
import stillwater.mission.MissionSpec
import stillwater.mission.Quantity
import stillwater.report.OutputDirectory
import stillwater.simulation.Film
import stillwater.simulation.LiveView
import stillwater.simulation.MissionRun
import stillwater.simulation.SimulationFiles
import stillwater.simulation.SimulationResult
import java.nio.file.Path

/** `stillwater simulate`: one whole mission in closed loop with a virtual boat. */
class SimulateCommand : WorkCommand("simulate") {
    private val missionFile by argument("MISSION").help("mission (JSON); docs/missions has examples")
    private val out by option(
        "--out",
        metavar = "DIR",
        help = "directory for the results",
    ).directory().default("stillwater-simulate")
    private val boat by VirtualBoatOptions()
    private val longest by option(
        "--longest",
        metavar = "S",
        help = "virtual time after which to end a mission that is not over, s; without it twice its budget and " +
            "600 s, at most 1000000 s",
    ).number("a number within 1..1000000") { it in 1.0..MOST_TIME }
    private val headless by option("--headless", help = "do not show the mission as it runs, even in a terminal").flag()
    private val speed by option("--speed", metavar = "X", help = "virtual seconds shown a second, in a terminal (60)")
        .number("a number within 0.1..10000") { it in SLOWEST..FASTEST }
    private val quiet by option(
        "--quiet",
        help = "show nothing, print no summary and no warnings; the report has these",
    ).flag()
    private val json by option("--json", help = "print the summary as JSON").flag()

    override fun help(context: Context) = "Run a whole mission with a virtual boat, in virtual time."

    override fun helpEpilog(context: Context) = helpEnd(
        "Writes mission.txt (the mission's log, which map, diagnose and correct read), cells.csv, summary.json, " +
            "animation.html (which plays the run), figures as SVG and PNG, and report.html into DIR.",
        listOf(
            "stillwater simulate docs/missions/ten-by-ten.json --probe-period 1",
            "stillwater simulate pond.json --field smooth --current 0.2,0.1 --wind 3,0",
            "stillwater simulate pond.json --link-loss 0.001 --seed 7",
            "stillwater simulate bay.json --sensor docs/sensors/noisy-two-path.json",
        ),
    )

    override fun work() {
        if (speed != null) requireShown()
        val mission = boat.mission(MissionFile.read(Path.of(missionFile)))
        requireVirtualProbe(mission)
        val most = longest ?: minOf(MissionRun.longest(mission), MOST_TIME)
        val settings = boat.settings()
        requireNoOtherMission(Path.of(out), "summary.json")
        OutputDirectory(Path.of(out), listOf(Path.of(missionFile))).use { directory ->
            val isShown = !headless && !quiet && !json && terminal.terminalInfo.outputInteractive
            val result = directory.stream("mission.txt") { log ->
                val run = MissionRun(mission, settings) { log.write((it + "\n").toByteArray()) }
                val film = Film(run, minOf(most, MissionRun.expected(mission)))
                val view = if (isShown) LiveView(terminal, run, speed ?: DEFAULT_SPEED) else null
                WorkProgress(terminal, "simulating", "s", most.toLong(), !isShown && !quiet).use { progress ->
                    while (!run.isOver && run.time.seconds < most) {
                        run.step()
                        film.watch()
                        view?.watch()
                        progress.advance(run.time.seconds.toLong())
                    }
                }
                view?.end()
                film.end()
                SimulationResult(run, film, most)
            }
            val files = SimulationFiles(result, commandLine())
            val drawing = files.write(directory)
            val written = directory.commit()
            when {
                json -> echo(files.json().trimEnd())
                !quiet -> {
                    files.summary.facts.forEach { (name, value) -> echo("$name: $value") }
                    for (warning in files.summary.warnings + drawing) echo("warning: $warning", err = true)
                    echo(wrote(written, out, "animation.html"))
                }
            }
        }
    }

    /** Refuses a speed of what is not shown. */
    private fun requireShown() {
        val hides = listOf("--headless" to headless, "--quiet" to quiet, "--json" to json).firstOrNull { it.second }
        if (hides != null) throw BadFlag("--speed", "a mission that is shown as it runs", hides.first)
    }

    private fun requireVirtualProbe(mission: MissionSpec) {
        val probe = mission.probe
        val expected = "dissolved-oxygen on port 1 or any, which is what the virtual boat has"
        if (probe.quantity != Quantity.DISSOLVED_OXYGEN) {
            throw failure("$missionFile: probe.quantity: expected $expected, found ${probe.quantity.name.lowercase()}")
        }
        if (probe.port != null && probe.port != 1) {
            throw failure("$missionFile: probe.port: expected $expected, found ${probe.port}")
        }
    }

    private fun commandLine(): String = commandLineText(
        "stillwater simulate",
        missionFile,
        boat.flags() + listOf("--longest" to longest, "--out" to out),
    )

    private companion object {
        const val MOST_TIME = 1e6
        const val SLOWEST = 0.1
        const val FASTEST = 10_000.0
        const val DEFAULT_SPEED = 60.0
    }
}
