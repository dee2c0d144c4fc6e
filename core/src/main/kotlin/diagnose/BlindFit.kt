package stillwater.diagnose

import kotlin.math.ln

/**
 * What is believed of an [UnknownField] and of the noise: [length], m; [duration], s; [ratio] of noise to field
 * variance;
 * [noiseTime], s.
 */
internal data class BlindScales(val length: Double, val duration: Double, val ratio: Double, val noiseTime: Double)

/**
 * A log without a reference under one response and one set of scales, with the field integrated out.
 *
 * @property score twice the log-likelihood, less a constant.
 */
internal class BlindFit(
    val field: UnknownField,
    val response: BlindResponse,
    val scales: BlindScales,
    private val precision: Pair<Array<DoubleArray>, Double>,
) {
    private val n = field.series.size
    private val rows = field.rows(response, scales.noiseTime)
    private val factor: DenseCholesky
    private val ones = DoubleArray(n) { 1.0 }

    /** The readings, whitened. */
    private val target = rows.whiten(field.series.values)
    private val mean: Double
    private val halves = HashMap<DoubleArray, DoubleArray>()

    val score: Double

    /** Residuals, whitened, and the field's nodes. */
    val residuals: DoubleArray
    private val beta: DoubleArray

    init {
        val k = field.size
        val matrix = Array(k) { i -> DoubleArray(k) { j -> scales.ratio * precision.first[i][j] } }
        rows.addSquare(matrix)
        factor = DenseCholesky(matrix)
        val one = rows.whiten(ones)
        mean = inner(one, target) / inner(one, one)
        val centred = DoubleArray(n) { target[it] - mean * one[it] }
        val half = factor.half(rows.transposed(centred, k))
        val square = dot(centred, centred) - dot(half, half)
        beta = factor.back(half)
        val shown = rows.times(beta)
        residuals = DoubleArray(n) { centred[it] - shown[it] }
        val logV = factor.logDeterminant - k * ln(scales.ratio) - precision.second - 2 * rows.logScale
        score = -n * ln(maxOf(square, 1e-290) / n) - logV
    }

    /** σ², the noise's variance, sensor units². */
    val variance: Double get() = inner(centred(), centred()) / n

    private fun centred(): DoubleArray {
        val one = rows.whiten(ones)
        return DoubleArray(n) { target[it] - mean * one[it] }
    }

    /** The water along the track as it is believed to be, sensor units. */
    fun water(): DoubleArray = field.along(beta).let { u -> DoubleArray(n) { u[it] + mean } }

    /** The readings without noise. */
    fun predicted(): DoubleArray = rows.coloured(residuals).let { e ->
        DoubleArray(n) { field.series.values[it] - e[it] }
    }

    private fun half(column: DoubleArray) = halves.getOrPut(column) { factor.half(rows.transposed(column, field.size)) }

    /** aᵀ V⁻¹ b times σ², for whitened columns [a] and [b]. */
    fun inner(a: DoubleArray, b: DoubleArray): Double = dot(a, b) - dot(half(a), half(b))

    /** [column] whitened. */
    fun whiten(column: DoubleArray): DoubleArray = rows.whiten(column)

    /** What of the whitened [column] no field can imitate. */
    fun unlike(column: DoubleArray): DoubleArray {
        val shown = rows.times(factor.back(half(column)))
        return DoubleArray(n) { column[it] - shown[it] }
    }

    /**
     * How well each of [count] stretches of the log is foretold by all others: logarithms of the densities of their
     * readings, up to a constant that all fits with these [scales] share; and the square sum of the errors, last.
     */
    fun foretold(count: Int): DoubleArray {
        val k = field.size
        val matrix = Array(k) { i -> DoubleArray(k) { j -> scales.ratio * precision.first[i][j] } }
        rows.addSquare(matrix)
        val centred = centred()
        val right = rows.transposed(centred, k)
        val squares = DoubleArray(count)
        val determinants = DoubleArray(count)
        var errors = 0.0
        for (block in 0 until count) {
            val inside = { i: Int -> (i.toLong() * count / n).toInt() == block }
            val others = Array(k) { matrix[it].copyOf() }
            rows.addSquare(others, -1.0, inside)
            val without = DenseCholesky(others)
            val own = DoubleArray(n) { if (inside(it)) centred[it] else 0.0 }
            val part = rows.transposed(own, k)
            val beta = without.back(without.half(DoubleArray(k) { right[it] - part[it] }))
            val shown = rows.times(beta)
            val error = DoubleArray(n) { if (inside(it)) centred[it] - shown[it] else 0.0 }
            val half = factor.half(rows.transposed(error, k))
            errors += dot(error, error)
            squares[block] = dot(error, error) - dot(half, half)
            determinants[block] = factor.logDeterminant - without.logDeterminant
        }
        val variance = squares.sum() / n
        return DoubleArray(count + 1) { b ->
            if (b ==
                count
            ) {
                errors
            } else {
                -0.5 *
                    (squares[b] / variance + determinants[b] + n.toDouble() / count * ln(variance))
            }
        }
    }

    /** The readings less their mean, whitened. */
    fun readings(): DoubleArray = centred()
}

