package stillwater.estimate

import stillwater.sensor.SensorStage
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Noise of which a share φ wanders over a time T and the rest is white, by the likelihood of what is left of readings
 * (Jones 1981; core/docs/Diagnosis.md, (2)).
 *
 * @param times of the [left], s, growing, as many. @param left what a sensor with a reference leaves of its readings, sensor
 *   units. Not modified.
 */
internal class WanderingNoise(private val times: DoubleArray, private val left: DoubleArray) {
    private val n = left.size

    /** Twice the log-likelihood but for a constant, and the noise's variance, sensor units². */
    private fun weighed(share: Double, time: Double): Pair<Double, Double> {
        var now = 0.0
        var spread = share
        var squares = 0.0
        var logarithms = 0.0
        for (i in 0 until n) {
            if (i > 0) {
                val fade = exp(-(times[i] - times[i - 1]) / time)
                now *= fade
                spread = fade * fade * spread + share * (1 - fade * fade)
            }
            val surprise = left[i] - now
            val variance = spread + 1 - share
            squares += surprise * surprise / variance
            logarithms += ln(variance)
            val gain = spread / variance
            now += gain * surprise
            spread *= 1 - gain
        }
        val mean = squares / n
        return -n * ln(maxOf(mean, LEAST)) - logarithms to mean
    }

    /** What of it wanders; null where white noise is as likely. */
    fun stage(): SensorStage.Wander? {
        if (n < FEWEST) return null
        val steps = DoubleArray(n - 1) { times[it + 1] - times[it] }
        steps.sort()
        val step = steps[steps.size / 2]
        // What wanders more slowly is no noise.
        val longest = maxOf((times.last() - times.first()) / PARTS, LEAST_STEPS * step)
        fun share(logs: DoubleArray) = 1 / (1 + exp(-logs[0]))
        fun time(logs: DoubleArray) = exp(logs[1]).coerceIn(step / LEAST_STEPS, longest)
        fun score(logs: DoubleArray) = weighed(share(logs), time(logs)).first
        val starts = SHARES.flatMap { share ->
            generateSequence(step) { it * FACTOR }.takeWhile { it < longest }
                .map { doubleArrayOf(ln(share / (1 - share)), ln(it)) }.toList()
        }
        val best = Search.simplex(starts.maxBy(::score), doubleArrayOf(0.5, 0.5), EVALUATIONS, CLOSE, ::score)
        val (found, variance) = weighed(share(best), time(best))
        if (!(found - weighed(0.0, step).first > CLEARLY)) return null
        return SensorStage.Wander(sqrt(share(best) * variance), time(best))
    }

    private companion object {
        const val FEWEST = 30
        const val PARTS = 20.0
        const val LEAST_STEPS = 3.0
        const val FACTOR = 3.0
        const val EVALUATIONS = 60
        const val CLOSE = 0.01
        val SHARES = listOf(0.3, 0.8, 0.98)

        /** Twice the gain in log-likelihood of two more numbers that chance gives one log in a hundred. */
        const val CLEARLY = 9.2
        const val LEAST = 1e-300
    }
}
