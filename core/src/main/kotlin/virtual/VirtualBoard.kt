package stillwater.virtual

import stillwater.model.Actuation
import stillwater.model.BoatTime
import stillwater.wire.LineFramer
import kotlin.math.abs
import kotlin.math.roundToInt

/**
 * The electronics of a virtual boat.
 *
 * @property watchdog without a command for so long the motors go to zero, s: 3 on firmware v4.2.0, 0.5 on the master.
 * @property standby without a command for so much longer the motors need arming again, s.
 * @property arming time that arming takes, s; 2 to 18 by the motor controllers' type.
 * @property booting time after a reset in which nothing is heard or said, s.
 * @property sendsCurrent whether motor lines have the current, as the older boards' do.
 * @property oxygenPeriod time between readings of the probe on port 1, s: about 3, on older boards 0.5.
 * @property volts of the battery, V.
 * @property knowsProbe whether port 1 has its probe built in; else it is silent until it was told, as on firmware v4.2.0,
 *   and again after each reset.
 * @property wakesByDrives whether a drive ends the rest that the watchdog began; else the motors need arming again.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class BoardSpec(
    val watchdog: Double = 0.5,
    val standby: Double = 5.0,
    val arming: Double = 2.0,
    val booting: Double = 1.5,
    val sendsCurrent: Boolean = true,
    val oxygenPeriod: Double = 3.0,
    val volts: Double = 15.3,
    val knowsProbe: Boolean = true,
    val wakesByDrives: Boolean = true,
) {
    init {
        for ((name, value) in listOf(
            "watchdog (s)" to watchdog,
            "standby (s)" to standby,
            "arming (s)" to arming,
            "booting (s)" to booting,
            "oxygenPeriod (s)" to oxygenPeriod,
            "volts (V)" to volts,
        )) {
            require(value > 0 && value.isFinite()) { "$name ($value) must be above 0 and finite" }
        }
    }
}

/** The truth that the probe on the board shows at a moment, sensor units. */
public fun interface Probe {
    /** What the probe says at [time], [dt] s after it was last asked; NaN where it gives nothing. */
    public fun read(time: BoatTime, dt: Double): Double
}

/** Takes what the board sends, terminator included. */
public fun interface BoardOutput {
    /** Takes [line]. */
    public fun line(line: String)
}

/**
 * The Arduino's side of the wire: Platypus firmware with its watchdog, arming delay, error lines and sensor rates.
 *
 * Moves nothing itself: [actuation] is what its motors get. Differential boats only have m0 and m1; s0's position is the
 * rudder's of a vectored one. Driven by [advance] in virtual time; pure and deterministic. Confined to one thread.
 *
 * Source: Platypus firmware v4.2.0, as in the project's notes on serial protocols. Differs: the JSON reader knows only the
 * objects the phone sends.
 *
 * @property spec its times and voltages.
 * @param probe the dissolved-oxygen probe on port 1. Retained.
 * @param vectored whether it has a thruster and a rudder in place of two thrusters.
 * @param output where lines go. Retained.
 */
