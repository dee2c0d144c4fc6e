package stillwater.diagnose

import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * A model with the numbers that fit a log best under correlated noise.
 *
 * @property model what was fitted. @property numbers its parameters. @property free which of them were fitted.
 * @property noise the noise at the optimum. @property residuals reading less prediction, length n; where no reading is
 * known the mean of those beside it.
 * @property whitened the same, whitened; 0 in rows not in use. @property score twice the log-likelihood, less a
 * constant.
 */
internal class ModelFit(
    val model: ResponseModel,
    val numbers: DoubleArray,
    val free: BooleanArray,
    val noise: CorrelatedNoise,
    val residuals: DoubleArray,
    val whitened: DoubleArray,
    val score: Double,
) {
    /** Variance of the whitened residuals, sensor units². */
    val variance: Double get() = squares(whitened) / maxOf(noise.rows - free.count { it }, 1)

    /** Whitened derivatives by each free parameter, on the scale it is fitted on. */
    val jacobian: Array<DoubleArray> by lazy { Fitting.jacobian(this) }

    /** What the model shows, sensor units, length n. */
    val predicted: DoubleArray by lazy {
        val values = model.series.values
        if (model.series.isRead == null) {
            DoubleArray(values.size) { values[it] - residuals[it] }
        } else {
            DoubleArray(values.size).also { model.predict(numbers, it) }
        }
    }

    private val usual by lazy { Spikes.spread(model.series.shown(whitened)) }

    /**
     * Whether row [i] is off alone by more than what is not known of the truth may make it: that fades with the lag, over
     * the rows after it.
     */
    fun isBeyondDoubt(i: Int): Boolean = numbers[ResponseModel.TIME_CONSTANT] > FADING * model.series.period &&
        abs(residuals[i]) > FAR_OFF * usual && Spikes.isSingle(residuals, i)

    /** Parameter [i] on the scale it is fitted on. */
    fun scaled(i: Int): Double = if (model.parameters[i].logarithmic) ln(numbers[i]) else numbers[i]
}

/** Rows, within a time constant, that show what fades; and deviations of the noise by which a row is far off in doubt. */
private const val FADING = 3.0
private const val FAR_OFF = 20.0

/** Finds the numbers under which a log is likeliest: Levenberg-Marquardt on whitened residuals, the noise in turn. */
internal object Fitting {
    private const val STEPS = 14
    private const val STEP = 1e-4
    private const val ENOUGH = 1e-3

    /**
     * Fits [model] from [start]; numbers not [free] stay. With [noise] given, it stays too.
     *
     * @param used rows to fit. @param longest longest correlation time of noise, s.
     */
    fun fit(
        model: ResponseModel,
        start: DoubleArray,
        free: BooleanArray,
        used: BooleanArray,
        longest: Double,
        noise: CorrelatedNoise? = null,
        guess: CorrelatedNoise? = null,
    ): ModelFit {
        var current = noise ?: guess ?: CorrelatedNoise.white(model.scales, used)
        var fit = descend(model, start, free, current)
        if (noise != null) return fit
        repeat(2) { round ->
            val near = current.takeIf { round > 0 }
            current = NoiseSearch(model.scales, fit.residuals, used, longest).near(near)
            fit = descend(model, fit.numbers, free, current)
        }
        return fit
    }

    /** The state of [model] at [numbers] under [noise]. */
    fun at(model: ResponseModel, numbers: DoubleArray, free: BooleanArray, noise: CorrelatedNoise): ModelFit {
        val n = model.series.size
        val residuals = DoubleArray(n)
        model.predict(numbers, residuals)
        for (i in 0 until n) residuals[i] = model.series.values[i] - residuals[i]
        model.series.isRead?.let { bridge(residuals, it) }
        val whitened = DoubleArray(n)
        noise.whiten(residuals, whitened)
        return ModelFit(
            model,
            numbers,
            free,
            noise,
            residuals,
            whitened,
            noise.twiceLogLikelihood(squares(whitened)),
        )
    }

    /** Puts the mean of the residuals beside it where none [isRead]. */
    private fun bridge(residuals: DoubleArray, isRead: BooleanArray) {
        var before = Double.NaN
        var i = 0
        while (i < residuals.size) {
            if (isRead[i]) {
                before = residuals[i++]
                continue
            }
            var next = i
            while (next < residuals.size && !isRead[next]) next++
            val after = residuals.getOrElse(next) { before }
            residuals.fill(if (before.isNaN()) after else (before + after) / 2, i, next)
            i = next
        }
    }

    private fun descend(
        model: ResponseModel,
        start: DoubleArray,
        free: BooleanArray,
        noise: CorrelatedNoise,
    ): ModelFit {
        var best = at(model, start.copyOf(), free, noise)
        var damping = 1e-3
        repeat(STEPS) {
            val jacobian = jacobian(best)
            val normal = SymmetricSystem.of(jacobian, best.whitened)
            var gained = 0.0
            var tries = 0
            while (gained <= 0 && tries++ < 6) {
                val step = normal.solve(damping)
                val next = at(model, moved(best, step), free, noise)
                gained = next.score - best.score
                if (gained > 0) {
                    best = next
                    damping = maxOf(damping / 10, 1e-9)
                } else {
                    damping = if (damping < 1e-3) 1e-2 else damping * 10
                }
            }
            if (!(gained > ENOUGH)) return best
        }
        return best
    }

