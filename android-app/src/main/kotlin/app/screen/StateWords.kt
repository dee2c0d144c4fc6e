package stillwater.app.screen

import android.content.Context
import stillwater.app.R
import stillwater.app.link.LinkState
import stillwater.app.mission.LogProblem
import stillwater.app.service.Answer
import stillwater.app.service.BoatActivity
import stillwater.app.service.BoatSnapshot
import stillwater.app.service.PreflightCheck
import stillwater.app.service.PreflightItem
import stillwater.app.service.PreflightNote
import stillwater.app.service.PreflightReason
import stillwater.app.setup.words
import stillwater.control.Danger
import stillwater.mission.GivenUp
import stillwater.mission.MissionState
import stillwater.mission.StopReason
import stillwater.model.Interval

/** What the boat does and how the link is: two short lines for the top of every screen. */
internal fun Context.stateWords(snapshot: BoatSnapshot): String {
    val mission = snapshot.mission
    val first =
        if (mission == null || snapshot.activity == BoatActivity.REFUSED) {
            listOfNotNull(getString(snapshot.activity.words()), snapshot.refusal).joinToString(": ")
        } else {
            missionWords(mission.state, mission.restsFor)
        }
    return listOfNotNull(first, linkWords(snapshot)).joinToString("\n")
}

/** The link's name and how it is: lost, or without a word of the probe, or in order; null where none is held. */
internal fun Context.linkWords(snapshot: BoatSnapshot): String? {
    val name = snapshot.linkName ?: return null
    val silence = snapshot.mission?.probeSilence?.takeIf { snapshot.link.state == LinkState.CONNECTED }
    val state =
        if (silence == null) {
            getString(snapshot.link.state.words())
        } else {
            getString(R.string.link_probe_silent, duration(silence))
        }
    return getString(R.string.notification_link, name, state)
}

/** Whether a person should look at once. */
internal fun isBad(snapshot: BoatSnapshot): Boolean =
    snapshot.link.state == LinkState.WAITING ||
        snapshot.activity == BoatActivity.REFUSED ||
        snapshot.mission?.probeSilence != null

/**
 * What a mission is about, with the reason where there is one; [restsFor] s is the time until a boat that was held up
 * tries again.
 */
internal fun Context.missionWords(state: MissionState, restsFor: Double = 0.0): String =
    when (state) {
        MissionState.Idle -> getString(R.string.mission_idle)
        is MissionState.Preflight ->
            when (val missing = state.missing) {
                null -> getString(R.string.mission_preflight)
                // The checklist has a fix already; the mission believes a place once fixes agree.
                Danger.FIX_STALE -> getString(R.string.mission_agreeing)
                else -> getString(R.string.mission_waiting, getString(missing.words()))
            }
        MissionState.Arming -> getString(R.string.mission_arming)
        MissionState.Surveying -> getString(R.string.mission_surveying)
        is MissionState.Holding -> {
            val danger = getString(state.danger.words())
            val rests = state.danger == Danger.HELD_UP && restsFor > 0
            val why = if (rests) getString(R.string.danger_held_up_for, danger, duration(restsFor)) else danger
            getString(R.string.mission_holding, why)
        }
        is MissionState.Returning -> getString(R.string.mission_returning, getString(state.danger.words()))
        is MissionState.Stopped -> getString(R.string.mission_stopped, getString(state.reason.words()))
    }

private fun StopReason.words(): Int =
    when (this) {
        StopReason.COMPLETED -> R.string.stopped_completed
        StopReason.OPERATOR -> R.string.stopped_operator
        StopReason.BATTERY -> R.string.danger_battery
        StopReason.PHONE -> R.string.danger_phone
        StopReason.LOG_LOST -> R.string.danger_log
        StopReason.FENCE -> R.string.danger_fence
        StopReason.STRANDED -> R.string.danger_stranded
        StopReason.DISARMED -> R.string.stopped_disarmed
    }

/** How many cells the boat did not get into; null where there is none. */
internal fun Context.givenUpWords(givenUp: GivenUp): String? {
    val cells = givenUp.cells.size + givenUp.offMap.size
    return if (cells == 0) null else resources.getQuantityString(R.plurals.cells_given_up, cells, cells)
}

/** What the service does, in words. */
internal fun BoatActivity.words(): Int =
    when (this) {
        BoatActivity.IDLE -> R.string.activity_idle
        BoatActivity.STANDING_BY -> R.string.activity_standing_by
        BoatActivity.RECOVERED -> R.string.activity_recovered
        BoatActivity.REFUSED -> R.string.activity_refused
    }

/** The link's state in words. */
internal fun LinkState.words(): Int =
    when (this) {
        LinkState.CONNECTED -> R.string.link_connected
        LinkState.CONNECTING -> R.string.link_connecting
        LinkState.WAITING -> R.string.link_waiting
        LinkState.CLOSED -> R.string.link_closed
    }

