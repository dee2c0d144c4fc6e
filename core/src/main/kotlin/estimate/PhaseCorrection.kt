package stillwater.estimate

import kotlin.math.PI
import kotlin.math.atan
import kotlin.math.atan2
import kotlin.math.cos
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * Readings put where a response took them from, and nothing else done to them: each frequency gets back the phase that
 * the response took, and keeps its amplitude. So no noise is amplified, nothing is smoothed, and the readings' spectrum
 * is the same whatever the response: passes in different directions can be compared for any response on equal terms.
 *
 * The readings are resampled to even steps of the series' median first. See core/docs/TrackCorrection.md, (1) to (3).
 *
 * @param series the readings. Retained.
 */
internal class PhaseCorrection(private val series: TrackSeries) {
    /** Time step, s. */
    val step: Double = series.medianStep

    /** One stretch without gaps: its place in the resampled series, and where in it readings rise. */
    private class Stretch(val begin: Int, val size: Int) {
        val fourier = Fourier(maxOf(2, Integer.highestOneBit(maxOf(1, size * 2 - 1)) * 2))
        val re = DoubleArray(fourier.size)
        val im = DoubleArray(fourier.size)
        val workRe = DoubleArray(fourier.size)
        val workIm = DoubleArray(fourier.size)
        val slopeRe = DoubleArray(fourier.size)
        val slopeIm = DoubleArray(fourier.size)
        val sides = DoubleArray(size)
        var offset = 0.0
        var slope = 0.0
    }

    /** Even times, s, and the places then, m. */
    val times: DoubleArray
    val xs: DoubleArray
    val ys: DoubleArray

    /** First index of the stretch that a point is in. */
    val first: IntArray

    private val stretches: List<Stretch>
    private val values: DoubleArray

    /** The same for another thread. */
    fun copy() = PhaseCorrection(series)

    /** Number of points. */
    val size: Int get() = times.size

    init {
        val starts = (0 until series.size).filter {
            it == 0 || series.times[it] - series.times[it - 1] > series.gapLimit
        }
        val counts = starts.indices.map { k ->
            val last = (starts.getOrNull(k + 1) ?: series.size) - 1
            ((series.times[last] - series.times[starts[k]]) / step).toInt() + 1
        }
        val total = counts.sum()
        times = DoubleArray(total)
        xs = DoubleArray(total)
        ys = DoubleArray(total)
        values = DoubleArray(total)
        first = IntArray(total)
        var at = 0
        stretches = starts.indices.map { k ->
            val begin = at
            var row = starts[k]
            val last = (starts.getOrNull(k + 1) ?: series.size) - 1
            repeat(counts[k]) { i ->
                val time = series.times[starts[k]] + i * step
                while (row < last - 1 && series.times[row + 1] < time) row++
                val next = minOf(row + 1, last)
                val span = series.times[next] - series.times[row]
                val share = if (span > 0) ((time - series.times[row]) / span).coerceIn(0.0, 1.0) else 0.0
                fun between(of: DoubleArray) = of[row] + share * (of[next] - of[row])
                times[at] = time
                xs[at] = between(series.xs)
                ys[at] = between(series.ys)
                values[at] = between(series.values)
                first[at] = begin
                at++
            }
            Stretch(begin, counts[k]).also(::prepare)
        }
    }

    /** Takes the line through both ends off, mirrors what is left at its end, and transforms it. */
    private fun prepare(stretch: Stretch) {
        val n = stretch.size
        val end = minOf(ENDS, n)
        var head = 0.0
        var tail = 0.0
        for (i in 0 until end) {
            head += values[stretch.begin + i] / end
            tail += values[stretch.begin + n - 1 - i] / end
        }
        stretch.slope = if (n > end) (tail - head) / ((n - end) * step) else 0.0
        stretch.offset = head - stretch.slope * (end - 1) / 2.0 * step
        for (i in 0 until n) {
            stretch.re[i] = values[stretch.begin + i] - stretch.offset - stretch.slope * i * step
            val from = values[stretch.begin + maxOf(0, i - SLOPE_REACH)]
            stretch.sides[i] = if (values[stretch.begin + minOf(n - 1, i + SLOPE_REACH)] > from) 1.0 else -1.0
        }
        stretch.fourier.transform(stretch.re, stretch.im, backwards = false)
    }

