package stillwater.simulation

import stillwater.mission.LogSink
import stillwater.mission.LogStart
import stillwater.mission.Mission
import stillwater.mission.MissionLog
import stillwater.mission.MissionSpec
import stillwater.mission.MissionState
import stillwater.model.BoatTime
import stillwater.world.VirtualWorld
import stillwater.world.WorldSettings
import stillwater.world.WorldSite

/**
 * One whole mission in closed loop with a virtual boat, in virtual time: core's own Mission at one end of a virtual link,
 * core's virtual boat at the other.
 *
 * The boat lies at home. Once the mission knows where it is and has waited for [SETTLING] s it is started, as by a person.
 * Deterministic. Confined to one thread.
 *
 * @property spec the mission.
 * @param settings the virtual world.
 * @param sink takes the mission's log.
 */
class MissionRun(val spec: MissionSpec, settings: WorldSettings, sink: LogSink) {
    /** Boat and water. */
    val world = VirtualWorld(settings, WorldSite.of(spec))

    /** What the log tells of the readings. */
    val readings = ReadingLog(sink)

    /** The mission. */
    val mission = Mission(spec, world.boat.phone, MissionLog(readings, START, spec))

    /** Where the boat really was, and how it kept to its legs. */
    val track = SailedTrack()

    /** The states, one after the other. */
    val history = StateHistory()
    private var stoppedFor = 0

    /** The virtual time. */
    val time: BoatTime get() = world.time

    /** Whether the mission has been over for [AFTER] steps, in which the board is disarmed. */
    val isOver: Boolean get() = stoppedFor > AFTER

    /** Lets one step of [STEP] s pass. */
    fun step() {
        world.advance(STEP)
        val boat = world.boat
        boat.takeFix()?.let { mission.fix(it.time, it.place) }
        mission.compass(boat.time, boat.heading(), boat.yawRate)
        val isReady = mission.position != null && time.seconds >= SETTLING
        if (isReady && mission.state == MissionState.Idle) mission.start()
        val state = mission.step(boat.time)
        history.add(time.seconds, state)
        track.add(time.seconds, boat.dynamics.x, boat.dynamics.y, mission)
        if (state is MissionState.Stopped) stoppedFor++
    }

    companion object {
        /** Time between two steps of the mission, s. */
        const val STEP = 0.1

        /** Time before the mission is started, s. */
        const val SETTLING = 3.0

        /** Steps after the mission's end. */
        const val AFTER = 20

        /** When every simulated log begins, so that the same seed gives the same bytes. */
        val START = LogStart(1_767_225_600_000, "2026-01-01 00:00:00 UTC, virtual time")

        /** Time within which [spec]'s mission should be over, s: twice its budget and ten minutes. */
        fun longest(spec: MissionSpec): Double = 2 * expected(spec) + 600

        /** Time that [spec]'s mission takes if it uses its budget, s: metres at half the cruising speed. */
        fun expected(spec: MissionSpec): Double =
            spec.budget.seconds ?: (2 * (spec.budget.metres ?: 0.0) / spec.boat.cruise)
    }
}
