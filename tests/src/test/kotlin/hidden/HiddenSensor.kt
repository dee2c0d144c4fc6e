package stillwater.hidden

import stillwater.field.Field
import stillwater.model.BoatTime
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.expm1
import kotlin.math.pow
import kotlin.math.sign
import kotlin.math.sin

/** Effects that a case may hide: those of the diagnosis' list by its names, and some that are not in it. */
internal enum class HiddenEffect(val label: String, val listed: Boolean = true) {
    TIME_CONSTANT("time-constant"),
    GAIN_OFFSET("gain-offset"),
    ASYMMETRIC("asymmetric-response"),
    SECOND_ORDER("second-order-response"),
    TWO_PATH("two-path-response"),
    DEAD_TIME("dead-time"),
    SLEW("slew-limit"),
    FLOW("flow-dependent-response"),
    TEMPERATURE("temperature-dependent-response"),
    CROSS("cross-sensitivity"),
    DRIFT("drift"),
    STEPS("offset-steps"),
    HYSTERESIS("hysteresis"),
    QUANTISATION("quantisation"),
    SATURATION("saturation"),
    OUTLIERS("outliers"),
    POSITION("position-offset"),
    TIME_VARYING("time-varying-field"),
    CURVED("curved calibration", listed = false),
    HEADING("offset with heading", listed = false),
    INTERFERENCE("periodic interference", listed = false),
    FOULING("time constant that grows with time", listed = false),
    RESONANCE("resonance", listed = false),
    VALUE_LAG("time constant that depends on the value", listed = false),
}

/** The world of a case at fine moments, [per] steps of which make a row; row r is taken at the moment (r + 1) [per]. */
internal class HiddenWorld(
    val track: HiddenTrack,
    val field: Field,
    val amplitude: Double,
    val level: Double,
    val temperature: DoubleArray,
    val salinity: DoubleArray,
    val per: Int,
) {
    val size: Int get() = track.x.size
    val rows: Int get() = (size - 1) / per
    val duration: Double get() = size * track.step

    /** The water at the boat, moved [ahead] m along its heading, plus [trend] over the whole log. */
    fun truth(i: Int, ahead: Double = 0.0, trend: Double = 0.0): Double {
        val t = i * track.step
        val x = track.x[i] + ahead * cos(track.heading[i])
        val y = track.y[i] + ahead * sin(track.heading[i])
        return level + amplitude * (field.truth(x, y, BoatTime(t)) + trend * t / duration)
    }
}

/**
 * The readings without noise of a sensor with hidden effects: the midpoint rule in fine time, 20 steps to a row.
 *
 * @property timeConstant s. @property effects each with its strength, in the unit that [strength] says.
 * @param isAhead whether a probe that is off the fixes is ahead of them; else it is behind. @param start how far from the
 *   first water all of it begins, in spreads of the water.
 */
