package stillwater.drive

import stillwater.mission.Mission

/** What is said, behind the number of all, of the readings that a mission had before it was taken up again. */
internal object Resumption {
    /** In brackets after a blank; empty where [mission] was not taken up again. */
    fun of(mission: Mission): String =
        if (mission.readingsBefore > 0) " (${mission.readingsBefore} before it was taken up again)" else ""
}
