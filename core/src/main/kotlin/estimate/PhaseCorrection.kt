package stillwater.estimate

import kotlin.math.PI
import kotlin.math.atan
import kotlin.math.atan2
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * Readings put where a response took them from, and nothing else done to them: each frequency gets back the phase that
 * the response took, and keeps its amplitude. So no noise is amplified, nothing is smoothed, and the readings' spectrum
 * is the same whatever the response: passes in different directions can be compared for any response on equal terms.
 *
 * The readings are resampled to even steps of the series' median first, as [EvenPoints] are. See core/docs/TrackCorrection.md, (1) to (3).
 *
 * @param series the readings. Retained.
 */
internal class PhaseCorrection(private val series: TrackSeries) {
    /** Time step, s. */
    val step: Double = series.medianStep

    /**
     * A stretch whose short gaps are bridged: the readings at even steps, sensor units, and where each is in the
     * resampled series, -1 in a bridged gap.
     */
    private class Stretch(val readings: DoubleArray, val at: IntArray) {
        val size get() = at.size
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

    /** First index of the stretch without gaps that a point is in. */
    val first: IntArray

    /** Logarithm of the boat's speed over the reference speed; 0 where unknown. */
    private val logSpeeds: DoubleArray
    private val logSums by lazy {
        val sorted = logSpeeds.sortedArray()
        // A boat that stands has no say in what the others' speeds do.
        val usual = sorted[(TAIL * (size - 1)).toInt()]..sorted[((1 - TAIL) * (size - 1)).toInt()]
        DoubleArray(size + 1).also { for (i in 0 until size) it[i + 1] = it[i] + logSpeeds[i].coerceIn(usual) }
    }

    private val stretches: List<Stretch>

    /** Whether the boat's speed is known, and that it changed. */
    val hasSpeeds: Boolean get() = series.hasSpeeds

    /** The same for another thread. */
    fun copy() = PhaseCorrection(series)

    /** Number of points. */
    val size: Int get() = times.size

    init {
        val points = EvenPoints(series, step)
        stretches = points.stretches.map { (readings, at) -> Stretch(readings, at).also(::prepare) }
        times = points.times.toDoubleArray()
        xs = points.xs.toDoubleArray()
        ys = points.ys.toDoubleArray()
        logSpeeds = points.logSpeeds.toDoubleArray()
        first = points.first.toIntArray()
    }

    /** Takes the line through both ends off, mirrors what is left at its end, and transforms it. */
    private fun prepare(stretch: Stretch) {
        val n = stretch.size
        val end = minOf(ENDS, n)
        var head = 0.0
        var tail = 0.0
        for (i in 0 until end) {
            head += stretch.readings[i] / end
            tail += stretch.readings[n - 1 - i] / end
        }
        stretch.slope = if (n > end) (tail - head) / ((n - end) * step) else 0.0
        stretch.offset = head - stretch.slope * (end - 1) / 2.0 * step
        for (i in 0 until n) {
            stretch.re[i] = stretch.readings[i] - stretch.offset - stretch.slope * i * step
            val from = stretch.readings[maxOf(0, i - SLOPE_REACH)]
            stretch.sides[i] = if (stretch.readings[minOf(n - 1, i + SLOPE_REACH)] > from) 1.0 else -1.0
        }
        stretch.fourier.transform(stretch.re, stretch.im, backwards = false)
    }

    /**
     * The readings with the phase of [response] given back, and [earlier], s, of either sign, on top of its dead time,
     * into [out], length [size]. Modified.
     */
    fun correct(response: Response, out: DoubleArray, earlier: Double = 0.0) {
        if (response.flowExponent > 0) return correctByFlow(response, out, earlier)
        for (stretch in stretches) correct(stretch, response, out, earlier)
    }

