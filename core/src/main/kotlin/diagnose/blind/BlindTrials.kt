package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.algebra.SymmetricSystem
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.all
import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.evidence.StillReadings
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.RangeEnd
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Starts
import stillwater.diagnose.response.Term
import kotlin.math.abs
import kotlin.math.sqrt

/** Weighs causes and looks on top of [state]; the water takes whatever it can imitate. */
internal class BlindTrials(private val search: BlindSearch, private val state: BlindState) {
    private val series = state.model.series
    private val scales = search.scales
    private val n = series.size
    private val descent = BlindDescent(search, state)
    private val base = descent.from(state.model, state.numbers, search.free(state.model), BASE_STEPS)
    private val z = state.fit.residual(base.residuals)

    /** What the base's own numbers change, whitened and off the water. */
    private val ownColumns = search.free(state.model).indices.filter { search.free(state.model)[it] }
        .map { BlindDescent.derivative(state.model, base.numbers, it) }
    private val ownBasis = Evidence.orthonormal(ownColumns.map { state.fit.unlike(it) })
    private val waters = BlindWaters(search, state, DRAWS)
    private val places = BlindJumps(state, z)
    private val asFit = ModelFit(
        state.model,
        base.numbers,
        search.free(state.model),
        state.fit.design.noise.noise,
        base.residuals,
        z,
        state.fit.score(base.left),
    )

    /** [term] as it serves best. */
    fun attempt(term: Term): BlindTrial = if (term.cause == Cause.OFFSET_STEPS) jumps() else fitted(term, 0.0)

    private fun fitted(term: Term, searched: Double): BlindTrial {
        val kept = state.model.terms.filter { it.key != term.key }
        val model = ResponseModel(series, kept + term, search.steps, scales, state.model.behind)
        val free = search.free(model)
        val starts = Starts(asFit, model, term, small = true).all()
        val places = if (term.cause == Cause.SATURATION) RangeEnd.begun(model, term, starts[0]) else starts
        val looked = places.map { descent.from(model, it, free, LOOKS) }.minBy { it.left }
        // What gains next to nothing at the first steps is no cause, however well it is fitted.
        val isWorthIt = Evidence.ratio(base.left, looked.left, state.fit.rows) > LEAST_GAIN
        val best = if (isWorthIt) descent.from(model, looked.numbers, free, STEPS) else looked
        val slot = model.slot(term)
        val columns = (slot until slot + model.width(term)).map {
            state.fit.unlike(BlindDescent.derivative(model, best.numbers, it))
        }
        val change = DoubleArray(n) { base.residuals[it] - best.residuals[it] }
        return weighed(Weighed(term, term.key, model, best), columns, best.left, change, searched)
    }

    /** The likeliest of [trial] on top of [without] and of its other beginnings, far from what the wrong water makes of it. */
    fun begun(trial: BlindTrial, without: BlindState): BlindState {
        val term = checkNotNull(trial.term)
        val model = checkNotNull(trial.model)
        val others = Starts(asFit, model, term).far().map {
            search.settled(model.terms, it, without.fit.design.noise, without.variances, before = without)
        }
        return (others + search.with(without, trial)).maxBy { it.score }
    }

    /**
     * The likeliest of what begins on top of [without] from the ends of [trial] and from ends closer by some of the
     * noise: rows at an end say nothing of the water, which is to find its own way there.
     */
    fun ended(term: Term, trial: BlindTrial, without: BlindState): BlindState {
        val model = checkNotNull(trial.model)
        val numbers = checkNotNull(trial.point).numbers
        val spread = sqrt(without.variance)
        val at = model.slot(term)
        return CLOSER.map { by ->
            val closer = numbers.copyOf().also {
                it[at] += by * spread
                it[at + 1] -= by * spread
            }
            val noise = without.fit.design.noise
            val begun = search.settled(model.terms, closer, noise, without.variances, before = without)
            search.improved(search.improved(begun))
        }.maxBy { it.score }
    }

