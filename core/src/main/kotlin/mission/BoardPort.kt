package stillwater.mission

import stillwater.control.Mixing
import stillwater.model.Actuation
import stillwater.model.BoatTime
import stillwater.model.Drive
import stillwater.wire.BoardState
import stillwater.wire.ByteLink
import stillwater.wire.Command
import stillwater.wire.CommandEncoder
import stillwater.wire.LineFramer
import stillwater.wire.LineSink
import stillwater.wire.Malformed
import stillwater.wire.Message
import stillwater.wire.MessageSink
import stillwater.wire.PlatypusCodec
import stillwater.wire.PlatypusEncoder

/**
 * The board as the mission sees it: what it said last, how long it has been silent, and what it is told.
 *
 * [hear] reads all that has arrived and hands messages on; [tell] sends at most one drive in [HEARTBEAT] s but
 * for a first rest, and [askState] at most one question in [PATIENCE] s. Never throws on data. Confined to one thread.
 *
 * @param link to the board. Retained.
 * @param mixing how a drive becomes thrust.
 * @param sink where messages go. Retained.
 * @param encoder turns commands into bytes.
 * @param lines takes every line before it is read, whatever it holds. Retained.
 */
public class BoardPort(
    private val link: ByteLink,
    private val mixing: Mixing,
    private val sink: MessageSink,
    private val encoder: CommandEncoder = PlatypusEncoder,
    private val lines: LineSink = LineSink { _, _, _ -> },
) {
    private val codec = PlatypusCodec(::heard)
    private val framer = LineFramer({ bytes, start, end ->
        lines.line(bytes, start, end)
        codec.line(bytes, start, end)
    })
    private val buffer = ByteArray(BUFFER)
    private var now = BoatTime(0.0)
    private var heardAt = Double.NEGATIVE_INFINITY
    private var toldAt = Double.NEGATIVE_INFINITY
    private var askedAt = Double.NEGATIVE_INFINITY
    private var restedFrom = Double.POSITIVE_INFINITY
    private var echoedAt = Double.NEGATIVE_INFINITY
    private var ranAt = Double.NEGATIVE_INFINITY
    private var isAsked = false
    private var isAnswerOld = false
    private var ordered: Command? = null
    private var hasDriven = false
    private var idleAnswers = 0

    /** What the board last said of itself; null where it has said nothing since it was last told to be otherwise. */
    public var state: BoardState? = null
        private set

    /** Battery, V; NaN before it was heard of. */
    public var volts: Double = Double.NaN
        private set

    /** Commands that the board could not use. */
    public var refusals: Long = 0
        private set

    /** Writes that the link did not take. */
    public var unsent: Long = 0
        private set

    /** What was last sent to the actuators. */
    public var sent: Actuation = mixing.mix(Drive.NONE)
        private set

    /** Lines and parts of lines that could not be read. */
    public val unreadable: Long get() = codec.malformed.total + framer.oversized

    /** Times [kind] was met in what the board sent. */
    public fun malformed(kind: Malformed): Long =
        if (kind == Malformed.OVERSIZED) framer.oversized else codec.malformed[kind]

    /** Time since the board was last understood, s; infinite before. */
    public fun silence(now: BoatTime): Double = now.seconds - heardAt

    /** Reads all that has arrived by [now]. */
    public fun hear(now: BoatTime) {
        this.now = now
        repeat(MOST_READS) {
            val count = link.read(buffer)
            if (count == ByteLink.LOST) framer.reset()
            if (count <= 0) return
            framer.accept(buffer, 0, count)
        }
    }

    /**
     * Drives; [drive] has passed the safety gate. Rest is sent at once, the rest of drives at the heartbeat's rate. Where
     * [isCalm] a rest that the board has obeyed for a while is only repeated before it disarms itself: each line may be
     * spoilt on the way and become a drive.
     */
    public fun tell(now: BoatTime, drive: Drive, isCalm: Boolean = false) {
        val actuation = mixing.mix(drive)
        val isNewRest = actuation.isAtRest && !sent.isAtRest
        restedFrom = if (actuation.isAtRest) minOf(restedFrom, now.seconds) else Double.POSITIVE_INFINITY
        val pause = if (isCalm && isRestKept(now)) REMINDER else HEARTBEAT
        if (!isNewRest && now.seconds - toldAt < pause) return
        toldAt = now.seconds
        sent = actuation
        if (!actuation.isAtRest) hasDriven = true
        // A line that is hit on the way is not heard, and of a first rest that must not happen.
        repeat(if (isNewRest) REST_COPIES else 1) { send(Command.Move(actuation)) }
    }

    /**
     * Whether the board has said [ASLEEP] times on end that it rests for want of commands though it was told to drive
     * before each: one that does not go on by itself needs arming.
     */
    public val isAsleep: Boolean get() = idleAnswers >= ASLEEP

    /** Whether rest was said for long enough, and the board says that its motors rest. */
    private fun isRestKept(now: BoatTime) = now.seconds - restedFrom >= RESTING &&
        now.seconds - echoedAt < ECHO &&
        now.seconds - ranAt > ECHO

    /**
     * Sends [command] at once. One to arm or to disarm makes what the board said before worthless, and so the answer to a
     * question that it was asked before; one that only repeats the last does not.
     */
    public fun order(command: Command) {
        if (command == Command.Arm || (command == Command.Disarm && ordered != Command.Disarm)) {
            state = null
            isAnswerOld = isAsked
        }
        if (command == Command.Arm) idleAnswers = 0
        ordered = command
        send(command)
    }

    /** Asks the board for its state, unless that was done less than [PATIENCE] s ago. Answers whether it was asked. */
    public fun askState(now: BoatTime): Boolean {
        if (now.seconds - askedAt < PATIENCE) return false
        askedAt = now.seconds
        isAsked = true
        send(Command.AskState)
        return true
    }

    private fun send(command: Command) {
        if (!link.write(encoder.encode(command))) unsent++
    }

    private fun heard(message: Message) {
        // What the board could not read is no sign that it obeys, but it is one that it hears and speaks.
        heardAt = now.seconds
        when (message) {
            is Message.State -> takeState(message.state)
            is Message.Battery -> volts = message.volts
            is Message.Refused -> refusals++
            is Message.Motor -> {
                echoedAt = now.seconds
                if (message.velocity != 0.0) ranAt = now.seconds
            }
            else -> Unit
        }
        sink.message(message)
    }

    /** Where the old answer was lost on the way a new one is passed over in its place, and the next one counts. */
    private fun takeState(said: BoardState) {
        if (!isAnswerOld) state = said
        if (said != BoardState.CONNECTED) {
            idleAnswers = 0
        } else if (hasDriven) {
            idleAnswers++
        }
        hasDriven = false
        isAnswerOld = false
        isAsked = false
    }

    public companion object {
        /** Time between drives, s: well within the watchdog of 0.5 s. */
        public const val HEARTBEAT: Double = 0.1 - 1e-6

        /** Time between questions, s. */
        public const val PATIENCE: Double = 1.0

        /** Silence after which nothing more is said of drives, s: rest was said four times. */
        internal const val RESTING: Double = 0.5

        /** Time between rests that are kept, s: boards disarm themselves 5 s after their watchdog. */
        private const val REMINDER = 2.0

        /** Answers, of which a lost drive may have made one. */
        private const val ASLEEP = 3

        /** Boards say ten times a second what their motors get; older than this it is not known, s. */
        private const val ECHO = 0.35
        private const val REST_COPIES = 3
        private const val BUFFER = 4096

        /** So that a link that never runs dry can't hold a step up. */
        private const val MOST_READS = 16
    }
}
