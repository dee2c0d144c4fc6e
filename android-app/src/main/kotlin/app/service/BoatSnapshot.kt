package stillwater.app.service

import stillwater.app.link.BoardReport
import stillwater.app.link.LinkHealth
import stillwater.app.mission.MissionReport
import stillwater.app.mission.PastMission
import stillwater.app.pose.PhoneFix

/** What the service does. */
enum class BoatActivity {
    /** Nothing: no link, no listening. */
    IDLE,

    /** The link is held and the phone listens; what a mission does beside that is in its report. */
    STANDING_BY,

    /** The same, after Android had ended the process: nothing moves before a person says so. */
    RECOVERED,

    /** Android did not let the service run in the foreground. */
    REFUSED,
}

/**
 * What the screens show, as of one moment.
 *
 * @property linkName null where no link is held.
 * @property isDemo whether boat and water are the virtual ones.
 * @property board what the board said on this connection.
 * @property refusal the system's words, null unless [activity] is REFUSED.
 * @property isWithoutPlace whether Android gives no position before a window is in sight.
 * @property fix newest fix of the phone, null before the first.
 * @property fixAgeSeconds how long ago [fix] was, s.
 * @property fixes what became of the fixes.
 * @property headingDeg which way the phone points, degrees from true north.
 * @property phoneBatteryPercent charge of the phone; null where it does not say.
 * @property gaps times the phone slept.
 * @property preflight what has to be in order before a start, in the order of the list; empty before it was looked at.
 * @property mission null where none is loaded.
 * @property answer to the last command that could not be followed; null where the last one was.
 * @property past missions on this phone, newest first; null before they were looked for.
 */
data class BoatSnapshot(
    val activity: BoatActivity = BoatActivity.IDLE,
    val linkName: String? = null,
    val isDemo: Boolean = false,
    val link: LinkHealth = LinkHealth(),
    val board: BoardReport = BoardReport(),
    val refusal: String? = null,
    val isWithoutPlace: Boolean = false,
    val fix: PhoneFix? = null,
    val fixAgeSeconds: Double? = null,
    val fixes: FixCounts = FixCounts(),
    val headingDeg: Float? = null,
    val phoneBatteryPercent: Int? = null,
    val gaps: Gaps = Gaps(),
    val preflight: List<PreflightItem> = emptyList(),
    val mission: MissionReport? = null,
    val answer: Answer? = null,
    val past: List<PastMission>? = null,
) {
    /** Missions that were cut off besides the one that is loaded: each can be gone on with, or marked as finished. */
    val cutOff: List<PastMission> get() = past.orEmpty().filter { !it.isComplete && it.name != mission?.log?.name }

    /** [fix] while the phone is still there: as new as the checklist wants it; null otherwise. */
    val freshFix: PhoneFix? get() = fix?.takeIf { fixAgeSeconds != null && fixAgeSeconds <= Preflight.OLDEST_FIX }
}

/**
 * What became of the receiver's fixes since the link was taken up.
 *
 * @property received from the receiver.
 * @property jumps of them, farther from the one before than a boat goes.
 * @property wide of them, too uncertain for a mission to be told of.
 * @property refused of those a mission was told of, by it.
 */
data class FixCounts(val received: Long = 0, val jumps: Long = 0, val wide: Long = 0, val refused: Long = 0)

/**
 * Times in which the phone did nothing although it was to work, as in Doze.
 *
 * @property count of them.
 * @property longestSeconds the longest, s.
 */
data class Gaps(val count: Long = 0, val longestSeconds: Double = 0.0)

/**
 * Why a command was not followed.
 *
 * @property reason what stood against it.
 * @property words more of it, for the person, in the words of whoever said so; null where [reason] says it all.
 */
data class Answer(val reason: Reason, val words: String? = null) {
    /** What can stand against a command. */
    enum class Reason {
        /** No mission is loaded. */
        NO_MISSION,

        /** What was to be loaded is no mission; the words say where and why. */
        NOT_A_MISSION,

        /** The checklist is not green. */
        NOT_READY,

        /** The mission is under way: stop it first. */
        UNDER_WAY,

        /** The mission was not started. */
        NOT_UNDER_WAY,

        /** The mission is over, or was stopped and the board is being told: load it again. */
        OVER,

        /** STOP was pressed without a mission, so the link is being given up. */
        GIVEN_UP,

        /** What the log of a mission that was cut off has cannot be read. */
        NOT_READABLE,

        /** The mission that was recovered is of a real boat, and the demo's is connected. */
        OF_A_REAL_BOAT,

        /** The mission that was recovered is of the demo's boat, and a real one is connected. */
        OF_THE_VIRTUAL_BOAT,
    }
}