    /**
     * [trial] with water and noise of its own, as [found] has them: what a cause does would otherwise be taken for
     * noise that wanders. The base's twice log-likelihood is then [score].
     */
    fun settled(trial: BlindTrial, found: BlindState, score: Double, searched: Double): BlindTrial {
        val term = checkNotNull(trial.term)
        val slot = found.model.slot(term)
        val free = search.free(found.model).let { f -> f.indices.filter { f[it] } }
        val columns = free.associateWith { found.fit.unlike(found.derivative(it)) }
        val (own, others) = free.partition { it in slot until slot + found.model.width(term) }
        val basis = Evidence.orthonormal(others.map(columns::getValue))
        val extra = Evidence.orthonormal(own.map(columns::getValue), basis)
        val z = found.whitened
        val inflation = inflation(term, extra, z, found.score - score)
        val count = term.times.size
        val looked = if (count == 0) searched else maxOf(searched, BlindJumps(found, z).searched(count))
        val ratio = maxOf((found.score - score) / inflation - looked, 0.0)
        val change = added(term, found)
        val unlike = Evidence.without(found.fit.unlike(change), basis)
        val without = DoubleArray(n) { z[it] + unlike[it] }
        val agreed = pValue(term, ratio, trial.degrees, BlindEvidence.agreed(unlike, without), unlike, change)
        // Few stretches may be at an end of the range, but to the last digit.
        val isEnd = term.cause == Cause.SATURATION && ratio > 0
        val p = if (isEnd) minOf(agreed, StillReadings(found.asFit(search.free(found.model))).atEnd) else agreed
        val point = BlindPoint(found.numbers, found.residuals, found.left)
        val halves = contradiction(unlike, without, found.variance)
        val degrees = trial.degrees
        val leftOut = if (p < Jackknife.SURE && term.cause !in LOCAL) {
            byStretches(degrees, found.sure(term) { Jackknife.t(found.fit, z, change, others.map(found::derivative)) })
        } else {
            0.0
        }
        val settled =
            BlindTrial(term, trial.name, found.model, point, change, ratio, inflation, degrees, p, found, ratio, halves)
                .leftOut(leftOut)
        val isNone = (term.cause == Cause.SATURATION && goOn(found)) ||
            (BlindTerms.isLittle(term, found) && ratio < BEYOND_FIXES)
        // What a second number is says nothing where the one that makes an effect of it may be nothing: a share's time.
        val makers = own.filter { found.model.parameters[it].neutral.isFinite() }.ifEmpty { own }
        val isReal =
            !isNone && (term.cause == Cause.SATURATION || makers.any { isShown(found, columns, it, inflation) })
        return if (isReal) settled else settled.atMost(0.0)
    }

    /**
     * Whether the log bounds number [i] of [found], away from where it does nothing: what is likelier with a number
     * that may as well be nothing, or anything, is no cause that could be named. [columns] are what is unlike water of
     * each number that is fitted.
     */
    private fun isShown(found: BlindState, columns: Map<Int, DoubleArray>, i: Int, inflation: Double): Boolean {
        val parameter = found.model.parameters[i]
        val system = SymmetricSystem.of(columns.values.toTypedArray(), found.whitened)
        val variance = system.inverseDiagonal(columns.keys.indexOf(i)) * found.variance * inflation
        val reach = BlindErrors.REACH * BlindErrors.WIDER * sqrt(maxOf(variance, 0.0))
        if (parameter.logarithmic) return reach < MOST_REACH
        return !parameter.neutral.isFinite() || abs(found.numbers[i] - parameter.neutral) > reach
    }