/** What is known of a value that lies from [lower] to [upper]: an end that [range], too, has says nothing of it. */
internal fun Context.boundsWords(lower: Double, upper: Double, range: Interval?): String {
    val (isLowerKnown, isUpperKnown) = (range == null || lower > range.lower) to (range == null || upper < range.upper)
    return when {
        isLowerKnown && isUpperKnown -> getString(R.string.bounds_both, lower, upper)
        isUpperKnown -> getString(R.string.bounds_upper, upper)
        isLowerKnown -> getString(R.string.bounds_lower, lower)
        else -> getString(R.string.bounds_none, range?.lower ?: lower, range?.upper ?: upper)
    }
}

/** Why a log is not written. */
internal fun Context.logWords(problem: LogProblem): String =
    when (problem.reason) {
        LogProblem.Reason.NOT_WRITTEN -> problem.words.orEmpty()
        LogProblem.Reason.LITTLE_ROOM -> getString(R.string.log_little_room)
        LogProblem.Reason.NO_FOLDER -> getString(R.string.log_no_folder)
    }

/** Why a command was not followed. */
internal fun Context.answerWords(answer: Answer): String {
    val words =
        when (answer.reason) {
            Answer.Reason.NO_MISSION -> R.string.answer_no_mission
            Answer.Reason.NOT_A_MISSION -> R.string.answer_not_a_mission
            Answer.Reason.NOT_READY -> R.string.answer_not_ready
            Answer.Reason.UNDER_WAY -> R.string.answer_under_way
            Answer.Reason.NOT_UNDER_WAY -> R.string.answer_not_under_way
            Answer.Reason.OVER -> R.string.answer_over
            Answer.Reason.GIVEN_UP -> R.string.answer_given_up
            Answer.Reason.NOT_READABLE -> R.string.answer_not_readable
            Answer.Reason.OF_A_REAL_BOAT -> R.string.answer_of_a_real_boat
            Answer.Reason.OF_THE_VIRTUAL_BOAT -> R.string.answer_of_the_virtual_boat
        }
    return listOfNotNull(getString(words), answer.words).joinToString(": ")
}

/** What a line of the checklist looks at. */
internal fun PreflightCheck.words(): Int =
    when (this) {
        PreflightCheck.PERMISSIONS -> R.string.check_permissions
        PreflightCheck.LINK -> R.string.check_link
        PreflightCheck.PROBE -> R.string.check_probe
        PreflightCheck.FIX -> R.string.check_fix
        PreflightCheck.PLACE -> R.string.check_place
        PreflightCheck.BOAT_BATTERY -> R.string.check_boat_battery
        PreflightCheck.PHONE_BATTERY -> R.string.check_phone_battery
        PreflightCheck.STORAGE -> R.string.check_storage
        PreflightCheck.BATTERY_SAVER -> R.string.check_battery_saver
    }

/** What a line of the checklist says besides its name: why it is red, or what is worth knowing; null for nothing. */
internal fun Context.preflightWords(item: PreflightItem): String? {
    val words = item.reason?.words() ?: item.note?.words() ?: return null
    return item.metres?.let { getString(words, distance(it)) } ?: getString(words)
}

private fun PreflightNote.words(): Int =
    when (this) {
        PreflightNote.NOT_REPORTED -> R.string.note_not_reported
        PreflightNote.PROBE_SILENT -> R.string.note_probe_silent
        PreflightNote.NOT_WATCHED -> R.string.note_not_watched
        PreflightNote.ON_THE_WAY -> R.string.note_on_the_way
    }

/** Why a line of the checklist is red. */
private fun PreflightReason.words(): Int =
    when (this) {
        PreflightReason.NOT_PERMITTED -> R.string.reason_not_permitted
        PreflightReason.NO_LINK -> R.string.reason_no_link
        PreflightReason.NOT_CONNECTED -> R.string.reason_not_connected
        PreflightReason.BOARD_SILENT -> R.string.reason_board_silent
        PreflightReason.NO_RECEIVER -> R.string.reason_no_receiver
        PreflightReason.RECEIVER_OFF -> R.string.reason_receiver_off
        PreflightReason.NO_FIX -> R.string.reason_no_fix
        PreflightReason.FIX_OLD -> R.string.reason_fix_old
        PreflightReason.FIX_WIDE -> R.string.reason_fix_wide
        PreflightReason.NO_HEADING -> R.string.reason_no_heading
        PreflightReason.OTHER_WATER -> R.string.reason_other_water
        PreflightReason.NOT_REPORTED -> R.string.reason_not_reported
        PreflightReason.NOT_SAID -> R.string.reason_not_said
        PreflightReason.UNKNOWN_CHARGE -> R.string.reason_unknown_charge
        PreflightReason.LOW_CHARGE -> R.string.reason_low_charge
        PreflightReason.LITTLE_ROOM -> R.string.reason_little_room
        PreflightReason.NOT_EXEMPT -> R.string.reason_not_exempt
    }
