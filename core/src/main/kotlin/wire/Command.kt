package stillwater.wire

import stillwater.model.Actuation

/** What is sent to a board. */
public sealed interface Command {
    /** Drives the actuators. Sent every 100 to 200 ms: it is the link's heartbeat too. */
    public data class Move(val actuation: Actuation) : Command

    /** Powers the motor controllers; takes 2 to 18 s by their type. */
    public data object Arm : Command

    /** Takes the power from the motor controllers. */
    public data object Disarm : Command

    /** Asks for the board's state. */
    public data object AskState : Command

    /** Says what is plugged into [port], 0 to 9. */
    public data class SetSensor(val port: Int, val sensor: PortSensor) : Command {
        init {
            requirePort(port)
        }
    }

    /**
     * Tells the oxygen probe on [port] the water's temperature, [celsius], −5 to 60 °C.
     *
     * No mission sends it: by the source of the firmware (master and v4.2.0) a probe that was told waits for an answer
     * that the firmware does not know, and gives no reading until the board is reset; and readings before and after
     * are not of one scale. So with [CompensateConductivity].
     */
    public data class CompensateTemperature(val port: Int, val celsius: Double) : Command {
        init {
            requirePort(port)
            require(celsius in -5.0..60.0) { "celsius ($celsius °C) must be in -5..60" }
        }
    }

    /** Tells the oxygen probe on [port] the water's conductivity, [microsiemensPerCm], 0 to 200 000 µS/cm. */
    public data class CompensateConductivity(val port: Int, val microsiemensPerCm: Double) : Command {
        init {
            requirePort(port)
            require(microsiemensPerCm in 0.0..200_000.0) {
                "microsiemensPerCm ($microsiemensPerCm µS/cm) must be in 0..200000"
            }
        }
    }

    /** Starts the water sampler on [port]. */
    public data class Sample(val port: Int) : Command {
        init {
            requirePort(port)
        }
    }

    private companion object {
        fun requirePort(port: Int) {
            require(port in 0..9) { "port ($port) must be in 0..9" }
        }
    }
}

/** What can be plugged into a port. [word] is its name on the wire. */
public enum class PortSensor(public val word: String) {
    /** Atlas EZO dissolved oxygen. */
    ATLAS_DO("AtlasDO"),

    /** Atlas EZO acidity. */
    ATLAS_PH("AtlasPH"),

    /** Decagon ES-2 conductivity and temperature. */
    ES2("ES2"),

    /** Humminbird depth sounder, NMEA 0183. */
    HDS("HDS"),

    /** Water sampler. */
    SAMPLER("Sampler"),

    /** Adafruit GPS receiver. */
    GPS("AdafruitGPS"),

    /** Nothing. */
    EMPTY("Empty"),
}

/** Turns commands into a board's bytes. */
public fun interface CommandEncoder {
    /** The bytes of [command], terminator included; empty where the board knows no such command. */
    public fun encode(command: Command): ByteArray
}

/**
 * Commands as a Platypus board reads them: one JSON object and LF each, two targets at most.
 *
 * Source: Platypus firmware v4.2.0, whose input buffer has 512 bytes and whose JSON tree 200. Shares are sent with
 * three decimals, but a rest as `0`, the shortest that means it: each digit is one that a spoilt byte can make a drive
 * of, and the lines have no checksum. The boats' own server, whose numbers Android's JSONObject writes, says rest so,
 * too. Stateless.
 */
public object PlatypusEncoder : CommandEncoder {
    override fun encode(command: Command): ByteArray = (json(command) + "\n").encodeToByteArray()

    private fun json(command: Command): String = when (command) {
        is Command.Move -> when (val actuation = command.actuation) {
            is Actuation.Differential ->
                """{"m0":{"v":${share(actuation.left)}},"m1":{"v":${share(actuation.right)}}}"""
            // The servo's sign is the other way round.
            is Actuation.Vectored ->
                """{"m0":{"v":${share(actuation.thrust)}},"s0":{"p":${share(-actuation.rudder)}}}"""
        }
        Command.Arm -> """{"e":{"cmd":"arm"}}"""
        Command.Disarm -> """{"e":{"cmd":"disarm"}}"""
        Command.AskState -> """{"e":{"info":"state"}}"""
        is Command.SetSensor -> """{"e":{"s${command.port}":"${command.sensor.word}"}}"""
        is Command.CompensateTemperature -> """{"s${command.port}":{"temp":"${fixed(command.celsius, 1)}"}}"""
        is Command.CompensateConductivity ->
            """{"s${command.port}":{"ec":"${fixed(command.microsiemensPerCm, 0)}"}}"""
        is Command.Sample -> """{"s${command.port}":{"sample":true}}"""
    }

    private fun share(value: Double) = fixed(value, 3).let { if (it == NONE) "0" else it }

    private const val NONE = "0.000"
}

/**
 * Drive commands as a board of the original Amarino protocol reads them: flag `v`, six velocities parted by `;`, 0x13.
 *
 * The first velocity is forward and the last the turn, as in `v0.5;0.0;0.0;0.0;0.0;0.1`. Of the other commands the
 * board knows only the sampler's, `q`. Source: CRW Amarino firmware. Stateless.
 */
public object AmarinoEncoder : CommandEncoder {
    override fun encode(command: Command): ByteArray = when (command) {
        is Command.Move -> when (val actuation = command.actuation) {
            is Actuation.Differential -> velocities(
                (actuation.left + actuation.right) / 2,
                (actuation.right - actuation.left) / 2,
            )
            is Actuation.Vectored -> velocities(actuation.thrust, actuation.rudder)
        }
        is Command.Sample -> "q${command.port}$END".encodeToByteArray()
        else -> ByteArray(0)
    }

    private fun velocities(forward: Double, turn: Double) =
        "v${fixed(forward, 3)};0.0;0.0;0.0;0.0;${fixed(turn, 3)}$END".encodeToByteArray()

    private const val END = '\u0013'
}

/** [value] with [decimals] decimals, whatever the locale; −0 is written 0. */
private fun fixed(value: Double, decimals: Int): String {
    var scale = 1L
    repeat(decimals) { scale *= 10 }
    val units = Math.round(value * scale)
    val magnitude = Math.abs(units)
    val whole = "${if (units < 0) "-" else ""}${magnitude / scale}"
    return if (decimals == 0) whole else "$whole.${(magnitude % scale).toString().padStart(decimals, '0')}"
}
