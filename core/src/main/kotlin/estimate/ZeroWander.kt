package stillwater.estimate

import kotlin.math.PI
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * How far the sensor's zero may have wandered along a corrected track, as far as the log can tell: a random walk from
 * nothing at the log's start.
 *
 * Means of the corrected values over even parts of the track are a level, a field that is alike in all directions, noise,
 * and the walk:
 *
 *     k = A (10 + M(|Δx| / length) + noise) + q min(t₁, t₂)
 *
 * Legs beside each other then differ by more than the water along a leg explains. So does water with a front between two
 * legs, or that changes in time: that the walk is the likelier says little, and how far it goes much. See
 * core/docs/TrackCorrection.md, (7c).
 *
 * @property still probability that the zero kept still; as likely beforehand as that it did not. @property walked root
 * mean square of the walk at the log's end if it did not, sensor units.
 */
public class ZeroWander private constructor(
    public val still: Double,
    public val walked: Double,
    private val rows: IntArray,
    private val walks: List<Walk>,
) {
    /** One strength of the walk: its weight, and its mean and variance at each node. */
    private class Walk(val weight: Double, val means: DoubleArray, val variances: DoubleArray)

    /** Whether the log speaks for a zero that wandered, or for what looks alike, rather than against it. */
    public val isSeen: Boolean get() = still < HALF

    /** [track] with intervals that hold what the zero may have wandered by as well; as it is unless that [isSeen]. */
    public fun widened(track: CorrectedTrack): CorrectedTrack {
        if (walks.isEmpty()) return track
        val size = track.values.size
        val mixture = NormalMixture(size)
        for (row in 0 until size) {
            val deviation = (track.upper[row] - track.lower[row]) / (2 * TWO_SIDED)
            var node = rows.binarySearch(row).let { if (it >= 0) it else maxOf(0, -it - 2) }
            node = minOf(node, rows.size - 2)
            val share = ((row - rows[node]).toDouble() / (rows[node + 1] - rows[node])).coerceIn(0.0, 1.0)
            for (walk in walks) {
                fun at(numbers: DoubleArray) = numbers[node] + share * (numbers[node + 1] - numbers[node])
                val variance = deviation * deviation + at(walk.variances)
                mixture.add(row, walk.weight, track.values[row] - at(walk.means), variance, 0, 0.0)
            }
        }
        val wide = CorrectedTrack(
            DoubleArray(size),
            DoubleArray(size),
            DoubleArray(size),
            BooleanArray(size),
            BooleanArray(size),
        )
        mixture.write(wide, 0)
        return track.holding(wide)
    }

    public companion object {
        private const val TWO_SIDED = 1.96
        private const val HALF = 0.5
        private const val NODES = 120
        private const val FEWEST = 40
        private const val LEVEL = 10.0
        private const val JITTER = 1e-9
        private const val EVALUATIONS = 10
        private const val CLOSE = 0.1
        private const val FIRST_NOISE = 0.01
        private const val LEAST_WEIGHT = 0.002

        /** A walk that is none: what no water is as even as. Deviations of the corrected values. */
        private const val SMALL = 0.04

        /** Deviations of the walk at the log's end that are asked for, in those of the corrected values; and none. */
        private val WALKS = listOf(0.0, SMALL, 0.09, 0.2, 0.45, 1.0, 2.2)

        /** What [track], the correction of [series], says. */
        public fun of(series: TrackSeries, track: CorrectedTrack): ZeroWander {
            val nodes = minOf(NODES, series.size)
            val still = ZeroWander(1.0, 0.0, IntArray(0), emptyList())
            if (nodes < FEWEST) return still
            return Nodes(series, track, nodes).wander() ?: still
        }
    }

    /** Means over [count] even parts of the track. */
    private class Nodes(series: TrackSeries, track: CorrectedTrack, private val count: Int) {
        private val rows = IntArray(count) { ((it + 0.5) * series.size / count).toInt() }
        private val values = means(series.size) { track.values[it] }
        private val xs = means(series.size) { series.xs[it] }
        private val ys = means(series.size) { series.ys[it] }
        private val start = series.times[0]
        private val end = series.times[series.size - 1] - start
        private val times = means(series.size) { (series.times[it] - start) / end }
        private val spread = sqrt(values.average().let { mean -> values.sumOf { (it - mean) * (it - mean) } } / count)
        private val extent = maxOf(xs.max() - xs.min(), ys.max() - ys.min())
        private val factor = DoubleArray(count * count)
        private val solved = DoubleArray(count)

        private fun means(size: Int, of: (Int) -> Double) = DoubleArray(count) { node ->
            val from = (node.toLong() * size / count).toInt()
            val to = ((node + 1L) * size / count).toInt()
            (from until to).sumOf(of) / (to - from)
        }

        private inner class Fit(val smoothness: Smoothness, val walk: Double, val logs: DoubleArray, val score: Double)

        fun wander(): ZeroWander? {
            if (!(spread > 0) || !(extent > 0) || !(end > 0)) return null
            val fits = ArrayList<Fit>()
            for (smoothness in Smoothness.entries) {
                var logs = doubleArrayOf(ln(extent / 6), ln(FIRST_NOISE), ln(spread * spread))
                for (walk in WALKS) {
                    val step = DoubleArray(3) { if (walk == 0.0) 1.0 else 0.4 }
                    val evaluations = EVALUATIONS * (if (walk == 0.0) 3 else 1)
                    logs = Search.simplex(logs, step, evaluations, CLOSE) { score(smoothness, walk, it) }
                    fits += Fit(smoothness, walk, logs, score(smoothness, walk, logs))
                }
            }
            val best = fits.maxOf { it.score }
            // None is as likely beforehand as all walks together.
            val walking = WALKS.count { it > SMALL }
            val share = walking.toDouble() / (WALKS.size - walking)
            val weights = fits.map { exp(it.score - best) * if (it.walk > SMALL) 1.0 else share }
            val total = weights.sum()
            val walks = fits.indices.filter { fits[it].walk > SMALL }
            val moved = walks.sumOf { weights[it] }
            val square = walks.sumOf { weights[it] / moved * fits[it].walk * fits[it].walk }
            val still = 1 - moved / total
            // What is not seen widens nothing.
            val kept = if (still < HALF) walks.filter { weights[it] > LEAST_WEIGHT * moved } else emptyList()
            val weight = kept.sumOf { weights[it] }
            return ZeroWander(still, spread * sqrt(square), rows, kept.map { walk(fits[it], weights[it] / weight) })
        }

        private fun square(walk: Double) = walk * walk * spread * spread

        /** Cholesky factor of the covariance; the logarithm of its determinant. */
        private fun decompose(smoothness: Smoothness, walk: Double, logs: DoubleArray): Double {
            val perLength = 2 * smoothness.nu / exp(2 * logs[0])
            val noise = exp(logs[1])
            val amplitude = exp(logs[2])
            val wandered = square(walk)
            var logDeterminant = 0.0
            for (i in 0 until count) {
                val row = i * count
                for (j in 0..i) {
                    val dx = xs[i] - xs[j]
                    val dy = ys[i] - ys[j]
                    var s = amplitude * (LEVEL + smoothness.covariance((dx * dx + dy * dy) * perLength)) +
                        wandered * times[j]
                    if (i == j) s += amplitude * (noise + JITTER)
                    val other = j * count
                    for (k in 0 until j) s -= factor[row + k] * factor[other + k]
                    if (i == j) {
                        factor[row + i] = sqrt(maxOf(s, JITTER * amplitude))
                        logDeterminant += 2 * ln(factor[row + i])
                    } else {
                        factor[row + j] = s / factor[other + j]
                    }
                }
            }
            return logDeterminant
        }

        private fun solve(of: (Int) -> Double) {
            for (i in 0 until count) {
                var s = of(i)
                for (k in 0 until i) s -= factor[i * count + k] * solved[k]
                solved[i] = s / factor[i * count + i]
            }
        }

        private val mean = values.average()

        private fun score(smoothness: Smoothness, walk: Double, logs: DoubleArray): Double {
            val logDeterminant = decompose(smoothness, walk, logs)
            solve { values[it] - mean }
            // A weak belief: a field whose length and amplitude are of the survey's own scales.
            val length = logs[0] - ln(extent / 6)
            val amplitude = logs[2] - ln(spread * spread)
            return -(logDeterminant + solved.sumOf { it * it } + count * ln(2 * PI)) / 2 - length * length / 8 -
                amplitude * amplitude / 8 - (logs[1] - ln(FIRST_NOISE)).let { it * it } / 32
        }

        private fun walk(fit: Fit, weight: Double): Walk {
            decompose(fit.smoothness, fit.walk, fit.logs)
            solve { values[it] - mean }
            val data = solved.copyOf()
            val wandered = square(fit.walk)
            val means = DoubleArray(count)
            val variances = DoubleArray(count)
            for (node in 0 until count) {
                solve { wandered * minOf(times[node], times[it]) }
                means[node] = (0 until count).sumOf { solved[it] * data[it] }
                variances[node] = maxOf(0.0, wandered * times[node] - solved.sumOf { it * it })
            }
            return Walk(weight, means, variances)
        }
    }
}