    /**
     * The readings with the phase of [response] given back, and [earlier], s, of either sign, on top of its dead time,
     * into [out], length [size]. Modified.
     */
    fun correct(response: Response, out: DoubleArray, earlier: Double = 0.0) {
        for (stretch in stretches) correct(stretch, response, out, earlier)
    }

    private fun correct(stretch: Stretch, response: Response, out: DoubleArray, earlier: Double) {
        val n = stretch.fourier.size
        val isOneSided = response.lags.any { it.rising != it.falling }
        if (isOneSided) slopes(stretch)
        for (k in 0 until n) {
            val omega = frequency(k, n)
            val phase = omega * earlier + phase(response, omega)
            // The turn at the highest frequency would not be a real number's.
            val c = cos(phase)
            val s = if (2 * k == n) 0.0 else sin(phase)
            stretch.workRe[k] = stretch.re[k] * c - stretch.im[k] * s
            stretch.workIm[k] = stretch.re[k] * s + stretch.im[k] * c
            if (isOneSided) addOneSided(stretch, response, k, omega)
        }
        stretch.fourier.transform(stretch.workRe, stretch.workIm, backwards = true)
        for (i in 0 until stretch.size) {
            out[stretch.begin + i] = stretch.workRe[i] / n + stretch.offset +
                stretch.slope * (i * step + response.meanDelay + earlier)
        }
    }

    private fun frequency(k: Int, n: Int) = 2 * PI * (if (2 * k <= n) k else k - n) / (n * step)

    private fun phase(response: Response, omega: Double): Double {
        var phase = omega * response.deadTime
        if (response.slowShare > 0) return phase + besidePhase(response, omega)
        for (lag in response.lags) phase += atan(omega * (lag.rising + lag.falling) / 2)
        return phase
    }

    /** −arg((1 − w) / (1 + i ω τ₁) + w / (1 + i ω τ₂)). */
    private fun besidePhase(response: Response, omega: Double): Double {
        var re = 0.0
        var im = 0.0
        for ((k, lag) in response.lags.withIndex()) {
            val share = if (k == 0) 1 - response.slowShare else response.slowShare
            val turn = omega * (lag.rising + lag.falling) / 2
            re += share / (1 + turn * turn)
            im += share * turn / (1 + turn * turn)
        }
        return atan2(im, re)
    }

    /** Transform of the slope with the sign of rising or falling: what a difference of time constants acts on. */
    private fun slopes(stretch: Stretch) {
        val n = stretch.fourier.size
        for (k in 0 until n) {
            val omega = if (2 * k == n) 0.0 else frequency(k, n)
            // Softened as the slope of differences over a few steps is, or noise would be all there is.
            val soft = 1 / (1 + (omega * SLOPE_REACH * step).let { it * it })
            stretch.slopeRe[k] = -stretch.im[k] * omega * soft
            stretch.slopeIm[k] = stretch.re[k] * omega * soft
        }
        stretch.fourier.transform(stretch.slopeRe, stretch.slopeIm, backwards = true)
        for (i in 0 until n) {
            stretch.slopeRe[i] =
                if (i < stretch.size) stretch.sides[i] * (stretch.slopeRe[i] / n + stretch.slope) else 0.0
            stretch.slopeIm[i] = 0.0
        }
        stretch.fourier.transform(stretch.slopeRe, stretch.slopeIm, backwards = false)
    }

    /** (τ_side − τ_mean) ż, with the amplitude that the lag at the mean leaves. */
    private fun addOneSided(stretch: Stretch, response: Response, k: Int, omega: Double) {
        for (lag in response.lags) {
            val mean = (lag.rising + lag.falling) / 2
            val weight = (lag.rising - lag.falling) / 2 / sqrt(1 + omega * omega * mean * mean)
            stretch.workRe[k] += weight * stretch.slopeRe[k]
            stretch.workIm[k] += weight * stretch.slopeIm[k]
        }
    }

    private companion object {
        const val ENDS = 5
        const val SLOPE_REACH = 3
    }
}
