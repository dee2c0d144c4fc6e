package stillwater.diagnose.reference

import stillwater.diagnose.Loops
import stillwater.diagnose.all
import stillwater.diagnose.evidence.AveragedNoise
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.refined
import stillwater.diagnose.three

/**
 * Readings that an instrument gives as means over the last seconds: no cause of the list, and much like a dead time of half of
 * these with a second lag.
 *
 * The mean of what a lag shows is what it shows of the truth's mean, ∫ₜ₋ᵥᵗ truth ds / V, so that one log with another
 * reference for each V tells. The truth goes on evenly between rows or is held over each step ([Steps]), which of a few rows'
 * mean is most of what there is to see.
 *
 * @param rest what was chosen, without delays. @param averaged what the residuals of all of it say of noise that is averaged; null
 *   for nothing.
 */
internal class RunningMean(
    private val rest: WithoutDelays,
    private val averaged: AveragedNoise?,
    private val loops: Loops,
) {
    private val base = rest.base
    private val series = base.model.series
    private val times = series.times

    private val truth = requireNotNull(series.reference) { "there is a truth to take means of" }
    private val even = integral { (truth[it - 1] + truth[it]) / 2 }
    private val held = integral { truth[it] }

    /** Of the truth up to each row, sensor units · s, where that is on average [over] the step to a row. */
    private fun integral(over: (Int) -> Double) = DoubleArray(times.size).also { sum ->
        for (i in 1 until sum.size) sum[i] = sum[i - 1] + over(i) * (times[i] - times[i - 1])
    }

    /**
     * That readings are running means, where that explains the log better than the delays and further lags among what was
     * chosen, or, where there are none, than nothing, or where delays were chosen and the noise is averaged; else null.
     */
    fun rival(): Rival? {
        // How the truth went between rows far apart is not known.
        if (series.isSparse) return null
        return mean() ?: if (rest.hadSome) averaged?.let { Rival(it.words(), rest.last.score) } else null
    }

    private fun mean(): Rival? {
        val (window, fit) = best() ?: return null
        val tau = fit.numbers[ResponseModel.TIME_CONSTANT]
        val lag = if (tau < series.period / 2) "" else " of what a lag of ${three(tau)} s shows"
        return rest.rival(fit, WINDOW) {
            "the readings look like running means over ${three(window)} s$lag, as an instrument that " +
                "${AveragedNoise.AVERAGES} gives them: half of that, ${three(window / 2)} s, they are late"
        }
    }

    /** The likeliest window and the model with it; null where that is the shortest or the longest that is looked for. */
    private fun best(): Pair<Double, ModelFit>? {
        val windows = generateSequence(SHORTEST * series.period) { it * FACTOR }
            .takeWhile { it < minOf(series.duration / PARTS, rest.longest) }.toList()
        if (windows.isEmpty()) return null
        return loops.all(WAYS) { way ->
            fun at(window: Double) = fit(window, way)
            val best = loops.all(windows) { it to at(it) }.maxBy { it.second.score }
            refined(best, FACTOR, { it.score }, ::at)
        }.maxBy { it.second.score }.takeIf { it.first in windows.first()..windows.last() }
    }

    private fun fit(window: Double, steps: Steps): ModelFit {
        val log = series.withQuieter(means(window, if (steps.isHeld) held else even))
        val tau = maxOf(base.numbers[ResponseModel.TIME_CONSTANT] - window / 2, series.period)
        return rest.fit(base.model.scales.of(log), steps, tau)
    }

    /** Means over [window] s before each row of the truth of which [integral] is; before the log it was what its first row has. */
    private fun means(window: Double, integral: DoubleArray): DoubleArray {
        var k = 0
        return DoubleArray(times.size) { i ->
            val from = times[i] - window
            while (k + 1 < times.size && times[k + 1] <= from) k++
            val before = if (from < times[0]) {
                truth[0] * (from - times[0])
            } else {
                val share = (from - times[k]) / (times[k + 1] - times[k])
                integral[k] + share * (integral[k + 1] - integral[k])
            }
            (integral[i] - before) / window
        }
    }

    private companion object {
        val WAYS = listOf(Steps.EVEN, Steps.HELD)

        /** Rows, and the ratio of one window that is tried to the one before. */
        const val SHORTEST = 2.0
        const val FACTOR = 1.5

        /** Of the log: a window that is longer is seen to end in few of its parts. */
        const val PARTS = 10

        /** Twice the log-likelihood that the best of so many windows gains by chance. */
        const val WINDOW = 6.0
    }
}
