package stillwater.diagnose

import kotlin.math.sqrt

/** How far the numbers of a model of a log without a reference may be off. */
internal object BlindErrors {
    /** Standard errors of the numbers of [state] on their fitted scales, as correlation inflates them; 0 of those fixed. */
    fun of(search: BlindSearch, state: BlindState): DoubleArray =
        of(search, state.fit, state.model, state.numbers, state.whitened)

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
