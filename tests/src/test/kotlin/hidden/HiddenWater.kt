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
            val track =
                HiddenTrack(step, DoubleArray(count), DoubleArray(count), DoubleArray(count), DoubleArray(count))
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
            return if (kind == TrackKind.SURVEY) track.rounded((TURN_RADIUS_SECONDS / step).toInt()) else track
        }

        private fun wobble(kind: TrackKind) = if (kind == TrackKind.TOW) 0.0005 else 0.02
        private const val TURN_SECONDS = 20.0
        private const val TURN_RADIUS_SECONDS = 3.0
    }

    /** The same way with round corners: the mean over [half] steps before and after, twice. */
    private fun rounded(half: Int): HiddenTrack {
        val east = smooth(smooth(x, half), half)
        val north = smooth(smooth(y, half), half)
        val last = x.size - 1
        val heading = DoubleArray(x.size) { i ->
            val from = minOf(i, last - 1)
            kotlin.math.atan2(north[from + 1] - north[from], east[from + 1] - east[from])
        }
        val speed = DoubleArray(x.size) { i ->
            val from = minOf(i, last - 1)
            hypot(north[from + 1] - north[from], east[from + 1] - east[from]) / step
        }
        return HiddenTrack(step, east, north, speed, heading)
    }

    private fun smooth(column: DoubleArray, half: Int): DoubleArray {
        val sums = DoubleArray(column.size + 1)
        for (i in column.indices) sums[i + 1] = sums[i] + column[i]
        return DoubleArray(column.size) { i ->
            val reach = minOf(half, i, column.size - 1 - i)
            (sums[i + reach + 1] - sums[i - reach]) / (2 * reach + 1)
        }
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

    /** Parallel legs up and down, then the same across, back to the start and again, as far as the way goes. */
    private class Legs(random: Random, total: Double) {
        private val side = kotlin.math.sqrt(total * SPACING / 2).coerceAtLeast(3 * SPACING)
        private val count = (side / SPACING).toInt().coerceAtLeast(2)
        private val corners = ArrayList<Pair<Double, Double>>()
        private val ways = ArrayList<Double>()
        private var next = 1

        init {
            var turned = random.nextBoolean()
            corners += 0.0 to 0.0
            ways += 0.0
            while (ways.last() < total) {
                for (leg in 0 until count) {
                    val from = if (leg % 2 == 0) 0.0 else side
                    for (u in listOf(from, side - from)) add(if (turned) leg * SPACING to u else u to leg * SPACING)
                }
                add(0.0 to 0.0)
                turned = !turned
            }
        }

        private fun add(corner: Pair<Double, Double>) {
            val length = hypot(corner.first - corners.last().first, corner.second - corners.last().second)
            if (length == 0.0) return
            corners += corner
            ways += ways.last() + length
        }

        fun at(way: Double): Pair<Double, Double> {
            while (next < ways.size - 1 && ways[next] < way) next++
            val share = ((way - ways[next - 1]) / (ways[next] - ways[next - 1])).coerceIn(0.0, 1.0)
            val (x, y) = corners[next - 1]
            return x + share * (corners[next].first - x) to y + share * (corners[next].second - y)
        }

        private companion object {
            const val SPACING = 12.0
        }
    }
}

/** A standard normal number, Box and Muller. */
internal fun Random.normal(): Double =
    kotlin.math.sqrt(-2 * kotlin.math.ln(1 - nextDouble())) * cos(2 * PI * nextDouble())
