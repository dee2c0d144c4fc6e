package stillwater.diagnose.blind

import stillwater.diagnose.algebra.SymmetricSystem
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.response.ResponseModel
import kotlin.math.sqrt

/** How far the numbers of a model of a log without a reference may be off. */
internal object BlindErrors {
    /**
     * By how much errors of the curvature are made larger: rings and lengths of the waves, noise and their spread are
     * chosen by the same readings and then taken for known. Set on 28 simulated surveys; docs/diagnosis.md.
     */
    const val WIDER = 1.515

    /** Errors to either end of an interval of 95 %: Student's t of stretches, with 23 degrees of freedom. */
    const val REACH = 2.07

    /** Standard errors of the numbers of [state] on their fitted scales, as correlation inflates them; 0 of those fixed. */
    fun of(search: BlindSearch, state: BlindState): DoubleArray =
        of(search, state.fit, state.model, state.numbers, state.whitened)

    /**
     * How far the numbers of [state] may be off, in the same way and with the [stretches] of its fit: the larger of
     * [WIDER] such errors and of those by [Jackknife], which know nothing of the noise; 0 of those fixed.
     */
    fun of(search: BlindSearch, state: BlindState, stretches: Stretches): DoubleArray {
        val errors = of(search, state)
        val free = search.free(state.model).let { f -> f.indices.filter { f[it] } }
        val left = Jackknife.of(state.fit, state.whitened, free.map(state::derivative), stretches)
        for (i in errors.indices) errors[i] *= WIDER
        free.forEachIndexed { k, i -> errors[i] = maxOf(errors[i], left.error(k)) }
        return errors
    }

    /** The same of [model] with [numbers] on the water of [fit], where [z] is left, whitened. */
    fun of(
        search: BlindSearch,
        fit: BlindFit,
        model: ResponseModel,
        numbers: DoubleArray,
        z: DoubleArray,
    ): DoubleArray {
        val free = search.free(model).let { f -> f.indices.filter { f[it] } }
        val apart = BlindDescent.apart(model, numbers)
        val columns = free.map { fit.unlike(BlindDescent.derivative(model, apart, it)) }.toTypedArray()
        val system = SymmetricSystem.of(columns, z)
        val variance = squares(z) / fit.rows
        val errors = DoubleArray(numbers.size)
        free.forEachIndexed { k, i ->
            val inflation = BlindEvidence.inflation(listOf(columns[k]), z)
            val error = sqrt(maxOf(system.inverseDiagonal(k), 0.0) * variance * inflation)
            // Lags that had to be moved apart are not known to be equal.
            errors[i] = if (apart[i] == numbers[i]) error else maxOf(error, BlindDescent.APART)
        }
        return errors
    }
}
