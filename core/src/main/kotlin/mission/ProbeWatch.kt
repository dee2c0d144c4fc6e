package stillwater.mission

import stillwater.model.BoatTime
import stillwater.wire.Command
import stillwater.wire.PortSensor

/** Port 0 is the rudder's and has no serial line, ports from 4 on are the board's own. */
private val SERIAL_PORTS = 1..3

/**
 * What a board is to be told of the probe's port before it reads it; null where the mission names no port, or one that
 * has no choice.
 */
public val ProbeSpec.setUp: Command?
    get() = if (port !in SERIAL_PORTS) {
        null
    } else {
        when (quantity) {
            Quantity.DISSOLVED_OXYGEN -> PortSensor.ATLAS_DO
            Quantity.ACIDITY -> PortSensor.ATLAS_PH
            Quantity.CONDUCTIVITY -> PortSensor.ES2
            Quantity.DEPTH -> PortSensor.HDS
            // Two kinds of sensor have it.
            Quantity.TEMPERATURE -> null
        }?.let { Command.SetSensor(checkNotNull(port), it) }
    }

/**
 * Knows what the board is to be told of the probe's port, and keeps watch whether the probe speaks.
 *
 * Firmware v4.2.0 reads a port only once it was told what is there, and forgets it at each reset; a probe whose answer
 * it missed it waits for for ever, until it is told anew. Older firmware has its probes built in and refuses the words,
 * which does no harm. To be told anew starts a probe over and costs readings: so the board is told only of a probe that
 * is silent, [MOST] times until it speaks, and when the boat rests. Confined to one thread.
 */
internal class ProbeWatch(probe: ProbeSpec) {
    private var begunAt = Double.NaN
    private var heardAt = Double.NEGATIVE_INFINITY
    private var toldAt = Double.NEGATIVE_INFINITY
    private var told = 0

    /** What the board is to be told, see [ProbeSpec.setUp]. */
    val setUp: Command? = probe.setUp

    /** The mission begins at [now]. */
    fun begin(now: BoatTime) {
        begunAt = now.seconds
    }

    /** The probe was heard at [now], whatever became of the reading. */
    fun heard(now: BoatTime) {
        heardAt = now.seconds
        told = 0
    }

    /** Time since the probe was heard, or since the mission began, s; NaN before it did. */
    fun silence(now: BoatTime): Double = now.seconds - maxOf(begunAt, heardAt)

    /** The board is told at [now]. */
    fun told(now: BoatTime) {
        toldAt = now.seconds
        told++
    }

    /** Whether the board was told since the probe last spoke. */
    val isTold: Boolean get() = told > 0

    /** Whether a board at rest is to be told at [now]. */
    fun isDue(now: BoatTime): Boolean = isSilent(now, SHORT)

    /** Whether a boat under way is to rest at [now] to be told. */
    fun isMissed(now: BoatTime): Boolean = isSilent(now, LONG)

    private fun isSilent(now: BoatTime, silence: Double) = setUp != null &&
        told < MOST &&
        now.seconds - heardAt > silence &&
        now.seconds - toldAt > PAUSE

    private companion object {
        /** More than the slowest firmware takes for a reading, 3 s. */
        const val SHORT = 5.0

        /** Three times that. */
        const val LONG = 10.0

        /** Within which a probe that was told speaks, s: it is asked for its calibration first, 2 s, and then every 3 s. */
        const val PAUSE = 10.0

        /** Lines may be lost; a probe that was told three times is dead. */
        const val MOST = 3
    }
}
