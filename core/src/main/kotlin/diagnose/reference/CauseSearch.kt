package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.evidence.AnyResponse
import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.evidence.HeldOut
import stillwater.diagnose.evidence.HeldOutScore
import stillwater.diagnose.evidence.JumpPlaces
import stillwater.diagnose.evidence.JumpScan
import stillwater.diagnose.evidence.LagPair
import stillwater.diagnose.evidence.LocalSpread
import stillwater.diagnose.evidence.SmallShifts
import stillwater.diagnose.evidence.Trial
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.RangeEnd
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Starts
import stillwater.diagnose.response.Term
import stillwater.diagnose.response.baseNumbers
import stillwater.diagnose.response.conditionalNumber
import stillwater.diagnose.response.isTiming
import kotlin.math.ln
import kotlin.math.sqrt

/** Tries causes one by one on top of a fitted model, adds the best, and drops what then is no longer needed. */
internal class CauseSearch(
    private val series: MeasuredSeries,
    private val scales: Scales,
    private val used: BooleanArray,
    private val settings: DiagnosisSettings,
) {
    /** Longest correlation time that counts as noise, s: slower wandering is structure. */
    val longest: Double = longest(series, settings)

    /** The numbers that [term] sets free in [fit]'s place beyond those of [before]. */
    private fun freed(model: ResponseModel, before: ModelFit, term: Term): BooleanArray {
        val free = BooleanArray(model.parameters.size)
        for (i in 0 until ResponseModel.BASE) free[i] = before.free[i]
        for (old in before.model.terms) {
            val from = before.model.slotOrNull(old) ?: continue
            val to = model.slotOrNull(old) ?: continue
            for (k in 0 until minOf(model.width(old), before.model.width(old))) free[to + k] = before.free[from + k]
        }
        for (i in term.cause.baseNumbers) free[i] = i != ResponseModel.GAIN || !ConstantTruth.isOf(series)
        if (before.model.slotOrNull(term) == null) term.cause.conditionalNumber?.let { free[it] = true }
        model.slotOrNull(term)?.let { at -> for (k in 0 until model.width(term)) free[at + k] = true }
        return free
    }

    /**
     * [base] with [term] on top, fitted; where it is likely, four fits more say what it foretells, and more where it
     * acts now and then only. [root] is the model without any term.
     */
    fun attempt(base: ModelFit, baseHeldOut: HeldOutScore, term: Term, root: ModelFit): Trial {
        val best = if (term.cause == Cause.OFFSET_STEPS) jumps(base) else extended(base, term)
        val free = best.free.count { it } - base.free.count { it }
        val degrees =
            maxOf(free + best.model.terms.sumOf { it.times.size } - base.model.terms.sumOf { it.times.size }, 1)
        val inflation = inflation(base, best)
        val places = jumpsBeyond(base, best)
        // The best of so many places gains twice the logarithm of their number by chance.
        val searched = if (places > 0) places * 2 * ln((series.size / 10).coerceIn(1, PLACES).toDouble()) else 0.0
        val gain = best.score - base.score
        val corrected = minOf(gain, evenly(base, best)) / inflation
        val ratio = maxOf(corrected - searched, 0.0)
        // Causes are held against each other by what they gain itself: how far each one's scores seem to be correlated
        // differs by chance.
        val cost = searched + 2 * degrees
        val isNone = GainSign(base).isTurned(best) || (term.cause == Cause.SATURATION && RangeEnd.isNone(best, used)) ||
            (term.cause == Cause.QUANTISATION && scales.resolution < sqrt(best.variance))
        val own = if (places > 0) jumpsPValue(base, best, corrected) else Evidence.pValue(ratio, degrees)
        // Where a log has no place for a jump nothing is added.
        val added = if (best === base) term else best.model.terms.last()
        val ofItself = maxOf(ownPValue(base, best, term), AnyResponse(base).pValue(best, added, degrees))
        val p = if (isNone) 1.0 else maxOf(own, ofItself)
        val worthHolding = p < settings.heldOutBelow
        val heldOut = if (worthHolding) HeldOut.score(best, used) else baseHeldOut
        var gained = heldOut.logLikelihood - baseHeldOut.logLikelihood
        if (worthHolding && gained <= 0 && best.model.terms.any(::actsNowAndThen)) {
            gained = HeldOut.gainWhereTheyAct(best, base, root, used)
        }
        val isWorse = heldOut.rmse > WORSE * baseHeldOut.rmse
        val worth = if (isWorse) Double.NEGATIVE_INFINITY else gain - cost
        return Trial(added, best, ratio, inflation, degrees, cost, worth, p, heldOut, gained > 0 && !isWorse)
    }

    /** Whether [term] shows only where the water comes to it, which may be once in a log. */
    private fun actsNowAndThen(term: Term) = term.cause in ACT_NOW_AND_THEN ||
        (term.cause.isTiming && scales.unknown?.isSharp == true)

    /**
     * Of what [term] itself adds where it leaves a given number open besides; 0 where it does not. A wrong number alone
     * would make any such cause look likely.
     */
    private fun ownPValue(base: ModelFit, best: ModelFit, term: Term): Double {
        val open = term.cause.conditionalNumber?.takeIf { best.free[it] && !base.free[it] } ?: return 0.0
        val free = base.free.copyOf().also { it[open] = true }
        val without = Fitting.fit(base.model, base.numbers, free, used, longest, guess = base.noise)
            .withOwnFade(used, longest)
        return Evidence.pValue((best.score - without.score) / inflation(without, best), 1)
    }

    private fun extended(base: ModelFit, term: Term): ModelFit {
        val best = forms(base, term).map { fitted(base, it) }.maxBy { it.score }
        val begun = best.model.terms.last().begun()
        return if (begun.hasOwnStart && best.score > base.score + OWN_START) begun(base, best, begun) else best
    }

    /** [fit] with its last term as [term], which has a first state of its own, where that is for certain likelier. */
    private fun begun(base: ModelFit, fit: ModelFit, term: Term): ModelFit {
        val model = ResponseModel(series, fit.model.terms.dropLast(1) + term, fit.model.steps, fit.model.scales)
        val free = freed(model, base, term)
        val start = model.carried(fit.model, fit.numbers)
        val found = likeliest(model, listOf(start), free, noises(fit), fit)
        return if (found.score > fit.score + OWN_START && !isOffset(found, term)) found else fit
    }

    /** Whether of [term] in [fit] the first state alone is for certain: an offset that settles is no slow path. */
    private fun isOffset(fit: ModelFit, term: Term): Boolean {
        if (term.cause != Cause.TWO_PATH_RESPONSE) return false
        val share = fit.model.slot(term) + 1
        val numbers = fit.numbers.copyOf().also { it[share] = 0.0 }
        val free = fit.free.copyOf().also { it[share] = false }
        val without = Fitting.fit(fit.model, numbers, free, used, longest, guess = fit.noise)
        return fit.score < without.score + OWN_START
    }

    /** The forms that [term] may have beside what [base] has: the likeliest is taken. */
    private fun forms(base: ModelFit, term: Term): List<Term> = when {
        // What is noise, or rounding, of the other quantity's own the sensor does not show.
        term.cause == Cause.CROSS_SENSITIVITY -> listOf(term.copy(isQuiet = false), term.quiet())
        // A lag of which one of two parts is limited, or that follows another one, is not told from one with a limit behind.
        term.cause == Cause.SLEW_LIMIT && base.model.terms.none { it.cause in LAG_PARTS } ->
            listOf(term.copy(isWithin = false), term.copy(isWithin = true))
        term.cause == Cause.SLEW_LIMIT ->
            listOf(term.copy(isWithin = base.model.terms.any { it.key == term.key && it.isWithin }))
        term.cause == Cause.HYSTERESIS ->
            listOf(false, true).map { term.copy(hasOwnStart = false, isFirst = it) }
        else -> listOf(term.copy(hasOwnStart = false))
    }

    /** [base] with [term], fitted from several starts. */
    private fun fitted(base: ModelFit, term: Term): ModelFit {
        val kept = base.model.terms.filter { it.key != term.key }
        val model = ResponseModel(series, kept + term, base.model.steps, base.model.scales)
        val free = freed(model, base, term)
        val starts = starts(base, model, term)
        // What a strong effect leaves of the base looks like noise that wanders. Under that only what goes from row to row
        // counts, of which in a condition most may be its own noise: the number comes out small, and what it misses wanders.
        return inOrder(likeliest(model, starts, free, noises(base), base).withOwnFade(used, longest))
    }

    /** The likeliest fit of [model] from [starts], under each of [noises] and under what suits it from there. */
    private fun likeliest(
        model: ResponseModel,
        starts: List<DoubleArray>,
        free: BooleanArray,
        noises: List<CorrelatedNoise>,
        base: ModelFit,
    ): ModelFit {
        val sign = GainSign(base)
        return noises.flatMap { noise ->
            val rough = starts.map { start ->
                val own = model.fadingAs(start, base)
                Fitting.fit(own, start, free, used, longest, noise = own.noise(noise, used))
            }.maxBy { plainest(it, sign) }
            listOf(rough, Fitting.fit(rough.model, rough.numbers, free, used, longest, guess = rough.noise))
        }.maxBy { plainest(it, sign) }
    }

    /** Twice the log-likelihood of [fit] less what each end of a range is to explain for certain; least with a gain of another [sign]. */
    private fun plainest(fit: ModelFit, sign: GainSign): Double =
        if (sign.isTurned(fit)) -Double.MAX_VALUE else fit.score - SmallShifts.CERTAIN * RangeEnd.count(fit)

    private fun starts(base: ModelFit, model: ResponseModel, term: Term): List<DoubleArray> {
        val all = Starts(base, model, term).all()
        if (term.cause == Cause.SATURATION) return all + all.map { within(base, model, term, it) }
        val late = scales.unknown?.late ?: 0.0
        if (term.cause != Cause.DEAD_TIME || late == 0.0) return all
        val slot = model.slot(term)
        val parameter = model.parameters[slot]
        return all + all.first().copyOf().also { it[slot] = late.coerceIn(parameter.lower, parameter.upper) }
    }

    /**
     * [start] of [model] with all numbers but the ends of [term] as the readings between these have them under [base]: what
     * an end cuts off pulls the gain towards it, and so far that no step leads back.
     */
    private fun within(base: ModelFit, model: ResponseModel, term: Term, start: DoubleArray): DoubleArray {
        val slot = model.slot(term)
        val rows = BooleanArray(used.size) { i ->
            used[i] && series.values[i] > start[slot] && series.values[i] < start[slot + 1]
        }
        val white = base.model.scales.white(rows)
        val inner = Fitting.fit(base.model, base.numbers, base.free, rows, longest, noise = white)
        val numbers = model.carried(base.model, inner.numbers)
        return start.copyInto(numbers, slot, slot, slot + model.width(term))
    }

    /** [fit] with the longer of two lags in a row first, where the order does not matter otherwise. */
    private fun inOrder(fit: ModelFit): ModelFit {
        val second = LagPair.of(fit)?.takeIf { it.isTurned }?.second ?: return fit
        val numbers = fit.numbers.copyOf()
        numbers[second] = fit.numbers[ResponseModel.TIME_CONSTANT]
        numbers[ResponseModel.TIME_CONSTANT] = fit.numbers[second]
        return Fitting.fit(fit.model, numbers, fit.free, used, longest, noise = fit.noise)
    }

    /**
     * [base] with the jumps that serve it best: from the best one on and from the best two on, because of two that undo
     * each other neither need show alone; more are added while each is worth it.
     *
     * Places are looked for under several noises: the base's has taken the jump for its own wandering, and then sees it
     * elsewhere or nowhere.
     */
    private fun jumps(base: ModelFit): ModelFit {
        val found = ArrayList<ModelFit>()
        noises(base).forEach { found += jumps(base, it) }
        found.maxByOrNull { it.score }?.let { found += jumps(base, it.noise) }
        val shown = found.filter { jumpsPValue(base, it, it.score - base.score) < SHOWN * settings.level }
        val best = shown.ifEmpty { found }.maxByOrNull { it.score - JUMP_WORTH * jumpsBeyond(base, it) } ?: return base
        return withMoreJumps(best)
    }

    /** Under which fits begin, and places of jumps are looked for. */
    private fun noises(base: ModelFit) =
        listOf(base.noise, base.model.scales.white(used)).distinctBy { it.share }

    /** [base] with the best jump, and with the best two, by [noise]. */
    private fun jumps(base: ModelFit, noise: CorrelatedNoise): List<ModelFit> {
        val known = base.model.terms.firstOrNull { it.cause == Cause.OFFSET_STEPS }?.times.orEmpty()
        val places = JumpPlaces(Fitting.at(base.model, base.numbers, base.free, noise), PLACES)
        return listOfNotNull(places.single()?.let { listOf(it) }, places.pair())
            .map { extended(base, Term(Cause.OFFSET_STEPS, times = (known + it).sorted())) }
    }

    private fun jumpsBeyond(base: ModelFit, fit: ModelFit) =
        fit.model.terms.sumOf { it.times.size } - base.model.terms.sumOf { it.times.size }

    /** Of a [gain] of [fit], which has more jumps than [base]: as often as under one noise, times their number. */
    private fun jumpsPValue(base: ModelFit, fit: ModelFit, gain: Double): Double {
        val before = Fitting.at(base.model, base.numbers, base.free, fit.noise)
        val one = JumpScan.of(before, JumpPlaces.edge(series.size)).pValue(gain, jumpsBeyond(base, fit))
        return minOf(1.0, one * noises(base).size)
    }

    private fun withMoreJumps(first: ModelFit): ModelFit {
        var best = first
        for (count in first.model.terms.sumOf { it.times.size } until MOST_JUMPS) {
            val times = best.model.terms.flatMap { it.times }
            val next = JumpPlaces(best, PLACES).single() ?: return best
            val fit = extended(best, Term(Cause.OFFSET_STEPS, times = (times + next).sorted()))
            if (fit.score - best.score < JUMP_WORTH) return best
            best = fit
        }
        return best
    }

    /** The gain where each row counts as much as readings scatter there: noise need not be the same everywhere. */
    private fun evenly(base: ModelFit, best: ModelFit): Double {
        val noise = best.noise.over(used)
        val before = DoubleArray(used.size).also { noise.whiten(base.residuals, it) }
        val after = DoubleArray(used.size).also { noise.whiten(best.residuals, it) }
        val factors = LocalSpread.of(best, after)
        var gain = 0.0
        var left = 0.0
        for (i in used.indices) {
            val weight = 1 / (factors[i] * factors[i])
            gain += weight * (before[i] * before[i] - after[i] * after[i])
            left += weight * after[i] * after[i]
        }
        return if (left > 0) noise.rows * gain / left else best.score - base.score
    }

    private fun inflation(base: ModelFit, best: ModelFit): Double {
        val columns = best.jacobian.toList()
        // What the base and its terms have fitted comes first in each; new terms stand last. A first state is no evidence.
        val terms = (ResponseModel.BASE until base.free.size).count { base.free[it] && it !in base.model.firstStates }
        var seen = 0
        val (old, new) = best.free.indices.filter { best.free[it] }.withIndex().partition { (_, i) ->
            when {
                i < ResponseModel.BASE -> base.free[i]
                i in best.model.firstStates -> true
                else -> seen++ < terms
            }
        }
        if (new.isEmpty()) return 1.0
        val basis = Evidence.orthonormal(old.map { columns[it.index] })
        val extra = Evidence.orthonormal(new.map { columns[it.index] }, basis)
        return Evidence.inflation(extra, best.whitened)
    }

    /**
     * [fit] without [term], fitted anew; a number of the [base] that was wrong is as given again, unless another cause
     * leaves it open.
     */
    fun without(fit: ModelFit, term: Term, base: ModelFit): ModelFit {
        val rest = fit.model.terms.filter { it.key != term.key }
        val model = ResponseModel(series, rest, fit.model.steps, fit.model.scales)
        val start = DoubleArray(model.parameters.size)
        val free = BooleanArray(model.parameters.size)
        val open = rest.filter { base.model.slotOrNull(it) == null }
            .flatMap { it.cause.baseNumbers + listOfNotNull(it.cause.conditionalNumber) }
        for (i in 0 until ResponseModel.BASE) {
            free[i] = base.free[i] || i in open
            start[i] = if (free[i]) fit.numbers[i] else base.numbers[i]
        }
        for (old in rest) {
            val from = fit.model.slotOrNull(old) ?: continue
            val to = model.slotOrNull(old) ?: continue
            for (k in 0 until model.width(old)) {
                start[to + k] = fit.numbers[from + k]
                free[to + k] = fit.free[from + k]
            }
        }
        return Fitting.fit(model, start, free, used, longest, guess = fit.noise).withOwnFade(used, longest)
    }

    companion object {
        private const val PLACES = 60
        private const val MOST_JUMPS = 3
        private const val JUMP_WORTH = 25.0

        /**
         * Of the residuals on held-out blocks without a cause, beyond which those with it explain nothing, however likely
         * noise that wanders more makes them: a jump to where a wild reading was, and no way back.
         */
        private const val WORSE = 1.1

        /** Below this share of the level jumps show by themselves, whatever else is tried. */
        private const val SHOWN = 0.05

        /** Longest correlation time of noise in [series], s. */
        fun longest(series: MeasuredSeries, settings: DiagnosisSettings): Double =
            maxOf(series.duration / settings.noiseShare, 3 * series.period)

        /** What shows at an end of the range, or in the steepest water, alone. */
        private val ACT_NOW_AND_THEN = setOf(Cause.SATURATION, Cause.SLEW_LIMIT)

        /** Twice a gain in log-likelihood by which a part has a first state of its own: 0.1 % of one number. */
        const val OWN_START = 10.8

        /** What makes two lags of one. */
        private val LAG_PARTS = setOf(Cause.TWO_PATH_RESPONSE, Cause.SECOND_ORDER_RESPONSE)
    }
}
