package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.all
import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import kotlin.math.ln

/**
 * All causes and looks on top of one model of a log without a reference.
 *
 * @param lag what the log says of a lag alone: where not even a time constant and a dead time can be told apart, nothing
 *   between them can be named, nor where fixes are far off. @param arms looks for far arms. @param settledStill the model on water that does not
 *   change. @param tell told how much of the round is done, 0..1.
 */
internal class BlindRound(
    private val search: BlindSearch,
    private val settings: DiagnosisSettings,
    private val lag: BlindLag,
    private val arms: FarArms,
    model: BlindState,
    private val settledStill: BlindState = search.still(model),
    private val tell: (Double) -> Unit,
) {
    private val loops get() = search.loops
    private val isShapeOpen = lag.isOpen(settings.separation)

    /** Still water under noise that hardly wanders; null where it does not anyway. */
    private val quiet = search.quiet(settledStill)
    private val open = search.opened(model)

    /** Water that does not change, from noise that suits it, from such as hardly wanders, and from what suits changes. */
    private val still = (quiet?.let { search.likelier(settledStill, it) } ?: settledStill)
        // Where the water of the model changes anyway, what suits it when it does not is known.
        .let { if (open !== model && open.score - it.score > CHANGING_TOO) better(it, search.still(open)) else it }

    /** The model, with water that changes in time or does not. */
    val state = if (open.score > still.score) open else still
    private val tries = BlindTrials(search, state)
    private val stillTries = if (still === state) tries else BlindTrials(search, still)

    private val quietTries = quiet?.let { BlindTrials(search, it) }

    /** Water that does not change, all else as it is: noise that suits such water may wander as a drift does. */
    private val held = if (still === state) state else search.held(state)
    private val heldTries = if (still === state) tries else BlindTrials(search, held)

    /**
     * Whether the finest waves are strong: the water may have finer ones, or the response is wrong, and other
     * responses are then begun far from what the wrong water makes of them.
     */
    private val isBlurred = !state.isResolved
    private val beyond = BeyondWaves(search, state)

    /** What water that changes in time explains. It could imitate a drift: the two are held against each other. */
    val changing = maxOf(open.score - still.score, 0.0)

    /** The same over what correlation inflates; nothing where finer waves may be missing, which look like changes. */
    val changed: Double by lazy {
        val column = open.fit.unlike(open.derivative(ResponseModel.TIME_CONSTANT))
        if (open.isResolved) changing / BlindEvidence.inflation(listOf(column), open.whitened) else 0.0
    }

    private val terms = BlindTerms.on(state, search, tries, isShapeOpen, settings.level)

    /**
     * What serves best on top of [quiet], where neither noise nor water that changes has taken what a cause does:
     * such as make up for much of what these explain.
     */
    private val onQuiet: Map<String, BlindTrial> = quietTries?.let { tries ->
        val least = MADE_UP * (state.score - checkNotNull(quiet).score)
        val tried = loops.all(terms.filter { it.cause !in BlindDiagnosis.SLOW }, tries::attempt)
        tried.filter { it.likelier > maxOf(LIKELY, least) }
            .sortedByDescending { it.likelier }.take(MOST_QUIET).associateBy { it.name }
    }.orEmpty()

    /** The causes that are not in the model yet. */
    val causes: List<BlindTrial> = run {
        tell(0.0)
        val all = loops.all(terms, tries::attempt)
        tell(TRIED)
        // Water that changes in time may have taken what the sensor does.
        val isOther = still !== state && changing > BlindDiagnosis.NO_CHANGE
        val isFar = changing >= BlindDiagnosis.FAR_CHANGE
        // Water that would change by very much, and waves that are missing, both come of a response that is wrong.
        val both = terms.filter {
            isOther && (it.cause in BlindDiagnosis.SLOW || !isFar || (isBlurred && it.cause in BlindSearch.LINEAR))
        }
        val tried = loops.all(both) {
            val tries = if (it.cause in BlindDiagnosis.SLOW) heldTries else stillTries
            tries.attempt(it)
        }
        val others = both.map { it.key }.zip(tried).toMap()
        fun other(trial: BlindTrial) = others[trial.term?.key]
        fun worth(trial: BlindTrial) = maxOf(trial.worth, other(trial)?.worth ?: 0.0)
        val likely = all.filter { it.ratio > LIKELY || other(it)?.let(::isLikelyOnStill) == true }
            .sortedByDescending(::worth).take(MOST_LIKELY).toSet() +
            all.filter { it.name in onQuiet || it.pValue < settings.level } +
            // Something changed: whether it is a drift is asked, however little of it water that changes has left.
            all.filter { it.term?.cause == Cause.DRIFT && changing > CHANGING_TOO }
        fun weighed(trial: BlindTrial): BlindTrial {
            val cause = trial.term?.cause
            // Responses are begun anew in blurred water, whatever their first steps gain, and some anywhere.
            val isAsked = (isBlurred && cause in BlindSearch.LINEAR) || cause in HIDDEN
            val settled = if (isAsked || trial in likely) settled(trial, other(trial)) else trial
            val clear = beyond.of(settled)
            val placed = if (mayBeOnArm(trial)) far(clear) else clear
            return if (isOfLag(placed) && !(isShapeOpen && placed.isLate)) doubted(placed) else placed.atMost(0.0)
        }
        fun gained(trial: BlindTrial) = maxOf(trial.gain, other(trial)?.gain ?: 0.0)
        fun isSure(trial: BlindTrial) = trial.pValue < settings.level
        fun asked(trials: List<BlindTrial>) = trials.zip(loops.all(trials, ::weighed)).toMap()
        val inOrder = all.sortedByDescending(::gained)
        var asked = asked(inOrder.take(1))
        if (asked.none { isSure(it.value) || gained(it.key) <= MissingWaves.most(0.0) }) {
            asked = asked + asked(inOrder.drop(1).take(NEXT))
        }
        val lead = asked.values.filter(::isSure).maxByOrNull { it.likelier }

        // What is far behind one that is sure is no rival of it, and is asked again once that is in the model.
        // Of what is slow, water that changes may have taken as much as that explains.
        fun isBehind(trial: BlindTrial): Boolean {
            val taken = if (trial.term?.cause in BlindDiagnosis.SLOW) changing else 0.0
            return lead != null && trial.name !in onQuiet && MissingWaves.most(gained(trial) + taken) < lead.likelier
        }
        loops.all(all) { asked[it] ?: if (isBehind(it)) it else weighed(it) }
    }

    /** Whether [trial] is an offset of place; coarse rounding makes a likelihood so rugged that other waves gain by chance. */
    private fun mayBeOnArm(trial: BlindTrial): Boolean = trial.term?.cause == Cause.POSITION_OFFSET &&
        state.model.terms.none { it.cause == Cause.QUANTISATION }

    /** [trial], an offset of place, or the same on an arm that turns hide, if that explains more. */
    private fun far(trial: BlindTrial): BlindTrial {
        val arm = arms.likeliest(state) ?: return trial
        val best = likewise(arm.state).max() + arm.anew
        val found = tries.settled(trial, arm.state, best, searched(trial) + arm.searched)
        val gain = arm.state.score - state.score - arm.anew
        return if (found.likelier > trial.likelier && gain > BeyondWaves.GAIN * found.inflation) found else trial
    }

    /** [trial], of which, if a drift, waves that are missing do as much: passes then differ by when they were. */
    private fun doubted(trial: BlindTrial): BlindTrial {
        val isDoubtful = trial.term?.cause == Cause.DRIFT && !(trial.state ?: state).isResolved
        return if (isDoubtful) trial.lessSure(BlindLook.DOUBT_OF_CHANGE) else trial
    }

    /** Whether [trial] needs no lag, or there is one for certain: a lag alone, or the one that it is another shape of. */
    private fun isOfLag(trial: BlindTrial): Boolean = lag.isSeen || trial.term?.cause !in BlindTerms.OF_LAG ||
        trial.state?.let { lag.isSeenIn(it, trial.inflation) } == true

    /**
     * Whether [trial], on water that does not change, may be worth water and noise of its own. A drift always may: it is
     * asked there where water that changes is worth something, whose noise has taken what a drift does at first.
     */
    private fun isLikelyOnStill(trial: BlindTrial): Boolean {
        if (trial.term?.cause == Cause.DRIFT) return true
        val isSlow = trial.term?.cause in BlindDiagnosis.SLOW
        return trial.ratio > LIKELY && !(isSlow && trial.ratio * trial.inflation < changing / 2)
    }

    /**
     * [trial] with the water and the noise that suit it.
     *
     * Water that changes in time can imitate a drift or a jump. Those are held against water that stays the same
     * where they explain more than such water, and against such water where they do not: something changed either
     * way.
     */
    private fun settled(trial: BlindTrial, other: BlindTrial?): BlindTrial {
        val first = settledAsIs(trial, other)
        return if (first.term?.cause == Cause.OFFSET_STEPS && first.pValue < settings.level) grown(first) else first
    }

    /** [trial], of jumps, with more of them: what the first leave shows others. */
    private fun grown(trial: BlindTrial): BlindTrial {
        val before = trial.state ?: return trial
        val term = checkNotNull(trial.term)
        val more = BlindTrials(search, before).oneMoreJump(term) ?: return trial
        val after = search.suited(search.with(before, more))
        val gain = after.score - before.score - 2 * (tries.searched(2) - tries.searched(1))
        if (gain < LIKELY) return trial
        val base = if (search.isStill(after)) still else state
        val next = tries.settled(more, after, likewise(after, listOf(base)).single(), searched(more))
        if (next.pValue >= settings.level) return trial
        return grown(if (base === state) next else next.among(base.score - state.score))
    }

    private fun settledAsIs(trial: BlindTrial, other: BlindTrial?): BlindTrial {
        val isSlow = trial.term?.cause in BlindDiagnosis.SLOW
        val onState = if (isSlow && other != null && !(trial.ratio > LIKELY)) null else found(state, trial)
        val onStill = other?.takeIf { !isSlow || isLikelyOnStill(it) }?.let {
            val own = found(if (isSlow) held else still, it)
            // Noise that suits changing water suits a drift no more than that which has taken it.
            if (it.term?.cause == Cause.DRIFT) likelierDrift(own, it) else own
        }
        if (isSlow && onStill != null && (onState == null || onState.score < onStill.score + CHANGING_TOO)) {
            return heldAgainstChange(checkNotNull(other), onStill)
        }
        val quieter = onQuiet[trial.name]?.let { search.climbed(found(checkNotNull(quiet), it)) }
        val own = listOfNotNull(onState, onStill, quieter)
        // Water that changes besides adds to what explains something.
        val isWorthIt = own.any { it.score > state.score + HOPELESS }
        val onWay = (own + listOfNotNull(onStill?.takeIf { isWorthIt }?.let(search::opened))).maxBy { it.score }
        val searched = searched(trial)
        val first = tries.settled(trial, onWay, state.score, searched)
        if (first.pValue > settings.level) {
            return if (isSlow && onStill != null) heldAgainstChange(checkNotNull(other), onStill) else first
        }
        val arm = if (mayBeOnArm(trial)) search.onArm(onWay) else onWay
        val anew = search.anew(onWay, arm)
        val isArm = arm.score > onWay.score + anew
        val found = if (isArm) arm else onWay
        // The same noise may suit the model without it as well.
        val best = likewise(found).max()
        return tries.settled(trial, found, if (isArm) best + anew else best, searched)
    }

    private fun better(one: BlindState, other: BlindState) = if (other.score > one.score) other else one

    /** [found], or a drift as [trial] begun from the noise that suits still water without it. */
    private fun likelierDrift(found: BlindState, trial: BlindTrial): BlindState {
        val begun = search.improved(search.with(still, stillTries.attempt(checkNotNull(trial.term))))
        return better(search.climbed(found), search.climbed(search.requieted(begun)))
    }

    private fun searched(trial: BlindTrial): Double = tries.searched(trial.term?.times.orEmpty().size)

    /** [trial], a drift or a jump in water that does not change, as [found] has it. */
    private fun heldAgainstChange(trial: BlindTrial, found: BlindState): BlindTrial {
        val searched = searched(trial)
        val first = tries.settled(trial, found, still.score, searched)
        if (first.pValue > settings.level) return first.instead(-maxOf(state.score - still.score, 0.0))
        // The same noise may suit the models without it as well.
        val (rest, best) = likewise(found)
        val trying = tries.settled(trial, found, best, searched)
        return when {
            found.score > rest -> trying.among(best - rest)
            // It explains most of what water that changes does: something changed, and both are in the answer.
            still !== state && found.score - best > (rest - best) / 2 && trying.pValue < settings.level ->
                trying.beside(search.climbed(search.with(state, trying))).among(best - rest)
            else -> trying.instead(best - rest)
        }
    }

    /** The model of [trial] on top of [without] with the water and the noise that suit it. */
    private fun found(without: BlindState, trial: BlindTrial): BlindState {
        val term = checkNotNull(trial.term)
        if (term.cause == Cause.SATURATION) return search.suited(tries.ended(term, trial, without))
        if (!isFar(term)) return search.suited(search.with(without, trial))
        val first = tries.begun(trial, without)
        // A dead band takes the water along, step by step.
        val begun = if (term.cause == Cause.HYSTERESIS) search.climbed(first) else search.improved(first)
        return if (begun.score < without.score + HOPELESS) begun else search.suited(begun)
    }

    /** Whether a fit of [term] may have to begin far from what the water makes of it. */
    private fun isFar(term: Term) = isBlurred || term.cause in HIDDEN

    /**
     * The scores of all of [without], by default of [state] and [still], models without what is new in [found], or what is
     * more: with the noise of [found], or from where [found] is with all of it but what is new there.
     */
    private fun likewise(found: BlindState, without: List<BlindState> = listOf(state, still)): List<Double> {
        val noise = found.fit.design.noise
        val model = without.first().model
        val numbers = model.carried(found.model, found.numbers)
        val there = search.climbed(search.settled(model.terms, numbers, noise, found.variances, before = found)).score
        val own = without.distinct().associateWith { search.improved(search.again(it, noise)).score }
        return without.map { maxOf(it.score, own.getValue(it), there) }
    }

    /** What no cause explains, with the water and the noise of [state]. */
    val looksAsIs: List<BlindTrial> get() = here.trials
    private val here by lazy { looksOn(state, tries) }

    /** What no cause explains. */
    val looks: List<BlindTrial> by lazy { looks() }
    private val adjusted by lazy {
        (causes + looks).let { all -> all.zip(Evidence.holm(all.map { it.chance }), BlindTrial::sure) }
    }

    /**
     * What no cause explains, with water and noise of its own where it may be something: both would take it
     * otherwise, as they take what a cause does.
     */
    private fun looks(): List<BlindTrial> {
        val onStill = if (still === state) null else looksOn(still, stillTries)
        val onQuiet = quietTries?.let { looksOn(checkNotNull(quiet), it) }
        // What is asked of one model waits for none of the others.
        loops.all(listOfNotNull(here, onStill, onQuiet)) { it.trials }
        val deficit = quiet?.let { state.score - it.score } ?: 0.0
        // What waves of the water that are missing do looks like another response: one counts with which none are.
        val found = here.list.zip(here.trials, beyond::of).toMutableList()
        val tight = here.list.indices.filter { !here.list[it].isLoose }
        val begun = tight.map { i ->
            listOfNotNull(here to 0.0, onStill?.let { it to state.score - still.score })
                .map { (looks, lost) -> Begun(looks, i, lost) }.maxBy { it.worth }
        }.filter { it.worth > LIKELY }.sortedByDescending { it.undoubted }.take(MOST_LOOKS)
        val quieter = onQuiet?.let { looks -> tight.map { Begun(looks, it, MADE_UP * deficit) } }.orEmpty()
            .filter { it.worth > LIKELY && begun.none { other -> other.index == it.index } }
            .maxByOrNull { it.undoubted }
        val looked = begun + listOfNotNull(quieter)
        loops.all(looked, ::refitted).forEachIndexed { i, next ->
            val index = looked[i].index
            found[index] = if (next.pValue < found[index].pValue) next else found[index].leftOut(next)
        }
        return found
    }

    private fun looksOn(state: BlindState, tries: BlindTrials) = BlindLooks(state, tries, !isShapeOpen)

    /** The [index]-th of [looks], on a model that is less likely than this round's by [lost]. */
    private inner class Begun(val looks: BlindLooks, val index: Int, lost: Double) {
        val look = looks.list[index]
        val trial = looks.trials[index]
        val worth = trial.likelier - lost

        /** The same less what the look has to explain beyond others, whose p-value may be too small by as much. */
        val undoubted = worth - 2 * ln(look.doubt)
    }

    private fun refitted(begun: Begun): BlindTrial {
        val refitted = begun.looks.refitted(begun.index)
        if (!beyond.isClear(begun.look, refitted.state)) return begun.trial.atMost(0.0)
        val alone = tries.settled(begun.look, refitted, maxOf(state.score, still.score))
        val first = beyond.of(begun.look, alone, refitted.state)
        if (first.pValue > settings.level) return first
        // The same noise may suit the model without it as well.
        val (onState, onStill) = likewise(refitted.state)
        val best = maxOf(onState, onStill)
        val settled = tries.settled(begun.look, refitted, best)
        return if (still === state || !search.isStill(refitted.state)) settled else settled.onLess(best - onStill)
    }

    /** The strongest of [looks] at which something is left for certain, by its place; null where nothing is. */
    val strongestLook: Int?
        get() = looks.indices.filter { adjustedLooks[it] < settings.structureLevel }
            .maxByOrNull { looks[it].worth }

    /** What the [index]-th of [looks] is at. */
    fun look(index: Int): BlindLook = here.list[index]

    /** The model with the likeliest cause where that is another shape of the lag; null where it is not, or none is sure. */
    fun shift(): BlindState? = causes.filter { it.pValue < settings.level }.maxByOrNull { it.likelier }
        ?.takeIf { it.term?.cause in BlindTerms.OF_LAG }?.state

    /** p-values of [causes] for all that was tried. */
    val adjustedCauses: List<Double> get() = adjusted.take(causes.size)

    /** p-values of [looks] for all that was tried. */
    val adjustedLooks: List<Double> get() = adjusted.drop(causes.size)

    private companion object {
        /** Share of a round that all causes' first tries are. */
        const val TRIED = 0.3

        /** Twice the gain in log-likelihood over inflation from which a cause is given water and noise of its own. */
        const val LIKELY = 4.0

        /** The same below which what was begun in many places is no cause, whatever noise suits it. */
        const val HOPELESS = 3.0

        const val MOST_LIKELY = 5

        /** Causes that other water hides: a slow path is like long waves, and a dead band like a longer lag. */
        val HIDDEN = setOf(Cause.TWO_PATH_RESPONSE, Cause.HYSTERESIS)

        /** Causes that are asked before all others where the one that gains most is none. */
        const val NEXT = 2

        /** Looks that are given water and noise of their own. */
        const val MOST_LOOKS = 2

        /** Share of what noise that wanders and water that changes explain, for which a cause may make up alone. */
        const val MADE_UP = 0.4

        /** Causes that are given water and noise of their own from quiet still water on. */
        const val MOST_QUIET = 3

        /** Twice the gain in log-likelihood that water which changes must add to a drift or a jump to be kept beside it. */
        const val CHANGING_TOO = 10.0
    }
}
