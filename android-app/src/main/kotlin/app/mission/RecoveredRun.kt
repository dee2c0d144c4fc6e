package stillwater.app.mission

import stillwater.mission.RecoveredMission

/**
 * What the log of a process that ended tells.
 *
 * @property name of the log.
 * @property mission to go on with.
 * @property trace of its last readings, to go on with.
 * @property track the boat took, to go on with.
 */
internal class RecoveredRun(val name: String, val mission: RecoveredMission, val trace: Trace, val track: Track)