internal class HiddenSensor(
    private val world: HiddenWorld,
    private val timeConstant: Double,
    private val gain: Double,
    private val offset: Double,
    private val effects: Map<HiddenEffect, Double>,
    private val stepShares: List<Double>,
    isAhead: Boolean,
    private val start: Double = 0.0,
) {
    private val behind = if (isAhead) -strength(HiddenEffect.POSITION) else strength(HiddenEffect.POSITION)

    private fun strength(effect: HiddenEffect) = effects[effect] ?: 0.0

    private val truth = DoubleArray(world.size) {
        world.truth(it, -behind, strength(HiddenEffect.TIME_VARYING))
    }
    private val middle = truth.average()
    private val spread = kotlin.math.sqrt(truth.sumOf { (it - middle) * (it - middle) } / truth.size)

    /** The reading at the end of each row's time, sensor units. */
    fun readings(): DoubleArray {
        val h = world.track.step
        val ratio = exp(strength(HiddenEffect.ASYMMETRIC) / 2)
        val second = strength(HiddenEffect.SECOND_ORDER)
        val resonance = strength(HiddenEffect.RESONANCE)
        val slow = 6 * timeConstant
        val first = truth[0] + start * spread
        var s = first
        var s2 = first
        var lastBoth = first
        var slowState = first
        var velocity = 0.0
        var ringing = 0.0
        var follower = first
        var play = first
        val delay = strength(HiddenEffect.DEAD_TIME) / h
        val out = DoubleArray(world.rows)
        for (i in 0 until world.size - 1) {
            val u = delayed(i + 0.5 - delay)
            val tau = timeConstant * factor(i, s) * if (u > s) ratio else 1 / ratio
            val before = s
            s += -expm1(-h / tau) * (u - s)
            if (resonance != 0.0) {
                // A ringing beside the lag: lightly damped, three time constants a turn.
                val w = 2 * Math.PI / (3 * timeConstant)
                velocity += h * (w * w * (u - (before + s) / 2 - ringing) - 0.2 * w * velocity)
                ringing += h * velocity
            }
            slowState += -expm1(-h / slow) * (u - slowState)
            val both = (1 - strength(HiddenEffect.TWO_PATH)) * s + strength(HiddenEffect.TWO_PATH) * slowState +
                resonance * ringing
            // Exact for what comes in going evenly: held over half a step it would be late by that, however short the
            // lag is.
            val late = (both - lastBoth) / h * second
            s2 = both - late + if (second > 0) (s2 - lastBoth + late) * exp(-h / second) else 0.0
            lastBoth = both
            follower = if (HiddenEffect.SLEW in effects) {
                val most = slewRate() * h
                follower + (s2 - follower).coerceIn(-most, most)
            } else {
                s2
            }
            val half = strength(HiddenEffect.HYSTERESIS) * spread / 2
            if (abs(follower - play) > half) play = follower - half * (follower - play).sign
            if ((i + 1) % world.per == 0) out[i / world.per] = shown(play, i + 1)
        }
        return out
    }

    /**
     * The number of [effect] in the units in which a sensor file holds it, with the sign it has there; NaN where there
     * is no such number.
     */
    fun number(effect: HiddenEffect): Double {
        val strength = strength(effect)
        return when (effect) {
            HiddenEffect.CROSS, HiddenEffect.STEPS, HiddenEffect.HYSTERESIS -> gain * spread * strength
            HiddenEffect.DRIFT -> gain * spread * strength / world.duration
            HiddenEffect.SLEW -> gain * slewRate()
            HiddenEffect.SATURATION -> end()
            HiddenEffect.TIME_CONSTANT -> timeConstant
            HiddenEffect.GAIN_OFFSET -> gain
            HiddenEffect.POSITION -> behind
            HiddenEffect.TIME_VARYING -> world.amplitude * strength / world.duration
            HiddenEffect.QUANTISATION, HiddenEffect.OUTLIERS -> Double.NaN
            else -> strength
        }
    }

    /** Strength 3 cuts at two spreads above the mean, 5 at the mean. */
    private fun end() = gain * (middle + spread * (5 - strength(HiddenEffect.SATURATION))) + offset

    /** Strength 1 is the rate that a tenth of the signal's spread in a time constant makes; stronger is slower. */
    private fun slewRate() = spread / timeConstant / strength(HiddenEffect.SLEW)

    private fun delayed(place: Double): Double {
        if (place <= 0) return truth[0]
        val from = place.toInt().coerceAtMost(truth.size - 2)
        return truth[from] + (place - from) * (truth[from + 1] - truth[from])
    }

    private fun factor(i: Int, s: Double): Double {
        var factor = 1.0
        val flow = strength(HiddenEffect.FLOW)
        // Water that stands still about a probe does not stop it for good.
        if (flow != 0.0) factor *= (maxOf(world.track.speed[i], SLOWEST) / ORDINARY_SPEED).pow(-flow)
        factor *= exp(-strength(HiddenEffect.TEMPERATURE) * (world.temperature[i] - ORDINARY_TEMPERATURE))
        factor *= exp(strength(HiddenEffect.FOULING) * (i.toDouble() / world.size - 0.5))
        factor *= exp(strength(HiddenEffect.VALUE_LAG) * ((s - middle) / spread).coerceIn(-3.0, 3.0))
        return factor
    }

    private fun shown(state: Double, i: Int): Double {
        val t = i.toDouble() / world.size
        var value = gain * state + offset
        val unit = (state - middle) / spread
        value += gain * spread * (
            strength(HiddenEffect.CROSS) * (world.salinity[i] - world.salinity[0]) +
                strength(HiddenEffect.DRIFT) * t +
                strength(HiddenEffect.CURVED) * unit * unit +
                strength(HiddenEffect.HEADING) * cos(world.track.heading[i] - 1.0) +
                strength(HiddenEffect.INTERFERENCE) * sin(2 * Math.PI * i * world.track.step / INTERFERENCE_SECONDS)
            )
        stepShares.forEachIndexed { k, share ->
            if (t > share) value += gain * spread * strength(HiddenEffect.STEPS) * if (k % 2 == 0) 1 else -1
        }
        if (HiddenEffect.SATURATION in effects) {
            value = minOf(value, end())
        }
        return value
    }

    companion object {
        const val ORDINARY_SPEED = 1.0
        const val SLOWEST = 0.05
        const val ORDINARY_TEMPERATURE = 15.0
        const val INTERFERENCE_SECONDS = 37.0
    }
}
