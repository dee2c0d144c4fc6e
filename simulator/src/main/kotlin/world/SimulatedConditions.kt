package stillwater.world

import stillwater.sensor.SensorSpec
import stillwater.virtual.VirtualBoat

/** What a simulated sensor can be told beside the water: how fast the boat goes through it, and nothing else. */
object SimulatedConditions {
    /** A sentence that names what [sensor] depends on and no simulation has; null where it has all. */
    fun missing(sensor: SensorSpec): String? {
        val missing = sensor.conditions - VirtualBoat.CONDITIONS
        if (missing.isEmpty()) return null
        val none = missing.joinToString(" and ") { "no $it" }
        val them = if (missing.size == 1) "it" else "these"
        return "the simulation has $none: what in the sensor depends on $them has no effect here"
    }
}
