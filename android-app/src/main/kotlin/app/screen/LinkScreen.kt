package stillwater.app.screen

import android.content.Context
import android.widget.LinearLayout
import android.widget.ScrollView
import android.widget.TextView
import stillwater.app.R
import stillwater.app.link.BluetoothTransport
import stillwater.app.link.BoardReport
import stillwater.app.link.LinkChoice
import stillwater.app.link.LinkState
import stillwater.app.link.SerialDrivers
import stillwater.app.service.BoatActivity
import stillwater.app.service.BoatSnapshot
import stillwater.app.service.PreflightCheck

/**
 * The link and its health, what it can be connected to, and the checklist before a start.
 *
 * @param onConnect called with what was chosen. [onAllow] and [onExempt] are for what Android has to ask.
 */
internal class LinkScreen(
    context: Context,
    private val onConnect: (LinkChoice) -> Unit,
    private val onAllow: () -> Unit,
    private val onExempt: () -> Unit,
) : ScrollView(context) {
    private val state = context.heading("").apply { id = R.id.state }
    private val lines = List(HEALTH_LINES) { context.line("") }
    private val choices = column()
    private val checks = PreflightCheck.entries.associateWith { context.line("") }
    private val allow = context.largeButton(context.getString(R.string.allow), onAllow).apply { id = R.id.allow }
    private val exempt = context.largeButton(context.getString(R.string.exempt_button), onExempt)
    private var offered: List<LinkChoice>? = null

    init {
        val all = column()
        val gap = resources.getDimensionPixelSize(R.dimen.gap)
        all.setPadding(gap, 0, gap, gap)
        all.below(state)
        lines.forEach(all::below)
        all.below(context.heading(context.getString(R.string.preflight)))
        checks.values.forEach(all::below)
        all.below(allow)
        all.below(exempt)
        all.below(context.heading(context.getString(R.string.choose_link)))
        all.below(choices)
        addView(all)
    }

    /** Shows [snapshot]. [refusedForGood]: Android asks no more, only its settings help. */
    fun show(snapshot: BoatSnapshot, refusedForGood: Boolean) {
        state.text = listOfNotNull(context.getString(snapshot.activity.words()), snapshot.refusal).joinToString(": ")
        healthLines(snapshot).forEachIndexed { index, words ->
            lines[index].text = words
            lines[index].visibility = if (words.isEmpty()) GONE else VISIBLE
        }
        val lost = snapshot.link.state == LinkState.WAITING
        lines[0].setTextColor(context.getColor(if (lost) R.color.bad else R.color.text))
        val ready = snapshot.preflight.associate { it.check to it.ready }
        for ((check, line) in checks) line.show(context.getString(check.words()), ready[check] == true)
        allow.visibility = if (ready[PreflightCheck.PERMISSIONS] == true) GONE else VISIBLE
        allow.text = context.getString(if (refusedForGood) R.string.allow_in_settings else R.string.allow)
        exempt.visibility = if (ready[PreflightCheck.BATTERY_SAVER] == true) GONE else VISIBLE
    }

    /** Offers what there is to connect to now. */
    fun offer() {
        val paired =
            BluetoothTransport.paired(context).map { LinkChoice.Bluetooth(it.address, nameOf(it.name, it.address)) }
        val usb = if (SerialDrivers.areBuiltIn()) listOf(LinkChoice.Usb) else emptyList()
        val now: List<LinkChoice> = paired + usb + LinkChoice.Demo
        if (now == offered) return
        offered = now
        choices.removeAllViews()
        if (paired.isEmpty()) choices.below(context.line(context.getString(R.string.no_paired)))
        for (choice in now) {
            val name =
                when (choice) {
                    is LinkChoice.Bluetooth -> choice.name
                    is LinkChoice.Usb -> context.getString(R.string.usb_serial)
                    is LinkChoice.Demo -> context.getString(R.string.demo)
                }
            choices.below(context.largeButton(context.getString(R.string.connect_to, name)) { onConnect(choice) })
        }
        if (LinkChoice.Usb !in now) choices.below(context.line(context.getString(R.string.usb_not_built_in)))
    }

    private fun nameOf(name: String?, address: String) = name ?: address

    private fun healthLines(snapshot: BoatSnapshot): List<String> {
        val link = snapshot.link
        val name = snapshot.linkName
        val fix = snapshot.fix
        return listOf(
            name?.let { context.getString(R.string.notification_link, it, context.getString(link.state.words())) },
            link.quietMillis?.let { context.getString(R.string.link_quiet, it / MILLIS_PER_SECOND) },
            name?.let { context.getString(R.string.link_connects, link.connects, link.drops, link.failures) },
            name?.let { context.getString(R.string.link_bytes, link.bytesIn, link.bytesOut) },
            name?.let { context.getString(R.string.link_dropped, link.bytesOverrun, link.writesDropped) },
            name?.let {
                context.getString(
                    R.string.board_lines,
                    snapshot.board.lines,
                    snapshot.board.malformed,
                    snapshot.board.refusals,
                )
            },
            boardLine(snapshot.board),
            link.lastError?.let { context.getString(R.string.link_error, it) },
            if (fix == null) {
                context.getString(R.string.no_fix_line)
            } else {
                context.getString(R.string.fix_line, fix.accuracyMetres ?: Float.NaN, snapshot.fixAgeSeconds)
            },
        ).map { it.orEmpty() }
    }

    /** What the board measured, in the order of its ports' likely use; empty where it said nothing. */
    private fun boardLine(board: BoardReport): String =
        listOfNotNull(
            board.state?.let { context.getString(R.string.board_state, it.word) },
            board.batteryVolts?.let { context.getString(R.string.board_battery, it) },
            board.oxygen?.let { context.getString(R.string.board_oxygen, it) },
            board.acidity?.let { context.getString(R.string.board_acidity, it) },
            board.conductivity?.let { context.getString(R.string.board_conductivity, it) },
            board.celsius?.let { context.getString(R.string.board_temperature, it) },
            board.depth?.let { context.getString(R.string.board_depth, it) },
        ).joinToString()

    private fun TextView.show(name: String, ready: Boolean) {
        text = context.getString(if (ready) R.string.check_ready else R.string.check_not_ready, name)
        contentDescription =
            context.getString(if (ready) R.string.check_ready_said else R.string.check_not_ready_said, name)
        setTextColor(context.getColor(if (ready) R.color.good else R.color.bad))
    }

    private fun column() = LinearLayout(context).apply { orientation = LinearLayout.VERTICAL }

    private companion object {
        const val HEALTH_LINES = 9
        const val MILLIS_PER_SECOND = 1000.0
    }
}

private fun BoatActivity.words(): Int =
    when (this) {
        BoatActivity.IDLE -> R.string.activity_idle
        BoatActivity.STANDING_BY -> R.string.activity_standing_by
        BoatActivity.RECOVERED -> R.string.activity_recovered
        BoatActivity.REFUSED -> R.string.activity_refused
    }

private fun PreflightCheck.words(): Int =
    when (this) {
        PreflightCheck.PERMISSIONS -> R.string.check_permissions
        PreflightCheck.LINK -> R.string.check_link
        PreflightCheck.FIX -> R.string.check_fix
        PreflightCheck.BOAT_BATTERY -> R.string.check_boat_battery
        PreflightCheck.PHONE_BATTERY -> R.string.check_phone_battery
        PreflightCheck.STORAGE -> R.string.check_storage
        PreflightCheck.BATTERY_SAVER -> R.string.check_battery_saver
    }

/** The state in words. */
internal fun LinkState.words(): Int =
    when (this) {
        LinkState.CONNECTED -> R.string.link_connected
        LinkState.CONNECTING -> R.string.link_connecting
        LinkState.WAITING -> R.string.link_waiting
        LinkState.CLOSED -> R.string.link_closed
    }
