package stillwater.diagnose.response

import stillwater.diagnose.algebra.SymmetricSystem
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.noise.CorrelatedNoise
import kotlin.math.abs
import kotlin.math.exp
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

    /** Standard error of number [i], which was fitted, on the scale it is fitted on. */
    fun standardError(i: Int): Double {
        val place = (0 until i).count { free[it] }
        return sqrt(SymmetricSystem.of(jacobian, whitened).inverseDiagonal(place) * variance)
    }

    /** What the model shows, sensor units, length n. */
    val predicted: DoubleArray by lazy {
        val values = model.series.values
        if (model.series.isRead == null) {
            DoubleArray(values.size) { values[it] - residuals[it] }
        } else {
            DoubleArray(values.size).also { model.predict(numbers, it) }
        }
    }
}

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
        var current = noise ?: guess ?: model.scales.white(used)
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
