package stillwater.diagnose

import kotlin.math.abs
import kotlin.math.sqrt

/**
 * Finds what a simulation gets wrong about a measured log, by name.
 *
 * A first-order lag with gain and offset, or the given sensor, is fitted to the log under noise of which a part may be
 * correlated. Each cause is then a nested extension: fitted, weighed by its likelihood ratio corrected for what
 * correlation the noise model has missed, for the number of causes tried (Holm) and held to a gain on held-out blocks.
 * The best is added and the search goes on. What the extended model still leaves is looked through for dependences of
 * any kind. Derivation in core/docs/Diagnosis.md.
 *
 * Pure: the same log gives the same answer. Cost: of the order of a second for a thousand rows.
 *
 * @param loops how what can be done at once is; the answer is the same bits.
 * @param before the share that the row before has in the reference of [series], which is held over each step; 0 of a log.
 * @param progress told how much is done, a share within 0..1 that grows; at most a few hundred times.
 * @throws IllegalArgumentException if there is a reference and parts of the given sensor would be lost, or take a
 *   condition that [series] has not; the message is for the user.
 */
public class Diagnosis private constructor(
    private val series: MeasuredSeries,
    private val settings: DiagnosisSettings,
    private val loops: Loops,
    private val before: Double,
    private val progress: (Double) -> Unit,
) {
    public constructor(
        series: MeasuredSeries,
        settings: DiagnosisSettings = DiagnosisSettings(),
        loops: Loops = Loops.IN_TURN,
        progress: (Double) -> Unit = {},
    ) : this(series.fromStart(), settings, loops, 0.0, progress)

    private val unknown = UnknownTruth.of(series)
    private val used = series.readRows()
    private val longest = CauseSearch.longest(series, settings)
    private var trials = 0

    init {
        if (series.reference != null) settings.base?.let { GivenSensor.requireKnown(it, series.conditions.keys) }
    }

    /** The base model as it looks with nothing known of gaps, sharp fronts and single wild readings. */
    private val rough by lazy { base(null, null) }

    /** What the reference leaves open of the readings, which may be late by whole rows. */
    private val shaken by lazy { if (unknown.isSharp) unknown.seen(late()) else unknown }

    /** The answer. Without a reference the field is inferred together with the sensor. */
    public fun run(): DiagnosisResult {
        val reference = series.reference ?: return withoutReference().also { progress(1.0) }
        val sane = series.withoutWild()
        val truth = sane.reference ?: reference
        val wrong = reference.indices.count { truth[it] != reference[it] }
        val diagnosis = if (sane === series) this else Diagnosis(sane, settings, loops, progress)
        val notes = listOfNotNull(WildNumbers.words(wrong).takeIf { wrong > 0 })
        return diagnosis.answer(truth).ofRead(series.isRead, notes).also { progress(1.0) }
    }

    private fun withoutReference(): DiagnosisResult {
        val given = settings.base ?: return LongDelay(series, settings, loops, progress).answer()
        if (GivenLag.delay(given) > 0) return GivenDelay(series, settings, given, loops, progress).answer()
        return BlindDiagnosis(series, settings, loops, progress).run()
    }

    private fun answer(reference: DoubleArray): DiagnosisResult {
        // Of readings that never change any lag that is long enough is as likely as any end of a range.
        TooLittle.still(series)?.let { return BlindAnswer.none(series, it) }
        TooLittle.inGaps(series, unknown.isGap)?.let { why ->
            return UnwrittenMoves(series, unknown.isGap, settings.base).answer(why)
        }
        val quieter = quieter(reference)
        val weighed = if (quieter == null) weighed() else likelier(Diagnosis(quieter, settings, loops, 0.0, progress))
        return weighed.result()
    }

    /**
     * The weighing by [quiet], whose reference has less noise, unless what it has less was the truth's own: then this one
     * explains more, and with no more causes, which might make up for the noise.
     */
    private fun likelier(quiet: Diagnosis): Weighing {
        val quieter = quiet.weighed()
        val noisier = weighed()
        val isLikelier = noisier.explained > quieter.explained + HELD && noisier.chosen.size <= quieter.chosen.size
        return if (isLikelier) noisier else quieter
    }

    /**
     * This log with a reference of less noise, where its own noise shows in the readings; null where it does not. A
     * model that takes noise for truth is wrong in its response, whatever the sensor's.
     */
    private fun quieter(reference: DoubleArray): MeasuredSeries? {
        // Water that changes faster than a sparse reference shows looks like noise.
        if (series.size < FEWEST || series.isSparse) return null
        val noise = ReferenceNoise(series.times, reference, unknown.isBroken)
        val shown = noise.spread * abs(rough.numbers[ResponseModel.GAIN])
        if (!(shown > NOISY * Spikes.spread(series.shown(rough.whitened)))) return null
        // How much of its noise is taken off is asked of the readings: what is left would make a response that smooths
        // it (the truth held, and a lag more that undoes the lead) look likelier than the right one. Nothing is to go
        // that is more than the noise.
        val courses = SmoothCourse(reference, unknown.isBroken)
        val most = noise.spread * (1 + CLEARLY / sqrt(2.0 * series.size))
        val smooth = SmoothCourse.STIFFNESSES.map(courses::of).filter { course ->
            squares(DoubleArray(series.size) { reference[it] - course[it] }) <= most * most * series.size
        }
        return (smooth + noise.smoothed()).map(series::withQuieter).maxBy(::explained)
    }

    /** Twice the log-likelihood of the base for [quiet], this log with another reference. */
    private fun explained(quiet: MeasuredSeries): Double {
        val model = ResponseModel(quiet, rough.model.terms, Steps.EVEN, Scales(quiet, unknown))
        return Fitting.fit(model, rough.numbers, rough.free, used, longest, guess = rough.noise).score
    }

    private fun weighed(): Weighing {
        val first = weighing(null).let { if (isAhead(it)) better(it, -HELD, Steps.EVEN) else it }
        // Whether steps are held shows only once the response is right: the other way is tried with what was named, and
        // with each beginning of it, because what came after may make up for the wrong way.
        // Where it moves in sharp steps a row's delay goes with the one way and half of it with the other, too much for
        // the numbers of one to do for the other.
        val doubtful = (unknown.isSharp && first.chosen.isNotEmpty()) ||
            first.chosen.any { turned(it.fit).score > it.fit.score + HELD }
        // A place ahead by just what a held truth is ahead by is rather that.
        val isLikeHeld = first.chosen.any { first.shifts.isLikeHeld(it.term) }
        val own = first.last.model.steps
        val turned = if (doubtful || isLikeHeld) better(first, if (isLikeHeld) HELD else 0.0, own.other) else first
        // What makes sharp steps look late may have hidden the third way.
        val third = (Steps.entries - own - own.other).filter { doubtful && unknown.isSharp }
        val weighed = third.fold(turned) { best, steps -> better(best, -HELD, steps) }
        // Sharp steps that are held until the next row are a row late, which a dead time may do as well.
        val isLate =
            weighed.last.model.steps == Steps.UNTIL_NEXT && weighed.chosen.any { it.term.cause == Cause.DEAD_TIME }
        if (isLate) return better(weighed, HELD, Steps.HELD)
        return led(weighed) ?: untilNext(weighed) ?: weighed
    }

    /** Whether a sensor ahead of the boat may explain more than the truth held over each step that [weighing] has. */
    private fun isAhead(weighing: Weighing): Boolean {
        if (weighing.base.model.steps != Steps.HELD || !weighing.hasPlace || unknown.isSharp) return false
        return isProbeAhead(weighing.base, base(Steps.EVEN, weighing.base), used, longest, HELD)
    }

    /**
     * The weighing with a reference that is late by a few rows at most put right, where the log is then as likely without
     * some of the shifts and second paths among what was chosen in [first], or, where there are none, as with readings
     * that are ahead of the reference for certain; null where it is not.
     */
    private fun led(first: Weighing): Weighing? {
        if (unknown.isSharp || series.isSparse) return null
        val shifts = first.chosen.filter { it.term.cause in ReferenceLead.ALIKE }
        // A time constant that was given and is too long does by itself what a late reference does.
        if (settings.base != null && shifts.isEmpty()) return null
        // What else is at work beside a late reference shows only once that is put right.
        val explained = (if (shifts.isEmpty()) first.lateness else first.explained) ?: return null
        // With a slow path beside it the time constant is that of the fast one.
        val shocks = scales(first.base, Steps.EVEN).shocks
        val tau = first.base.numbers[ResponseModel.TIME_CONSTANT]
        fun led(fit: ModelFit, gone: List<Trial>, rows: Double) =
            fit.without(gone, tau, Scales(ahead(rows), shaken, shocks), Steps.EVEN, used, longest)
        val (rows, least) = shifts.allOrEach().mapNotNull { gone ->
            val kept = first.chosen.sumOf { it.cost } - gone.sumOf { it.cost }
            val least = ReferenceFaults.enough(explained, first.base.score) + NUMBER -
                if (gone.isNotEmpty() && gone.all { first.shifts.isLikeLate(it.term) }) LIKELIER else 0.0
            val best = ReferenceLead.likeliest { led(first.last, gone, it).score }
            best?.takeIf { it.second - kept >= least }?.let { Triple(it.first, least, it.second - kept) }
        }.maxByOrNull { it.third } ?: return null
        val second = weighing(led(first.base, emptyList(), rows), first.spikes, rows * series.period)
        return second.takeIf { it.explained >= maxOf(least, first.farLateness ?: least) }
    }

    /**
     * The weighing with a truth that is held from each row until the next, or goes straight there, where the log is as
     * likely so without some of the shifts that were chosen in [first], or clearly likelier; null where it is not. A
     * sensor that is stepped once a row by what the row before had is half a row late, which is no cause.
     */
    private fun untilNext(first: Weighing): Weighing? {
        // When a sharp step came is not known to a row, and of a sparse reference a row is not one of the readings'.
        if (unknown.isSharp || series.isSparse) return null
        // Of a sensor that shows the truth within a row, what is held until the next is a delay of a row like any other.
        val shifts = first.chosen.filter(::isShift)
        val isAtOnce = first.last.numbers[ResponseModel.TIME_CONSTANT] < series.period / 2
        if (isAtOnce && shifts.none { it.term.cause == Cause.TWO_PATH_RESPONSE }) return null
        val rows = used.copyOf()
        val fewer = (shifts.allOrEach() + listOf(emptyList())).distinct()
        val (before, gone) = SHARES.flatMap { share ->
            val held = series.withQuieter(rowBefore(series, unknown.isGap, share))
            val before = Diagnosis(held, settings, loops, share) { }
            fewer.map { gone -> Triple(before, gone, before.ahead(first, gone, rows)) }
        }.maxBy { it.third }.takeIf { it.third >= 0 } ?: return null
        val second = before.weighing(Steps.HELD, first.spikes)
        val isFewer = second.chosen.count(::isShift) < shifts.size
        if (isUndone(first, second) && second.explained < first.explained + COINCIDENCE) return null
        return second.takeIf { it.explained >= first.explained + if (isFewer && gone.isNotEmpty()) -SHIFT else HELD }
    }

    /** Whether [trial] is what half a row of delay looks like; of a given sensor the time constant is, too. */
    private fun isShift(trial: Trial) = trial.term.cause in ReferenceLead.ALIKE ||
        (settings.base != null && trial.term.cause == Cause.TIME_CONSTANT)

    /**
     * By how much this log, whose truth is held over each step, explains its [rows] better without [gone] of what was
     * chosen in [first] than that is to; a log-likelihood, doubled.
     */
    private fun ahead(first: Weighing, gone: List<Trial>, rows: BooleanArray): Double {
        val kept = first.chosen.sumOf { it.cost } - gone.sumOf { it.cost }
        val tau = first.base.numbers[ResponseModel.TIME_CONSTANT]
        val fit = first.last.without(gone, tau, scales(first.base, Steps.HELD), Steps.HELD, rows, longest)
        return fit.score - kept - first.explained + if (gone.isEmpty()) -HELD else SHIFT
    }

    /** This log with the truth that a reference with a lag of [rows] is late for. */
    private fun ahead(rows: Double) =
        series.withQuieter(ReferenceLead.course(series, rows * series.period, unknown.isBroken))

    /**
     * [first] where it explains the log better for its numbers, by [margin], than the weighing with [steps]; a truth that
     * is held, and a delay that is by chance just what undoes that, must explain far more. Where sharp steps come at some
     * moment between rows, no cause is likelier than one.
     */
    private fun better(first: Weighing, margin: Double, steps: Steps): Weighing {
        val rows = used.copyOf()
        val second = weighing(steps)
        val least = when {
            isUndone(first, second) -> COINCIDENCE
            unknown.isSharp && second.clear < first.clear -> -maxOf(margin, SHIFT)
            else -> -margin
        }
        if (second.explained > first.explained + least) return second
        rows.copyInto(used)
        return first
    }

    /** Whether [second] has a truth held over each step, which [first] has not, and a delay that undoes that. */
    private fun isUndone(first: Weighing, second: Weighing) =
        !first.last.model.steps.isHeld && second.shifts.areUndone(second.chosen)

    /** [fit] with steps held if they are not, and the other way round. */
    private fun turned(fit: ModelFit): ModelFit {
        val steps = fit.model.steps.other
        val other = ResponseModel(series, fit.model.terms, steps, scales(fit, steps))
        val guess = CorrelatedNoise(series.times, fit.noise.share, fit.noise.time, used, other.scales.shocks)
        return Fitting.fit(other, fit.numbers, fit.free, used, longest, guess = guess)
    }

    private fun weighing(steps: Steps?): Weighing {
        series.readRows().copyInto(used)
        val settled = settled(steps)
        val sure = BeyondDoubt(settled)
        // Rounding moves readings by up to half a step: what is within a step need not be wild.
        val spikes = lone(settled).filter {
            val isDoubtful = shaken.isInDoubt(it) || settled.model.scales.isInDoubt(it)
            abs(settled.residuals[it]) > settled.model.scales.resolution && Spikes.isSingle(settled.residuals, it) &&
                (!isDoubtful || it in sure)
        }
        spikes.forEach { used[it] = false }
        return weighing(if (spikes.isEmpty()) settled else base(steps, settled), spikes, 0.0)
    }

    /** The rows of [fit] that stick out of those beside them. */
    private fun lone(fit: ModelFit): List<Int> {
        val rows = used.indices.filter { used[it] }
        return Spikes.of(DoubleArray(rows.size) { fit.whitened[rows[it]] }).map { rows[it] }
    }

    /** The weighing with [steps] where [spikes] are known. */
    private fun weighing(steps: Steps, spikes: List<Int>): Weighing {
        series.readRows().copyInto(used)
        val settled = settled(steps)
        spikes.forEach { used[it] = false }
        return weighing(if (spikes.isEmpty()) settled else base(steps, settled), spikes, 0.0)
    }

    /** The weighing of all causes on top of [base], where [spikes] are left out of and the reference was [late] s late. */
    private fun weighing(base: ModelFit, spikes: List<Int>, late: Double) =
        Weighing(
            CauseSearch(base.model.series, base.model.scales, used, settings),
            base,
            used,
            spikes,
            settings,
            late,
            before,
            loops,
            ::tell,
        )

    /**
     * The base model. How much a gap or a sharp front shakes the reading is told by the lag, and that by what is left
     * of the log: each in turn.
     */
    private fun settled(steps: Steps?): ModelFit {
        var last = if (steps == null) rough else base(steps, null)
        repeat(SETTLING) {
            if (scales(last, last.model.steps).shocks == null) return last
            last = base(steps, last)
        }
        return last
    }

    /** What models share where the readings have lag and noise like those of [fit]. */
    private fun scales(fit: ModelFit?, steps: Steps): Scales {
        if (fit == null) return Scales(series, unknown)
        val tau = maxOf(fit.numbers[ResponseModel.TIME_CONSTANT], series.period / 50)
        val spread = Spikes.spread(series.shown(fit.whitened))
        return Scales(series, shaken, shaken.shocks(tau, fit.numbers[ResponseModel.GAIN], spread, steps.isHeld))
    }

    /**
     * By how much the readings are later than the reference, s, below 0 where they are earlier: by a row or more for
     * certain, else 0. When the truth moved within a row then shakes the readings as much later.
     */
    private fun late(): Double {
        val term = Term(Cause.DEAD_TIME, isEitherWay = true)
        if (rough.model.slotOrNull(term) != null) return 0.0
        val model = ResponseModel(series, rough.model.terms + term, rough.model.steps, rough.model.scales)
        val slot = model.slot(term)
        val free = BooleanArray(model.parameters.size) { it == slot || rough.free.getOrElse(it) { false } }
        val tau = rough.numbers[ResponseModel.TIME_CONSTANT]
        val best = (TIMES_LATE.map { it * tau } + ROWS_LATE.map { it * series.period }).map { delay ->
            val start = rough.numbers.copyOf(model.parameters.size)
            start[slot] = delay.coerceIn(model.parameters[slot].lower, model.parameters[slot].upper)
            if (free[ResponseModel.TIME_CONSTANT]) start[ResponseModel.TIME_CONSTANT] = maxOf(tau - delay, tau / 3)
            Fitting.fit(model, start, free, used, longest, noise = rough.noise)
        }.maxBy { it.score }
        val found = best.numbers[slot]
        return if (best.score > rough.score + SHAKEN && abs(found) > series.period) found else 0.0
    }

    /** One more trial is done, on any thread; a search of [terms] terms takes one round of them or several. */
    @Synchronized
    private fun tell(terms: Int) {
        trials++
        progress(trials / (trials + maxOf(terms.toDouble() - trials, terms / 2.0)))
    }

    /**
     * The base model with [steps], as the log says where that is null. Lag and noise are as [rough].
     */
    private fun base(steps: Steps?, rough: ModelFit?): ModelFit {
        val ways = listOf(Steps.EVEN, Steps.HELD) + listOfNotNull(Steps.UNTIL_NEXT.takeIf { unknown.isSharp })
        val fits = (steps?.let { listOf(it) } ?: ways).map { base(it, scales(rough, it)) }
        // Held steps are the simulator's own way; where the log does not say, the truth is taken as continuous. A given
        // sensor's numbers may be wrong, so that this is told with them free.
        val likeliest = fits.maxBy { it.score }
        val best = if (likeliest.score > fits[0].score + HELD) likeliest else fits[0]
        if (settings.base == null) return best
        val free = BooleanArray(best.free.size) { it in best.model.firstStates }
        val numbers = GivenSensor(settings.base, best.model.scales).numbers(best.model)
        return Fitting.fit(best.model, numbers, free, used, longest)
    }

    private fun base(steps: Steps, scales: Scales): ModelFit {
        val given = settings.base?.let { GivenSensor(it, scales) }
        // A sensor file does not say how noisily another quantity is measured that the sensor shows.
        val known = given?.terms.orEmpty().let { listOf(it, it.map(Term::quiet)) }
        val forms = (known + known.map { it.map(Term::begun) }).distinct()
        return forms.map { ResponseModel(series, it, steps, scales) }.flatMap { model ->
            val free = BooleanArray(model.parameters.size) { it < ResponseModel.BASE || it in model.firstStates }
            val starts = given?.let { listOf(it.numbers(model)) } ?: Starts.ofLags(model)
            starts.map { Fitting.fit(model, it, free, used, longest) }
        }.maxBy { it.score - CauseSearch.OWN_START * it.model.firstStates.size }
    }

    private companion object {
        /** Twice the log-likelihood by which steps must look held. */
        const val HELD = 6.0
        const val SETTLING = 2

        /** The same of one delay in five hundred that there might be, of which few sensors have any. */
        const val COINCIDENCE = 18.0

        /** Of the row before in a truth that is held over a step: none, as in one that goes straight, and all. */
        val SHARES = listOf(0.0, 0.5, 1.0)

        /** Twice the log-likelihood, less two, above which a shift is more than half a row: 1 % over 18 causes tried. */
        const val SHIFT = 9.9

        /** Twice the log-likelihood that a number gains by chance. */
        const val NUMBER = 2.0

        /** Twice the log of the odds, ten to one, of a reference that is late as an ordinary one may be and a probe ahead. */
        const val LIKELIER = 4.6

        /** Twice the log-likelihood by which readings must look late before they are shaken later. */
        const val SHAKEN = 25.0

        /** Delays that are tried then, in time constants and in rows. */
        val TIMES_LATE = listOf(-1.0, -0.3, 0.3, 1.0, 3.0)
        val ROWS_LATE = listOf(-4.0, -1.5, 1.5, 4.0)
        const val FEWEST = 30

        /** Noise of the reference, in that of the readings, above which it is taken off. */
        const val NOISY = 0.2

        /** Standard errors of the reference's noise by which what is taken off may be larger. */
        const val CLEARLY = 3.0
    }
}
