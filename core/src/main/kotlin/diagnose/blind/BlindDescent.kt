package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.algebra.SymmetricSystem
import stillwater.diagnose.algebra.dot
import stillwater.diagnose.response.Parameter
import stillwater.diagnose.response.ResponseModel
import kotlin.math.abs
import kotlin.math.exp

/**
 * Numbers that were found, and what they leave.
 *
 * @property left square sum of the residuals once the water has taken what it can, times what makes up in the likelihood
 *   for water that is bound more tightly ([BlindDeterminant]). @property residuals readings less what the model shows of
 *   the water before that.
 */
internal class BlindPoint(val numbers: DoubleArray, val residuals: DoubleArray, val left: Double)

/** Levenberg-Marquardt with the water free to take what it can at each step; the water's part is that of [state]. */
internal class BlindDescent(search: BlindSearch, private val state: BlindState) {
    private val n = state.residuals.size
    private val determinant by lazy { BlindDeterminant(search, state) }
    private val values = state.model.series.values

    /** What [model] at [numbers] leaves. */
    private fun at(model: ResponseModel, numbers: DoubleArray): Tried {
        val shown = DoubleArray(n)
        model.predict(numbers, shown)
        val r = DoubleArray(n) { values[it] - shown[it] }
        val white = state.fit.whitened(r)
        val taken = state.fit.taken(white)
        val bound = determinant.at(model, numbers)
        val left = state.fit.left(white, taken)
        return Tried(BlindPoint(numbers, r, left * exp(bound / state.fit.rows)), shown, white, taken, left, bound)
    }

    /**
     * A point, what the model has [shown] there, to the last bit (what does not change with a number has a derivative of
     * 0 and nothing else), its residuals [white] whitened, what the water has [taken] of them and [left], and how much
     * more tightly it is [bound].
     */
    private class Tried(
        val point: BlindPoint,
        val shown: DoubleArray,
        val white: DoubleArray,
        val taken: DoubleArray,
        val left: Double,
        val bound: Double,
    )

    /** The best numbers of [model], whose truth is the state's water, near [start] in at most [steps] steps. */
    fun from(model: ResponseModel, start: DoubleArray, free: BooleanArray, steps: Int): BlindPoint {
        var best = at(model, start)
        var damping = 1e-3
        val indices = free.indices.filter { free[it] }
        repeat(steps) {
            // With H = L Lᵀ what is unlike the water of a and b is Wa·Wb − L⁻¹RᵀWa · L⁻¹RᵀWb.
            val white = indices.map { state.fit.whitened(derivative(model, best.point.numbers, it, best.shown)) }
            val halves = state.fit.imitated(white)
            val matrix = Array(white.size) { i ->
                DoubleArray(white.size) { j -> dot(white[i], white[j]) - dot(halves[i], halves[j]) }
            }
            // Where rows · ln left + ln det H is least.
            val share = best.left / (2 * state.fit.rows)
            val pull = DoubleArray(white.size) {
                dot(white[it], best.white) - dot(halves[it], best.taken) - share * binding(model, best, indices[it])
            }
            val system = SymmetricSystem(matrix, pull)
            val before = best.point.left
            var tries = 0
            while (tries++ < TRIES) {
                val next = at(model, moved(model, best.point.numbers, indices, system.solve(damping)))
                if (next.point.left < best.point.left) {
                    best = next
                    damping = maxOf(damping / 10, 1e-9)
                    break
                }
                damping = if (damping < 1e-3) 1e-2 else damping * 10
            }
            if (!(before - best.point.left > ENOUGH * before / n)) return best.point
        }
        return best.point
    }

    /** How fast water is bound more tightly as parameter [i] of [model] grows on the scale it is fitted on. */
    private fun binding(model: ResponseModel, from: Tried, i: Int): Double {
        val isShown = i == ResponseModel.TIME_CONSTANT ||
            model.terms.any { it.cause in BlindSearch.LINEAR && i - model.slot(it) in 0 until model.width(it) }
        if (!isShown) return 0.0
        val numbers = from.point.numbers
        val step = step(model, numbers, i)
        return (determinant.at(model, stepped(model, numbers, i, step)) - from.bound) / step
    }

    private fun moved(model: ResponseModel, at: DoubleArray, free: List<Int>, step: DoubleArray): DoubleArray {
        val numbers = at.copyOf()
        free.forEachIndexed { k, i ->
            val parameter = model.parameters[i]
            if (!step[k].isFinite()) return@forEachIndexed
            val next =
                if (parameter.logarithmic) numbers[i] * exp(step[k].coerceIn(-1.0, 1.0)) else numbers[i] + step[k]
            numbers[i] = next.coerceIn(parameter.lower, parameter.upper)
        }
        return numbers
    }

    companion object {
        private const val TRIES = 4
        private const val ENOUGH = 0.02
        private const val STEP = 1e-3

        /** Of the mean of two lags: how far from it either is at the least where derivatives are taken. */
        const val APART = 0.25

        /** How what [model] shows changes with parameter [i] on the scale it is fitted on, length n. */
        fun derivative(model: ResponseModel, numbers: DoubleArray, i: Int): DoubleArray {
            val before = DoubleArray(model.series.size)
            model.predict(numbers, before)
            return derivative(model, numbers, i, before)
        }

        /** The same where [model] is known to show [before] at [numbers]. */
        private fun derivative(model: ResponseModel, numbers: DoubleArray, i: Int, before: DoubleArray): DoubleArray {
            val step = step(model, numbers, i)
            val after = DoubleArray(model.series.size)
            model.predict(stepped(model, numbers, i, step), after)
            for (r in after.indices) after[r] = (after[r] - before[r]) / step
            return after
        }

        /**
         * [numbers] of [model] with two lags in a row that are nearly equal moved apart, their sum the same. Of equal
         * ones the readings change with either in the same way, and how far one is off the other not at all to first
         * order: derivatives there would say that neither shows, however much the two explain.
         */
        fun apart(model: ResponseModel, numbers: DoubleArray): DoubleArray {
            val term = model.terms.firstOrNull { it.cause == Cause.SECOND_ORDER_RESPONSE } ?: return numbers
            val slot = model.slotOrNull(term) ?: return numbers
            val first = numbers[ResponseModel.TIME_CONSTANT]
            val middle = (first + numbers[slot]) / 2
            if (abs(first - middle) >= APART * middle) return numbers
            val off = if (first < middle) -APART else APART
            return numbers.copyOf().also {
                it[ResponseModel.TIME_CONSTANT] = middle * (1 + off)
                it[slot] = middle * (1 - off)
            }
        }

        /** A small step of parameter [i] on the scale it is fitted on, within its range. */
        private fun step(model: ResponseModel, numbers: DoubleArray, i: Int): Double {
            val parameter = model.parameters[i]
            val size = if (parameter.logarithmic) STEP else STEP * maxOf(abs(numbers[i]), scale(model, parameter))
            val forward = if (parameter.logarithmic) numbers[i] * exp(size) else numbers[i] + size
            return if (forward > parameter.upper) -size else size
        }

        private fun stepped(model: ResponseModel, numbers: DoubleArray, i: Int, step: Double): DoubleArray {
            val isLogarithmic = model.parameters[i].logarithmic
            return numbers.copyOf().also { it[i] = if (isLogarithmic) it[i] * exp(step) else it[i] + step }
        }

        private fun scale(model: ResponseModel, parameter: Parameter): Double = when (parameter.unit) {
            "s", "m" -> model.series.period
            "sensor units" -> model.scales.range
            "sensor units/s" -> model.scales.range / maxOf(model.series.duration, 1.0)
            else -> 0.1
        }
    }
}
