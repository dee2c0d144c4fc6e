package stillwater.drive

import stillwater.link.ReconnectingWire
import stillwater.mission.Mission
import stillwater.mission.MissionState
import stillwater.mission.StopReason
import stillwater.model.BoatTime
import stillwater.model.Drive
import stillwater.report.OutputException
import stillwater.wire.Command
import stillwater.wire.PlatypusEncoder

/** Takes what a person is to see of a mission under way. */
interface DriveWatcher {
    /** The [mission] is now in another state, at [time]. */
    fun changed(mission: Mission, time: BoatTime)

    /** A step of [mission] was taken at [time]. */
    fun stepped(mission: Mission, time: BoatTime)
}

/**
 * A mission under way on a wire: waits for the phone's next moment, steps, writes the log, until the mission is over.
 *
 * A person's [start] and [stop] may come from any thread. Whatever ends the run, the board has then been told to rest
 * its motors and to disarm, as far as there is a wire.
 *
 * @param mission to be stepped. @param phone where time, fixes and heading come from. @param wire to the board.
 * @param prompt the same, as the mission reads it.
 * @param file the mission's log. All four are retained and confined to the thread that calls [sail].
 */
internal class DriveRun(
    private val mission: Mission,
    private val phone: Phone,
    private val wire: ReconnectingWire,
    private val prompt: PromptWire,
    private val file: LogOnDisk,
    private val watcher: DriveWatcher,
) {
    @Volatile
    private var startWanted = false

    @Volatile
    private var stopWanted = false
    private var startTold = false
    private var stopTold = false
    private var isParted = false

    /** A person wants the mission to begin. */
    fun start() {
        startWanted = true
    }

    /** A person typed [line]: a blank one begins the mission, any other ends it, also before it began. */
    fun heed(line: String) = if (line.isBlank()) start() else stop()

    /** Nobody will type any more: a mission that nobody began ends. Answers whether it does for that. */
    fun heedSilence(): Boolean {
        val isLeft = !startWanted && !stopWanted
        if (isLeft) stop()
        return isLeft
    }

    /** A person wants the boat to stop and the mission to be over. */
    fun stop() {
        stopWanted = true
    }

    /**
     * Steps until the mission is over and the board has said that it is disarmed, or has not said so for [PARTING] s: a
     * wire that is lost just then is soon open again. Whatever is thrown, the board is told to rest and to disarm
     * first.
     *
     * @return why it was over; null where it was stopped before it began.
     * @throws OutputException if the log cannot be written for hours; the motors then rest.
     */
    fun sail(): StopReason? = try {
        untilOver()
    } finally {
        if (!isParted) abandon()
    }

    private fun untilOver(): StopReason? {
        var over = Double.NaN
        while (true) {
            val time = step()
            val state = mission.state
            val stopped = state is MissionState.Stopped || (state == MissionState.Idle && stopTold)
            if (stopped && over.isNaN()) over = time.seconds
            if (!stopped) continue
            val disarmed = wire.isOpen && mission.board.isDisarmed
            if (disarmed || time.seconds - over > PARTING) {
                isParted = true
                return (state as? MissionState.Stopped)?.reason
            }
        }
    }

    /** The last words to a board that is left in the middle of a mission, by a mistake of this program or its disk. */
    private fun abandon() {
        val rest = PlatypusEncoder.encode(Command.Move(mission.spec.boat.mixing.mix(Drive.NONE)))
        val disarm = PlatypusEncoder.encode(Command.Disarm)
        // A line may be spoilt on its way.
        repeat(LAST_WORDS) {
            wire.write(rest)
            wire.write(disarm)
        }
    }

    private fun step(): BoatTime {
        val moment = phone.await()
        moment.sent?.let(prompt::await)
        if (startWanted && !startTold && moment.time.seconds >= BOOTING) mission.start().also { startTold = true }
        if (stopWanted && !stopTold) mission.stop().also { stopTold = true }
        for (fix in moment.fixes) mission.fix(fix.time, fix.place)
        if (moment.heading.isFinite()) mission.compass(moment.time, moment.heading, moment.yawRate)
        val before = mission.state.word
        mission.step(moment.time)
        phone.done()
        if (mission.state.word != before) watcher.changed(mission, moment.time)
        watcher.stepped(mission, moment.time)
        flush(moment.time)
        return moment.time
    }

    /** A mission that cannot be written down must not go on: it goes home, and the lines wait for the disk. */
    private fun flush(time: BoatTime) {
        try {
            file.flushWhenDue()
        } catch (full: OutputException) {
            mission.logLost()
            if (file.pending <= MOST_PENDING) return
            mission.stop()
            mission.step(BoatTime(time.seconds + STEP))
            check(mission.drive == Drive.NONE) { "a stopped mission drives" }
            throw full
        }
    }

    companion object {
        /**
         * How long the board is waited for to say that it is disarmed, s on the boat's clock: one that is not heard is
         * told every 5 s.
         */
        const val PARTING = 6.0

        /**
         * A board resets when its port is opened, and what it said just before may still arrive: the mission is not
         * begun for so long, s, so that the board is not told to arm while it boots and cannot hear.
         */
        const val BOOTING = 3.0
        private const val STEP = 1e-3
        private const val LAST_WORDS = 3

        /** Hours of lines, bytes. */
        private const val MOST_PENDING = 64 shl 20
    }
}