public class VirtualBoard(
    public val spec: BoardSpec,
    private val vectored: Boolean,
    private val probe: Probe,
    private val output: BoardOutput,
) {
    private enum class Mode { BOOTING, STANDBY, ARMING, ACTIVE, CONNECTED }

    private val framer = LineFramer(
        { bytes, start, end -> command(String(bytes, start, end - start, Charsets.ISO_8859_1)) },
        longest = 512,
    )
    private var mode = Mode.BOOTING
    private var now = 0.0
    private var since = 0.0
    private var lastCommand = Double.NEGATIVE_INFINITY
    private var motorLine = 0.0
    private var batteryLine = 0.0
    private var probeLine = 0.0
    private var first = 0.0
    private var second = 0.0
    private var isProbeNamed = spec.knowsProbe

    /** Volts, V; may be set to let the battery sag. */
    public var volts: Double = spec.volts

    /** Readings of the probe that it has sent. */
    public var readings: Long = 0
        private set

    /** What the motors get: nothing unless armed and fed with commands. */
    public val actuation: Actuation
        get() = when {
            mode != Mode.ACTIVE -> if (vectored) Actuation.Vectored(0.0, 0.0) else Actuation.Differential(0.0, 0.0)
            vectored -> Actuation.Vectored(first, -second)
            else -> Actuation.Differential(first, second)
        }

    /** Starts the board anew, as opening its port does: disarmed, and silent while it boots. */
    public fun reset() {
        enter(Mode.BOOTING)
        forgetProbe()
        framer.reset()
    }

    /** What was said of the probe's port is forgotten, as if it had not been heard. */
    public fun forgetProbe() {
        isProbeNamed = spec.knowsProbe
    }

    /** Takes bytes from the phone. Not modified, not retained. */
    public fun receive(bytes: ByteArray, offset: Int = 0, length: Int = bytes.size - offset) {
        if (mode != Mode.BOOTING) framer.accept(bytes, offset, length)
    }

    /** Lets [dt] s pass, at most 0.1 for the rates to hold; not above 0 or not finite passes none. */
    public fun advance(dt: Double) {
        if (!(dt > 0 && dt.isFinite())) return
        now += dt
        val inMode = now - since
        when (mode) {
            Mode.BOOTING -> if (inMode < spec.booting) return else enter(Mode.STANDBY)
            Mode.ARMING -> if (inMode >= spec.arming) enter(Mode.ACTIVE)
            Mode.ACTIVE -> if (now - lastCommand > spec.watchdog) enter(Mode.CONNECTED)
            Mode.CONNECTED -> if (inMode > spec.standby) enter(Mode.STANDBY)
            Mode.STANDBY -> Unit
        }
        speak()
    }

    private fun enter(next: Mode) {
        mode = next
        since = now
        if (next == Mode.ACTIVE) lastCommand = now
        if (next != Mode.ACTIVE) {
            first = 0.0
            second = 0.0
        }
    }

    private fun speak() {
        if (now - motorLine >= MOTOR_PERIOD) {
            motorLine = now
            output.line("{\"m0\":{${motor(first)}}" + (if (vectored) "" else ",\"m1\":{${motor(second)}}") + "}\r\n")
        }
        if (now - batteryLine >= BATTERY_PERIOD) {
            batteryLine = now
            output.line("{\"s4\":{\"type\":\"battery\",\"data\":\"${fixed(volts, 1000)} 0.000000 0.000000\"}}\r\n")
        }
        if (now - probeLine >= spec.oxygenPeriod) {
            val value = probe.read(BoatTime(now), now - probeLine)
            probeLine = now
            if (!value.isNaN() && isProbeNamed) {
                readings++
                output.line("{\"s1\":{\"type\":\"atlas_do\",\"data\":\"${fixed(value, 100)}\"}}\r\n")
            }
        }
    }

    private fun motor(share: Double) =
        "\"v\":${fixed(share, 1000)}000" + if (spec.sendsCurrent) ",\"c\":0.000000" else ""

    private fun command(line: String) {
        lastCommand = now
        val move = if (vectored) VECTORED.matchEntire(line) else DIFFERENTIAL.matchEntire(line)
        when {
            move != null -> move(move)
            line == """{"e":{"cmd":"arm"}}""" -> {
                if (mode != Mode.ACTIVE) enter(Mode.ARMING)
                output.line("Arming motor 0...\r\n")
            }
            line == """{"e":{"cmd":"disarm"}}""" -> enter(Mode.STANDBY)
            line == """{"e":{"info":"state"}}""" -> {
                val word = if (mode == Mode.ARMING) "standby" else mode.name.lowercase()
                output.line("{\"e\":{\"type\":\"state\",\"data\":\"$word\"}}\r\n")
            }
            line == """{"e":{"s1":"AtlasDO"}}""" -> isProbeNamed = true
            SETTING.matches(line) -> Unit
            !line.startsWith("{") || !line.endsWith("}") -> error("Failed to parse JSON command.", line)
            else -> error("Unknown command target.", line)
        }
    }

    private fun move(match: MatchResult) {
        if (mode == Mode.CONNECTED && spec.wakesByDrives) enter(Mode.ACTIVE)
        if (mode != Mode.ACTIVE) return
        first = share(match.groupValues[1])
        second = share(match.groupValues[2])
    }

    private fun share(text: String) = (text.toDoubleOrNull() ?: 0.0).coerceIn(-1.0, 1.0)

    /** As on the board, what it got is not escaped. */
    private fun error(words: String, line: String) = output.line("{\"error\": \"$words\",\"args\": \"$line\"}\r\n")

    private fun fixed(value: Double, scale: Int): String {
        val units = (value * scale).roundToInt()
        val digits = scale.toString().length - 1
        val magnitude = abs(units)
        val decimals = (magnitude % scale).toString().padStart(digits, '0')
        return (if (units < 0) "-" else "") + "${magnitude / scale}.$decimals"
    }

    private companion object {
        const val MOTOR_PERIOD = 0.1 - 1e-9
        const val BATTERY_PERIOD = 1.0
        val DIFFERENTIAL = Regex("""\{"m0":\{"v":(-?[0-9.]+)},"m1":\{"v":(-?[0-9.]+)}}""")
        val VECTORED = Regex("""\{"m0":\{"v":(-?[0-9.]+)},"s0":\{"p":(-?[0-9.]+)}}""")
        val SETTING = Regex("""\{"(e":\{"s\d":"\w+"|s\d":\{"(temp|ec)":"[-0-9.]+"|s\d":\{"sample":true)}}""")
    }
}