    private fun moved(fit: ModelFit, step: DoubleArray): DoubleArray {
        val numbers = fit.numbers.copyOf()
        var k = 0
        for (i in numbers.indices) {
            if (!fit.free[i]) continue
            val parameter = fit.model.parameters[i]
            val shift = step[k++]
            if (!shift.isFinite()) continue
            val next = if (parameter.logarithmic) numbers[i] * exp(shift.coerceIn(-1.5, 1.5)) else numbers[i] + shift
            numbers[i] = next.coerceIn(parameter.lower, parameter.upper)
        }
        return numbers
    }

    /** Whitened derivatives of the prediction by each free parameter of [fit]. */
    fun jacobian(fit: ModelFit): Array<DoubleArray> =
        derivatives(fit).also(fit.noise::whitenAll).toTypedArray()

    /** Derivatives of the prediction by each free parameter of [fit]. */
    fun derivatives(fit: ModelFit): List<DoubleArray> {
        val shown = fit.predicted
        return fit.free.indices.filter { fit.free[it] }.map { i ->
            val parameter = fit.model.parameters[i]
            val numbers = fit.numbers.copyOf()
            val size = if (parameter.logarithmic) STEP else STEP * maxOf(abs(numbers[i]), scale(fit.model, parameter))
            val forward = if (parameter.logarithmic) numbers[i] * exp(size) else numbers[i] + size
            val sign = if (forward > parameter.upper) -1 else 1
            numbers[i] = if (parameter.logarithmic) numbers[i] * exp(sign * size) else numbers[i] + sign * size
            val shifted = DoubleArray(shown.size)
            fit.model.predict(numbers, shifted)
            for (r in shifted.indices) shifted[r] = (shifted[r] - shown[r]) / (sign * size)
            shifted
        }
    }

    private fun scale(model: ResponseModel, parameter: Parameter): Double = when (parameter.unit) {
        "s", "m" -> model.series.period
        "sensor units" -> model.scales.range
        "sensor units/s" -> model.scales.range / maxOf(model.series.duration, 1.0)
        else -> 0.1
    }
}

/** Normal equations of a least-squares problem. */
internal class SymmetricSystem(private val matrix: Array<DoubleArray>, private val right: DoubleArray) {
    private val size = right.size

    /** The step that solves (A + damping diag A) step = right; columns without weight stay where they are. */
    fun solve(damping: Double): DoubleArray {
        val scale = DoubleArray(size) { if (matrix[it][it] > 0) 1 / sqrt(matrix[it][it]) else 0.0 }
        val lower = factor(scale, damping + 1e-12)
        val step = DoubleArray(size) { right[it] * scale[it] }
        for (i in 0 until size) {
            for (j in 0 until i) step[i] -= lower[i][j] * step[j]
            step[i] /= lower[i][i]
        }
        for (i in size - 1 downTo 0) {
            for (j in i + 1 until size) step[i] -= lower[j][i] * step[j]
            step[i] /= lower[i][i]
        }
        return DoubleArray(size) { step[it] * scale[it] }
    }

    /** Element ([k], [k]) of the inverse. */
    fun inverseDiagonal(k: Int): Double {
        val unit = SymmetricSystem(matrix, DoubleArray(size) { if (it == k) 1.0 else 0.0 })
        return unit.solve(0.0)[k]
    }

    private fun factor(scale: DoubleArray, damping: Double): Array<DoubleArray> {
        val lower = Array(size) { DoubleArray(size) }
        for (i in 0 until size) {
            for (j in 0..i) {
                var sum = if (i == j) 1 + damping else matrix[i][j] * scale[i] * scale[j]
                for (k in 0 until j) sum -= lower[i][k] * lower[j][k]
                lower[i][j] = if (i == j) sqrt(maxOf(sum, 1e-14)) else sum / lower[j][j]
            }
        }
        return lower
    }

    companion object {
        /** The normal equations of [columns] and the vector [target]. */
        fun of(columns: Array<DoubleArray>, target: DoubleArray): SymmetricSystem {
            val matrix = Array(columns.size) { DoubleArray(columns.size) }
            val right = DoubleArray(columns.size)
            for ((i, column) in columns.withIndex()) {
                val products = dots(column, columns.take(i + 1) + target)
                for (j in 0..i) {
                    matrix[i][j] = products[j]
                    matrix[j][i] = products[j]
                }
                right[i] = products[i + 1]
            }
            return SymmetricSystem(matrix, right)
        }
    }
}

/** Inner product. */
internal fun dot(a: DoubleArray, b: DoubleArray): Double {
    var sum = 0.0
    for (i in a.indices) sum += a[i] * b[i]
    return sum
}

/** Inner products of [column] with each of [others], four at a time: sums that do not wait for each other. */
internal fun dots(column: DoubleArray, others: List<DoubleArray>): DoubleArray {
    val products = DoubleArray(others.size)
    for (from in others.indices step TOGETHER) {
        if (from + TOGETHER > others.size) {
            for (k in from until others.size) products[k] = dot(column, others[k])
        } else {
            dots(column, others[from], others[from + 1], others[from + 2], others[from + 3], products, from)
        }
    }
    return products
}

private const val TOGETHER = 4

private fun dots(
    column: DoubleArray,
    a: DoubleArray,
    b: DoubleArray,
    c: DoubleArray,
    d: DoubleArray,
    out: DoubleArray,
    at: Int,
) {
    var first = 0.0
    var second = 0.0
    var third = 0.0
    var fourth = 0.0
    for (i in column.indices) {
        val here = column[i]
        first += here * a[i]
        second += here * b[i]
        third += here * c[i]
        fourth += here * d[i]
    }
    out[at] = first
    out[at + 1] = second
    out[at + 2] = third
    out[at + 3] = fourth
}