    /** Whether readings go on beyond the ends of the range that [found] has, more than noise takes them. */
    private fun goOn(found: BlindState): Boolean {
        val term = found.model.terms.first { it.cause == Cause.SATURATION }
        val slot = found.model.slot(term)
        val lower = found.numbers[slot]
        val upper = found.numbers[slot + 1]
        val far = BEYOND_NOISE * sqrt(found.variance) + scales.resolution
        val beyond = series.values.indices.count {
            search.used[it] && (series.values[it] < lower - far || series.values[it] > upper + far)
        }
        return beyond > maxOf(FEW_BEYOND, FEW_SHARE * n)
    }

    /**
     * By how many standard errors the halves of the log differ about the size of the change [unlike] in [z]. What
     * correlation inflates is told by what either half leaves with its own size: the other's would count as
     * correlation.
     */
    private fun contradiction(unlike: DoubleArray, z: DoubleArray, variance: Double): Double {
        val scores = DoubleArray(2)
        val weights = DoubleArray(2)
        for (i in 0 until n) {
            val half = if (2 * i < n) 0 else 1
            scores[half] += unlike[i] * z[i]
            weights[half] += unlike[i] * unlike[i]
        }
        val sizes = DoubleArray(2) { scores[it] / maxOf(weights[it], TINY) }
        val rest = DoubleArray(n) { i -> z[i] - sizes[if (2 * i < n) 0 else 1] * unlike[i] }
        val inflated = variance * BlindEvidence.inflation(listOf(unlike), rest)
        val error = sqrt(inflated * (1 / maxOf(weights[0], TINY) + 1 / maxOf(weights[1], TINY)))
        return (sizes[0] - sizes[1]) / error
    }

    /** What [term] adds to what [found] shows, all else the same. */
    private fun added(term: Term, found: BlindState): DoubleArray {
        val kept = found.model.terms.filter { it.key != term.key }
        val model = ResponseModel(found.model.series, kept, search.steps, scales, found.model.behind)
        val out = DoubleArray(n)
        model.predict(model.carried(found.model, found.numbers), out)
        // What the model with it shows = reading − residual.
        for (i in 0 until n) out[i] = series.values[i] - found.residuals[i] - out[i]
        return out
    }

    /** What the [gain] of [term] with the columns [extra] is divided by, where [z] is left with it. */
    private fun inflation(term: Term?, extra: List<DoubleArray>, z: DoubleArray, gain: Double): Double {
        val correlated = BlindEvidence.inflation(extra, z)
        return if (term?.cause == Cause.OFFSET_STEPS) maxOf(correlated, BlindJumps.tails(z, gain)) else correlated
    }

    private class Weighed(val term: Term?, val name: String, val model: ResponseModel?, val point: BlindPoint?)

    private fun weighed(
        what: Weighed,
        columns: List<DoubleArray>,
        left: Double,
        change: DoubleArray,
        searched: Double,
        floor: Double = 1.0,
        rest: DoubleArray? = null,
    ): BlindTrial {
        val extra = Evidence.orthonormal(columns, ownBasis)
        val gain = Evidence.ratio(base.left, left, state.fit.rows)
        val after = rest ?: what.point?.let { state.fit.residual(it.residuals) } ?: z
        val inflation = maxOf(inflation(what.term, extra, after, gain), floor)
        val ratio = maxOf(gain / inflation - searched, 0.0)
        val degrees = maxOf(columns.size, 1)
        val unlike = Evidence.without(state.fit.unlike(change), ownBasis)
        val p = pValue(what.term, ratio, degrees, BlindEvidence.agreed(unlike, z), unlike, change)
        return BlindTrial(what.term, what.name, what.model, what.point, change, ratio, inflation, degrees, p)
    }

    /** The jumps that serve best, one after the other while each is worth it; or two at once, where these do better. */
    private fun jumps(): BlindTrial {
        val first = places.best(z, emptyList()) ?: return fitted(jumps(listOf(series.duration / 2)), 0.0)
        val one = grown(fitted(jumps(listOf(first)), searched(1)))
        val two = places.pair(z)?.let { fitted(jumps(it), searched(2)) } ?: return one
        // One after the other the first may be where none is, and stay.
        val count = checkNotNull(one.term).times.size
        val least = if (count == 1) TWO_WORTH else (2 - count) * JUMP_WORTH
        return if (two.ratio > one.ratio + least) grown(two) else one
    }

