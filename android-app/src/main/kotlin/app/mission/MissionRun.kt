package stillwater.app.mission

import stillwater.app.pose.Pose
import stillwater.control.FixCheck
import stillwater.mission.GivenUp
import stillwater.mission.LogStart
import stillwater.mission.Mission
import stillwater.mission.MissionLog
import stillwater.mission.MissionSpec
import stillwater.mission.MissionState
import stillwater.mission.Wish
import stillwater.mission.readingsTaken
import stillwater.model.BoatTime
import stillwater.model.Reading
import java.time.Instant

/**
 * A mission from its arming to its end: the one place where the phone's clock, pose, link and file meet core's mission.
 * Confined to the boat's thread.
 *
 * @param boat whose board and name it is. Retained.
 * @param log where it is written. Retained.
 * @param recovered what to go on with; null to begin anew.
 */
internal class MissionRun(
    private val spec: MissionSpec,
    boat: BoatAtHand,
    val log: LogFile,
    private val recovered: RecoveredRun?,
    epochMillis: Long,
) {
    private val start =
        LogStart(epochMillis, Instant.ofEpochMilli(epochMillis).toString(), boat.name, boat.isVirtual)
    private val mission =
        Mission(spec, boat.link, MissionLog(log, start, spec), recovered = recovered?.mission, taken = ::took)
    private val trace = recovered?.trace ?: Trace()
    private val track = recovered?.track ?: Track()
    private val readAt = DoubleArray(spec.grid.grid().size) { Double.NaN }
    private var fixNanos = Long.MIN_VALUE
    private var headingNanos = Long.MIN_VALUE
    private var now = 0.0
    private var stoppedAt = Double.NaN

    /** Fixes too uncertain to be handed on. */
    var wideFixes = 0L
        private set

    /** Fixes that the mission refused. */
    val refusedFixes: Long get() = mission.refusedFixes

    val state: MissionState get() = mission.state

    /** Whether the motors were last told to do something. */
    val isMoving: Boolean get() = !mission.board.sent.isAtRest

    /** Whether it has ended, and the board has said so or had the time to. */
    val isOver: Boolean
        get() = stoppedAt.isFinite() &&
            (mission.board.isDisarmed || now - stoppedAt > LONGEST_DISARMING)

    /** What a person wants. */
    var wish: Wish by mission::wish

    /** Begins. */
    fun start() = mission.start()

    /** Whether a person has ended it, and the board is still being told. */
    var isStopping = false
        private set

    /** Ends. */
    fun stop() {
        isStopping = true
        mission.stop()
    }

    /** The phone's charge, percent; null where it does not say. */
    fun phoneCharge(percent: Int?) = mission.phoneCharge(percent?.toDouble() ?: Double.NaN)

    /** Does all that is due at [seconds] on the phone's clock, with the newest of [pose]. */
    fun step(seconds: Double, pose: Pose) {
        now = seconds
        pose.fix?.takeIf { it.elapsedNanos > fixNanos }?.let { fix ->
            fixNanos = fix.elapsedNanos
            if (FixCheck.isNarrow(fix.accuracyMetres?.toDouble())) {
                mission.fix(BoatTime(fix.elapsedNanos * SECONDS_PER_NANO), fix.place)
            } else {
                wideFixes++
            }
        }
        pose.heading?.takeIf { it.elapsedNanos > headingNanos }?.let {
            headingNanos = it.elapsedNanos
            mission.compass(BoatTime(it.elapsedNanos * SECONDS_PER_NANO), it.radians, it.yawRate)
        }
        if (log.failed) mission.logLost()
        val state = mission.step(BoatTime(seconds))
        mission.position?.let(track::add)
        if (state is MissionState.Stopped && stoppedAt.isNaN()) stoppedAt = seconds
    }

    /** As of now; [isOver] where the log is closed. */
    fun report(isOver: Boolean): MissionReport =
        MissionReport(
            spec,
            mission.state,
            mission.wish,
            recovered != null,
            isOver,
            mission.map.copy(),
            mission.position,
            track.places(),
            mission.waypoints(),
            mission.used,
            trace.points(),
            counts(),
            log.report,
            mission.probeSilence.takeIf { mission.isProbeSilent },
            GivenUp(mission.givenUpCells, mission.givenUpOffMap),
            mission.restsFor,
            readAt.copyOf(),
            now,
        )

    private fun counts(): ReadingCounts {
        val gate = mission.readings
        val waiting = gate.waiting.toLong()
        val taken = mission.readingsTaken
        return ReadingCounts(
            taken + gate.leftOut + waiting,
            taken,
            waiting,
            gate.outOfRange,
            gate.lone,
            gate.stuck,
            gate.withoutValueOrPlace,
            mission.board.unreadable,
            mission.unplaced,
        )
    }

    private fun took(reading: Reading) {
        val map = mission.map
        trace.take(reading, map)
        map.grid.cellAt(reading.position).takeIf { it >= 0 }?.let { readAt[it] = now }
    }

    private companion object {
        const val SECONDS_PER_NANO = 1e-9

        /** A board that is not heard is told to disarm every 5 s; twice is enough, s. */
        const val LONGEST_DISARMING = 6.0
    }
}
