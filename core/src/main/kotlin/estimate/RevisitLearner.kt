package stillwater.estimate

import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Learns a sensor's response from where its track comes back to the same water: a slow sensor drags old water along, so
 * that passes in different directions disagree unless the response is undone.
 *
 * Only the phase of the response is used, because its amplitude cannot be told from how smooth the water is. Model and
 * derivation: core/docs/TrackCorrection.md. Confined to one thread.
 *
 * @param series the readings; long ones are best cut to some ten thousand. Retained.
 */
public class RevisitLearner(series: TrackSeries) : ResponseLearner {
    private val even = PhaseCorrection(series)
    private val thinning = maxOf(1, Math.round(even.size.toDouble() / TARGET_NODES).toInt())
    private val nodes = TrackNodes(even, thinning)
    private val found = RevisitBlocks(nodes, MOST_BLOCKS).find().let { if (it.size < FEWEST_BLOCKS) emptyList() else it }
    private val likelihood = RevisitLikelihood(nodes, found)
    private val corrected = DoubleArray(even.size)
    private val values = DoubleArray(nodes.size)
    private val groupOf = (found.size / GROUP).coerceIn(2, MOST_GROUPS).let { count ->
        IntArray(found.size) { (it.toLong() * count / found.size).toInt() }
    }
    private var amplitude = 1.0
    private var delay = DELAY_FROM * even.step

    /** Number of short runs of the track that other passes foretell; 0 where the log says nothing about the response. */
    public val blocks: Int get() = found.size

    /** Usual distance from a block to the nearest other pass, m; NaN without any. */
    public val passDistance: Double
        get() = if (found.isEmpty()) Double.NaN else found.map { it.nearest }.sorted()[found.size / 2]

    override val groups: Int get() = (groupOf.lastOrNull() ?: -1) + 1

    init {
        if (found.isNotEmpty()) learnField()
    }

    /** The water's scales at no delay, the best delay, and the scales again at that. */
    private fun learnField() {
        val extent = listOf(nodes.xs, nodes.ys).maxOf { at -> at.max() - at.min() }
        val spans = found.map { abs(nodes.times[it.start] - nodes.times[it.firsts[0]]) }.sorted()
        var scale = FieldScale(extent / LENGTHS, spans[spans.size / 2] * DURATIONS, FIRST_NOISE)
        take(Response())
        scale = fitted(scale, listOf(Smoothness.USUAL), EVALUATIONS)
        settle(scale)
        val delays = (0 until DELAYS).map { even.step * DELAY_FROM * Math.pow(DELAY_FACTOR, it.toDouble()) }
        delay = delays.maxBy { total(ResponseKind.FIRST_ORDER, doubleArrayOf(ln(it))) }
        take(ResponseKind.FIRST_ORDER.response(delay))
        settle(fitted(scale, Smoothness.entries, EVALUATIONS))
    }

    private fun settle(scale: FieldScale) {
        likelihood.assume(scale)
        likelihood.take(values)
        amplitude = likelihood.bestAmplitude()
    }

    private fun fitted(start: FieldScale, among: List<Smoothness>, evaluations: Int): FieldScale {
        fun at(logs: DoubleArray, smoothness: Smoothness) =
            FieldScale(exp(logs[0]), exp(logs[1]), exp(logs[2]), smoothness)

        fun total(logs: DoubleArray, smoothness: Smoothness): Double {
            if (logs.any { abs(it) > MOST_LOG } || logs[2] < LEAST_NOISE) return Double.NEGATIVE_INFINITY
            likelihood.assume(at(logs, smoothness))
            likelihood.take(values)
            return likelihood.total(likelihood.bestAmplitude())
        }
        val logs = doubleArrayOf(ln(start.length), ln(start.duration), ln(start.noise))
        return among.map { smoothness ->
            val best = Search.simplex(logs, DoubleArray(logs.size) { 1.0 }, evaluations, CLOSE) { total(it, smoothness) }
            at(best, smoothness) to total(best, smoothness)
        }.maxBy { it.second }.first
    }

    private fun take(response: Response) {
        even.correct(response, corrected)
        nodes.means(corrected, values)
        likelihood.take(values)
    }

    private fun total(kind: ResponseKind, logs: DoubleArray): Double {
        if (logs.any { it > ln(MOST_STEPS * even.step * thinning) || it < ln(LEAST_STEPS * even.step) }) {
            return Double.NEGATIVE_INFINITY
        }
        take(kind.response(*DoubleArray(logs.size) { exp(logs[it]) }))
        return likelihood.total(amplitude)
    }

    private fun scores(kind: ResponseKind, logs: DoubleArray): DoubleArray {
        take(kind.response(*DoubleArray(logs.size) { exp(logs[it]) }))
        return DoubleArray(found.size) { likelihood.score(it, amplitude) }
    }

    override fun candidate(kind: ResponseKind): CandidateResponse? {
        if (found.isEmpty() || kind == ResponseKind.SLEW) return null
        val fit = ResponseFit(kind, groupOf, groups, { total(kind, it) }, { scores(kind, it) })
        return fit.best(delay)
    }

    private companion object {
        const val TARGET_NODES = 1500
        const val MOST_BLOCKS = 150
        const val FEWEST_BLOCKS = 8
        const val GROUP = 6
        const val MOST_GROUPS = 20
        const val LENGTHS = 4.0
        const val DURATIONS = 5.0
        const val FIRST_NOISE = 1e-3
        const val EVALUATIONS = 40
        const val CLOSE = 0.05
        const val MOST_LOG = 25.0
        const val LEAST_NOISE = -16.0
        const val DELAY_FROM = 0.25
        const val DELAY_FACTOR = 1.6
        const val DELAYS = 16
        const val MOST_STEPS = 40.0
        const val LEAST_STEPS = 0.01
    }
}
