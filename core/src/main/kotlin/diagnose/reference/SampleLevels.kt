package stillwater.diagnose.reference

import stillwater.diagnose.Loops
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.Cholesky
import stillwater.diagnose.algebra.dot
import stillwater.diagnose.all
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import kotlin.math.ln

/**
 * A truth that stands still between sharp steps, as where a probe is moved between samples, and a reference of it with noise.
 *
 * The mean of a stretch's rows is off the truth by the noise over the root of their number, and with it all that is read there:
 * as if the sensor did not follow small changes, or none at the ends of its range. How high each stretch is, is therefore told
 * by the readings as well, each by its own noise: a Gaussian random effect in a linear model.
 *
 * Source: Rasmussen and Williams 2006, Gaussian Processes for Machine Learning, (2.43): the marginal likelihood with heights
 * that are known to their mean's error.
 *
 * @param series the log with the reference as it is. @param isBroken whether the truth steps before a row, length n.
 * @param spread standard deviation of the reference's noise, its own units.
 */
internal class SampleLevels(
    private val series: MeasuredSeries,
    private val isBroken: BooleanArray,
    private val spread: Double,
    private val longest: Double,
    private val loops: Loops,
) {
    private val reference = requireNotNull(series.reference) { "levels are a reference's" }
    private val starts = reference.indices.filter { it == 0 || isBroken[it] }.let { sharp ->
        sharp.zip(sharp.drop(1) + reference.size).flatMap { (from, to) -> parts(from, to) }
    }
    private val ends = starts.drop(1) + reference.size

    /** The reference's mean over each stretch, its own units, length n. */
    val means: DoubleArray = reference.copyOf().also { out ->
        for ((k, from) in starts.withIndex()) {
            out.fill(reference.copyOfRange(from, ends[k]).average(), from, ends[k])
        }
    }

    /** Whether so few stretches are so long that they say more than their rows. */
    val isFew: Boolean get() = starts.size <= minOf(MOST, reference.size / FEWEST_ROWS, NUMBERS / reference.size)

    /**
     * Heights as reference and readings say them, the reference's units, length n, and twice the log-likelihood then. The readings are
     * those of a sensor like that of [fit], and their noise is that one's.
     */
    fun told(fit: ModelFit): Pair<DoubleArray, Double> {
        var course = means
        var last = fit.fitted(course)
        var worth = Double.NEGATIVE_INFINITY
        repeat(TURNS) {
            val white = white(last)
            val left = last.whitened.copyOf()
            // What is left of the means alone.
            for ((k, from) in starts.withIndex()) {
                val moved = course[from] - means[from]
                for (i in left.indices) left[i] += moved * white[k][i]
            }
            val known = DoubleArray(starts.size) { (ends[it] - starts[it]) / (spread * spread) }
            val variance = last.variance
            val precision = Cholesky(
                Array(starts.size) { k ->
                    DoubleArray(k + 1) { dot(white[k], white[it]) / variance }.also { it[k] += known[k] }
                },
            )
            val right = DoubleArray(starts.size) { dot(white[it], left) / variance }
            val heights = precision.back(precision.half(right))
            course = means.copyOf()
            for ((k, from) in starts.withIndex()) for (i in from until ends[k]) course[i] += heights[k]
            last = last.fitted(course)
            val off = heights.indices.sumOf { heights[it] * heights[it] * known[it] - ln(known[it]) }
            worth = last.score - off - precision.logDeterminant
        }
        return course to worth
    }

    /** Where the truth goes on at another height within the stretch [from] until [to], by a few times the noise, and [from]. */
    private fun parts(from: Int, to: Int): List<Int> {
        val count = to - from
        val mean = (from until to).sumOf { reference[it] } / count
        var above = 0.0
        var at = from
        var most = STEPS * spread * spread
        for (k in 1 until count) {
            above += reference[from + k - 1] - mean
            val gain = above * above * count / (k * (count - k).toDouble())
            if (gain > most) {
                most = gain
                at = from + k
            }
        }
        return if (at == from) listOf(from) else parts(from, at) + parts(at, to)
    }

    private fun ModelFit.fitted(course: DoubleArray): ModelFit =
        Fitting.fit(model.of(course), numbers, free, noise.used, longest, guess = noise)

    private fun ResponseModel.of(course: DoubleArray): ResponseModel {
        val log = series.withQuieter(course)
        return ResponseModel(log, terms, steps, scales.of(log))
    }

    /** What the readings change by with the height of each stretch, whitened. */
    private fun white(fit: ModelFit): List<DoubleArray> {
        val course = checkNotNull(fit.model.series.reference)
        val step = STEP * spread
        return loops.all(starts.indices.toList()) { k ->
            val higher = course.copyOf()
            for (i in starts[k] until ends[k]) higher[i] += step
            val shown = DoubleArray(course.size)
            fit.model.of(higher).predict(fit.numbers, shown)
            for (i in shown.indices) shown[i] = (shown[i] - fit.predicted[i]) / step
            shown
        }.also(fit.noise::whitenAll)
    }

    private companion object {
        const val MOST = 300
        const val FEWEST_ROWS = 4
        const val TURNS = 3

        /** Of all stretches and rows: a column for each is kept. */
        const val NUMBERS = 4_000_000

        /** Of the noise, for derivatives. */
        const val STEP = 1e-3

        /** Squares of the noise that a step takes off at least: a stretch in two costs little. */
        const val STEPS = 12.0
    }
}
