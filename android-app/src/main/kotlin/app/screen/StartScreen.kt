package stillwater.app.screen

import android.content.Context
import android.content.Intent
import android.provider.Settings
import android.view.View
import android.widget.Button
import android.widget.LinearLayout
import stillwater.app.R
import stillwater.app.mission.MissionReport
import stillwater.app.service.BoatSnapshot
import stillwater.app.service.PreflightCheck
import stillwater.app.service.PreflightItem
import stillwater.app.service.PreflightReason
import stillwater.app.setup.words

/** The mission that is loaded, the buttons that move the boat, and the checklist that has to be green before. */
internal class StartScreen(private val context: Context, private val host: ScreenHost) : Screen {
    private val name = context.heading("").apply { id = R.id.loaded_mission }
    private val about = context.line("")
    private val answer = context.liveLine().apply {
        id = R.id.answer
        setTextColor(context.getColor(R.color.bad))
    }
    private val setUp = button(R.string.set_up, R.id.set_up) { host.open(ScreenName.MISSION) }
    private val arm = button(R.string.arm, R.id.arm) { host.boat?.arm() }
    private val start = button(R.string.start, R.id.start) { host.boat?.start() }
    private val hold = button(R.string.hold, R.id.hold) { host.boat?.hold() }
    private val goHome = button(R.string.go_home, R.id.go_home) { host.boat?.goHome() }
    private val another = button(R.string.another, R.id.another) {
        host.boat?.newMission()
        host.open(ScreenName.MISSION)
    }
    private val others = context.liveLine().apply { id = R.id.others_cut_off }
    private val toOthers = button(R.string.open_cut_off, R.id.open_cut_off) { host.open(ScreenName.PAST) }
    private val controls = context.column()
    private val ready = context.liveLine().apply { id = R.id.readiness }
    private val checks = PreflightCheck.entries.associateWith(::CheckLine)

    override val view: View =
        context.scrolling {
            for (button in listOf(arm, start, hold, goHome)) {
                button.minimumHeight = resources.getDimensionPixelSize(R.dimen.control_height)
            }
            controls.below(context.row(arm, start))
            controls.below(context.row(hold, goHome))
            // What moves the boat is in sight on the smallest phone; what there is to read comes after it.
            below(name)
            below(answer)
            below(ready)
            below(controls)
            below(about)
            below(setUp)
            below(another)
            below(others)
            below(toOthers)
            below(context.heading(context.getString(R.string.preflight)))
            checks.values.forEach { below(it) }
        }

    override fun show(snapshot: BoatSnapshot) {
        val mission = snapshot.mission
        name.say(mission?.spec?.name ?: context.getString(R.string.no_mission))
        about.say(mission?.let(::about))
        answer.say(snapshot.answer?.let { context.answerWords(it) })
        val may = Pressable.of(snapshot)
        arm.isEnabled = may.arm
        start.isEnabled = may.start
        hold.isEnabled = may.hold
        goHome.isEnabled = may.goHome
        start.say(context.getString(if (may.hold || may.goHome) R.string.go_on else R.string.start))
        controls.show(mission != null)
        setUp.show(mission == null)
        another.show(may.another)
        val items = snapshot.preflight.associateBy { it.check }
        for ((check, line) in checks) line.show(items[check])
        val red = snapshot.preflight.count { !it.ready }
        val notes = snapshot.preflight.count { it.note != null }
        ready.say(
            when {
                snapshot.preflight.isEmpty() -> context.getString(R.string.checks_unknown)
                red == 0 && notes == 0 -> context.getString(R.string.checks_green)
                red == 0 -> context.resources.getQuantityString(R.plurals.checks_noted, notes, notes)
                else -> context.resources.getQuantityString(R.plurals.checks_red, red, red)
            },
        )
        ready.setTextColor(context.getColor(readyColour(red, notes, isKnown = items.isNotEmpty())))
        val cutOff = if (mission?.isUnderWay == true) 0 else snapshot.cutOff.size
        others.say(context.resources.getQuantityString(R.plurals.others_cut_off, cutOff, cutOff).takeIf { cutOff > 0 })
        toOthers.show(cutOff > 0)
    }

