package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.ChannelLag
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.Loops
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.all
import stillwater.diagnose.evidence.CoarseRounding
import stillwater.diagnose.evidence.SmallShifts
import stillwater.diagnose.evidence.StillReadings
import stillwater.diagnose.evidence.TooLittle
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Steps
import stillwater.diagnose.track.Passes
import java.util.Locale
import kotlin.math.sqrt

/**
 * The diagnosis of a log without a reference: the water is inferred with the sensor, from passes over the same place.
 *
 * Each cause is an extension of a first-order lag, fitted with the water free to take what it can imitate at every
 * step. What is left counts: likelihood ratios are divided by what correlation inflates them, and stretches of the log
 * must agree, but about jumps. See core/docs/Diagnosis.md, (11) to (15b).
 */
internal class BlindDiagnosis(
    private val series: MeasuredSeries,
    private val settings: DiagnosisSettings,
    private val loops: Loops = Loops.IN_TURN,
    private val progress: (Double) -> Unit = {},
) {
    /** What finds the models, and counts their designs. */
    val search by lazy { BlindSearch(series, loops) { progress(SEARCH * it) } }
    private var rounds = 0

    /** The model that [run] found; null where it found none. */
    var found: BlindState? = null
        private set

    /** The share [done] of a round is behind: each takes half of what is left. */
    private fun tell(done: Double) {
        var left = 1 - SEARCH
        repeat(rounds) { left /= 2 }
        progress(1 - left + left / 2 * done.coerceAtMost(1.0))
    }

    /** The answer. */
    fun run(): DiagnosisResult {
        val why = TooLittle.why(series)
        if (why != null) return TooLittle.answer(series, why)
        val base = search.best()
        val share = passes(base)
        if (share < LEAST_PASSES) {
            val near = "%.2g".format(Locale.ROOT, base.shortestNeeded / Passes.NEAR)
            return TooLittle.answer(
                series,
                Passes.tooFew(share, LEAST_PASSES, near, series.placeUnit),
                BlindOutliers(search, base).rows,
                ofReadings(base),
            )
        }
        val (begun, isTurned) = prepared(base)
        return answer(begun, isTurned)
    }

    /** The share of the rows that are near another pass, for the waves that the water of [base] needs. */
    private fun passes(base: BlindState) = Passes.share(search.track.x, search.track.y, base.shortestNeeded)

    /**
     * The model [begun] of a lag alone without wild readings, with steps that are held where they look so, and with the
     * waves that the water has beyond doubt; finer ones that it may have are in [deeper]. And whether half a row's delay is
     * told by such steps.
     */
    private fun prepared(begun: BlindState): Pair<BlindState, Boolean> {
        var base = begun
        val loose = BlindOutliers(search, base)
        if (loose.rows.isNotEmpty()) {
            loose.rows.forEach { search.used[it] = false }
            base = search.improved(search.evened(base))
            // Wild readings hide that steps are held; they do not make them look so.
            if (!search.steps.isHeld) base = search.stepped(base)
        }
        // Before finer waves, which look like half a row's delay.
        val halfRow = BlindHalfRow(search, base)
        val turned = halfRow.held() ?: halfRow.ahead()
        if (turned != null) base = turned
        val finer = search.deeper(base)
        if (finer != null && MissingWaves(search, base).areClear(finer)) base = search.begun(finer) else deeper = finer
        return base to (turned != null)
    }

    /** What the log says of a lag alone, of the channel [name]; whatever else is at work beside. */
    fun channel(name: String): ChannelLag {
        if (TooLittle.why(series) != null) return ChannelLag(name, Double.NaN, Double.NaN)
        val (base, _) = prepared(search.best())
        val lag = lag(base, search.still(base))
        val errors = BlindAssessed(search, lag.timeConstant).errors
        return lag.channel(name, errors[ResponseModel.TIME_CONSTANT]).also { progress(1.0) }
    }

    /** The time constant of a lag alone; null where passes do not show it. */
    fun timeConstant(): FoundLag? {
        if (TooLittle.why(series) != null) return null
        val begun = search.best()
        if (passes(begun) < LEAST_PASSES) return null
        val (base, _) = prepared(begun)
        val state = lag(base, search.still(base)).takeIf { it.isSeen }?.timeConstant ?: return null
        return FoundLag(state.timeConstant, BlindAssessed(search, state).errors[ResponseModel.TIME_CONSTANT])
    }

    /** What readings show by themselves, whether or not the boat comes back, in words; [base] is the model of a lag alone. */
    private fun ofReadings(base: BlindState): List<String> {
        val rounding = CoarseRounding(series, search.used, search.scales.resolution)
        val still = StillReadings(base.asFit(search.free(base.model))).words(settings.level)
        return listOfNotNull(
            rounding.words().takeIf { rounding.isCoarse(sqrt(base.variance)) },
            still?.let { "${it.replaceFirstChar(Char::uppercase)}." },
        )
    }

    /** The model of a lag alone with finer waves, where those found at first may have been too few; it is asked once. */
    private var deeper: BlindState? = null

    /** The answer on top of [likeliest], a lag alone. */
    private fun answer(likeliest: BlindState, isTurned: Boolean = false): DiagnosisResult {
        val still = search.still(likeliest)
        lag = lag(likeliest, still)
        var base = lag.timeConstant
        // Between a time constant and a dead time nothing can be named: both are then left free beside all else.
        val start = if (lag.isOpen(settings.separation)) lag.both else base
        val first = if (start === likeliest) round(start, still) else round(start)
        finer(first)?.let { return answer(search.begun(it)) }
        val turned = if (isTurned) null else turned(base, first)
        if (turned != null) return answer(turned, isTurned = true)
        val once = BlindForward(search, settings) { round(it) }.of(first)
        val found = heldInstead(once.steps) ?: once
        val chosen = found.steps
        if (base.model.steps != search.steps) {
            base = checkNotNull(search.turned(base, search.steps, Double.NEGATIVE_INFINITY))
            lag = lag(base, search.still(base))
        }
        val last = chosen.lastOrNull()?.state ?: first.state
        this.found = last
        val end = found.ended ?: round(last)
        val causes = causes(start, chosen)
        val given = settings.base?.let { GivenLag(search, base, it, last.takeIf { chosen.isNotEmpty() }) }
        return BlindAnswer(series, settings, search, base, last, lag, BlindOutliers(search, last), given)
            .of(first, causes, end)
    }

    /**
     * The model with finer waves where it is likelier than all that [first] has, and not asked yet. Waves that are missing
     * and a response that is wrong look alike: what no response makes up for is the water's.
     */
    private fun finer(first: BlindRound): BlindState? {
        val likeliest = (first.causes.mapNotNull { it.state } + first.state).maxOf { it.score }
        return deeper?.takeIf { it.score > likeliest + BlindLag.MUCH }?.also { deeper = null }
    }

    /**
     * [base] with other steps, where what [first] found is a shift that these do for: a truth that is held over each step
     * is ahead by half of one, or behind. Null where they do not.
     */
    private fun turned(base: BlindState, first: BlindRound): BlindState? {
        val ahead = first.shift()?.let { search.turned(base, search.steps.other, it.score - ONE_NUMBER) }
        if (ahead != null || search.steps.isHeld) return ahead
        val late = halfRowLate(base, first) ?: return null
        // Of those that shift readings another may explain more: an offset of place, where speeds differ.
        val shapes = first.causes.filter { it.term?.cause in BlindTerms.OF_LAG }.mapNotNull { it.state } + first.state
        return search.turned(late, Steps.UNTIL_NEXT, shapes.maxOf { it.score } - ONE_NUMBER)
    }

    /**
     * The model of [first] with a dead time of about half a row beside the lag that is much likelier than [base], whether
     * or not finer water may do as much; null for none.
     */
    private fun halfRowLate(base: BlindState, first: BlindRound): BlindState? {
        val dead = first.causes.firstOrNull { it.term?.cause == Cause.DEAD_TIME }?.state
        return listOfNotNull(first.state, dead).firstOrNull {
            BlindHalfRow.isHalfARow(it) && it.score > base.score + BlindLag.MUCH
        }
    }

    /**
     * [chosen] without its shifts, with steps that are held, where these do as much; null where they do not. Each lag has
     * what is held half a row sooner or later, so that two have it a row.
     */
    private fun heldInstead(chosen: List<BlindStep>): BlindFound? {
        val rest = chosen.filter { it.trial.term?.cause !in SmallShifts.WHOLE }
        val last = chosen.lastOrNull()?.state
        if (last == null || rest.isEmpty() || rest.size == chosen.size || search.steps.isHeld) return null
        val (shifts, others) = last.model.terms.partition { it.cause in SmallShifts.WHOLE }
        val rows = shifts.sumOf { SmallShifts.late(it, last.model, last.numbers) ?: 0.0 } / series.period
        val steps = Steps.entries.firstOrNull { it.isHeld && -rows / it.lead in HALVES } ?: return null
        val state = search.turned(last, steps, last.score - ONE_NUMBER, others) ?: return null
        val held = BlindStep(rest.last().trial, rest.last().round, state)
        return BlindFound(rest.dropLast(1) + held, round(state))
    }

    /**
     * What the log says of a lag alone on [likeliest], or on [still], the same in water that does not change: water that
     * changes in time can take what the sensor does.
     */
    private fun lag(likeliest: BlindState, still: BlindState): BlindLag {
        val changing = likeliest.score - still.score
        val lags = if (changing in 0.0..NO_CHANGE) {
            listOf(BlindLag(search, likeliest))
        } else if (changing < FAR_CHANGE) {
            loops.all(listOf(likeliest, still)) { state -> BlindLag(search, state).also { it.likeliest } }
        } else {
            listOf(BlindLag(search, likeliest, still.takeIf { !likeliest.isResolved }))
        }
        return lags.maxBy { it.likeliest }
    }

    private val arms by lazy { FarArms(search) }

    /** What the log says of a lag alone. */
    private lateinit var lag: BlindLag

    private fun round(model: BlindState, still: BlindState = search.still(model)) =
        BlindRound(search, settings, lag, arms, model, still, ::tell).also { rounds++ }

    /** Each chosen cause beside all others, with those that explain as much in its place. */
    private fun causes(base: BlindState, chosen: List<BlindStep>): List<ChosenCause> = chosen.mapIndexed { i, step ->
        val round = if (i == chosen.size - 1) step.round else round(search.without(base, chosen, i))
        val taken = chosen.filter { it !== step }.map { it.trial.name }
        val own = round.causes.firstOrNull { it.name == step.trial.name } ?: step.trial
        val rivals = round.causes.filter { it.name !in taken && it.pValue < settings.level }
        // Others have water that changes beside them, where there is such water, and so are no answer in place of it.
        val isBesideChange = own.term?.cause in SLOW && round.changing > settings.separation
        val possible = rivals.filter { !isBesideChange || it.term?.cause in SLOW }
        val others = BlindRivals.alike(own, settings.setProbability, possible)
        val term = checkNotNull(step.trial.term)
        val twin = listOfNotNull(Cause.TIME_VARYING_FIELD.takeIf { BlindRivals.mayBeWaters(term) })
        val isContradicted = step.trial.isContradicted && (own.state == null || own.isContradicted)
        ChosenCause(step, (listOf(term.cause) + twin + others).distinct(), isContradicted)
    }

    companion object {
        /**
         * Water that is not wholly resolved and fixes that jitter in steep water make p-values too small by many times:
         * the level of outliers is lower by as much. Looks have [BlindLook.doubt] for it.
         */
        const val STRICTER = 0.1

        /** Share of the rows that must come near another pass. */
        private const val LEAST_PASSES = 0.02

        /** Share of the work that the search for the lag is. */
        private const val SEARCH = 0.5

        /** Twice the gain in log-likelihood of water that changes that is none. */
        const val NO_CHANGE = 2.0

        /** Twice the gain in log-likelihood of water that changes that no cause in still water is asked to make up for. */
        const val FAR_CHANGE = 300.0

        /** Twice a gain in log-likelihood that one number has by chance in one log of twenty. */
        const val ONE_NUMBER = 3.84

        /** Half rows of a shift that held steps are tried for. */
        private val HALVES = 0.5..2.5

        /** Causes that water which changes in time can imitate. */
        val SLOW = setOf(Cause.DRIFT, Cause.OFFSET_STEPS)
    }
}
