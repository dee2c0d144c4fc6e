package stillwater.wire

import stillwater.model.LatLon

/**
 * What a board says, one thing at a time. A line may hold several.
 *
 * `port` is the number n of the board's sensor port "sn"; [NO_PORT] where the protocol names none.
 *
 * Source: Platypus firmware v4.2.0 and the original Amarino firmware, as in the project's notes on serial protocols.
 */
public sealed interface Message {
    /**
     * A motor's state. About 10 Hz; the board's heartbeat.
     *
     * @property velocity commanded share of full thrust, dimensionless.
     * @property current A; NaN on newer boards, which do not send it.
     */
    public data class Motor(val index: Int, val velocity: Double, val current: Double) : Message

    /** A servo's or rudder's state: [position], a share of its full swing, dimensionless, in the board's own sign. */
    public data class Servo(val index: Int, val position: Double) : Message

    /** The battery: [volts], V. Every 1 to 5 s. */
    public data class Battery(val port: Int, val volts: Double) : Message

    /** Dissolved oxygen, [milligramsPerLitre], mg/L. */
    public data class Oxygen(val port: Int, val milligramsPerLitre: Double) : Message

    /** Acidity, [ph], dimensionless. */
    public data class Acidity(val port: Int, val ph: Double) : Message

    /** Electrical conductivity, [microsiemensPerCm], µS/cm, and water temperature, [celsius], °C. */
    public data class Conductivity(val port: Int, val microsiemensPerCm: Double, val celsius: Double) : Message

    /** Depth of the water below the transducer, [metres], m. */
    public data class Depth(val port: Int, val metres: Double) : Message

    /** Water temperature, [celsius], °C. */
    public data class WaterTemperature(val port: Int, val celsius: Double) : Message

    /**
     * A fix of a receiver on the board.
     *
     * @property secondsOfDay UTC time of day, s.
     * @property place where; null where the receiver said that it had no fix.
     * @property speed over ground, m/s; NaN where not given.
     * @property courseDeg over ground, compass degrees; NaN where not given.
     */
    public data class Fix(
        val port: Int,
        val secondsOfDay: Double,
        val place: LatLon?,
        val speed: Double,
        val courseDeg: Double,
    ) : Message

    /** Cable paid out by the winch, [metres], m. */
    public data class Winch(val port: Int, val metres: Double) : Message

    /**
     * The board's own inertial unit.
     *
     * @property headingDeg compass degrees.
     * @property system calibration level 0 to 3, as [magnetometer], [gyroscope] and [accelerometer].
     */
    public data class Imu(
        val port: Int,
        val headingDeg: Double,
        val system: Int,
        val magnetometer: Int,
        val gyroscope: Int,
        val accelerometer: Int,
    ) : Message

    /** A sensor whose numbers mean nothing to this program: [type] as sent, [values] in its own units. */
    public data class Other(val port: Int, val type: String, val values: List<Double>) : Message

    /** The board's state. */
    public data class State(val state: BoardState) : Message

    /** The board could not use a command: [kind], and [raw], what it got, as far as it sent it back. */
    public data class Refused(val kind: BoardError, val raw: String) : Message

    /** A line of plain text, such as `Arming motor 0...`. */
    public data class Notice(val text: String) : Message

    public companion object {
        /** The port of what names none. */
        public const val NO_PORT: Int = -1
    }
}

/** What the board's watchdog lets it do. [word] is its name on the wire. */
public enum class BoardState(public val word: String) {
    /** Motors are powered and obey. */
    ACTIVE("active"),

    /** Commands stopped coming; motors are at zero. */
    CONNECTED("connected"),

    /** Motors are off until they are armed. */
    STANDBY("standby"),
}

/** Why the board could not use a command; [text] is how it begins to say so. */
public enum class BoardError(public val text: String) {
    /** The line was not JSON to it. */
    JSON("Failed to parse JSON command."),

    /** No such motor. */
    MOTOR("Invalid motor index."),

    /** No such sensor port. */
    SENSOR("Invalid sensor index."),

    /** No such target. */
    TARGET("Unknown command target."),

    /** No such parameter. */
    PARAMETER("Invalid parameter set."),

    /** Words that this program does not know. */
    UNKNOWN(""),
}

/** Takes what was decoded, in the order in which it was sent. */
public fun interface MessageSink {
    /** Takes [message]. */
    public fun message(message: Message)
}

/** What can be wrong with what a board sends. */
public enum class Malformed {
    /** A line longer than the framer holds. */
    OVERSIZED,

    /** Bytes that are no text. */
    BINARY,

    /** An object that is not well-formed, or text that is neither an object nor a notice. */
    SYNTAX,

    /** A well-formed object about something unknown. */
    UNKNOWN_TARGET,

    /** A known sensor whose value is not the numbers it should be, or not finite. */
    BAD_VALUE,

    /** A sentence whose checksum is wrong. */
    CHECKSUM,
}

/** How many times each kind of malformed input was met. Confined to one thread. */
public class MalformedCounts {
    private val counts = LongArray(Malformed.entries.size)

    /** Times [kind] was met. */
    public operator fun get(kind: Malformed): Long = counts[kind.ordinal]

    /** All kinds together. */
    public val total: Long get() = counts.sum()

    internal fun count(kind: Malformed) {
        counts[kind.ordinal]++
    }

    override fun toString(): String =
        Malformed.entries.filter { get(it) > 0 }.joinToString { "${it.name.lowercase()} ${get(it)}" }
}
