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
 */
public class RevisitLearner private constructor(
    private val even: PhaseCorrection,
    private val thinning: Int,
    private var learnedScale: FieldScale? = null,
    private var amplitude: Double = 1.0,
    private var delay: Double = 0.0,
) : ResponseLearner {
    private val nodes = TrackNodes(even, thinning)
    private val extent = listOf(nodes.xs, nodes.ys).maxOf { at -> at.max() - at.min() }

    private val finder = RevisitBlocks(nodes, MOST_BLOCKS)

    // A boat at rest passes its own place all the time, and no pass goes another way.
    private val found = finder.find().takeIf { extent > 0 && it.size >= FEWEST_BLOCKS }.orEmpty()
    private val likelihood = RevisitLikelihood(nodes, found)
    private val corrected = DoubleArray(even.size)
    private val values = DoubleArray(nodes.size)
    private val grouping = RevisitGroups.of(nodes, found, finder.isRepeated)

    /** Longest time constant or dead time that is looked for, s: a quarter of the log's length. */
    public val longest: Double = (even.times.last() - even.times.first()) / LAGS_IN_A_LOG

    /**
     * Number of short runs of the track that other passes foretell; 0 where the log says nothing about the response.
     */
    public val blocks: Int get() = found.size

    /**
     * Number of runs beside them that say nothing, because the track goes round and round on one course: all passes go the same
     * way at the same speed there, and agree whatever the response. 0 where such runs are few.
     */
    public val alike: Int get() = if (finder.isRepeated) finder.alike else 0

    override val groups: Int get() = grouping.count

    init {
        val known = learnedScale
        if (known != null) {
            likelihood.assume(known)
        } else if (found.isNotEmpty()) {
            learnField()
        }
    }

    /**
     * First the delay with which the passes agree best under any of some guesses at the water, then the water's scales
     * at that delay: at no delay water would be found that changes from pass to pass.
     */
    private fun learnField() {
        val delays =
            listOf(0.0) + generateSequence(DELAY_FROM * even.step) { it * DELAY_FACTOR }.takeWhile { it < longest }
        var best = Double.NEGATIVE_INFINITY
        var bestScale: FieldScale? = null
        for (part in LENGTHS) {
            for (own in OWNS) {
                val guess = FieldScale(extent / part, own, nodes.step * RevisitBlocks.RUN, FIRST_NOISE)
                likelihood.assume(guess)
                for (candidate in delays) {
                    take(if (candidate > 0) ResponseKind.FIRST_ORDER.response(candidate) else Response())
                    val total = likelihood.total(likelihood.bestAmplitude())
                    if (total > best) {
                        best = total
                        bestScale = guess
                        delay = maxOf(candidate, delays[1])
                    }
                }
            }
        }
        take(ResponseKind.FIRST_ORDER.response(delay))
        settle(fitted(requireNotNull(bestScale), Smoothness.entries, EVALUATIONS))
    }

    /** The same learner for another thread. */
    public fun copy(): RevisitLearner = RevisitLearner(even.copy(), thinning, learnedScale, amplitude, delay)

    private fun settle(scale: FieldScale) {
        learnedScale = scale
        likelihood.assume(scale)
        likelihood.take(values)
        amplitude = likelihood.bestAmplitude()
    }

    private fun fitted(start: FieldScale, among: List<Smoothness>, evaluations: Int): FieldScale {
        fun at(logs: DoubleArray, smoothness: Smoothness) =
            FieldScale(exp(logs[0]), exp(logs[1]), exp(logs[2]), exp(logs[3]), smoothness)

        fun total(logs: DoubleArray, smoothness: Smoothness): Double {
            if (logs.any { abs(it) > MOST_LOG } || logs[3] < LEAST_NOISE) return Double.NEGATIVE_INFINITY
            likelihood.assume(at(logs, smoothness))
            likelihood.take(values)
            return likelihood.total(likelihood.bestAmplitude())
        }
        val logs = doubleArrayOf(ln(start.length), ln(start.own), ln(start.ownTime), ln(start.noise))
        return among.map { smoothness ->
            val best = Search.simplex(
                logs,
                DoubleArray(logs.size) {
                    1.0
                },
                evaluations,
                CLOSE,
            ) { total(it, smoothness) }
            at(best, smoothness) to total(best, smoothness)
        }.maxBy { it.second }.first
    }

    private fun take(response: Response) {
        even.correct(response, corrected)
        nodes.means(corrected, values)
        likelihood.take(values)
    }

    private fun total(kind: ResponseKind, logs: DoubleArray): Double {
        val parameters = DoubleArray(logs.size) { exp(logs[it]) }
        val times = shortest..longest
        val isPossible = kind.isOwn(parameters) &&
            parameters.indices.all { !kind.isTime(it) || kind.isSlow(it) || parameters[it] in times }
        if (!isPossible) return Double.NEGATIVE_INFINITY
        return scores(kind, logs).sum()
    }

    /**
     * One score a block, the mean over small shifts either way: which readings share a node is chance, and its effect
     * on the score would otherwise hide that of a dead time. As far back as ahead, because values that are taken later
     * at the same places look like a sensor that much quicker.
     */
    private fun scores(kind: ResponseKind, logs: DoubleArray): DoubleArray =
        scores(kind.response(*DoubleArray(logs.size) { exp(logs[it]) }))

    private fun scores(response: Response, earlier: Double = 0.0): DoubleArray {
        even.correct(response, corrected, earlier)
        val scores = DoubleArray(found.size)
        val farthest = thinning / 2
        for (shift in -farthest..farthest) {
            // Of an even number of readings the shift by half of them, either way, is the same nodes one further.
            val share = if (2 * abs(shift) == thinning) HALF else 1.0
            nodes.means(corrected, values, shift)
            likelihood.take(values)
            for (block in scores.indices) scores[block] += share * likelihood.score(block, amplitude) / thinning
        }
        for (block in scores.indices) scores[block] *= grouping.weights[block]
        return scores
    }

    /**
     * By how much the delay of single runs of the track scatters about that of [response], s, beyond what a boat's fixes
     * and its clock may be off, a step and [FIXES_OFF] at least: a lag that changes with the flow, the temperature or the slope of the
     * water does that, one that is always the same does not. 0 where nothing was learned.
     *
     * Each block's delay is normal about the response's, its deviation the likeliest one of some; see
     * core/docs/TrackCorrection.md, (7b).
     */
    public fun unevenness(response: Response): Double {
        if (found.isEmpty()) return 0.0
        val at = scores(response)
        val telling = awayFromGaps(response)
        fun total(deviation: Double): Double {
            val each = HERMITE.map { (place, weight) -> weight to scores(response, place * deviation) }
            return telling.sumOf { block ->
                val others = each.sumOf { (weight, moved) -> weight * exp(minOf(moved[block] - at[block], MOST_LOG)) }
                ln(HERMITE_MIDDLE + others)
            }
        }
        // How far off a fix is does not depend on how often the sensor is read.
        val allowed = maxOf(even.step, FIXES_OFF)
        val likeliest = List(DEVIATIONS) { allowed * Math.pow(DEVIATION_FACTOR, it.toDouble()) }.maxBy(::total)
        return sqrt(BOTH_MOVED * (likeliest * likeliest - allowed * allowed))
    }

    /**
     * Blocks of which no run is so near a gap that what [response] gives there is of readings that are missing; all where
     * too few are left.
     */
    private fun awayFromGaps(response: Response): List<Int> {
        val reach = GAP_REACH * response.meanDelay
        return found.indices.filter { index ->
            val block = found[index]
            block.firsts.indices.none { run ->
                nodes.isNearGap(block.firsts[run] until block.firsts[run] + block.lengths[run], reach)
            }
        }.takeIf { it.size >= FEWEST_BLOCKS } ?: found.indices.toList()
    }

    override fun candidate(kind: ResponseKind): CandidateResponse? {
        if (found.isEmpty() || kind in NOT_TOLD) return null
        if (kind == ResponseKind.FLOW && !even.hasSpeeds) return null
        // The delay is that of the likeliest single lag, in water that was guessed.
        return fit(kind).best(List(BEGINS) { delay * Math.pow(2.0, it - BEGINS + 2.0) })
    }

    override fun near(kind: ResponseKind, parameters: List<Double>): CandidateResponse =
        fit(kind).near(DoubleArray(parameters.size) { ln(parameters[it]) })

    override val shortest: Double get() = LEAST_STEPS * even.step

    private fun fit(kind: ResponseKind) =
        ResponseFit(
            kind,
            grouping.of,
            groups,
            { total(kind, it) },
            { scores(kind, it) },
            longest = longest,
            areFew = grouping.arePlaces,
        )

    public companion object {
        /** A learner for [series]; long ones are best cut to some ten thousand readings. */
        public fun of(series: TrackSeries): RevisitLearner {
            val even = PhaseCorrection(series.withFreshPositions())
            val thinning = maxOf(1, Math.round(even.size.toDouble() / TARGET_NODES).toInt())
            val learner = RevisitLearner(even, thinning)
            // Nodes longer than the delay hide what tells one response from another.
            val finer = (learner.delay / (NODES_A_DELAY * even.step)).toInt().coerceAtLeast(1)
            return if (learner.blocks > 0 && finer < thinning) RevisitLearner(even, finer) else learner
        }

        /** Gauss and Hermite's rule of five places for a normal distribution; the middle one's weight by itself. */
        private val HERMITE = listOf(
            -2.856970013872806 to 0.011257411327721,
            -1.355626179974266 to 0.222075922005613,
            1.355626179974266 to 0.222075922005613,
            2.856970013872806 to 0.011257411327721,
        )
        private const val HERMITE_MIDDLE = 0.533333333333333

        /** A metre of a boat at 1 m/s, s. */
        private const val FIXES_OFF = 1.0

        /** Delays of a response after which a twentieth of what it remembers is left, e⁻³. */
        private const val GAP_REACH = 3.0
        private const val DEVIATIONS = 14
        private const val DEVIATION_FACTOR = 1.25

        /** A block and two passes the other way, each late by itself, look as if all were late by √(3/8) of that. */
        private const val BOTH_MOVED = 8.0 / 3
        private const val NODES_A_DELAY = 2.0
        private const val HALF = 0.5

        /** Passes do not tell a rate from the water, nor two lags in a row from a dead time and a lag. */
        private val NOT_TOLD = setOf(ResponseKind.SLEW, ResponseKind.TWO_LAGS)

        /** Delays from which responses are searched: down to an eighth and up to twice the single lag's. */
        private const val BEGINS = 5
        private const val TARGET_NODES = 1500
        private const val MOST_BLOCKS = 150
        private const val FEWEST_BLOCKS = 8
        private val LENGTHS = listOf(2.0, 6.0, 18.0)
        private val OWNS = listOf(0.03, 0.3)
        private const val FIRST_NOISE = 1e-3
        private const val EVALUATIONS = 60
        private const val CLOSE = 0.05
        private const val MOST_LOG = 25.0
        private const val LEAST_NOISE = -16.0
        private const val DELAY_FROM = 0.25
        private const val DELAY_FACTOR = 1.6

        /** A lag is seen by where it sets in and by where it has died away: several times within the log. */
        private const val LAGS_IN_A_LOG = 4
        private const val LEAST_STEPS = 0.01
    }
}