    private fun jumps(times: List<Double>) = Term(Cause.OFFSET_STEPS, times = times.sorted())

    /** [trial], of jumps, with one more, and so on, while each is worth it. */
    private fun grown(trial: BlindTrial): BlindTrial {
        val times = checkNotNull(trial.term).times
        if (times.size >= MOST_JUMPS) return trial
        val time = places.best(z, times) ?: return trial
        val next = fitted(jumps(places.moved(z, times + time)), searched(times.size + 1))
        return if (next.ratio - trial.ratio < JUMP_WORTH) trial else grown(next)
    }

    /** The jumps of [term], which this model has, and the one that serves best beside them; null where none is worth it. */
    fun oneMoreJump(term: Term): BlindTrial? {
        if (term.times.size >= MOST_JUMPS) return null
        val time = places.best(z, term.times) ?: return null
        val more = fitted(jumps(term.times + time), 0.0)
        return more.takeIf { it.ratio * it.inflation > JUMP_WORTH }
    }

    /** What the best of many places gains by chance, for [count] jumps. */
    fun searched(count: Int): Double = places.searched(count)

    /** What [look] gains, all else as it is. */
    fun looked(look: BlindLook): BlindTrial {
        val found = LookedAt(look, state, ownColumns, waters)
        if (found.directions.isEmpty()) return BlindTrial(null, look.name, null, null, DoubleArray(n), 0.0, 1.0, 1, 1.0)
        val heights = found.heights(z)
        val columns = found.columns
        val after = DoubleArray(n) { i -> z[i] - columns.indices.sumOf { heights[it] * columns[it][i] } }
        val left = base.left - heights.sumOf { it * it }
        val what = Weighed(null, look.name, null, null)
        return weighed(
            what,
            columns,
            left,
            found.sum(heights),
            look.searched,
            look.floor(state, after),
            after,
        ).lessSure(look.doubt)
    }

    /** [look] with the water, the noise and the numbers that suit it, begun from what it gains by [trial]. */
    fun refitted(look: BlindLook, trial: BlindTrial): RefittedLook {
        var found = RefittedLook(state, trial.change, 0.0, emptyList(), emptyList())
        repeat(REFITS) {
            val less = search.less(found.change)
            val was = found.state
            val begun = less.settled(was.model.terms, was.numbers, was.fit.design.noise, was.variances, before = was)
            val next = less.fullySuited(begun)
            val own = less.free(next.model).let { free -> free.indices.filter { free[it] } }.map(next::derivative)
            val at = LookedAt(look, next, own, BlindWaters(search, next, DRAWS))
            val whole = DoubleArray(n) { next.residuals[it] + found.change[it] }
            val z = next.fit.residual(whole)
            val heights = at.heights(z)
            found = RefittedLook(next, at.sum(heights), at.gained(heights), at.columns, own)
        }
        return found
    }

    /** [found], of [look], where the base's twice log-likelihood is [score]. */
    fun settled(look: BlindLook, found: RefittedLook, score: Double): BlindTrial {
        val z = found.state.whitened
        val extra = Evidence.orthonormal(found.columns, found.basis)
        val inflation = maxOf(BlindEvidence.inflation(extra, z), look.floor(found.state, z))
        val ratio = maxOf((found.state.score - found.chance - score) / inflation - look.searched, 0.0)
        val unlike = Evidence.without(found.state.fit.unlike(found.change), found.basis)
        val without = DoubleArray(n) { z[it] + unlike[it] }
        val degrees = maxOf(found.columns.size, 1)
        val p = pValue(null, ratio, degrees, BlindEvidence.agreed(unlike, without), unlike, found.change)
        val leftOut = if (p < Jackknife.SURE) byStretches(degrees, found.sure) else 0.0
        val settled = BlindTrial(null, look.name, null, null, found.change, ratio, inflation, degrees, p)
        return settled.lessSure(look.doubt).leftOut(leftOut)
    }

