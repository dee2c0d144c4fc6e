package stillwater.app.link

import stillwater.mission.Quantity
import stillwater.mission.Quantity.ACIDITY
import stillwater.mission.Quantity.CONDUCTIVITY
import stillwater.mission.Quantity.DEPTH
import stillwater.mission.Quantity.DISSOLVED_OXYGEN
import stillwater.mission.Quantity.TEMPERATURE
import stillwater.wire.BoardState
import stillwater.wire.ByteLink
import stillwater.wire.LineFramer
import stillwater.wire.Message
import stillwater.wire.PlatypusCodec

/**
 * What the board has said, as far as the screens show it. Null where it has not said so on this connection.
 *
 * @property lines whole lines that came.
 * @property malformed lines, or parts of them, that were not understood.
 * @property refusals commands that the board could not use.
 * @property batteryVolts of the boat, V.
 * @property oxygen dissolved, mg/L.
 * @property acidity pH, dimensionless.
 * @property conductivity µS/cm.
 * @property celsius temperature of the water, °C.
 * @property depth of the water, m.
 * @property probes what was measured, and on which ports of the board.
 */
data class BoardReport(
    val lines: Long = 0,
    val malformed: Long = 0,
    val refusals: Long = 0,
    val state: BoardState? = null,
    val batteryVolts: Double? = null,
    val oxygen: Double? = null,
    val acidity: Double? = null,
    val conductivity: Double? = null,
    val celsius: Double? = null,
    val depth: Double? = null,
    val probes: Set<HeardProbe> = emptySet(),
)

/** Something that measures [quantity] on [port] of the board. */
data class HeardProbe(val port: Int, val quantity: Quantity)

/** Listens to a board: core cuts the bytes into lines and the lines into messages. Confined to one thread. */
internal class BoardEars {
    private val codec = PlatypusCodec(::hear)
    private val framer = LineFramer(codec)
    private var heard = BoardReport()

    /** Messages understood so far. */
    var messages = 0L
        private set

    /** What was said so far. */
    val report: BoardReport
        get() = heard.copy(lines = framer.lines, malformed = codec.malformed.total + framer.oversized)

    /** Takes the first [length] of [bytes], or, where that is [ByteLink.LOST], that the link is lost. */
    fun take(bytes: ByteArray, length: Int) {
        if (length == ByteLink.LOST) {
            // What follows is not the rest of the line that was cut, nor need it be the same board.
            framer.reset()
            heard = BoardReport(refusals = heard.refusals)
        } else {
            framer.accept(bytes, 0, length)
        }
    }

    private fun hear(message: Message) {
        messages++
        heard =
            when (message) {
                is Message.State -> heard.copy(state = message.state)
                is Message.Battery -> heard.copy(batteryVolts = message.volts)
                is Message.Oxygen ->
                    heard.copy(oxygen = message.milligramsPerLitre, probes = of(message.port, DISSOLVED_OXYGEN))
                is Message.Acidity -> heard.copy(acidity = message.ph, probes = of(message.port, ACIDITY))
                is Message.Conductivity ->
                    heard.copy(
                        conductivity = message.microsiemensPerCm,
                        celsius = message.celsius,
                        probes = of(message.port, CONDUCTIVITY, TEMPERATURE),
                    )
                is Message.WaterTemperature ->
                    heard.copy(celsius = message.celsius, probes = of(message.port, TEMPERATURE))
                is Message.Depth -> heard.copy(depth = message.metres, probes = of(message.port, DEPTH))
                is Message.Refused -> heard.copy(refusals = heard.refusals + 1)
                else -> heard
            }
    }

    /** The probes heard so far, with those of [quantities] on [port]; the same set where they were among them. */
    private fun of(port: Int, vararg quantities: Quantity): Set<HeardProbe> {
        val now = quantities.map { HeardProbe(port, it) }
        return if (heard.probes.containsAll(now)) heard.probes else heard.probes + now
    }
}
