package stillwater.mission

import stillwater.model.BoatTime
import stillwater.wire.Command
import stillwater.wire.PortSensor

/**
 * Knows what the board is to be told of the probe's port, and keeps watch whether the probe speaks.
 *
 * Firmware v4.2.0 reads a port only once it was told what is there, and forgets it at each reset; older firmware has
 * its probes built in and refuses the words, which does no harm. To be told anew starts a probe over, so it is done
 * when the boat is armed, as it is after each reset, and when nothing was heard for long: the line may have been lost.
 * Confined to one thread.
 */
internal class ProbeWatch(private val probe: ProbeSpec) {
    private var since = Double.NaN
    private var toldAt = Double.NEGATIVE_INFINITY

    /** What the board is to be told; null where the mission names no port, or one that has no choice. */
    val setUp: Command? = sensor()?.let { Command.SetSensor(checkNotNull(probe.port), it) }

    /** The mission begins at [now]. */
    fun begin(now: BoatTime) {
        since = now.seconds
    }

    /** The probe was heard at [now], whatever became of the reading. */
    fun heard(now: BoatTime) {
        since = now.seconds
    }

    /** Time since the probe was heard, or since the mission began, s; NaN before it did. */
    fun silence(now: BoatTime): Double = now.seconds - since

    /** The board is told at [now]. */
    fun told(now: BoatTime) {
        toldAt = now.seconds
    }

    /** Whether the board is to be told once more at [now]. */
    fun isDue(now: BoatTime): Boolean = silence(now) > LONG && now.seconds - toldAt > LONG

    /** Port 0 is the rudder's and has no serial line, ports from 4 on are the board's own. */
    private fun sensor(): PortSensor? = if (probe.port !in FIRST_PORT..LAST_PORT) {
        null
    } else {
        when (probe.quantity) {
            Quantity.DISSOLVED_OXYGEN -> PortSensor.ATLAS_DO
            Quantity.ACIDITY -> PortSensor.ATLAS_PH
            Quantity.CONDUCTIVITY -> PortSensor.ES2
            Quantity.DEPTH -> PortSensor.HDS
            // Two kinds of sensor have it.
            Quantity.TEMPERATURE -> null
        }
    }

    private companion object {
        const val FIRST_PORT = 1
        const val LAST_PORT = 3

        /** Ten times what the slowest firmware takes for a reading, s. */
        const val LONG = 30.0
    }
}
