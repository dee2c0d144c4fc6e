package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.Loops
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.ProgressParts
import stillwater.diagnose.evidence.BeyondDoubt
import stillwater.diagnose.evidence.Spikes
import stillwater.diagnose.evidence.TooLittle
import stillwater.diagnose.evidence.Trial
import stillwater.diagnose.evidence.allOrEach
import stillwater.diagnose.evidence.without
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.response.FinerTruth
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.RangeEnd
import stillwater.diagnose.response.ReferenceGaps
import stillwater.diagnose.response.ReferenceLead
import stillwater.diagnose.response.Resolution
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.UnknownTruth
import stillwater.estimate.LagWeights
import kotlin.math.abs
import kotlin.math.sqrt

/**
 * Diagnoses a log with a reference.
 *
 * @param loops how what can be done at once is; the answer is the same bits.
 * @param before the share that the row before has in the reference of [series], which is held over each step; 0 of a log.
 * @param lengthScale of what tells the truth halfway between rows, usual steps; 0 for a spline through these alone.
 * @param progress told how much is done, a share within 0..1 that grows; at most a few hundred times.
 */
internal class ReferenceDiagnosis(
    private val series: MeasuredSeries,
    private val settings: DiagnosisSettings,
    private val loops: Loops,
    private val before: Double,
    private val lengthScale: Double = 0.0,
    progress: (Double) -> Unit,
) {
    private val unknown = UnknownTruth.of(series)
    private val used = series.readRows()
    private val longest = CauseSearch.longest(series, settings)
    private val models = BaseModels(series, settings, unknown, used, lengthScale)
    private val parts = ProgressParts(progress)
    private val told by lazy { parts.next(1.0) }
    private var trials = 0

    /** The answer. */
    fun answer(): DiagnosisResult {
        // Of readings that never change any lag that is long enough is as likely as any end of a range.
        TooLittle.still(series)?.let { return TooLittle.answer(series, it) }
        TooLittle.inGaps(series, unknown.isGap)?.let { why ->
            return UnwrittenMoves(series, unknown.isGap, settings.base).answer(why)
        }
        val reference = QuieterReference(series, unknown, models, used, longest, loops)
        val quieter = reference.likeliest()
        val first = if (quieter == null) {
            weighed()
        } else {
            retold(reference, likelier(ReferenceDiagnosis(quieter, settings, loops, 0.0, progress = parts.next(HALF))))
        }
        return finer(unrounded(first)).result()
    }

    /**
     * The weighing with heights of samples in [reference] that go with what was named in [first], or with the beginning of that,
     * where one explains more; else that one. What came after may make up for heights that go with nothing.
     */
    private fun retold(reference: QuieterReference, first: Weighing): Weighing =
        first.chosen.mapNotNull { reference.with(it.fit) }.fold(first) { best, log ->
            val second = ReferenceDiagnosis(log, settings, loops, 0.0) { }.weighed()
            if (second.explained > best.explained + HELD) second else best
        }

    /**
     * The weighing with a smooth course within the reference's steps, where these are coarse beside what [first] leaves and that
     * explains more; else that one. How smooth it is is asked of what was chosen, too: without it nothing fits.
     */
    private fun unrounded(first: Weighing): Weighing {
        val reference = checkNotNull(series.reference)
        val step = Resolution.of(reference)
        val shown = step / sqrt(12.0) * abs(first.last.numbers[ResponseModel.GAIN])
        if (series.isSparse || !(shown > NOISY * sqrt(first.last.variance))) return first
        val fits = setOf(first.base, first.last)
        val (best, gain) = RoundedReference(reference, step, unknown.isGap).courses().map(series::withQuieter)
            .map { log ->
                val open = UnknownTruth.of(log)
                val calm = Scales(log, open)
                log to fits.maxOf { gained(it, it.scales(calm, open, isHeld = false)) }
            }.maxBy { it.second }
        if (gain < HELD) return first
        val second = ReferenceDiagnosis(best, settings, loops, 0.0) { }.weighed()
        return if (second.explained > first.explained + HELD) second else first
    }

    /**
     * The weighing with the truth told halfway between the rows, where these are so far apart for the water that what was chosen
     * in [first], or nothing, is then for certain likelier, and that explains more; else that one. Where something strong is in
     * the log it shows with that alone, and where nothing is what was chosen may have made up for it. What was taken off the
     * reference as its noise may have been such water.
     */
    private fun finer(first: Weighing): Weighing {
        if (unknown.isSharp || series.isSparse || ReferenceGaps.reach(first.last) < FELT) return first
        val fits = setOf(first.base, first.last)
        val (best, gain) = setOf(series, first.last.model.series)
            .flatMap { log -> FinerTruth.LENGTHS.map { log to it } }
            .map { (log, length) ->
                val scales = Scales(log, unknown, swing = first.last.model.scales.swing, lengthScale = length)
                Pair(log, length) to fits.maxOf { gain(it, scales) }
            }
            .maxBy { it.second }
        if (gain < HELD) return first
        val second = ReferenceDiagnosis(best.first, settings, loops, 0.0, best.second) { }.weighed()
        // Other rows may have been left out as wild.
        val rows = first.last.noise.rows
        return if (second.explained / second.last.noise.rows * rows > first.explained + HELD) second else first
    }

    /** By how much the model of [fit] is likelier in the log of [scales], with its truth between the rows; doubled. */
    private fun gain(fit: ModelFit, scales: Scales): Double =
        gained(fit, scales.shaken(unknown, fit.model.scales.shocks, fit.model.scales.doubt))

    /** By how much the model of [fit] is likelier in the log of [own]; doubled. */
    private fun gained(fit: ModelFit, own: Scales): Double {
        val model = ResponseModel(own.series, fit.model.terms, Steps.EVEN, own)
        return Fitting.fit(model, fit.numbers, fit.free, fit.noise.used, longest, guess = fit.noise).score - fit.score
    }

    /**
     * The weighing by [quiet], whose reference has less noise, unless what it has less was the truth's own: then this one
     * explains more, and with no more causes, which might make up for the noise.
     */
    private fun likelier(quiet: ReferenceDiagnosis): Weighing {
        val quieter = quiet.weighed()
        if (quieter.chosen.isEmpty()) {
            // With no more causes than none this log explains what its base does.
            quieter.spikes.forEach { used[it] = false }
            if (models.settled(null).score <= quieter.explained) return quieter
        }
        val noisier = weighed()
        val isLikelier = noisier.explained > quieter.explained + HELD && noisier.chosen.size <= quieter.chosen.size
        return if (isLikelier) noisier else quieter
    }

    private fun weighed(): Weighing {
        val first = weighing(null).let { if (isAhead(it)) better(it, -HELD, Steps.EVEN) else it }
        // Whether steps are held shows only once the response is right: the other way is tried with what was named, and
        // with each beginning of it, because what came after may make up for the wrong way.
        // Where it moves in sharp steps a row's delay goes with the one way and half of it with the other, too much for
        // the numbers of one to do for the other.
        val doubtful = (unknown.isSharp && (first.chosen.isNotEmpty() || first.isStructured)) ||
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
        return isProbeAhead(weighing.base, models.of(Steps.EVEN, weighing.base), used, longest, HELD)
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
        val scales = models.scales(first.base, Steps.EVEN)
        val tau = first.base.numbers[ResponseModel.TIME_CONSTANT]
        fun led(fit: ModelFit, gone: List<Trial>, rows: Double) =
            fit.without(gone, tau, scales.of(ahead(rows)), Steps.EVEN, used, longest)
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
        val (before, gone) = (SHARES + straight(first.last)).flatMap { share ->
            val held = series.withQuieter(rowBefore(series, unknown.isGap, share))
            val before = ReferenceDiagnosis(held, settings, loops, share) { }
            // What goes straight is no simulation's peculiarity, but what lies between two rows.
            val more = if (share == MEANS) COINCIDENCE - HELD else 0.0
            fewer.map { gone -> Triple(before, gone, before.ahead(first, gone, rows) - more) }
        }.maxBy { it.third }.takeIf { it.third >= 0 } ?: return null
        val second = before.weighing(Steps.HELD, first.spikes)
        val isFewer = second.chosen.count(::isShift) < shifts.size
        if (isUndone(first, second) && second.explained < first.explained + COINCIDENCE) return null
        return second.takeIf { it.explained >= first.explained + if (isFewer && gone.isNotEmpty()) -SHIFT else HELD }
    }

    /**
     * The share that the row before has in a step of the lag of [fit] where the truth goes straight from row to row. Unlike a
     * smooth curve through its rows that makes none of a reference's noise larger.
     */
    private fun straight(fit: ModelFit): Double {
        val weights = LagWeights().also { it.set(fit.numbers[ResponseModel.TIME_CONSTANT], series.period) }
        return weights.before / (weights.before + weights.now)
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
        // What gaps leave fades alike in both: a base that lacks a cause has more noise, and smaller shocks for it.
        val fit = first.last.without(gone, tau, models.scales(first.last, Steps.HELD), Steps.HELD, rows, longest)
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
        if (unknown.isSharp && FarBehind(first, models, longest).isSo(steps)) return first
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
        val other = ResponseModel(series, fit.model.terms, steps, models.scales(fit, steps))
        val guess = CorrelatedNoise(series.times, fit.noise.share, fit.noise.time, used, other.scales.shocks)
        return Fitting.fit(other, fit.numbers, fit.free, used, longest, guess = guess)
    }

    /** The weighing with [steps], or as the log says; the wild readings are those [known], or looked for. */
    private fun weighing(steps: Steps?, known: List<Int>? = null): Weighing {
        series.readRows().copyInto(used)
        val settled = models.settled(steps)
        val spikes = known ?: wild(settled)
        val first = without(spikes, settled, steps)
        // What an end of the range cuts off alone is not wild.
        val end = first.forward.first.firstOrNull { it.term.cause == Cause.SATURATION && known == null }
        val atEnd = end?.let { RangeEnd.explained(it.fit, spikes) }.orEmpty()
        if (atEnd.isEmpty()) return first
        val rows = used.copyOf()
        val second = without(spikes - atEnd.toSet(), settled, steps)
        if (second.chosen.any { it.term.cause == Cause.SATURATION }) return second
        rows.copyInto(used)
        return first
    }

    /** The weighing without [spikes], where [settled] is the base with all readings. */
    private fun without(spikes: List<Int>, settled: ModelFit, steps: Steps?): Weighing {
        series.readRows().copyInto(used)
        spikes.forEach { used[it] = false }
        return weighing(if (spikes.isEmpty()) settled else models.of(steps, settled), spikes, 0.0)
    }

    /** The rows of [fit] that stick out of those beside them by more than rounding, or what is in doubt, may do. */
    private fun wild(fit: ModelFit): List<Int> {
        val rows = used.indices.filter { used[it] }
        val sure = BeyondDoubt(fit)
        val scales = fit.model.scales
        fun off(column: DoubleArray) = Spikes.of(DoubleArray(rows.size) { column[rows[it]] }).map { rows[it] }
        // Under noise that wanders a wild reading shows twice, there and back; beside what is in doubt it may be taken for that.
        val found = off(fit.whitened) union off(fit.noise.impulses(fit.whitened)) union rows.filter { it in sure }
        return found.sorted().filter {
            // Rounding moves readings by up to half a step: what is within a step need not be wild.
            abs(fit.residuals[it]) > scales.resolution && Spikes.isSingle(fit.residuals, it) &&
                (!(models.shaken.isInDoubt(it) || scales.isInDoubt(it)) || it in sure)
        }
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

    /** One more trial is done, on any thread; a search of [terms] terms takes one round of them or several. */
    @Synchronized
    private fun tell(terms: Int) {
        trials++
        told(trials / (trials + maxOf(terms.toDouble() - trials, terms / 2.0)))
    }

    private companion object {
        const val HELD = BaseModels.HELD

        /** Of all, that one of two weighings is. */
        const val HALF = 0.5

        /** The same of one delay in five hundred that there might be, of which few sensors have any. */
        const val COINCIDENCE = 18.0

        /** Of the row before in a truth that is held over a step: half, as in a simulation by means. */
        const val MEANS = 0.5

        /** The same that any log is asked for: none and all besides. */
        val SHARES = listOf(0.0, MEANS, 1.0)

        /** Twice the log-likelihood, less two, above which a shift is more than half a row: 1 % over 18 causes tried. */
        const val SHIFT = 9.9

        /** Twice the log-likelihood that a number gains by chance. */
        const val NUMBER = 2.0

        /** Twice the log of the odds, ten to one, of a reference that is late as an ordinary one may be and a probe ahead. */
        const val LIKELIER = 4.6

        /** Standard errors of the whole log by which what is not known between rows may carry a fit before it is looked for. */
        const val FELT = 1.0

        /** What steps of the reference make of noise, in that of the readings, above which they are made smooth. */
        const val NOISY = 0.2
    }
}
