package stillwater.virtual

import stillwater.model.Actuation
import stillwater.model.BoatTime
import stillwater.wire.LineFramer
import kotlin.math.abs
import kotlin.math.roundToInt

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
 * The Arduino's side of the wire: Platypus firmware of either generation, as silent as it is in each mode.
 *
 * Moves nothing itself: [actuation] is what its motors get. Differential boats only have m0 and m1; s0's position is the
 * rudder's of a vectored one. Driven by [advance] in virtual time; pure and deterministic. Confined to one thread.
 *
 * The firmware's one task for motors sleeps 0.1 s between its rounds. A drive is believed whatever the mode is, and taken
 * back by the next round of a board that is not to run: one that is connected and told to drive ten times a second
 * twitches. While it arms that task does nothing else, so nothing takes a drive back, and the first motor runs by it
 * before the second is armed.
 *
 * Source: [Firmware]. Differs: the JSON reader knows only the objects the phone sends; motors reach what they are told at
 * once, where the firmware ramps them within some ms; of two lines that come as one the accessory line of the master
 * branch reads only the first.
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
    /** The master branch has no standby while its cable is plugged in, and calls active running. */
    private enum class Mode { BOOTING, STANDBY, CONNECTED, ACTIVE }

    private enum class Power { OFF, ARMING, ON }

    private val isNewer = spec.firmware == Firmware.V4_2
    private val framer = LineFramer(
        { bytes, start, end -> command(String(bytes, start, end - start, Charsets.ISO_8859_1)) },
        longest = 512,
    )
    private var mode = Mode.BOOTING
    private var power = Power.OFF
    private var now = 0.0
    private var bootedAt = 0.0
    private var armedFrom = 0.0
    private var heardAt = 0.0
    private var motorRound = 0.0
    private var batteryLine = 0.0
    private var probeLine = 0.0
    private var first = 0.0
    private var second = 0.0
    private var rudder = 0.0
    private var isProbeNamed = spec.knowsProbe

    /** Volts, V; may be set to let the battery sag. */
    public var volts: Double = spec.volts

    /** Readings of the probe that it has sent. */
    public var readings: Long = 0
        private set

    /** What the motors get: nothing unless they have power and were told to run. */
    public val actuation: Actuation
        get() {
            val left = if (firstHasPower()) first else 0.0
            val right = if (power == Power.ON) second else 0.0
            return if (vectored) Actuation.Vectored(left, -rudder) else Actuation.Differential(left, right)
        }

    /** Starts the board anew, as opening its port does: disarmed, and silent while it boots. */
    public fun reset() {
        mode = Mode.BOOTING
        power = Power.OFF
        bootedAt = now
        heardAt = now
        first = 0.0
        second = 0.0
        rudder = 0.0
        forgetProbe()
        framer.reset()
    }

    /** What was said of the probe's port is forgotten, as if it had not been heard. */
    public fun forgetProbe() {
        isProbeNamed = spec.knowsProbe
    }

    /** Takes bytes from the phone. Not modified, not retained. */
    public fun receive(bytes: ByteArray, offset: Int = 0, length: Int = bytes.size - offset) {
        if (mode == Mode.BOOTING || length == 0) return
        heardAt = now
        watch()
        framer.accept(bytes, offset, length)
    }

    /** Lets [dt] s pass, at most 0.1 for the rates to hold; not above 0 or not finite passes none. */
    public fun advance(dt: Double) {
        if (!(dt > 0 && dt.isFinite())) return
        now += dt
        if (mode == Mode.BOOTING) {
            if (now - bootedAt < spec.booting) return
            mode = Mode.STANDBY
        }
        watch()
        if (now - motorRound >= MOTOR_PERIOD) {
            motorRound = now
            motors()
        }
        speak()
    }

    /** What the time since the last byte makes of the mode. */
    private fun watch() {
        val silence = now - heardAt
        when {
            mode == Mode.ACTIVE -> if (silence >= spec.watchdog) enter(Mode.CONNECTED)
            !isNewer -> mode = if (silence < spec.watchdog) Mode.ACTIVE else Mode.CONNECTED
            mode == Mode.CONNECTED -> if (silence >= spec.standby) enter(Mode.STANDBY)
            mode == Mode.STANDBY -> if (silence < spec.standby) enter(Mode.CONNECTED)
        }
    }

    private fun enter(next: Mode) {
        mode = next
        // On the accessory line the master branch does not tell.
        if (isNewer) output.line("STATE: ${next.name}\r\n")
    }

    /** A round of the task for motors; there is none while it arms. */
    private fun motors() {
        if (power == Power.ARMING) {
            if (now - armedFrom < spec.arming) return
            power = Power.ON
        }
        if (mode == Mode.STANDBY) {
            power = Power.OFF
            return
        }
        if (mode == Mode.CONNECTED) {
            first = 0.0
            second = 0.0
        }
        if (power == Power.OFF && (mode == Mode.ACTIVE || !isNewer)) {
            power = Power.ARMING
            armedFrom = now
        } else if (mode == Mode.ACTIVE) {
            output.line("{\"m0\":{${motor(first)}},\"m1\":{${motor(second)}}}\r\n")
        }
    }

    private fun firstHasPower() =
        power == Power.ON || (power == Power.ARMING && now - armedFrom >= spec.arming / 2)

    private fun speak() {
        if (now - batteryLine >= spec.batteryPeriod) {
            batteryLine = now
            output.line("{\"s4\":{\"type\":\"battery\",\"data\":\"${fixed(volts, 1000)} 0.000000 0\"}}\r\n")
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

    private fun motor(share: Double) = "\"v\":${fixed(share, 1000)}000" + if (isNewer) "" else ",\"c\":0.000000"

    private fun command(line: String) {
        val move = if (vectored) VECTORED.matchEntire(line) else DIFFERENTIAL.matchEntire(line)
        val port = SENSOR.matchEntire(line)
        when {
            move != null -> move(move)
            isNewer && port != null -> setUp(port)
            isNewer && line == """{"e":{"cmd":"arm"}}""" -> {
                output.line("Arming Boat\r\n")
                enter(Mode.ACTIVE)
            }
            isNewer && line == """{"e":{"cmd":"disarm"}}""" -> {
                output.line("Disarming Boat\r\n")
                enter(Mode.CONNECTED)
            }
            isNewer && line == """{"e":{"info":"state"}}""" ->
                output.line("{\"e\":{\"type\":\"state\",\"data\":\"${mode.name.lowercase()}\"}}\r\n")
            SETTING.matches(line) -> Unit
            !line.startsWith("{") || !line.endsWith("}") -> error("Failed to parse JSON command.", line)
            else -> error("Unknown command target.", line)
        }
    }

    /** Whoever is told what is on its port starts it over: the next reading comes a whole period later. */
    private fun setUp(match: MatchResult) {
        if (match.groupValues[1] != "1") return
        isProbeNamed = match.groupValues[2] == "AtlasDO"
        probeLine = now
    }

    private fun move(match: MatchResult) {
        first = share(match.groupValues[1])
        if (vectored) rudder = share(match.groupValues[2]) else second = share(match.groupValues[2])
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
        val DIFFERENTIAL = Regex("""\{"m0":\{"v":(-?[0-9.]+)},"m1":\{"v":(-?[0-9.]+)}}""")
        val VECTORED = Regex("""\{"m0":\{"v":(-?[0-9.]+)},"s0":\{"p":(-?[0-9.]+)}}""")
        val SENSOR = Regex("""\{"e":\{"s(\d)":"(\w+)"}}""")
        val SETTING = Regex("""\{"s\d":(\{"(temp|ec)":"[-0-9.]+"|\{"sample":true)}}""")
    }
}
