package stillwater.app.service

import stillwater.app.link.BoardReport
import stillwater.app.link.LinkHealth
import stillwater.app.pose.PhoneFix

/** What the service does. */
enum class BoatActivity {
    /** Nothing: no link, no listening. */
    IDLE,

    /** The link is held and the phone listens; the board is disarmed. */
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
 * @property board what the board said on this connection.
 * @property refusal the system's words, null unless [activity] is REFUSED.
 * @property fix newest fix of the phone, null before the first.
 * @property fixAgeSeconds how long ago [fix] was, s.
 * @property headingDeg which way the phone points, degrees from true north.
 * @property preflight what has to be in order before a start, in the order of the list; empty before it was looked at.
 */
data class BoatSnapshot(
    val activity: BoatActivity = BoatActivity.IDLE,
    val linkName: String? = null,
    val link: LinkHealth = LinkHealth(),
    val board: BoardReport = BoardReport(),
    val refusal: String? = null,
    val fix: PhoneFix? = null,
    val fixAgeSeconds: Double? = null,
    val headingDeg: Float? = null,
    val preflight: List<PreflightItem> = emptyList(),
)
