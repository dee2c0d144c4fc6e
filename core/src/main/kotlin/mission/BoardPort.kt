package stillwater.mission

import stillwater.control.Mixing
import stillwater.model.Actuation
import stillwater.model.BoatTime
import stillwater.model.Drive
import stillwater.wire.BoardError
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
 * for a first rest. Never throws on data. Confined to one thread.
 *
 * What it believes of boards was read in the Platypus firmware's source. Both generations, v4.2.0 and the master branch
 * before it, speak of motors ten times a second exactly while motors have power and obey, so that a motor line is the
 * one sure sign of a board that runs. Else they speak of their battery every 1 to 5 s, of their probes, and v4.2.0 of
 * its state when asked and when it changes. v4.2.0 says active from the moment it is told to arm, seconds before it
 * has.
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
    private var isStateless = false

    /**
     * What the board last said of itself, a motor line being the word of an active one; null where it has said nothing
     * since it was last told to be otherwise. Boards of the master branch never say more than that.
     */
    public var state: BoardState? = null
        private set

    /** Whether the board has spoken of its motors since it was told to arm, and has not said since that it rests. */
    public val isRunning: Boolean get() = echoedAt > Double.NEGATIVE_INFINITY

    /**
     * Whether the board has said that it has to be armed before it drives. v4.2.0 is connected after it was told to
     * disarm, after its watchdog and after a reset; in none of these a drive makes it go on.
     */
    public val isDisarmed: Boolean get() = state != null && state != BoardState.ACTIVE

    /** Whether the board is of the master branch: it refuses all words of states, arms itself and cannot be disarmed. */
    public val armsItself: Boolean get() = isStateless

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

    /** Time since the board last spoke of its motors, s; infinite where it has not since it was armed, or rests. */
    public fun motorSilence(now: BoatTime): Double = now.seconds - echoedAt

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
     * Drives; [drive] has passed the safety gate. Rest is sent at once, the rest of drives at the heartbeat's rate.
     * Where [isCalm] a rest is not repeated for as long as the board says that its motors rest: each line may be spoilt
     * on the way and become a drive. Questions keep the board awake meanwhile; where one is not answered at once and
     * the board is to stay armed, [staysArmed], rests do.
     */
    public fun tell(now: BoatTime, drive: Drive, isCalm: Boolean = false, staysArmed: Boolean = false) {
        val actuation = mixing.mix(drive)
        val isNewRest = actuation.isAtRest && !sent.isAtRest
        restedFrom = if (actuation.isAtRest) minOf(restedFrom, now.seconds) else Double.POSITIVE_INFINITY
        val isLate = staysArmed && isAsked && now.seconds - askedAt > KEEPING
        val isSpared = isCalm && isRestKept(now) && !isLate
        if (!isNewRest && (now.seconds - toldAt < HEARTBEAT || isSpared)) return
        toldAt = now.seconds
        sent = actuation
        repeat(if (isNewRest) copies(now) else 1) { send(Command.Move(actuation)) }
    }

    /**
     * A line that is hit on the way is not heard, and of a first rest that must not happen. A board that speaks of its
     * motors shows whether it was, and is told on where it was not; of one that does not, these may be the last words,
     * and each that is spoilt feeds its watchdog as well as a good one.
     */
    private fun copies(now: BoatTime) = if (motorSilence(now) > ECHO) LAST_COPIES else REST_COPIES

    /** Says rest at once, as often as a first rest (more often to a board that is silent), whatever was said before. */
    public fun rest(now: BoatTime) {
        sent = mixing.mix(Drive.NONE)
        restedFrom = minOf(restedFrom, now.seconds)
        toldAt = now.seconds
        repeat(copies(now)) { send(Command.Move(sent)) }
    }

    /** Whether rest was said for long enough, and the board says that its motors rest. */
    public fun isRestKept(now: BoatTime): Boolean = now.seconds - restedFrom >= RESTING &&
        now.seconds - echoedAt < ECHO &&
        now.seconds - ranAt > ECHO

    /** Whether the board says that its motors run. */
    internal fun saysItRuns(now: BoatTime): Boolean = now.seconds - ranAt <= ECHO

    /**
     * Sends [command] at once. One to arm or to disarm makes what the board said before worthless, and so the answer to
     * a question that it was asked before; one that only repeats the last does not.
     */
    public fun order(command: Command) {
        if (command == Command.Arm || (command == Command.Disarm && ordered != Command.Disarm)) {
            state = null
            echoedAt = Double.NEGATIVE_INFINITY
            isAnswerOld = isAsked
        }
        if (command == Command.Arm || command == Command.Disarm) ordered = command
        send(command)
    }

    /**
     * Asks the board for its state, unless that was done less than [pause] s ago, or less than [PATIENCE] s and it has
     * not answered yet: which question an answer is to must not be in doubt.
     */
    public fun askState(now: BoatTime, pause: Double = PATIENCE) {
        if (now.seconds - askedAt < if (isAsked) PATIENCE else pause) return
        askedAt = now.seconds
        isAsked = true
        send(Command.AskState)
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
            is Message.Refused -> takeRefusal(message)
            is Message.Motor -> {
                echoedAt = now.seconds
                state = BoardState.ACTIVE
                if (message.velocity != 0.0) ranAt = now.seconds
            }
            else -> Unit
        }
        sink.message(message)
    }

    /** Where the old answer was lost on the way a new one is passed over in its place, and the next one counts. */
    private fun takeState(said: BoardState) {
        isStateless = false
        if (!isAnswerOld) {
            state = said
            if (said != BoardState.ACTIVE) echoedAt = Double.NEGATIVE_INFINITY
        }
        isAnswerOld = false
        isAsked = false
    }

    /**
     * The master branch has no target "e" at all: it says "Unknown command target.", its older versions "Unknown
     * command entry.". Its reader of JSON cuts up what it reads, so that of the line it got it may echo no more than
     * the target.
     */
    private fun takeRefusal(refused: Message.Refused) {
        refusals++
        if (refused.kind != BoardError.TARGET && refused.kind != BoardError.UNKNOWN) return
        if (refused.raw.firstOrNull { it.isLetter() } != 'e') return
        isStateless = true
        isAsked = false
    }

    public companion object {
        /** Time between drives, s: well within the watchdog of 0.5 s. */
        public const val HEARTBEAT: Double = 0.1 - 1e-6

        /** Time between questions that are not answered, s. */
        public const val PATIENCE: Double = 1.0

        /** Silence after which nothing more is said of drives, s: rest was said four times. */
        internal const val RESTING: Double = 0.5

        /**
         * Time between questions that keep a board awake to which no drives are said, s: twice that is within the
         * watchdog of 0.5 s.
         */
        public const val KEEPING: Double = 0.2 - 1e-6

        /** Boards say ten times a second what their motors get; older than this it is not known, s. */
        private const val ECHO = 0.35
        private const val REST_COPIES = 3

        /**
         * Of one byte in a hundred spoilt a rest of 28 bytes is lost in one of four, all three in one of 68 and all six
         * in one of 4600. They fill 168 of the 512 bytes that a board takes in.
         */
        private const val LAST_COPIES = 6
        private const val BUFFER = 4096

        /** So that a link that never runs dry can't hold a step up. */
        private const val MOST_READS = 16
    }
}
