package stillwater.diagnose

import kotlin.math.ln

/** What is believed of an [UnknownField] and of the noise: [length], m; [ratio] of noise to field variance; [noiseTime], s. */
internal data class BlindScales(val length: Double, val ratio: Double, val noiseTime: Double)

/**
 * A log without a reference under one response and one set of scales, with the field integrated out.
 *
 * @property score twice the log-likelihood, less a constant.
 */
internal class BlindFit(
    val field: UnknownField,
    val response: BlindResponse,
    val scales: BlindScales,
    precision: Pair<Array<DoubleArray>, Double>,
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
    fun predicted(): DoubleArray = rows.coloured(residuals).let { e -> DoubleArray(n) { field.series.values[it] - e[it] } }

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

    /** The readings less their mean, whitened. */
    fun readings(): DoubleArray = centred()
}

/** Finds the likeliest response and scales for a log without a reference. */
internal class BlindSearch(private val series: MeasuredSeries) {
    private val extent = maxOf(series.x.max() - series.x.min(), series.y.max() - series.y.min())

    /** Grid as fine as the boat's way in two rows, or as the number of nodes allows. */
    val field: UnknownField = run {
        var spacing = maxOf(2 * series.period * median(series.speed), extent / 400, 1e-9)
        var found = UnknownField(series, spacing)
        while (found.size > MOST_NODES) {
            spacing *= 1.25
            found = UnknownField(series, spacing)
        }
        found
    }

    private val precisions = HashMap<Double, Pair<Array<DoubleArray>, Double>>()

    /** The fit under [response] and [scales]. */
    fun fit(response: BlindResponse, scales: BlindScales) =
        BlindFit(field, response, scales, precisions.getOrPut(scales.length) { field.precision(scales.length) })

    /** The likeliest first-order lag with the scales that suit it. */
    fun best(): BlindFit {
        var fit = fit(BlindResponse(3 * series.period, 0.0), BlindScales(4 * field.spacing, 0.01, 0.0))
        fun offer(next: BlindFit) {
            if (next.score > fit.score) fit = next
        }
        repeat(2) {
            for (length in LENGTHS) offer(fit(fit.response, fit.scales.copy(length = length * field.spacing)))
            for (ratio in RATIOS) offer(fit(fit.response, fit.scales.copy(ratio = ratio)))
            for (steps in NOISE_TIMES) offer(fit(fit.response, fit.scales.copy(noiseTime = steps * series.period)))
            for (steps in LAGS) offer(fit(BlindResponse(steps * series.period, 0.0), fit.scales))
        }
        return refined(fit) { BlindResponse(it, 0.0) }
    }

    /** [fit] with the likeliest time near its own that [response] makes a response of. */
    fun refined(fit: BlindFit, response: (Double) -> BlindResponse): BlindFit {
        var best = fit
        var width = 0.35
        repeat(REFINEMENTS) {
            val time = maxOf(best.response.timeConstant, best.response.deadTime, 0.1 * series.period)
            for (factor in doubleArrayOf(1 - width, 1 + width)) {
                val next = fit(response(time * factor), best.scales)
                if (next.score > best.score) best = next
            }
            width /= 1.7
        }
        return best
    }

    /** The likeliest pure delay under [scales]. */
    fun delay(scales: BlindScales): BlindFit =
        refined(LAGS.map { fit(BlindResponse(0.0, it * series.period), scales) }.maxBy { it.score }) { BlindResponse(0.0, it) }

    private companion object {
        const val MOST_NODES = 320
        const val REFINEMENTS = 6
        val LENGTHS = doubleArrayOf(2.0, 6.0, 16.0, 40.0)
        val RATIOS = doubleArrayOf(1e-5, 1e-4, 1e-3, 0.003, 0.03, 0.1)
        val NOISE_TIMES = doubleArrayOf(0.0, 0.7, 2.0, 6.0, 20.0)
        val LAGS = doubleArrayOf(0.1, 0.7, 1.4, 2.8, 4.0, 5.6, 8.0, 11.0, 16.0, 23.0, 45.0, 90.0)
    }
}