/** Finds the likeliest response and scales for a log without a reference. */
internal class BlindSearch(private val series: MeasuredSeries) {
    /** The water; nodes as close as their number allows. */
    val field = UnknownField(series, MOST_NODES)
    private val precisions = HashMap<Pair<Double, Double>, Pair<Array<DoubleArray>, Double>>()

    /** The fit under [response] and [scales]. */
    fun fit(response: BlindResponse, scales: BlindScales) = BlindFit(
        field,
        response,
        scales,
        precisions.getOrPut(scales.length to scales.duration) { field.precision(scales.length, scales.duration) },
    )

    /**
     * The likeliest delay with the scales that suit it. A lag also smooths, and how smooth the water is nobody knows:
     * its
     * amplitude would be mistaken for that. A delay is phase alone.
     */
    fun best(): BlindFit {
        val near = maxOf(field.spacing, 1e-9)
        var fit = fit(
            BlindResponse(0.0, 3 * series.period),
            BlindScales(LENGTHS[1] * near, DURATIONS[0] * series.duration, RATIOS[2], NOISE_TIMES[1] * series.period),
        )
        fun offer(next: BlindFit) {
            if (next.score > fit.score) fit = next
        }
        repeat(2) {
            for (length in LENGTHS) offer(fit(fit.response, fit.scales.copy(length = length * near)))
            for (duration in DURATIONS) offer(fit(fit.response, fit.scales.copy(duration = duration * series.duration)))
            for (ratio in RATIOS) offer(fit(fit.response, fit.scales.copy(ratio = ratio)))
            for (steps in NOISE_TIMES) offer(fit(fit.response, fit.scales.copy(noiseTime = steps * series.period)))
            for (steps in LAGS) offer(fit(BlindResponse(0.0, steps * series.period), fit.scales))
        }
        return refined(fit) { BlindResponse(0.0, it) }
    }

    /** [fit] with the likeliest time near its own that [response] makes a response of. */
    fun refined(fit: BlindFit, response: (Double) -> BlindResponse): BlindFit {
        var best = fit
        var width = 0.3
        repeat(REFINEMENTS) {
            val time = maxOf(best.response.timeConstant, best.response.deadTime, 0.1 * series.period)
            for (factor in doubleArrayOf(1 - width, 1 + width)) {
                val next = fit(response(time * factor), best.scales)
                if (next.score > best.score) best = next
            }
            width /= 2
        }
        return best
    }

    private companion object {
        const val MOST_NODES = 400
        const val REFINEMENTS = 4
        val LENGTHS = doubleArrayOf(3.0, 8.0, 20.0, 50.0)
        val DURATIONS = doubleArrayOf(3.0, 0.7, 0.2)
        val RATIOS = doubleArrayOf(1e-5, 1e-4, 1e-3, 0.01)
        val NOISE_TIMES = doubleArrayOf(0.0, 1.0, 4.0, 15.0)
        val LAGS = doubleArrayOf(0.1, 1.0, 2.0, 3.5, 5.0, 7.0, 10.0, 14.0, 20.0, 35.0)
    }
}
