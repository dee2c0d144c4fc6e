package stillwater.diagnose.blind

import stillwater.diagnose.Candidate
import stillwater.diagnose.Cause
import stillwater.diagnose.Dependence
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.Estimate
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.ModelAssessment
import stillwater.diagnose.Verdict
import stillwater.diagnose.evidence.CoarseRounding
import stillwater.diagnose.evidence.Manoeuvres
import stillwater.diagnose.evidence.SmallShifts
import stillwater.diagnose.evidence.StillReadings
import stillwater.diagnose.evidence.SuddenChanges
import stillwater.diagnose.evidence.UnevenNoise
import stillwater.diagnose.response.ExtendedSensor
import stillwater.diagnose.response.ReferenceLead
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import stillwater.diagnose.three
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt

/** Puts what was found in a log without a reference into words and numbers. */
internal class BlindAnswer(
    private val series: MeasuredSeries,
    private val settings: DiagnosisSettings,
    private val search: BlindSearch,
    private val base: BlindState,
    private val last: BlindState,
    private val lag: BlindLag,
    private val outliers: BlindOutliers,
    private val given: GivenLag?,
) {
    private val estimates = BlindEstimates(series.period)
    private val rounding = CoarseRounding(series, search.used, search.scales.resolution)
    private val isCoarse = rounding.isCoarse(rmse(last.residuals))

    /** In words, where the noise is larger; null where it is even. */
    private val uneven by lazy { UnevenNoise(asFit(last), isInferred = true).words(UNEVEN * settings.level) }

    /** The result. */
    fun of(
        first: BlindRound,
        causes: List<ChosenCause>,
        end: BlindRound,
    ): DiagnosisResult {
        val chosen = causes.map { it.step }
        val looks = end.looks
        val order = order(looks, end.adjustedLooks)
        val left = order.map { i ->
            Dependence(looks[i].name, looks[i].ratio, looks[i].degrees, looks[i].pValue, end.adjustedLooks[i])
        }
        val isLoose = areLoose(first.causes.size + 1)
        val unknown = chosen.mapNotNull { it.trial.term }.filter { UnknownSize.isOf(it, last, assessed(last).errors) }
        val told = causes.filterNot { isLeftOut(it, unknown) }.map { it.causes }
        val isRounded = isCoarse && told.none { Cause.QUANTISATION in it }
        // An unknown water may be as flat as the readings, so that the likelihood alone does not tell of an end.
        val still = StillReadings(asFit(last))
        val level = settings.level / (first.causes.size + 1)
        val range = still.range(level).takeIf { told.none { set -> Cause.SATURATION in set } }
        // A drift or a jump that was chosen is held against such water already.
        val isChangeTold = told.any { Cause.TIME_VARYING_FIELD in it }
        val isChangeNamed = !isChangeTold && isNamedChange(end.changed, chosen)
        val isLikelyChange = end.changed > CHANGED && !isChangeTold && !isChangeNamed
        val all = told + listOfNotNull(
            listOf(Cause.TIME_VARYING_FIELD, Cause.DRIFT).takeIf { isChangeNamed },
            listOf(Cause.OUTLIERS).takeIf { isLoose },
            listOf(Cause.QUANTISATION).takeIf { isRounded },
            listOf(Cause.SATURATION).takeIf { range != null },
        )
        val strongest = order.first()
        // What goes with the boat alone is no lag's of either kind, nor the water's.
        val certain = if (end.look(strongest).ofTime) CERTAIN_OF_TIME else CERTAIN
        val isOthers = end.looksAsIs[strongest].ratio > LEFT * lag.seen ||
            (chosen.isEmpty() && (end.look(strongest).ofBoat || left.first().adjusted < certain))
        // One number for many readings hides all else; what hides in noise shows where nothing was found.
        val isDelayed = told.any { set -> set.any { it in ReferenceLead.ALIKE } }
        val unlisted = still.words(level) ?: last.averaged?.takeIf { isDelayed }?.words()
            ?: if (all.isEmpty()) SuddenChanges.words(last.whitened) else null
        val verdict = verdict(all, left.first(), strongest, end, isOthers, causes, unlisted)
        val isNamed = verdict is Verdict.Named || verdict is Verdict.Ambiguous
        // Where nothing was chosen a lag of either kind was named: the base stands for it, or both kinds in a row.
        val named = if (chosen.isEmpty()) listOf(base, last).distinct().maxBy { heldOut(it).logLikelihood } else last
        val size = outliers.size()?.takeIf { isLoose }
        val leftOut = unknown.mapTo(HashSet()) { it.cause }
        val sensor = ExtendedSensor(asFit(named), size, isRounded, leftOut, range = range)
        val extended = onLog(sensor.spec("extended")).takeIf { isNamed }
        val tried = candidates(first, range, isRounded, still)
        // Of what was only tried nobody need know that it ended at a bound.
        estimates.bounds.clear()
        val lagging = assessment(base)
        val baseline = given?.state?.let { assessment(it) } ?: lagging
        val after = if (named === base) lagging else assessment(named)
        return DiagnosisResult(
            verdict,
            tried,
            baseline,
            after.takeIf { isNamed },
            settings.base?.takeIf { given?.state != null } ?: onLog(ExtendedSensor(asFit(base), null).spec("base")),
            extended,
            verdict.ambiguity.flatten().toSet().takeIf { it.isNotEmpty() }?.let { Manoeuvres.of(it) },
            left,
            outliers.rows,
            warnings(left.first(), verdict, still) + listOfNotNull(CHANGES.takeIf { isLikelyChange }) + little(chosen) +
                unknown.map(UnknownSize::words) + besideNamed(isNamed) + sensor.losses.takeIf { isNamed }.orEmpty() +
                estimates.bounds.distinct(),
            mayHaveChanged = isLikelyChange,
            lag = lag.channel("", assessed(lag.timeConstant).errors[ResponseModel.TIME_CONSTANT]),
        )
    }

    /** Whether [cause] stays in the model and is not named: it shifts readings by next to nothing, or is of [unknown] size. */
    private fun isLeftOut(cause: ChosenCause, unknown: List<Term>): Boolean =
        cause.step.trial.term?.let { isNothing(it) || it in unknown } == true

    private fun warnings(left: Dependence, verdict: Verdict, still: StillReadings) =
        BlindWarnings(series, settings, search, last, lag, outliers, given)
            .of(left, verdict, rounding.takeIf { isCoarse }, still)

    private fun besideNamed(isNamed: Boolean) =
        listOfNotNull(uneven?.takeIf { isNamed }?.let { "Beside what was named $it." })

    /** Whether single readings are wild, among [tried] causes; where the noise is larger for a while far ones are none. */
    private fun areLoose(tried: Int) =
        outliers.pValue * tried < BlindDiagnosis.STRICTER * settings.level && uneven == null

    /** Places of [looks], the surest first: fits without stretches say whether something is left, not what it goes with most. */
    private fun order(looks: List<BlindTrial>, adjusted: List<Double>): List<Int> = looks.indices.sortedWith(
        compareBy<Int>({ adjusted[it] >= settings.structureLevel }, { looks[it].chance })
            .thenByDescending { looks[it].ratio },
    )

    /**
     * Whether water that changes in time, worth [changed] beside those [chosen], is named. Beside rounding nothing else can
     * be looked for. Alone it is said and not named: fixes that jitter make passes disagree as well, and real water is
     * never quite still. Nor is it named where what fixes are off by shows in the readings.
     */
    private fun isNamedChange(changed: Double, chosen: List<BlindStep>): Boolean = changed > NAMED_CHANGE &&
        chosen.isNotEmpty() && chosen.none { it.trial.term?.cause == Cause.QUANTISATION } && !search.fixes.isWide(last)

    /**
     * Where [left] is the [strongest] of what is left at the [end], which [isOthers] if a lag that may be of either kind is
     * not enough for it; [unlisted] is what hides all else, in words.
     */
    private fun verdict(
        all: List<List<Cause>>,
        left: Dependence,
        strongest: Int,
        end: BlindRound,
        isOthers: Boolean,
        causes: List<ChosenCause>,
        unlisted: String?,
    ): Verdict {
        val chosen = causes.map { it.step }
        val isOpen = lag.isOpen(settings.separation) && (chosen.isEmpty() || !lag.isToldIn(last, assessed(last).errors))
        // Like is held against like: a cause has water and noise of its own, the lag's kinds have the model's.
        val weakest = chosen.minOfOrNull { it.trial.sureness }
        val outweighs = when {
            isOpen && isOthers -> true
            weakest != null -> end.looks[strongest].sureness > LEFT * weakest
            else -> !isOpen
        }
        // An end at which readings stand still is in no model, and shows in what is left.
        val isEnded = listOf(Cause.SATURATION) in all && chosen.none { it.trial.term?.cause == Cause.SATURATION }
        val isStructured = left.adjusted < settings.structureLevel && outweighs && !isEnded
        val isOfFixes = end.look(strongest).ofWater && search.fixes.areFar(last)
        val sets = all + listOfNotNull(lagSet(isOpen))
        val contradicted = causes.firstOrNull { it.isContradicted && it.causes.first() !in NOT_HALVED }?.step?.trial
        return when {
            unlisted != null -> Verdict.Unexplained(unlisted, listOfNotNull(openLag(isOpen)))
            contradicted != null -> Verdict.Unexplained(
                "the halves of the log contradict each other about the ${contradicted.name}",
                listOfNotNull(openLag(isOpen)),
            )
            isStructured && !isOfFixes ->
                Verdict.Unexplained("the residuals depend on ${left.description}", listOfNotNull(openLag(isOpen)))
            isStructured && !(isOpen && chosen.isEmpty()) ->
                Verdict.InsufficientData("fixes that are so far off may be why residuals depend on ${left.description}")
            sets.isEmpty() && !lag.isSeen && longest() > MOST_STEPS * series.period ->
                Verdict.InsufficientData(NO_LAG + atMost(longest()))
            sets.isEmpty() && base.timeConstant > LONGEST * series.duration -> Verdict.InsufficientData(
                "what passes over the same water show would take a lag of ${three(base.timeConstant)} s, which " +
                    "such a log cannot tell from water that changes, or from positions that are wrong",
            )
            else -> otherLag(all, end)?.let { Verdict.Unexplained(it, listOfNotNull(openLag(isOpen))) } ?: verdict(sets)
        }
    }

    private fun verdict(sets: List<List<Cause>>): Verdict = when {
        sets.isEmpty() -> uneven?.let(Verdict::Unexplained) ?: Verdict.Consistent
        sets.any { it.size > 1 } -> Verdict.Ambiguous(sets)
        else -> Verdict.Named(sets.map { it.single() })
    }

    /**
     * In words, that the lag changed while the log was written, as its halves by themselves say it; null where they do not,
     * where something is named in [all], or where at the [end] nothing points to it, neither a look nor water that changes.
     */
    private fun otherLag(all: List<List<Cause>>, end: BlindRound): String? {
        if (all.isNotEmpty()) return null
        val isLikely = end.looksAsIs.any { it.name == BlindLooks.LAG_CHANGES && it.gain > LAG_CHANGES }
        return if (isLikely || end.changed > FAR_CHANGED) LagOfHalves(series, settings, search.loops).words() else null
    }

    /** What is to be said of the lag: that it is not the given one, or that it is of one kind or the other. */
    private fun lagSet(isOpen: Boolean): List<Cause>? = when {
        given?.state != null && given.pValue > settings.level -> null
        isOpen -> listOf(Cause.TIME_CONSTANT, Cause.DEAD_TIME)
        given?.state != null -> listOf(Cause.TIME_CONSTANT)
        else -> null
    }

    /** The kinds of lag where it may be either: a lag is there whatever else is. */
    private fun openLag(isOpen: Boolean): List<Cause>? = lagSet(isOpen)?.takeIf { it.size > 1 }

    /** The longest time constant that the log allows, s: the upper end of the interval that the answer shows. */
    private fun longest(): Double =
        base.timeConstant *
            exp(
                (BlindErrors.REACH * assessed(base).errors[ResponseModel.TIME_CONSTANT])
                    .coerceAtMost(BlindEstimates.MOST_REACH),
            )

    /** That a lag is no longer than [most], s, in words; nothing where that is as long as the log allows. */
    private fun atMost(most: Double) =
        if (most < LONGEST * series.duration) "; it is ${three(most)} s at the most" else ""

    /** Whether [term] shifts readings by no more than a simulation in fine steps does. */
    private fun isNothing(term: Term) = BlindTerms.isLittle(term, last, SmallShifts.SIMULATED_ROWS)

    /** [found] as a sensor on the log as it was given. */
    private fun onLog(found: SensorSpec) = given?.delayed(found) ?: found

    /** What is to be said of those [chosen] that do little, however surely. */
    private fun little(chosen: List<BlindStep>) =
        chosen.mapNotNull { it.trial.term }.filter { BlindTerms.isLittle(it, last) }.map { term ->
            if (isNothing(term)) {
                SmallShifts.words(term, last.model, last.numbers, "it is a ${SmallShifts.LITTLE}")
            } else {
                "The ${term.cause.label} is a ${SmallShifts.LITTLE}"
            }
        }

    private fun asFit(state: BlindState) = state.asFit(search.free(state.model))

    private fun rmse(residuals: DoubleArray): Double {
        val rows = residuals.indices.filter { search.used[it] }
        return sqrt(rows.sumOf { residuals[it] * residuals[it] } / maxOf(rows.size, 1))
    }

    private fun assessment(state: BlindState): ModelAssessment {
        val spread = sqrt(maxOf(state.variance, 1e-300))
        val noise = state.fit.design.noise.noise
        val heldOut = heldOut(state)
        return ModelAssessment(
            estimates.of(state.model, state.numbers, assessed(state).errors, state.model.terms),
            rmse(state.residuals),
            heldOut.rmse,
            heldOut.logLikelihood,
            state.shown,
            spread,
            noise.share,
            noise.time,
            DoubleArray(series.size) { state.whitened[it] / spread },
            state.fit::nullResiduals,
        )
    }

    private val assessed = HashMap<BlindState, BlindAssessed>()

    private fun assessed(state: BlindState) = assessed.getOrPut(state) { BlindAssessed(search, state) }

    private fun heldOut(state: BlindState) = assessed(state).heldOut

    /**
     * All that was tried on the [first] model, the likeliest first: with the [range] at whose ends readings stand [still],
     * where that is named, and with rounding as sure as these show it if it [isRounded].
     */
    private fun candidates(
        first: BlindRound,
        range: SensorStage.Range?,
        isRounded: Boolean,
        still: StillReadings,
    ): List<Candidate> = candidates(first).map { candidate ->
        when {
            candidate.cause == Cause.SATURATION && range != null -> candidate.ended(range, still)
            isRounded -> candidate.surelyRounded()
            else -> candidate
        }
    } + outliers.beside(rmse(first.state.residuals), first)

    private fun candidates(first: BlindRound): List<Candidate> {
        val state = first.state
        val predicted = state.shown
        val list = first.causes.mapIndexed { i, trial ->
            val model = checkNotNull(trial.model)
            val point = checkNotNull(trial.point)
            val term = checkNotNull(trial.term)
            // What was chosen may be right only beside others, and with steps that are held otherwise.
            val kept = last.model.terms.firstOrNull { it.key == term.key }
            val numbers = if (kept != null) {
                estimates.of(last.model, last.numbers, assessed(last).errors, listOf(kept))
            } else {
                val fit = trial.state?.fit ?: state.fit
                val z = trial.state?.whitened ?: fit.residual(point.residuals)
                // Of what was only tried stretches are not asked.
                val errors = BlindErrors.of(search, fit, model, point.numbers, z)
                for (k in errors.indices) errors[k] *= BlindErrors.WIDER
                estimates.of(model, point.numbers, errors, listOf(model.terms.last()))
            }
            Candidate(
                term.cause,
                term.condition,
                numbers,
                rmse(state.residuals) * sqrt(exp(-trial.ratio * trial.inflation / series.size)),
                Double.NaN,
                Double.NaN,
                trial.pValue,
                first.adjustedCauses[i],
                DoubleArray(series.size) { predicted[it] + trial.change[it] },
            ) to trial.worth
        }
        return listOfNotNull(givenCandidate()) + list.sortedByDescending { it.second }.map { it.first }
    }

    private fun givenCandidate(): Candidate? = given?.state?.let {
        val free = assessment(base)
        val p = given.pValue
        Candidate(
            Cause.TIME_CONSTANT,
            null,
            free.parameters,
            free.trainRmse,
            Double.NaN,
            Double.NaN,
            p,
            p,
            free.predicted,
        )
    }

    private companion object {
        const val LEFT = 0.25

        /** Twice a gain in log-likelihood of a lag that changes in time from which halves are asked; chance gave 3.5. */
        const val LAG_CHANGES = 30.0

        /** The same of water that changes: a lag that doubled made 1300 to 2950 of it. */
        const val FAR_CHANGED = 100.0
        const val NO_LAG = "passes over the same water do not agree for certain that there is a lag"

        /** Of the log's duration: a lag that is longer would be seen to end in few of its parts. */
        const val LONGEST = 0.2

        /** Adjusted p-value below which what is left is told beside an open lag, of whatever size that is. */
        const val CERTAIN = 1e-3

        /** The same of what goes with time alone: what the noise's model does not know of a real log gave 4e-6. */
        const val CERTAIN_OF_TIME = 1e-6

        /**
         * Twice the gain in log-likelihood over inflation from which water that changes is told where no drift is named:
         * of 108 simulated logs without an effect and with all waves two had 19.9 and 21.9, the others below 9 (seeds
         * 194000 to 197079).
         */
        const val CHANGED = 25.0

        const val CHANGES =
            "The log is likelier where the water, or the sensor's zero, is let change while it was measured: it may " +
                "have changed."

        /**
         * The same from which it is named beside a cause: less may be fixes that jitter (33.6 in 236051, nothing wrong), or the
         * waves that suit the cause (26.8 and 28.4 in 234153 and 234097, where nothing changes). A jump would have been sure by
         * itself from here on, wherever it is.
         */
        const val NAMED_CHANGE = 40.0

        /** Causes that halves of a log do not contradict: what happens once, and steps that all readings are on. */
        val NOT_HALVED = BlindDiagnosis.SLOW + Cause.QUANTISATION
        const val MOST_STEPS = 3

        /** Of the level at which noise is uneven: what the water's waves lack may make some of it. */
        const val UNEVEN = 1e-4
    }
}
