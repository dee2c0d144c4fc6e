package stillwater.cli

import com.github.ajalt.clikt.core.Context
import com.github.ajalt.clikt.parameters.arguments.argument
import com.github.ajalt.clikt.parameters.arguments.help
import com.github.ajalt.clikt.parameters.groups.provideDelegate
import com.github.ajalt.clikt.parameters.options.RawOption
import com.github.ajalt.clikt.parameters.options.convert
import com.github.ajalt.clikt.parameters.options.default
import com.github.ajalt.clikt.parameters.options.flag
import com.github.ajalt.clikt.parameters.options.option
import stillwater.boatserver.BoatServer
import stillwater.boatserver.PhoneServer
import stillwater.io.MissionFile
import stillwater.link.PseudoTerminal
import stillwater.link.ServedWire
import stillwater.link.TcpServedWire
import stillwater.link.WireProblem
import stillwater.mission.ProbeSpec
import stillwater.mission.Quantity
import stillwater.report.CsvTable
import stillwater.report.OutputDirectory
import stillwater.report.counted
import stillwater.world.SimulatedConditions
import stillwater.world.VirtualWorld
import stillwater.world.WorldSite
import java.nio.file.Path
import kotlin.math.roundToLong

/** `stillwater virtual-boat`: a boat that is not there, on a wire that is. */
class VirtualBoatCommand : WorkCommand("virtual-boat") {
    private val mission by argument("MISSION")
        .help("mission (JSON): where the boat lies, and over which cells the water")
    private val boat by VirtualBoatOptions()
    private val pty by option("--pty", help = "the board on a pseudo-terminal, as if on a serial port (Linux)").flag()
    private val tcp by option("--tcp", metavar = "PORT", help = "the board on this TCP port; 0 for any that is free")
        .port()
    private val phonePort by option("--phone-port", metavar = "PORT", help = "TCP port of the phone's channel").port()
        .default(0, defaultForHelp = "any that is free")
    private val host by option("--host", metavar = "HOST", help = "address to listen on; 0.0.0.0 for the whole network")
        .default("127.0.0.1")
    private val speed by option("--speed", metavar = "N", help = "the boat's seconds in one of the wall's")
        .number("a number within 0.1..1000") { it in SLOWEST..FASTEST }.default(1.0)
    private val duration by option("--for", metavar = "S", help = "end after so many of the boat's seconds")
        .number("a number above 0") { it > 0 }.default(Double.POSITIVE_INFINITY, defaultForHelp = "never")
    private val once by option("--once", help = "end when the program that came has left").flag()
    private val out by option("--out", metavar = "DIR", help = "directory for the truth, written at the end")
        .directory()

    override fun help(context: Context) = "Serve a virtual boat's electronics on a pseudo-terminal or a TCP port."

    override fun helpEpilog(context: Context) = helpEnd(
        "The first line printed is where the board is, the second where the phone's channel is: what `stillwater " +
            "drive` takes as --port and --phone. The boat's time begins when they are opened; opening the board's " +
            "resets it. Ctrl-C ends it. With --out, truth.csv has the water at each cell's centre and the cell's mean.",
        listOf(
            "stillwater virtual-boat pond.json --pty",
            "stillwater virtual-boat pond.json --tcp 4001 --phone-port 4002 --speed 60",
            "stillwater virtual-boat pond.json --tcp 4001 --wind 3,0 --link-loss 0.001",
        ),
    )

    override fun work() {
        if (pty == (tcp != null)) {
            throw failure("expected one of --pty and --tcp PORT, found ${if (pty) "both" else "neither"}")
        }
        val spec = boat.mission(MissionFile.read(Path.of(mission)))
        requireProbe(spec.probe)
        // Written at the end: where it cannot be, nobody wants to sail for hours first.
        out?.let { OutputDirectory(Path.of(it)).close() }
        val world = VirtualWorld(boat.settings(), WorldSite.of(spec))
        SimulatedConditions.missing(world.sensor)?.let { echo("warning: $it", err = true) }
        try {
            (if (pty) PseudoTerminal() else TcpServedWire(host, checkNotNull(tcp))).use { wire ->
                PhoneServer(TcpServedWire(host, phonePort)).use { phone -> serve(world, wire, phone) }
            }
        } catch (problem: WireProblem) {
            throw failure(problem.message.orEmpty())
        }
    }

    private fun requireProbe(probe: ProbeSpec) {
        val isThere = probe.quantity == Quantity.DISSOLVED_OXYGEN && (probe.port == null || probe.port == 1)
        if (isThere) return
        val found = "${probe.quantity.name.lowercase().replace('_', '-')} on port ${probe.port ?: "any"}"
        throw failure("$mission: probe: expected dissolved-oxygen on port 1, which the virtual boat has, found $found")
    }

    private fun serve(world: VirtualWorld, wire: ServedWire, phone: PhoneServer) {
        val server = BoatServer(world, wire, phone, speed)
        Signals().attend { server.stop() }
        // Programs read these lines through a pipe and wait for them.
        println("board ${wire.address}")
        println("phone ${phone.address}")
        System.out.flush()
        server.serve(duration, once)
        out?.let { write(it, world) }
        val unanswered = "${counted(phone.unanswered, "time")} without an answer from the phone's program"
        val bad = listOfNotNull(
            "${counted(wire.untaken, "byte")} that nobody took".takeIf { wire.untaken > 0 },
            unanswered.takeIf { phone.unanswered > 0 },
            "${phone.unreadable} of its lines unreadable".takeIf { phone.unreadable > 0 },
            "fell behind the asked speed ${counted(server.slips, "time")}".takeIf { server.slips > 0 },
        )
        val seconds = (world.time.seconds * TENTHS).roundToLong() / TENTHS
        echo("$seconds s of the boat's time, openings: ${wire.openings}" + bad.joinToString("") { ", $it" })
    }

    private fun write(directory: String, world: VirtualWorld) = OutputDirectory(Path.of(directory)).use { files ->
        files.stream("truth.csv") { stream ->
            CsvTable(stream, listOf("cell", "x_m", "y_m", "centre", "mean")).use { table ->
                val grid = world.site.grid
                for (cell in 0 until grid.size) {
                    val centre = world.truthAtCentre(cell)
                    table.row(cell, grid.centerX(cell), grid.centerY(cell), centre, world.meanTruth(cell))
                }
            }
        }
        files.commit()
    }

    private companion object {
        const val SLOWEST = 0.1
        const val FASTEST = 1000.0
        const val TENTHS = 10.0
    }
}

/** A TCP port, 0 to 65535. */
internal fun RawOption.port() = convert { text ->
    text.toIntOrNull()?.takeIf { it in 0..LAST_PORT } ?: throw BadFlag(name, "a port in 0..$LAST_PORT", "'$text'")
}

private const val LAST_PORT = 65535
