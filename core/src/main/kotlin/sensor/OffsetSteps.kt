package stillwater.sensor

import stillwater.model.Conditions

/**
 * A calibration that jumps: y(t) = ψ(t) + o with o the offset of the last jump before t, 0 before the first; t since the
 * sensor was built. A probe that was knocked, a bubble on a membrane, a reconnected supply. What is not finite passes
 * unchanged.
 *
 * @param times when it jumps, s, ascending, finite, the first above 0. Retained, not modified.
 * @param offsets the offset after each jump, sensor units, finite; as many as [times]. Retained, not modified.
 * @throws IllegalArgumentException if the lengths differ or a number is out of its range.
 */
public class OffsetSteps(private val times: DoubleArray, private val offsets: DoubleArray) : SensorModel {
    init {
        require(times.size == offsets.size) { "times (${times.size}) and offsets (${offsets.size}) must be as many" }
        for (i in times.indices) {
            val before = if (i == 0) 0.0 else times[i - 1]
            require(times[i] > before && times[i].isFinite()) { "times[$i] (${times[i]} s) must be above $before s" }
            require(offsets[i].isFinite()) { "offsets[$i] (${offsets[i]}) must be finite" }
        }
    }

    private var now = 0.0
    private var next = 0

    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        if (dt > 0 && dt.isFinite()) now = inRange(now + dt)
        while (next < times.size && times[next] < now) next++
        return if (input.isFinite() && next > 0) inRange(input + offsets[next - 1]) else input
    }
}