    /** By chance, of the [ratio] and of how stretches of the log agree about the change [unlike], by [t], the larger. */
    private fun pValue(
        term: Term?,
        ratio: Double,
        degrees: Int,
        t: Double,
        unlike: DoubleArray,
        change: DoubleArray,
    ): Double {
        // A jump shows at its own rows alone.
        if (term?.cause == Cause.OFFSET_STEPS) return Evidence.pValue(ratio, degrees)
        // An end of the range may be reached a few times in a log; one wrong reading or two are none. These may be
        // anywhere, and are at one of the two ends by as much of a chance as it has of the rows.
        if (term?.cause == Cause.SATURATION) {
            val wrong = search.used.count { !it }
            val there = minOf(2.0 * change.count { it != 0.0 } * (1 + wrong) / n, 1.0)
            val few = there * Evidence.pValue(ratio * (1 - strongest(unlike)), degrees)
            return maxOf(Evidence.pValue(ratio, degrees), few)
        }
        // What was searched is in the ratio; stretches tell whether all of it is in a few.
        return maxOf(Evidence.pValue(ratio, degrees), if (t > 0) byStretches(degrees, t) else 1.0)
    }

    /** By chance, of [t] of stretches; several numbers give the sum of what they change a good look of chance. */
    private fun byStretches(degrees: Int, t: Double): Double =
        Evidence.student(sqrt(maxOf(t * t - 2 * (degrees - 1), 0.0)), BlindEvidence.STRETCHES - 1)

    /** The share of the squares of [unlike] that the [SINGLE] strongest readings have: whitened, each is in the row behind, too. */
    private fun strongest(unlike: DoubleArray): Double {
        val shares = squares(unlike).let { all -> DoubleArray(n) { unlike[it] * unlike[it] / maxOf(all, TINY) } }
        var taken = 0.0
        repeat(SINGLE) {
            val first = (0 until n).maxBy { shares[it] }
            for (row in first..minOf(first + 1, n - 1)) {
                taken += shares[row]
                shares[row] = 0.0
            }
        }
        return taken
    }

    /** The whitened residuals of the base. */
    val residual: DoubleArray get() = z

    private companion object {
        /** Logarithm of how far the ends of an interval may be from the number: a factor of ten. */
        const val MOST_REACH = 2.3

        /** Twice a gain in log-likelihood over inflation that errors of the smoothed way do not give. */
        const val BEYOND_FIXES = 30.0

        /** Causes that may show in a few stretches of a log alone: where the water reaches a threshold, or at single rows. */
        val LOCAL =
            setOf(Cause.SLEW_LIMIT, Cause.SATURATION, Cause.OFFSET_STEPS, Cause.QUANTISATION, Cause.OUTLIERS)

        /** Deviations of the noise that no reading at an end of the range is beyond it; and so many rows are none. */
        const val BEYOND_NOISE = 4.0
        const val FEW_BEYOND = 2.0
        const val FEW_SHARE = 0.001
        const val TINY = 1e-290
        const val BASE_STEPS = 4
        const val LOOKS = 2

        /** Waters drawn that tell what a look gains by chance. */
        const val DRAWS = 24
        const val REFITS = 2
        const val STEPS = 6

        /** Readings that may be wrong. */
        const val SINGLE = 2

        /** Twice the gain in log-likelihood below which a cause is not fitted to the end: far below any level. */
        const val LEAST_GAIN = 2.0

        /** Standard deviations of the noise. */
        val CLOSER = doubleArrayOf(0.0, 2.0).toList()
        const val MOST_JUMPS = 3
        const val JUMP_WORTH = 20.0

        /** The same, less what is searched, that two jumps must gain more than one: a second gains so much by chance. */
        const val TWO_WORTH = 10.0
    }
}
