package stillwater.diagnose.blind

import stillwater.diagnose.algebra.dot
import stillwater.diagnose.response.LinearResponse
import stillwater.diagnose.response.ResponseModel
import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.random.Random

/**
 * Waters that the readings allow around the likeliest one of [state]: [draws] of them drawn from the posterior, less its
 * mean. With a hundred waves that the log binds, sums over eight of them are off by some 5 %.
 */
internal class BlindWaters(private val search: BlindSearch, private val state: BlindState, private val draws: Int) {
    private val times = state.model.series.times
    private val heights: Array<DoubleArray> by lazy {
        val random = Random(SEED)
        Array(draws) {
            state.fit.drawn(DoubleArray(state.fit.design.size) { if (random.nextBoolean()) 1.0 else -1.0 })
        }
    }
    private val waters: Array<DoubleArray> by lazy { search.along(state.modes, heights) }
    private val bends = LinearResponse.Bends(draws)

    /** What the sensor of [state] shows of each, whitened, over the noise's spread. */
    val shown: Array<DoubleArray> by lazy { state.fit.design.times(heights) }

    /** What the sensor with [numbers] of [model] shows of each, sensor units over the noise's spread; new. */
    fun seen(model: ResponseModel, numbers: DoubleArray): Array<DoubleArray> {
        val seen = search.seen(model.terms, numbers, waters, state.modes.behind, bends)
        val timeConstant = numbers[ResponseModel.TIME_CONSTANT]
        // What was before the log, the same of all waters but for its height.
        val fading = DoubleArray(times.size) { exp(-(times[it] - times[0]) / timeConstant) }
        for (k in seen.indices) {
            val before = heights[k].last()
            val column = seen[k]
            for (i in column.indices) column[i] += before * fading[i]
        }
        return seen
    }

    /** What the sensor of [state] shows of each, sensor units. */
    private val own: List<DoubleArray> by lazy {
        val spread = sqrt(state.variance)
        seen(state.model, state.numbers).onEach { for (i in it.indices) it[i] *= spread }.asList()
    }

    /**
     * What whitened residuals are on average with each of columns that what the model shows makes, of which nothing is
     * due to them: columns of the likeliest water go with its errors. [of] is how they change, each of length n, where
     * what the model shows does by so much.
     *
     * With z the whitened residuals and c(V) a column of what is shown, V, the score of its height in the likelihood of
     * the readings is the mean of Wc(V + v) · (z − Wv) over what the waters drawn show, v: Wc · z less the mean of
     * Wc′v · Wv.
     */
    fun chance(of: (DoubleArray) -> List<DoubleArray>): List<Double> {
        val changes = own.map(of)
        val spread = sqrt(state.variance)
        return changes[0].indices.map { j ->
            changes.indices.sumOf { k -> dot(state.fit.whitened(changes[k][j]), shown[k]) } * spread / draws
        }
    }

    private companion object {
        const val SEED = 20261122
    }
}
