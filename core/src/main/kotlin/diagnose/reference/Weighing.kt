package stillwater.diagnose.reference

import stillwater.diagnose.Candidate
import stillwater.diagnose.Cause
import stillwater.diagnose.Dependence
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.Estimate
import stillwater.diagnose.Loops
import stillwater.diagnose.NamedEffect
import stillwater.diagnose.Verdict
import stillwater.diagnose.evidence.AveragedNoise
import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.evidence.FitReport
import stillwater.diagnose.evidence.HeldOut
import stillwater.diagnose.evidence.LooseReadings
import stillwater.diagnose.evidence.Manoeuvres
import stillwater.diagnose.evidence.QuickMoves
import stillwater.diagnose.evidence.SmallShifts
import stillwater.diagnose.evidence.StillReadings
import stillwater.diagnose.evidence.Structure
import stillwater.diagnose.evidence.Trial
import stillwater.diagnose.evidence.UnevenNoise
import stillwater.diagnose.evidence.without
import stillwater.diagnose.isFlat
import stillwater.diagnose.response.ExtendedSensor
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ReferenceGaps
import stillwater.diagnose.response.ReferenceLead
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.SpikeSize
import stillwater.diagnose.response.Term
import stillwater.diagnose.response.isAdded
import stillwater.diagnose.response.isTiming
import stillwater.diagnose.three
import stillwater.model.Conditions
import stillwater.model.Interval
import kotlin.math.abs
import kotlin.math.sqrt

/**
 * The weighing of all causes on top of [base], a model without them.
 *
 * @param used rows that are fitted. @param spikes rows that are not, because they are far off by themselves.
 * @param late by how much the reference was late, s, before it was put right; 0 where it was not.
 * @param loops how what can be done at once is. @param before the share that the row before has in the truth that is held
 * over each step.
 */