    /**
     * For a lag that follows the boat's speed: the inverse of τ(t) ṡ = f − s is f = s + τ(t) ṡ, local in time. With the
     * amplitude that a lag of the geometric mean τ̄ leaves, that is (1) at τ̄ and beside it (τ(t) − τ̄) ż / √(1 + ω² τ̄²):
     * fast changes become τ(t) / τ̄ as large, which is 1 on geometric average, so that no exponent has a head start by
     * making all values smaller. Speeds are means over τ either way, as far as there is no gap, because those from fixes are rough.
     */
    private fun correctByFlow(response: Response, out: DoubleArray, earlier: Double) {
        val reach = (response.lags.single().rising / step).toInt()
        val logs = DoubleArray(size)
        var end = 0
        for (at in 0 until size) {
            if (end <= at) end = (at until size).firstOrNull { first[it] != first[at] } ?: size
            val from = maxOf(first[at], at - reach)
            val to = minOf(end - 1, at + reach)
            logs[at] = -response.flowExponent * (logSums[to + 1] - logSums[from]) / (to + 1 - from)
        }
        val usual = exp(logs.average())
        val mean = response.lags.single().rising * usual
        val times = DoubleArray(size) { exp(logs[it]) }
        for (stretch in stretches) {
            correct(stretch, Response(lags = listOf(ResponseLag(mean))), out, earlier)
            slopes(stretch, mean, earlier)
            for (i in 0 until stretch.size) {
                val at = stretch.at[i]
                if (at < 0) continue
                out[at] += mean * (times[at] / usual - 1) * (stretch.workRe[i] / stretch.fourier.size + stretch.slope)
            }
        }
    }

    /** What slope a lag of [mean], s, leaves, [earlier], s, without that of the stretch's line. */
    private fun slopes(stretch: Stretch, mean: Double, earlier: Double) {
        val n = stretch.fourier.size
        for (k in 0..n / 2) {
            val omega = if (2 * k == n) 0.0 else frequency(k, n)
            // Softened where only noise is, which would else be larger here than there, and cost more than the water says.
            val soft = 1 / (1 + (omega * maxOf(SLOPE_REACH * step, mean * SOFT)).let { it * it })
            val size = soft * omega / sqrt(1 + omega * omega * mean * mean)
            val c = -size * sin(omega * earlier)
            val s = size * cos(omega * earlier)
            turn(stretch, k, c, s)
            if (k in 1 until n - k) turn(stretch, n - k, c, -s)
        }
        stretch.fourier.transform(stretch.workRe, stretch.workIm, backwards = true)
    }

    private fun correct(stretch: Stretch, response: Response, out: DoubleArray, earlier: Double) {
        val n = stretch.fourier.size
        val isOneSided = response.lags.any { it.rising != it.falling }
        if (isOneSided) slopes(stretch)
        for (k in 0..n / 2) {
            val omega = frequency(k, n)
            val phase = omega * earlier + phase(response, omega)
            // The turn at the highest frequency would not be a real number's.
            val c = cos(phase)
            val s = if (2 * k == n) 0.0 else sin(phase)
            turn(stretch, k, c, s)
            // The other half is of real numbers, too: the same turn the other way.
            if (k in 1 until n - k) turn(stretch, n - k, c, -s)
        }
        if (isOneSided) for (k in 0 until n) addOneSided(stretch, response, k, frequency(k, n))
        stretch.fourier.transform(stretch.workRe, stretch.workIm, backwards = true)
        for (i in 0 until stretch.size) {
            if (stretch.at[i] < 0) continue
            out[stretch.at[i]] = stretch.workRe[i] / n + stretch.offset +
                stretch.slope * (i * step + response.meanDelay + earlier)
        }
    }

    private fun turn(stretch: Stretch, k: Int, c: Double, s: Double) {
        stretch.workRe[k] = stretch.re[k] * c - stretch.im[k] * s
        stretch.workIm[k] = stretch.re[k] * s + stretch.im[k] * c
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
        const val SOFT = 0.2
        const val ENDS = 5

        /** Share of points at either end of the speeds that are taken for as fast or slow as those next to them. */
        const val TAIL = 0.05
        const val SLOPE_REACH = 3
    }
}
