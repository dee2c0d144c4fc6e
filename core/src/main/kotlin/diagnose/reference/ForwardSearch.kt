package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.Loops
import stillwater.diagnose.all
import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.evidence.HeldOutScore
import stillwater.diagnose.evidence.RoundingNull
import stillwater.diagnose.evidence.Trial
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import stillwater.diagnose.response.baseNumbers
import stillwater.diagnose.response.conditionalNumber
import kotlin.math.exp
import kotlin.math.ln

/**
 * Finds the combination of causes that explains a log: the best is added as long as one is worth it, then those are
 * dropped that the others make needless. Where more than one is found, the search is begun anew with each of the next
 * likeliest, because a combination can imitate a single cause that was second at first.
 *
 * @param terms all that is tried. @param loops how trials that do not wait for each other are gone through.
 * @param told called after each trial, on any thread.
 */
internal class ForwardSearch(
    private val search: CauseSearch,
    private val base: ModelFit,
    private val baseHeldOut: HeldOutScore,
    private val terms: List<Term>,
    private val settings: DiagnosisSettings,
    private val loops: Loops,
    private val told: () -> Unit,
) {
    /** Each of [terms] alone on top of the base. */
    val first: List<Trial> = loops.all(terms) { attempt(base, baseHeldOut, it) }

    /** The trials chosen one after the other; each fit holds all before it. */
    fun chosen(): List<Trial> {
        val worthy = worthy(first)
        val best = best(worthy) ?: return undoing()
        val found = from(best)
        if (found.size < 2 || best.term.cause.baseNumbers.isNotEmpty()) return found
        val keys = found.map { it.term.key }
        // That something is at work is certain here: what might be it need be likely only.
        val others = first.filter { it.pValue < LIKELY && it.term.key !in keys }
            .sortedByDescending { it.worth }.take(OTHER_BEGINNINGS)
        return (listOf(found) + loops.all(others) { from(it, found) }.filter { it.isNotEmpty() }).maxBy(::worth)
    }

    /**
     * A probe ahead and a delay that undoes that at the usual speed, where the two together explain the log: neither need help
     * alone. Empty where they do not.
     */
    private fun undoing(): List<Trial> {
        val place = first.firstOrNull { it.term.cause == Cause.POSITION_OFFSET }
        val delay = terms.firstOrNull { it.cause == Cause.DEAD_TIME }
        if (place == null || delay == null) return emptyList()
        val both = attempt(place.fit, place.heldOut, delay)
        val ratio = (both.fit.score - base.score) / maxOf(both.inflation, place.inflation)
        val isSure = Evidence.pValue(ratio, place.degrees + both.degrees) * terms.size < BESIDE * settings.level
        val isForetold = both.foretells && both.heldOut.logLikelihood > baseHeldOut.logLikelihood
        return if (isSure && isForetold) pruned(listOf(place, both)) else emptyList()
    }

    private fun attempt(fit: ModelFit, heldOut: HeldOutScore, term: Term) =
        search.attempt(fit, heldOut, term, base).also { told() }

    /** Those of [trials] that are less likely than [level] by chance and foretell what is held out. */
    private fun worthy(trials: List<Trial>, level: Double = settings.level): List<Trial> {
        val adjusted = Evidence.holm(trials.map { it.pValue })
        return trials.indices.filter { adjusted[it] < level && trials[it].foretells }.map { trials[it] }
    }

    /**
     * The likeliest; a wrong number of the base comes first unless another cause is clearly likelier, because others
     * can make up for a wrong number: a slow path that is hardly slower is a longer time constant.
     */
    private fun best(worthy: List<Trial>): Trial? {
        val best = worthy.maxByOrNull { it.worth } ?: return null
        return worthy.filter { given ->
            val numbers = given.term.cause.baseNumbers
            // What leaves the same number open holds it already: whether it is wrong besides is asked afterwards.
            val other = worthy.filter { it.term.cause.conditionalNumber !in numbers }.maxBy { it.worth }
            numbers.isNotEmpty() &&
                (other.worth - given.worth) / 2 / other.inflation < -ln(1 - settings.setProbability)
        }.maxByOrNull { it.worth } ?: best
    }

    /**
     * The search that begins with [beginning]; nothing where with two causes or more it explains no more than as many
     * of [rival] do, or comes upon the same.
     */
    private fun from(beginning: Trial, rival: List<Trial> = emptyList()): List<Trial> {
        val chosen = arrayListOf(beginning)
        while (chosen.size < settings.mostCauses) {
            val last = chosen.last()
            val taken = chosen.map { it.term.key }
            val rest = terms.filter { it.key !in taken && compatible(it, chosen) }
            val trials = loops.all(rest) { attempt(last.fit, last.heldOut, it) }
            chosen += best(worthy(trials, BESIDE * settings.level)) ?: break
            val other = rival.take(chosen.size)
            if (other.isNotEmpty() && chosen.last().fit.score < other.last().fit.score + DIFFERENT) return emptyList()
        }
        return pruned(chosen)
    }

    private fun compatible(term: Term, chosen: List<Trial>) =
        chosen.none { it.term.cause == Cause.TWO_PATH_RESPONSE } || term.cause != Cause.SECOND_ORDER_RESPONSE

    /** What [chosen] gains over the base, less what its numbers and the choice among all causes gain by chance. */
    private fun worth(chosen: List<Trial>): Double = chosen.last().fit.score - base.score -
        chosen.sumOf { it.cost + 2 * ln(terms.size.toDouble()) }

    /** [chosen] without what the later ones have made needless. */
    private fun pruned(chosen: List<Trial>): List<Trial> {
        if (chosen.size < 2) return chosen
        val full = chosen.last().fit
        val isCoarse = chosen.any { it.term.cause == Cause.QUANTISATION }
        val needless = chosen.filter { trial ->
            val without = search.without(full, trial.term, base)
            val gain = if (isCoarse && trial.term.cause != Cause.QUANTISATION) {
                RoundingNull(without, search.longest).gain(full, trial.term) - (trial.cost - 2 * trial.degrees)
            } else {
                full.score - without.score
            }
            Evidence.pValue(gain, trial.degrees) * terms.size > settings.level &&
                CalibrationPoint.isPossible(without, base, trial.term.cause.baseNumbers)
        }
        return if (needless.isEmpty()) jumpsLast(chosen) else again(chosen.filter { it !in needless })
    }

    /** [chosen] with its jumps looked for anew, which may have stood for what came after them, where that explains as much. */
    private fun jumpsLast(chosen: List<Trial>): List<Trial> {
        val (jumps, others) = chosen.partition { it.term.cause == Cause.OFFSET_STEPS }
        if (others.isEmpty() || jumps.isEmpty() || chosen.last() in jumps) return chosen
        val again = again(others + jumps)
        return if (worth(again) > worth(chosen)) again else chosen
    }

    /** What comes of [kept] where they are tried one after the other. */
    private fun again(kept: List<Trial>): List<Trial> {
        var fit = base
        var heldOut = baseHeldOut
        return kept.map { trial ->
            attempt(fit, heldOut, trial.term.copy(times = emptyList())).also {
                fit = it.fit
                heldOut = it.heldOut
            }
        }
    }

    /** For each of [chosen], those that would explain what it explains as well on this track; itself first. */
    fun alike(chosen: List<Trial>): List<List<Cause>> = chosen.map { trial ->
        if (chosen.size == 1) return@map alike(trial, trial.worth, first)
        // A given number that is wrong at all conditions of the log is not asked by likelihood: another cause holds it.
        val held = chosen.mapNotNull { it.term.cause.conditionalNumber }
        val numbers = trial.term.cause.baseNumbers
        if (numbers.isNotEmpty() && held.containsAll(numbers)) return@map listOf(trial.term.cause)
        val others = chosen.filter { it !== trial }.map { it.term.key }
        val last = chosen.last().fit
        val rest = search.without(last, trial.term, base)
        // Of a gain and an offset another cause holds the offset: where the gain does not show, it was that.
        val isHeld = numbers.any { it in held } && Evidence.pValue(last.score - rest.score, 1) > LIKELY
        if (isHeld) return@map listOf(trial.term.cause)
        val likely = first.filter { it.pValue < LIKELY && it.term.key !in others && it.term.key != trial.term.key }
        val trials = loops.all(likely) { attempt(rest, baseHeldOut, it.term.copy(times = emptyList())) }
        alike(trial, last.score - rest.score - trial.cost, trials)
    }

    /**
     * The smallest set with [trial], worth [own], that holds the cause with the probability of the settings if each
     * was as likely before.
     */
    private fun alike(trial: Trial, own: Double, trials: List<Trial>): List<Cause> {
        val rivals = trials.filter { it.term.key != trial.term.key && isRival(it) }.sortedByDescending { it.worth }
        val weights = rivals.map { exp(minOf((it.worth - own) / 2 / trial.inflation, 0.0)) }
        val total = 1 + weights.sum()
        var covered = 1.0
        val set = arrayListOf(trial.term.cause)
        rivals.forEachIndexed { i, rival ->
            if (covered < settings.setProbability * total) set += rival.term.cause
            covered += weights[i]
        }
        return set.distinct()
    }

    /** What leaves a given number open may owe all that it explains to that number. */
    private fun isRival(trial: Trial) = !isLagAlone(trial) &&
        (trial.pValue < LIKELY || trial.term.cause.conditionalNumber?.let { base.free[it] } ?: true)

    /** Whether [trial] has as much of a second path as there may be, beside a given lag: that is another lag, and no second path. */
    private fun isLagAlone(trial: Trial): Boolean {
        if (trial.term.cause != Cause.TWO_PATH_RESPONSE || base.free[ResponseModel.TIME_CONSTANT]) return false
        val share = trial.fit.model.slot(trial.term) + 1
        return trial.fit.numbers[share] > trial.fit.model.parameters[share].upper - ALL
    }

    companion object {
        /**
         * Of a level: what is there beside a cause must be as much surer. One thing wrong with a log is likelier than two, and
         * what one leaves that is not quite its model is taken by others.
         */
        const val BESIDE = 0.1
        private const val OTHER_BEGINNINGS = 2

        /** Of a share, what it may lack of the most. */
        private const val ALL = 0.01
        private const val LIKELY = 0.01

        /** Twice the log-likelihood by which two sets of causes are not the same. */
        private const val DIFFERENT = 0.5
    }
}
