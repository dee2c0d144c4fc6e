package stillwater.drive

import com.github.ajalt.mordant.terminal.Terminal
import stillwater.control.Danger
import stillwater.link.ReconnectingWire
import stillwater.mission.Mission
import stillwater.mission.MissionState
import stillwater.mission.readingsTaken
import stillwater.model.BoatTime
import stillwater.report.SignificantDigits
import stillwater.report.counted
import stillwater.run.label
import stillwater.wire.Malformed
import java.util.Locale
import kotlin.math.ceil

/**
 * Shows a mission under way: a line that stays up to date where somebody watches the terminal, else a line at each
 * change of state and every minute of the boat's time, and before the boat moves also when it waits for something else,
 * every 5 s at most.
 */
internal class DriveStatus(
    private val terminal: Terminal,
    private val wire: ReconnectingWire,
    private val phone: Phone,
    private val isQuiet: Boolean,
) : DriveWatcher {
    private val isLive = terminal.terminalInfo.outputInteractive
    private var shownAt = 0L
    private var shownTime = 0.0
    private var shownWaiting = emptyList<String>()

    override fun changed(mission: Mission, time: BoatTime) {
        if (isQuiet) return
        wipe()
        terminal.println(line(mission, time))
        shownTime = time.seconds
        shownWaiting = kinds(mission, time)
    }

    override fun stepped(mission: Mission, time: BoatTime) {
        if (isQuiet) return
        val now = System.nanoTime()
        if (isLive) {
            if (now - shownAt < LIVE_NANOS) return
            shownAt = now
            wipe()
            terminal.rawPrint(line(mission, time).take(room()))
        } else if (time.seconds - shownTime >= MINUTE || waitsForOther(mission, time)) {
            changed(mission, time)
        }
    }

    /** How much of a line fits on the terminal, characters; a width of 0 is that of one that does not know its own. */
    private fun room() = (if (terminal.size.width > 0) terminal.size.width else USUAL_WIDTH) - 1

    private fun waitsForOther(mission: Mission, time: BoatTime) =
        time.seconds - shownTime >= PAUSE && kinds(mission, time) != shownWaiting

    /** What is waited for, without how long. */
    private fun kinds(mission: Mission, time: BoatTime) = Waiting.of(mission, time).map { it.filterNot(Char::isDigit) }

    /** Leaves the line that stays up to date. */
    fun wipe() {
        if (isLive && !isQuiet) terminal.rawPrint("\r\u001b[K")
    }

    private fun line(mission: Mission, time: BoatTime): String {
        val state = mission.state
        val why = when (state) {
            is MissionState.Holding -> " (${words(
                state.danger.name,
            )}${if (state.danger == Danger.HELD_UP) rest(mission) else ""})"
            is MissionState.Returning -> " (${words(state.danger.name)})"
            is MissionState.Stopped -> " (${words(state.reason.name)})"
            else -> Waiting.of(mission, time).takeIf { it.isNotEmpty() }?.joinToString("; ", " (", ")").orEmpty()
        }
        val map = mission.map
        val known = (0 until map.grid.size).count { map.readings(it) > 0 }
        val parts = listOf(
            "%7.1f s  %s%s".format(Locale.ROOT, time.seconds, state.word, why),
            // Early in the line: what does not fit on the terminal is cut off.
            silence(mission),
            mission.position?.let { "at %.1f, %.1f m".format(Locale.ROOT, it.x, it.y) } ?: "place unknown",
            "$known of ${counted(map.grid.size, "cell")}, ${counted(mission.readingsTaken, "reading")}",
            if (mission.board.volts.isNaN()) "" else "${VOLTS.format(mission.board.volts)} V",
            mission.run { givenUpCells.size + givenUpOffMap.size }
                .let { if (it > 0) "${counted(it, "cell")} given up" else "" },
            trouble(mission),
            phone.trouble(),
        )
        return parts.filter { it.isNotEmpty() }.joinToString(", ")
    }

    /** When a boat that was held up on every way home tries again. */
    private fun rest(mission: Mission): String {
        val seconds = mission.restsFor
        return if (seconds > 0) " on every way home, tries again in ${ceil(seconds / MINUTE).toInt()} min" else ""
    }

    /** A port that is not named, or a cable that came off, must not show only when the survey is over. */
    private fun silence(mission: Mission): String {
        if (!(mission.probeSilence > LONGEST_SILENCE)) return ""
        val probe = mission.spec.probe
        val port = probe.port?.let { " on port $it" }.orEmpty()
        return "no ${probe.quantity.label}$port for ${mission.probeSilence.toInt()} s"
    }

    private fun trouble(mission: Mission): String {
        val board = mission.board
        val bad = Malformed.entries.filter { board.malformed(it) > 0 }
            .joinToString(" ") { "${words(it.name)} ${board.malformed(it)}" }
        return listOf(
            if (wire.isOpen) "" else "wire lost",
            if (wire.losses > 0) "lost ${counted(wire.losses, "time")}" else "",
            if (bad.isEmpty()) "" else "unreadable: $bad",
            if (board.refusals > 0) "${counted(board.refusals, "command")} refused" else "",
            if (board.unsent > 0) "${counted(board.unsent, "write")} not sent" else "",
        ).filter { it.isNotEmpty() }.joinToString(", ")
    }

    private fun words(name: String) = name.lowercase().replace('_', ' ')

    private companion object {
        const val LIVE_NANOS = 250_000_000L
        const val MINUTE = 60.0
        const val USUAL_WIDTH = 80

        /** Between two lines on what is waited for, s. */
        const val PAUSE = 5.0

        /** Five times what the slowest firmware takes for a reading, s. */
        const val LONGEST_SILENCE = 15.0
        val VOLTS = SignificantDigits(3)
    }
}
