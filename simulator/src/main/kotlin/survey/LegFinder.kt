package stillwater.survey

import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.atan2
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin

/**
 * Finds the straight, parallel legs of a survey in its track.
 *
 * The track is walked in strides that are long against the steps of the receiver. The main axis is the direction
 * (modulo half a turn) in which most way was made. Successive strides within 30 degrees of it, in one sense, make a
 * leg; up to two strays are forgiven. Legs that are shorter than half of what is usual are dropped: turns, transits.
 */
class LegFinder(private val statistics: SurveyStatistics) {
    private class Stride(val from: Int, val to: Int, val dx: Double, val dy: Double, val afterGap: Boolean) {
        val length = hypot(dx, dy)
    }

    /** The legs of [track]; none where it never runs straight for long. */
    fun find(track: Track): Legs {
        val strides = strides(track)
        val axis = axis(strides)
        val found = runs(strides, axis).map { leg(track, strides[it.first].from, strides[it.last].to, axis) }
        val usual = usualLength(found)
        return Legs(axis, found.filter { it.length >= usual / 2 && it.points >= FEWEST_POINTS })
    }

    private fun strides(track: Track): List<Stride> {
        if (track.size < 2) return emptyList()
        val speed = statistics.speeds[FAST].let { if (it.isNaN()) 0.0 else it }
        val reach = maxOf(speed * STRIDE_SECONDS, STRIDE_STEPS * speed * statistics.steps.median * track.stride)
        if (reach <= 0) return emptyList()
        val gap = maxOf(statistics.gapLimit, 2 * statistics.steps.median * track.stride)
        val strides = ArrayList<Stride>()
        var from = 0
        var gapSeen = false
        for (i in 1 until track.size) {
            if (track.times[i] - track.times[i - 1] > gap) {
                from = i
                gapSeen = true
                continue
            }
            val dx = track.xs[i] - track.xs[from]
            val dy = track.ys[i] - track.ys[from]
            // Most points are far below: that is seen without a root.
            if (dx * dx + dy * dy < SURELY_BELOW * reach * reach || hypot(dx, dy) < reach) continue
            strides += Stride(from, i, dx, dy, gapSeen)
            gapSeen = false
            from = i
        }
        return strides
    }

    /** The direction in which most way was made: the fullest bin of the directions, then the mean around it. */
    private fun axis(strides: List<Stride>): Double {
        val bins = DoubleArray(BINS)
        for (stride in strides) {
            val share = atan2(stride.dy, stride.dx).mod(PI) / PI
            bins[(share * BINS).toInt().coerceAtMost(BINS - 1)] += stride.length
        }
        val smooth = DoubleArray(BINS) { i -> (-2..2).sumOf { bins[(i + it).mod(BINS)] } }
        val peak = (smooth.indices.maxBy { smooth[it] } + 0.5) / BINS * PI
        var sines = 0.0
        var cosines = 0.0
        for (stride in strides) {
            val off = 2 * (atan2(stride.dy, stride.dx) - peak)
            if (cos(off) < cos(2 * TOLERANCE)) continue
            sines += stride.length * sin(off)
            cosines += stride.length * cos(off)
        }
        return Math.IEEEremainder(peak + atan2(sines, cosines) / 2, PI)
    }

    /** Runs of strides along the axis in one sense, as ranges of indices. */
    private fun runs(strides: List<Stride>, axis: Double): List<IntRange> {
        val runs = ArrayList<IntRange>()
        var start = -1
        var end = -1
        var sense = 0
        for ((i, stride) in strides.withIndex()) {
            val along = (stride.dx * cos(axis) + stride.dy * sin(axis)) / stride.length
            val here = if (along > cos(TOLERANCE)) {
                1
            } else if (along < -cos(TOLERANCE)) {
                -1
            } else {
                0
            }
            val broken = stride.afterGap || here == -sense || i - end > STRAYS + 1
            if (start >= 0 && broken) {
                runs += start..end
                start = -1
            }
            if (here == 0) continue
            if (start < 0) {
                start = i
                sense = here
            }
            end = i
        }
        if (start >= 0) runs += start..end
        return runs
    }

    private fun leg(track: Track, first: Int, last: Int, axis: Double): Leg {
        val cosine = cos(axis)
        val sine = sin(axis)
        fun along(i: Int) = track.xs[i] * cosine + track.ys[i] * sine
        var across = 0.0
        for (i in first..last) across += track.ys[i] * cosine - track.xs[i] * sine
        return Leg(
            first = first,
            last = last,
            forward = along(last) > along(first),
            start = minOf(along(first), along(last)),
            end = maxOf(along(first), along(last)),
            across = across / (last - first + 1),
            seconds = track.times[last] - track.times[first],
        )
    }

    /** The length of the leg in which the boat was half way through all legs: short ones hardly count. */
    private fun usualLength(legs: List<Leg>): Double {
        val sorted = legs.map { abs(it.length) }.sorted()
        var way = sorted.sum() / 2
        for (length in sorted) {
            way -= length
            if (way <= 0) return length
        }
        return 0.0
    }

    private companion object {
        /** Below one by more than rounding. */
        const val SURELY_BELOW = 1 - 1e-9
        const val FAST = 0.9
        const val STRIDE_SECONDS = 5.0
        const val STRIDE_STEPS = 2.5
        const val BINS = 36
        const val STRAYS = 2
        const val FEWEST_POINTS = 10
        val TOLERANCE = Math.toRadians(30.0)
    }
}
