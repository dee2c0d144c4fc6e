package stillwater.world

import stillwater.model.Actuation
import kotlin.math.abs
import kotlin.math.pow

/**
 * A battery and what draws on it.
 *
 * @property capacity W h, above 0.
 * @property idlePower of electronics and probes, W, at least 0.
 * @property fullPower of all thrusters at full thrust, W, at least 0.
 * @throws IllegalArgumentException if a number is out of its range.
 */
data class BatterySpec(
    val capacity: Double = 300.0,
    val idlePower: Double = 8.0,
    val fullPower: Double = 300.0,
) {
    init {
        require(capacity > 0 && capacity.isFinite()) { "capacity ($capacity W h) must be above 0 and finite" }
        require(idlePower >= 0 && idlePower.isFinite()) { "idlePower ($idlePower W) must be at least 0 and finite" }
        require(fullPower >= 0 && fullPower.isFinite()) { "fullPower ($fullPower W) must be at least 0 and finite" }
    }
}

/**
 * Energy that a boat has used, and the voltage that is left.
 *
 * A propeller's power grows with its thrust to the 3/2 (momentum theory of an ideal propeller at rest: thrust with the
 * square of the flow's speed, power with its cube). The voltage falls in a straight line from full to [EMPTY] of it
 * when the capacity is used. Then it [isEmpty]: motors draw nothing any more, and the electronics go on and bring the
 * voltage down to [LEAST] of the full one with [REST] of the capacity, where it stays. A model to see a policy work
 * with, no prediction. Confined to one thread.
 *
 * @property spec the battery. @property fullVolts when nothing is used yet, V.
 */
class Battery(val spec: BatterySpec, val fullVolts: Double) {
    private var joules = 0.0

    /** Used so far, W h. */
    val used: Double get() = joules / JOULES

    /** Whether the capacity is used, so that nothing is left for the motors. */
    val isEmpty: Boolean get() = used >= spec.capacity

    /** What a voltmeter shows, V. */
    val volts: Double
        get() {
            val share = used / spec.capacity
            if (!isEmpty) return fullVolts * (1 - (1 - EMPTY) * share)
            return fullVolts * (EMPTY - (EMPTY - LEAST) * minOf(1.0, (share - 1) / REST))
        }

    /** Lets [seconds] s pass with [actuation] on the motors; of an empty battery they draw nothing. */
    fun advance(seconds: Double, actuation: Actuation) {
        val share = when (actuation) {
            is Actuation.Differential -> (power(actuation.left) + power(actuation.right)) / 2
            is Actuation.Vectored -> power(actuation.thrust)
        }
        joules += seconds * (spec.idlePower + if (isEmpty) 0.0 else spec.fullPower * share)
    }

    private fun power(thrust: Double) = abs(thrust).pow(1.5)

    private companion object {
        /** Share of the full voltage at which a lithium polymer cell counts as empty: 3.5 of 4.2 V. */
        const val EMPTY = 3.5 / 4.2

        /** Share of the full voltage that is left of a cell that is drawn on beyond that: 3.0 of 4.2 V. */
        const val LEAST = 3.0 / 4.2

        /** Share of the capacity that lies between the two: below its knee a cell's voltage falls steeply. */
        const val REST = 0.01

        /** In a watt hour. */
        const val JOULES = 3600.0
    }
}
