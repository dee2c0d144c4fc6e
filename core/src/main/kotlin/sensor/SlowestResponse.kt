package stillwater.sensor

import stillwater.model.Conditions
import kotlin.math.abs
import kotlin.random.Random

/**
 * How long a sensor takes for 1 - 1/e of a step between [low] and [high], up or down, whichever is longer; s.
 *
 * For a first-order lag that is its time constant. Tried on the sensor itself in steps of 0.1 s with nothing else
 * measured, so noise and drift are in it; at most 3600 s, which a sensor that never gets there is said to take.
 *
 * @throws IllegalArgumentException if an end is not finite or [low] is not below [high].
 */
public fun SensorSpec.slowestResponse(low: Double, high: Double): Double {
    require(low < high && low.isFinite() && high.isFinite()) { "low ($low) must be below high ($high), both finite" }
    return maxOf(responseTime(low, high), responseTime(high, low))
}

private fun SensorSpec.responseTime(from: Double, to: Double): Double {
    val sensor = build(from, Random(1))
    var begun = from
    var ends = to
    for (stage in stages) {
        begun = stage.settled(begun)
        ends = stage.settled(ends)
    }
    var steps = 1
    while (steps < LONGEST) {
        val value = sensor.step(to, STEP, Conditions.NONE)
        if (abs(value - begun) >= SHARE * abs(ends - begun)) break
        steps++
    }
    return steps * STEP
}

private const val STEP = 0.1
private const val LONGEST = 36_000

/** 1 - 1/e. */
private const val SHARE = 0.6321205588285577
