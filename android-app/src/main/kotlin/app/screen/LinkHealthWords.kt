package stillwater.app.screen

import android.content.Context
import stillwater.app.R
import stillwater.app.link.BoardReport
import stillwater.app.link.LinkState
import stillwater.app.service.BoatSnapshot

/** One line of the link screen. */
internal class HealthLine(val words: String, val isBad: Boolean = false, val isTitle: Boolean = false)

/** All that there is to say about the health of link, board, position, readings and log. */
internal class LinkHealthWords(private val context: Context) {
    /** The lines for [snapshot]; parts of which nothing is known are left out. */
    fun of(snapshot: BoatSnapshot, rates: LinkRates): List<HealthLine> =
        link(snapshot, rates) + board(snapshot) + position(snapshot) + readings(snapshot, rates) + log(snapshot)

    private fun link(snapshot: BoatSnapshot, rates: LinkRates): List<HealthLine> {
        val link = snapshot.link
        val name = snapshot.linkName ?: return listOf(HealthLine(text(R.string.no_link_chosen)))
        return listOfNotNull(
            HealthLine(
                text(R.string.notification_link, name, text(link.state.words())),
                isBad = link.state == LinkState.WAITING,
                isTitle = true,
            ),
            HealthLine(text(R.string.link_demo)).takeIf { snapshot.isDemo },
            link.quietMillis?.let {
                HealthLine(text(R.string.link_quiet, it / MILLIS_PER_SECOND), isBad = it > LONG_QUIET)
            },
            HealthLine(text(R.string.link_connects, link.connects, link.drops, link.failures)),
            HealthLine(text(R.string.link_bytes, link.bytesIn, link.bytesOut)),
            rates.bytes?.let { HealthLine(text(R.string.link_rate, it)) },
            HealthLine(
                text(R.string.link_dropped, link.bytesOverrun, link.writesDropped),
                isBad = link.bytesOverrun > 0,
            ),
            HealthLine(text(R.string.link_hung, link.writesHung), isBad = true).takeIf { link.writesHung > 0 },
            link.lastError?.let { HealthLine(text(R.string.link_error, it)) },
        )
    }

    private fun board(snapshot: BoatSnapshot): List<HealthLine> {
        if (snapshot.linkName == null) return emptyList()
        val board = snapshot.board
        return listOfNotNull(
            HealthLine(text(R.string.board), isTitle = true),
            HealthLine(text(R.string.board_lines, board.lines, board.malformed, board.refusals)),
            said(board).takeIf { it.isNotEmpty() }?.let { HealthLine(it) },
        )
    }

    /** What the board measured, in the order of its ports' likely use; empty where it said nothing. */
    private fun said(board: BoardReport): String =
        listOfNotNull(
            board.state?.let { text(R.string.board_state, it.word) },
            board.batteryVolts?.let { text(R.string.board_battery, it) },
            board.oxygen?.let { text(R.string.board_oxygen, it) },
            board.acidity?.let { text(R.string.board_acidity, it) },
            board.conductivity?.let { text(R.string.board_conductivity, it) },
            board.celsius?.let { text(R.string.board_temperature, it) },
            board.depth?.let { text(R.string.board_depth, it) },
        ).joinToString()

    private fun position(snapshot: BoatSnapshot): List<HealthLine> {
        val fix = snapshot.fix
        val age = snapshot.fixAgeSeconds
        val fixes = snapshot.fixes
        val gaps = snapshot.gaps
        return listOfNotNull(
            HealthLine(text(R.string.phone), isTitle = true),
            if (fix == null || age == null) {
                HealthLine(text(R.string.no_fix_line))
            } else {
                HealthLine(fixWords(fix.accuracyMetres, age), isBad = snapshot.freshFix == null)
            },
            HealthLine(text(R.string.fix_counts, fixes.received, fixes.jumps, fixes.wide, fixes.refused))
                .takeIf { fixes.received > 0 },
            snapshot.phoneBatteryPercent?.let {
                HealthLine(text(R.string.phone_battery, it), isBad = isLow(it, snapshot))
            },
            HealthLine(text(R.string.gaps, gaps.count, gaps.longestSeconds), isBad = true).takeIf { gaps.count > 0 },
        )
    }

    private fun isLow(percent: Int, snapshot: BoatSnapshot): Boolean =
        snapshot.mission?.spec?.let { percent < it.failsafe.lowestPhonePercent } == true

    private fun fixWords(accuracy: Float?, age: Double): String =
        if (accuracy == null) {
            text(R.string.fix_line_unsure, context.duration(age))
        } else {
            text(R.string.fix_line, accuracy, age)
        }

    private fun readings(snapshot: BoatSnapshot, rates: LinkRates): List<HealthLine> {
        val mission = snapshot.mission ?: return emptyList()
        val counts = mission.counts
        return listOfNotNull(
            HealthLine(text(R.string.readings), isTitle = true),
            HealthLine(text(R.string.readings_taken, counts.received, counts.taken, counts.waiting)),
            rates.readings?.let { HealthLine(text(R.string.readings_rate, it)) },
            mission.probeSilence?.let { HealthLine(text(R.string.probe_silent, context.duration(it)), isBad = true) },
            counts.atBorders.takeIf { it > 0 }?.let { HealthLine(text(R.string.readings_at_borders, it)) },
            HealthLine(
                text(
                    R.string.readings_refused,
                    counts.outOfRange,
                    counts.unconfirmed,
                    counts.withoutPlace,
                    counts.stuck,
                ),
            ),
            HealthLine(text(R.string.readings_unreadable, counts.unreadable)),
            context.givenUpWords(mission.givenUp)?.let { HealthLine(it) },
        )
    }

    private fun log(snapshot: BoatSnapshot): List<HealthLine> {
        val log = snapshot.mission?.log ?: return emptyList()
        return listOfNotNull(
            HealthLine(text(R.string.log), isTitle = true),
            HealthLine(text(if (log.isClosed) R.string.log_closed else R.string.log_open, log.name)),
            HealthLine(text(R.string.log_lines, log.lines, log.written, log.lost), isBad = log.lost > 0),
            log.problem?.let { HealthLine(text(R.string.log_problem, context.logWords(it)), isBad = true) },
        )
    }

    private fun text(id: Int, vararg words: Any): String = context.getString(id, *words)

    private companion object {
        const val MILLIS_PER_SECOND = 1000.0

        /** A board answers several times a second, ms. */
        const val LONG_QUIET = 2_000
    }
}
