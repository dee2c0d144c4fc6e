package stillwater.hidden

import stillwater.field.Field
import stillwater.model.BoatTime
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.random.Random

/** Waves of random direction, length and phase: a smooth field of unit spread. Lengths spread about [length], m. */
internal class WaveField(random: Random, length: Double) : Field {
    private val waves = List(WAVES) {
        val direction = 2 * PI * random.nextDouble()
        val number = 2 * PI / (length * (0.5 + 1.5 * random.nextDouble()))
        doubleArrayOf(number * cos(direction), number * sin(direction), 2 * PI * random.nextDouble())
    }

    override fun truth(x: Double, y: Double, time: BoatTime): Double =
        waves.sumOf { (kx, ky, phase) -> cos(kx * x + ky * y + phase) } * SCALE

    private companion object {
        const val WAVES = 24
        const val SCALE = 0.2886751346
    }
}

/** Samples on a bench: the probe goes from one to another and stays; each change takes [move] s. */
internal class BenchField(random: Random, duration: Double, private val move: Double, dwell: Double) : Field {
    private val starts = ArrayList<Double>()
    private val levels = ArrayList<Double>()

    init {
        var time = 0.0
        while (time < duration) {
            starts += time
            levels += 1.6 * (2 * random.nextDouble() - 1)
            time += dwell * (0.5 + random.nextDouble())
        }
    }

    override fun truth(x: Double, y: Double, time: BoatTime): Double {
        val i = starts.indexOfLast { it <= time.seconds }.coerceAtLeast(0)
        val before = levels[maxOf(i - 1, 0)]
        val share = ((time.seconds - starts[i]) / move).coerceIn(0.0, 1.0)
        return before + (levels[i] - before) * (1 - cos(PI * share)) / 2
    }
}

/** What kind of way the probe takes. */
internal enum class TrackKind { SURVEY, RANDOM_WALK, BENCH, TOW }

/**
 * Where the boat really is at every fine step.
 *
 * @property step length of a fine step, s. @property x m. @property y m. @property speed m/s. @property heading rad.
 */
internal class HiddenTrack(
    val step: Double,
    val x: DoubleArray,
    val y: DoubleArray,
    val speed: DoubleArray,
    val heading: DoubleArray,
) {
    companion object {
        /** A track of [kind] with [count] fine steps of [step] s and a mean speed of [speed] m/s. */
        fun draw(kind: TrackKind, random: Random, count: Int, step: Double, speed: Double): HiddenTrack {
            val track = HiddenTrack(step, DoubleArray(count), DoubleArray(count), DoubleArray(count), DoubleArray(count))
            if (kind == TrackKind.BENCH) return track
            val pace = Pace(random, speed, count * step)
            val legs = Legs(random, speed * count * step)
            var way = 0.0
            var heading = 2 * PI * random.nextDouble()
            var turn = 0.0
            var x = 0.0
            var y = 0.0
            for (i in 0 until count) {
                val v = pace.at(i * step)
                way += v * step
                if (kind == TrackKind.SURVEY) {
                    val (px, py) = legs.at(way)
                    if (i > 0 && hypot(px - x, py - y) > 0) heading = kotlin.math.atan2(py - y, px - x)
                    x = px
                    y = py
                } else {
                    turn += (-turn / TURN_SECONDS) * step + random.normal() * kotlin.math.sqrt(step) * wobble(kind)
                    heading += turn * step
                    x += v * step * cos(heading)
                    y += v * step * sin(heading)
                }
                track.x[i] = x
                track.y[i] = y
                track.speed[i] = v
                track.heading[i] = heading
            }
            return track
        }

        private fun wobble(kind: TrackKind) = if (kind == TrackKind.TOW) 0.0005 else 0.02
        private const val TURN_SECONDS = 20.0
    }

    /** A speed that changes from stretch to stretch and slowly within each. */
    private class Pace(random: Random, private val mean: Double, duration: Double) {
        private val factors = DoubleArray((duration / STRETCH).toInt() + 2) { 0.55 + 0.9 * random.nextDouble() }

        fun at(time: Double): Double {
            val place = time / STRETCH
            val i = place.toInt()
            val share = place - i
            return mean * ((1 - share) * factors[i] + share * factors[i + 1])
        }

        private companion object {
            const val STRETCH = 45.0
        }
    }

    /** Parallel legs up and down, then the same across, as far as the way goes. */
    private class Legs(random: Random, total: Double) {
        private val side = kotlin.math.sqrt(total * SPACING / 2).coerceAtLeast(3 * SPACING)
        private val count = (side / SPACING).toInt().coerceAtLeast(2)
        private val turned = random.nextBoolean()

        fun at(way: Double): Pair<Double, Double> {
            val round = count * (side + SPACING)
            val second = (way / round).toInt() % 2 == 1
            val along = way % round
            val leg = (along / (side + SPACING)).toInt()
            val rest = along - leg * (side + SPACING)
            val run = minOf(rest, side)
            val u = if (leg % 2 == 0) run else side - run
            val v = leg * SPACING + maxOf(rest - side, 0.0)
            return if (second != turned) v to u else u to v
        }

        private companion object {
            const val SPACING = 12.0
        }
    }
}

/** A standard normal number, Box and Muller. */
internal fun Random.normal(): Double =
    kotlin.math.sqrt(-2 * kotlin.math.ln(1 - nextDouble())) * cos(2 * PI * nextDouble())