internal class Weighing(
    private val search: CauseSearch,
    val base: ModelFit,
    private val used: BooleanArray,
    val spikes: List<Int>,
    private val settings: DiagnosisSettings,
    private val late: Double,
    private val before: Double,
    private val loops: Loops,
    told: (Int) -> Unit,
) {
    private val series = base.model.series
    private val scales = base.model.scales
    private val report = FitReport(series, used, isOpen = before == 0.0)
    private val baseHeldOut = HeldOut.score(base, used)
    private val truth = requireNotNull(series.reference) { "weighing needs a reference" }
    private val terms = terms().filter { it.cause.isAdded || !ConstantTruth.isOf(series) }

    /** What was tried, each cause alone first. */
    val forward = ForwardSearch(search, base, baseHeldOut, terms, settings, loops) { told(terms.size) }

    private val water = ChangingWater(series, truth)

    /**
     * All that is tried; outliers, changes that last, a change of the water, a late reference, readings that stand still and
     * noise that is not even included.
     */
    private val tried = terms.size + 6

    /** What was chosen, one after the other. */
    val chosen: List<Trial> = forward.chosen()

    /** The model with all that was chosen. */
    val last: ModelFit = chosen.lastOrNull()?.fit ?: base

    /** Twice the log-likelihood of [last], less what its numbers would gain by chance. */
    val explained: Double get() = last.score - chosen.sumOf { it.cost }

    /** What of the answer is a shift that may be none. */
    val shifts: SmallShifts = SmallShifts(last, base, late)

    /** How many of what was chosen are more than the way the log is sampled may make. */
    val clear: Int get() = chosen.count { !shifts.isSmall(it, listOf(it.term.cause)) }

    /** Whether the log's speeds differ enough to tell an offset of place. */
    val hasPlace: Boolean get() = terms.any { it.cause == Cause.POSITION_OFFSET }

    private val warnings = ReferenceWarnings(base, last, settings, late, before)

    private val still by lazy { StillReadings(last) }
    private val coarse by lazy { CoarseTruth(base, last, report) }

    /** In words, what the noise goes with; null where it is even. */
    private val uneven by lazy { UnevenNoise(last).words(settings.level / tried) }
    private val left by lazy { Structure.dependences(last, search.longest) }

    private val averaged by lazy { AveragedNoise.of(last.whitened, series.values, series.times) }

    /** Whether something is left for certain beside what was chosen. */
    val isStructured: Boolean get() = left.first().adjusted < settings.structureLevel
    private val faults by lazy { ReferenceFaults(search, base, baseHeldOut, used, tried, settings.level) }

    /**
     * Twice the log-likelihood with a reference that is late in the place of all that was chosen, where that is certain
     * and explains as much; else null.
     */
    val lateness: Double? get() = faults.lateness.takeIf { faults.isLate(explained) }

    /**
     * [lateness] where that is more than an ordinary reference's: what is put right as a lag of the reference must explain
     * as much, which it does not of a clock that is behind.
     */
    val farLateness: Double? get() = faults.lateness.takeIf { faults.isFarLate(explained) }

    /** The answer. */
    fun result(): DiagnosisResult {
        val loose = LooseReadings(last)
        val outliers = loose.pValue * tried < settings.level
        val changing = water.pValue * tried < settings.level
        val rounded = chosen.none { it.term.cause == Cause.QUANTISATION } && isRounded
        val certain = listOfNotNull(
            Cause.QUANTISATION.takeIf { rounded },
            Cause.OUTLIERS.takeIf { outliers },
            Cause.TIME_VARYING_FIELD.takeIf { changing },
        )
        val sets = forward.alike(chosen).map(::withPlace)
        val (equal, others) = chosen.zip(sets).partition { (trial, _) -> mayBeEqual(trial.term) }
        val (small, clear) = others.partition { (trial, set) -> shifts.isSmall(trial, set) }
        val verdict =
            hung() ?: insufficient() ?: unlisted(loose) ?: verdict(clear.map { it.second }, certain, left.first())
        val named = verdict is Verdict.Named || verdict is Verdict.Ambiguous
        val size = loose.size().takeIf { outliers }
        val unnamed = (equal + small).map { (trial, _) -> trial.term.cause }.toSet()
        val sensor = ExtendedSensor(last, size, rounded, leftOut = unnamed, hasWander = true)
        val extended = if (named) sensor.spec("extended") else null
        val candidates = candidates(size, loose.pValue).map { if (rounded) it.surelyRounded() else it }
        val shifted = if (equal.isEmpty() && small.isNotEmpty()) shiftedBase(verdict, clear.map { it.first }) else null
        val baseline = shifted?.let(::assessment) ?: report.assessment(base, baseHeldOut)
        val baseSensor = ExtendedSensor(shifted ?: base, null, leftOut = unnamed, hasWander = true)
        val after = if (named) assessment(last) else null
        return DiagnosisResult(
            verdict,
            candidates,
            baseline,
            after,
            settings.base ?: baseSensor.spec("base"),
            extended,
            (verdict as? Verdict.Ambiguous)?.let { open ->
                Manoeuvres.of(open.sets.filter { it.size > 1 }.flatten().toSet())
            },
            left,
            (spikes + series.wild.keys).sorted(),
            warnings.of(left.first(), verdict, uneven, faults.caution(explained), spikes.size, still, averaged) +
                shifts.words(small.map { it.first }) +
                listOfNotNull(EQUAL.takeIf { equal.isNotEmpty() }) +
                shifts.cautions(clear).takeIf { named }.orEmpty() + report.warnings +
                listOfNotNull(BESIDE.takeIf { named && unnamed.isNotEmpty() }) +
                if (named) sensor.losses + lost(changing) else emptyList(),
            if (named) clear.map { (trial, _) -> effect(trial.term) } else emptyList(),
            water.revisits(),
        )
    }

    /**
     * The base with the shifts that are fitted beside and not named, without the [named] causes: without those, lag and gain
     * make up for them, and what was named would have their part in its gain. Null where nothing is told of the log.
     */
    private fun shiftedBase(verdict: Verdict, named: List<Trial>): ModelFit? {
        if (verdict is Verdict.Unexplained || verdict is Verdict.InsufficientData) return null
        if (named.isEmpty()) return last
        val tau = last.numbers[ResponseModel.TIME_CONSTANT]
        return last.without(named, tau, scales, last.model.steps, used, search.longest)
    }

    /** A boat that keeps its speed has a probe behind it that is late by the same time everywhere: a dead time may be that. */
    private fun withPlace(set: List<Cause>): List<Cause> {
        val isSteady = !hasPlace && series.isMoving && !isFlat(series.y)
        return if (isSteady && set == listOf(Cause.DEAD_TIME)) set + Cause.POSITION_OFFSET else set
    }

    /**
     * Whether [term] is two paths that may as well be one: how much slower the second is has an interval that holds 1, or its
     * share may be all there is.
     */
    private fun mayBeEqual(term: Term): Boolean {
        if (term.cause != Cause.TWO_PATH_RESPONSE) return false
        val own = report.estimates(last, listOf(term)).associate { it.name to it.interval }
        val ratio = own["slow_ratio"] ?: return false
        return ratio.lower <= 1 || (own["slow_share"]?.upper ?: 0.0) >= 1
    }

    /** Whether rounding makes a quarter of the noise: it need not show in what the model foretells of single readings. */
    private val isRounded: Boolean get() = scales.resolution * scales.resolution / 12 > ROUNDED * last.variance

    private fun assessment(fit: ModelFit) = report.assessment(fit, HeldOut.score(fit, used))

    private fun effect(term: Term) = NamedEffect(term.cause, report.estimates(last, listOf(term)))

    private fun lost(changing: Boolean) = if (changing) {
        listOf("A change of the water belongs to the field, not to the sensor: the sensor file does not hold it.")
    } else {
        emptyList()
    }

    private fun terms(): List<Term> = buildList {
        if (settings.base != null) {
            add(Term(Cause.TIME_CONSTANT))
            add(Term(Cause.GAIN_OFFSET))
        }
        add(Term(Cause.ASYMMETRIC_RESPONSE))
        add(Term(Cause.SECOND_ORDER_RESPONSE))
        add(Term(Cause.TWO_PATH_RESPONSE))
        add(Term(Cause.DEAD_TIME))
        add(Term(Cause.SLEW_LIMIT))
        val spread = sqrt(scales.logSpeed.map { it * it }.average())
        val moving = series.isMoving
        if (moving && spread > LEAST_SPREAD) add(Term(Cause.FLOW_DEPENDENT_RESPONSE))
        if (scales.warmth.any { abs(it) > LEAST_WARMTH }) add(Term(Cause.TEMPERATURE_DEPENDENT_RESPONSE))
        for ((name, column) in scales.centred) {
            if (name != Conditions.HEADING && column.any { it != 0.0 }) add(Term(Cause.CROSS_SENSITIVITY, name))
        }
        add(Term(Cause.DRIFT))
        // A handful of rows has no place for a jump.
        if (series.readRows().count { it } >= FEWEST_ROWS) add(Term(Cause.OFFSET_STEPS))
        add(Term(Cause.HYSTERESIS))
        if (scales.resolution > COARSE * sqrt(base.variance)) add(Term(Cause.QUANTISATION))
        add(Term(Cause.SATURATION))
        // What stirs a beaker has a speed and goes nowhere.
        if (moving && series.hasPlaces && spread > LEAST_SPREAD) add(Term(Cause.POSITION_OFFSET))
    }

    private fun verdict(sets: List<List<Cause>>, certain: List<Cause>, left: Dependence): Verdict {
        val all = sets + certain.map { listOf(it) }
        val structured = isStructured
        // A truth that is guessed between rows swings beyond both ends of what it does; readings that stand still at one end
        // do so whatever it does.
        val isAtEnd by lazy { still.atEnd < settings.level / tried }
        val isTiming = structured || sets.flatten().any { it.isTiming || (it == Cause.SATURATION && !isAtEnd) }
        return when {
            isTiming && isMostlyUnknown(structured, all.size) -> Verdict.InsufficientData(
                "the truth often moves within a row or two, and how it went in between might explain what is left",
            )
            isTiming && series.isSparse && ReferenceGaps.reach(base) > MOST_UNKNOWN -> Verdict.InsufficientData(
                "the reference is known every ${three(series.period)} s only, and how the truth " +
                    "went in between might explain what is left",
            )
            // A clock that is behind is no lag of a reference, and leaves something that is put right as one.
            all.isEmpty() && late > ReferenceLead.ordinary(base) -> Verdict.Unexplained(ReferenceLead.words(late))
            structured && isMore(left) -> coarse.left()?.let(Verdict::InsufficientData)
                ?: Verdict.Unexplained(LeftOver(base, chosen).words(left))
            sets.isNotEmpty() && coarse.chosen != null -> Verdict.InsufficientData(checkNotNull(coarse.chosen))
            all.isEmpty() && ConstantTruth.isOf(series) -> Verdict.InsufficientData(ConstantTruth.words(base))
            all.isEmpty() -> (passing() ?: uneven)?.let(Verdict::Unexplained) ?: Verdict.Consistent
            all.any { it.size > 1 } -> Verdict.Ambiguous(all)
            else -> Verdict.Named(all.map { it.single() })
        }
    }

    /**
     * Whether the truth moves within a row so often that how the reading follows it is not known. It is known all the same
     * where readings after such moves are foretold, by a model that leaves nothing [structured] beside what was chosen, and
     * where one cause, of the [found] ones, leaves nothing: how the truth went in between would.
     */
    private fun isMostlyUnknown(structured: Boolean, found: Int): Boolean {
        if (scales.unknown?.isMostly != true || (!structured && found == 1)) return false
        return (structured && chosen.isNotEmpty()) || !QuickMoves.areForetold(last, search.longest)
    }

    /** Whether [left], which is there, is as strong as the weakest of what was chosen, or a part of it and surer. */
    private fun isMore(left: Dependence): Boolean {
        val least = chosen.minOfOrNull { it.ratio } ?: 0.0
        val isSurer = left.adjusted < ForwardSearch.BESIDE * settings.structureLevel
        return left.ratio > if (isSurer) LEFT * least else least
    }

    /**
     * In words, what is there for certain although no cause that would explain it foretells rows it was not fitted to: what
     * comes and goes, as bubbles, weed or a loose plug, looks like jumps that are others in each part of a log. Else null.
     */
    private fun passing(): String? {
        if (chosen.isNotEmpty()) return null
        val adjusted = Evidence.holm(forward.first.map { it.pValue }, tried)
        val surest = adjusted.indices.filterNot { forward.first[it].foretells }.minByOrNull { adjusted[it] }
        if (surest == null || adjusted[surest] >= PASSING * settings.level) return null
        return "it comes and goes: ${forward.first[surest].term.cause.label} would explain part of what is left, for " +
            "certain, but what one part of the log says of it does not hold in another"
    }

    /** What hides all else: who gives one number for many readings shows no lag. */
    private fun hung(): Verdict? = still.words(settings.level / tried)?.let(Verdict::Unexplained)

    /** What explains the log better than any cause of the list and is none. */
    private fun unlisted(loose: LooseReadings): Verdict? {
        val isTwoPath = chosen.any { it.term.cause == Cause.TWO_PATH_RESPONSE }
        faults.words(explained, isTwoPath)?.let { return Verdict.Unexplained(it) }
        SlowRivals(last, chosen).words()?.let { return Verdict.Unexplained(it) }
        val isOpen = chosen.isNotEmpty() || isStructured
        val rest = WithoutDelays(base, chosen, search.longest)
        val mean = if (isOpen) RunningMean(rest, averaged, loops).rival() else null
        val clock = ClockDrift(rest, loops).rival()
        listOfNotNull(mean, clock).maxByOrNull { it.worth }?.let { return Verdict.Unexplained(it.words) }
        val lasting = loose.lasting.size
        return when {
            lasting >= FEWEST_CHANGES && loose.lastingPValue * tried < settings.level && chosen.isEmpty() ->
                Verdict.Unexplained("the readings change suddenly $lasting times and come back slowly, as with bubbles")
            else -> null
        }
    }

    private fun insufficient(): Verdict? {
        val rows = series.readRows().count { it }
        if (rows < FEWEST_ROWS) {
            return Verdict.InsufficientData("there are $rows rows only, and $FEWEST_ROWS are needed")
        }
        val seen = base.free[ResponseModel.TIME_CONSTANT] &&
            base.numbers[ResponseModel.TIME_CONSTANT] > series.period / 2
        // A lag that the base cannot tell may be plain once what hides it is in the model.
        if (seen && setOf(base, last).all { report.timeConstantError(it) > 1 }) {
            return Verdict.InsufficientData("the truth changes too little to show any lag")
        }
        return null
    }

    private fun candidates(size: SpikeSize?, outlierP: Double): List<Candidate> {
        val first = forward.first
        val adjusted = Evidence.holm(first.map { it.pValue } + outlierP + water.pValue)
        val list = first.mapIndexed { i, trial ->
            // Blocks are held out for what is worth a look.
            val isHeldOut = trial.heldOut !== baseHeldOut
            Candidate(
                trial.term.cause,
                trial.term.condition,
                report.estimates(trial.fit, listOf(trial.term)),
                report.rmse(trial.fit),
                if (isHeldOut) trial.heldOut.rmse else Double.NaN,
                if (isHeldOut) trial.heldOut.logLikelihood else Double.NaN,
                trial.pValue,
                adjusted[i],
                report.predicted(trial.fit),
            ) to trial.worth
        }
        val change = water.rate.takeIf { it.isFinite() }?.let { rate ->
            val interval = Interval(rate - NORMAL_95 * water.error, rate + NORMAL_95 * water.error)
            listOf(Estimate("rate_per_s", "sensor units/s", rate, interval))
        }
        return list.sortedByDescending { it.second }.map { it.first } +
            beside(Cause.OUTLIERS, size?.numbers.orEmpty(), outlierP, adjusted[first.size]) +
            beside(Cause.TIME_VARYING_FIELD, change.orEmpty(), water.pValue, adjusted[first.size + 1])
    }

    /** A cause that changes nothing in what the model shows of the reference. */
    private fun beside(cause: Cause, parameters: List<Estimate>, pValue: Double, adjusted: Double) = Candidate(
        cause,
        null,
        parameters,
        report.rmse(base),
        Double.NaN,
        Double.NaN,
        pValue,
        adjusted,
        report.predicted(base),
    )

    private companion object {
        const val FEWEST_ROWS = 60

        /** Of two paths that may be one. */
        const val EQUAL =
            "A second path was fitted and is not named: it may be as fast as the first or all there is."

        /** Of what was too small to be named. */
        const val BESIDE =
            "The errors of the extended model are those with what was fitted beside; the sensor file is without it."

        /** Sudden changes that last: fewer are jumps. */
        const val FEWEST_CHANGES = 5
        const val NORMAL_95 = 1.96
        const val LEFT = 0.25
        const val LEAST_SPREAD = 0.03
        const val LEAST_WARMTH = 0.05
        const val COARSE = 0.3

        /** Of the level: what no cause of the list foretells must be as much surer. */
        const val PASSING = 0.01

        /** Of the noise's variance: more of it is told of rounding. */
        const val ROUNDED = 0.25

        /** Standard errors by which what is not known of the truth may move a fit before its causes are in doubt. */
        const val MOST_UNKNOWN = 2.0
    }
}
