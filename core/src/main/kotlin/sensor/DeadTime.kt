package stillwater.sensor

import stillwater.model.Conditions

/**
 * Shows what was there a fixed time ago: the way through a tube to the probe, or a log that stamps readings late.
 *
 * y(t) = ψ(t − d), with ψ the input held over each step. Until more than d has passed it shows the initial value. A d of
 * a whole number of equal steps shifts the samples by that number.
 *
 * Memory: the steps of the last d seconds; above 65 536 of them neighbours are held as one, so that the delay of a step
 * is right within d / 65 536.
 *
 * @property deadTime d, s, at least 0 and finite.
 * @param initial what is shown first, sensor units, finite.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class DeadTime(public val deadTime: Double, initial: Double) : SensorModel {
    init {
        require(deadTime >= 0 && deadTime.isFinite()) { "deadTime ($deadTime s) must be at least 0 and finite" }
        require(initial.isFinite()) { "initial ($initial) must be finite" }
    }

    /** Ring of the past steps that may still be shown, oldest at [first]: the length of each, s, and its input. */
    private var lengths = DoubleArray(FIRST_SIZE)
    private var inputs = DoubleArray(FIRST_SIZE)
    private var first = 0
    private var count = 0

    /** Sum of the lengths in the ring, s. */
    private var span = 0.0
    private var output = initial

    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        if (!input.isFinite() || !(dt > 0 && dt.isFinite())) return output
        if (deadTime == 0.0) {
            output = input
            return output
        }
        // What is longer than the dead time hides all that was before, however long it is.
        remember(input, minOf(dt, 2 * deadTime))
        // Sums of lengths are rounded: a step is over when it ended clearly more than d ago.
        val over = deadTime * (1 + ROUNDING)
        while (count > 1 && span - lengths[first] > over) forget()
        if (span > over) output = inputs[first]
        return output
    }

    private fun remember(input: Double, length: Double) {
        val last = (first + count - 1) and (lengths.size - 1)
        span += length
        if (count > 0 && lengths[last] + length < deadTime / MOST) {
            lengths[last] += length
            inputs[last] = input
            return
        }
        if (count == lengths.size) grow()
        val next = (first + count) and (lengths.size - 1)
        lengths[next] = length
        inputs[next] = input
        count++
    }

    /** Drops the oldest step. Once a round the sum is taken anew, so that roundings do not add up. */
    private fun forget() {
        span -= lengths[first]
        first = (first + 1) and (lengths.size - 1)
        count--
        if (first != 0) return
        span = 0.0
        for (i in 0 until count) span += lengths[i]
    }

    private fun grow() {
        val size = lengths.size
        lengths = DoubleArray(2 * size) { lengths[(first + it) and (size - 1)] }
        inputs = DoubleArray(2 * size) { inputs[(first + it) and (size - 1)] }
        first = 0
    }

    private companion object {
        /** A power of two, as are all later sizes. */
        const val FIRST_SIZE = 16
        const val MOST = 65_536
        const val ROUNDING = 1e-9
    }
}
