package stillwater.diagnose.blind

import stillwater.diagnose.algebra.dot
import stillwater.diagnose.response.ResponseModel

/**
 * By how much more the log would tell of the water of [state] if the sensor showed it otherwise: ln det of the
 * posterior's precision H less that of [state].
 *
 * The likelihood of a model is less by it, because water that is bound more tightly has less room to suit the readings. A
 * fit that only lets the water take what it can knows nothing of it: of waves that noise hides a shorter lag shows more,
 * so that smaller ones do, and it would be taken for the likelier one.
 *
 * With R what the sensor shows of the waves, whitened, it is 2 tr H⁻¹Rᵀ(R(θ) − R) to first order in R. Of waters x drawn
 * from the posterior that is the mean of 2 Rx · (R(θ)x − Rx).
 *
 * Source: Hutchinson 1989, A stochastic estimator of the trace of the influence matrix for Laplacian smoothing splines,
 * doi:10.1080/03610918908812806.
 */
internal class BlindDeterminant(search: BlindSearch, private val state: BlindState) {
    private val own = linear(state.model, state.numbers)
    private val waters = BlindWaters(search, state, DRAWS)

    /** Wᵀ Rx of each, so that no R(θ)x need be whitened. */
    private val turned = waters.shown.map(state.fit.design.noise::turned)
    private val squares = product(state.model, state.numbers)

    /** For [model] with [numbers]. */
    fun at(model: ResponseModel, numbers: DoubleArray): Double =
        if (linear(model, numbers) == own) 0.0 else 2 * (product(model, numbers) - squares) / DRAWS

    private fun product(model: ResponseModel, numbers: DoubleArray): Double {
        val seen = waters.seen(model, numbers)
        return seen.indices.sumOf { dot(turned[it], seen[it]) }
    }

    /** What [numbers] of [model] tell what the sensor shows of a wave. */
    private fun linear(model: ResponseModel, numbers: DoubleArray): Map<String, List<Double>> =
        model.terms.filter { it.cause in BlindSearch.LINEAR }.associate { term ->
            val slot = model.slot(term)
            term.key to List(model.width(term)) { numbers[slot + it] }
        } + ("" to listOf(numbers[ResponseModel.TIME_CONSTANT]))

    private companion object {
        const val DRAWS = 8
    }
}