    /** Green is for a list in which there is nothing to know. */
    private fun readyColour(red: Int, notes: Int, isKnown: Boolean): Int =
        when {
            red > 0 || !isKnown -> R.color.bad
            notes > 0 -> R.color.text
            else -> R.color.good
        }

    private fun about(mission: MissionReport): String {
        val spec = mission.spec
        val unit = if (spec.budget.metres != null) R.string.unit_metres else R.string.unit_seconds
        val used = context.getString(R.string.budget_used, mission.used, mission.budget, context.getString(unit))
        val method =
            context.getString(
                R.string.mission_method,
                context.getString(spec.probe.quantity.words()),
                context.getString(spec.planner.words()),
            )
        val recovered = context.getString(R.string.mission_recovered).takeIf { mission.isRecovered }
        return listOfNotNull(recovered, method, used).joinToString("\n")
    }

    private fun button(words: Int, id: Int, action: () -> Unit): Button =
        context.largeButton(context.getString(words), action).also { it.id = id }

    /** One line of the checklist, with what mends it. */
    private inner class CheckLine(private val check: PreflightCheck) : LinearLayout(context) {
        private val words = context.line("")
        private val mend: Button = context.largeButton("") { mending?.second?.invoke() }
        private var mending: Pair<Int, () -> Unit>? = null

        init {
            orientation = VERTICAL
            below(words)
            below(mend)
        }

        fun show(item: PreflightItem?) {
            val isReady = item?.ready == true
            val name = context.getString(check.words())
            val more = item?.let { context.preflightWords(it) }
            val full = if (more == null) name else context.getString(R.string.check_reason, name, more)
            val (shown, spoken, colour) =
                when {
                    !isReady -> Triple(R.string.check_not_ready, R.string.check_not_ready_said, R.color.bad)
                    item.note != null -> Triple(R.string.check_noted, R.string.check_noted_said, R.color.text)
                    else -> Triple(R.string.check_ready, R.string.check_ready_said, R.color.good)
                }
            words.say(context.getString(shown, full))
            words.contentDescription = context.getString(spoken, full)
            words.setTextColor(context.getColor(colour))
            mending = if (isReady || item == null) null else mending(item)
            mend.say(mending?.let { context.getString(it.first) })
        }
    }

    /** What a person can do about it here, and what the button says; null where only waiting or charging helps. */
    private fun mending(item: PreflightItem): Pair<Int, () -> Unit>? =
        when (item.reason) {
            PreflightReason.NOT_PERMITTED ->
                (if (host.isRefusedForGood) R.string.allow_in_settings else R.string.allow) to host::allow
            PreflightReason.RECEIVER_OFF ->
                R.string.open_location to { host.leave(Intent(Settings.ACTION_LOCATION_SOURCE_SETTINGS)) }
            PreflightReason.OTHER_WATER, PreflightReason.NOT_REPORTED, PreflightReason.NOT_SAID ->
                R.string.open_mission to { host.open(ScreenName.MISSION) }
            PreflightReason.LITTLE_ROOM -> R.string.open_past to { host.open(ScreenName.PAST) }
            PreflightReason.NOT_EXEMPT -> R.string.exempt_button to host::exempt
            PreflightReason.NO_LINK, PreflightReason.NOT_CONNECTED, PreflightReason.BOARD_SILENT ->
                R.string.open_link to { host.open(ScreenName.LINK) }
            PreflightReason.LOW_CHARGE ->
                if (item.check == PreflightCheck.PHONE_BATTERY) {
                    R.string.open_saver to { host.leave(Intent(Settings.ACTION_BATTERY_SAVER_SETTINGS)) }
                } else {
                    null
                }
            else -> null
        }
}
