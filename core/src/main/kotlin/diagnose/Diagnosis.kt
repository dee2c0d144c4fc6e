package stillwater.diagnose

import stillwater.model.Conditions
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt

/**
 * Finds what a simulation gets wrong about a measured log, by name.
 *
 * A first-order lag with gain and offset, or the given sensor, is fitted to the log under noise of which a part may be
 * correlated. Each cause is then a nested extension: fitted, weighed by its likelihood ratio corrected for what
 * correlation
 * the noise model has missed, for the number of causes tried (Holm) and held to a gain on held-out blocks. The best is
 * added and the search goes on. What the extended model still leaves is looked through for dependences of any kind.
 * Derivation in core/docs/Diagnosis.md.
 *
 * Pure: the same log gives the same answer. Cost: of the order of a second for a thousand rows.
 */
public class Diagnosis(
    private val series: MeasuredSeries,
    private val settings: DiagnosisSettings = DiagnosisSettings(),
) {
    private val scales = Scales(series)
    private val used = BooleanArray(series.size) { true }
    private val search = CauseSearch(series, scales, used, settings)
    private val warnings = ArrayList<String>()

    /** The answer. Without a reference the field is inferred together with the sensor. */
    public fun run(): DiagnosisResult {
        if (series.reference == null) return BlindDiagnosis(series, settings).run()
        val first = weighing(null)
        val last = first.last
        // Whether steps are held shows only once the response is right: the other way is tried with what was named.
        val other = ResponseModel(series, last.model.terms, !last.model.held, scales)
        val turned = Fitting.fit(other, last.numbers, last.free, used, search.longest, guess = last.noise)
        val better = first.chosen.isNotEmpty() && turned.score > last.score + HELD
        return (if (better) weighing(other.held) else first).result()
    }

    private fun weighing(held: Boolean?): Weighing {
        used.fill(true)
        warnings.clear()
        val rough = base(held)
        val spikes = Spikes.of(rough.whitened)
        spikes.forEach { used[it] = false }
        return Weighing(if (spikes.isEmpty()) rough else base(held), spikes)
    }

    /** The base model; steps are held where [held], as the log says where that is null. */
    private fun base(held: Boolean?): ModelFit {
        val given = settings.base?.let { GivenSensor(it, scales) }
        val fits = listOf(false, true).filter { held == null || it == held }.map { way ->
            val model = ResponseModel(series, given?.terms.orEmpty(), way, scales)
            val free = BooleanArray(model.parameters.size) { it < ResponseModel.BASE }
            val starts = given?.let { listOf(it.numbers(model)) } ?: starts(model)
            starts.map { Fitting.fit(model, it, free, used, search.longest) }.maxBy { it.score }
        }
        // Held steps are the simulator's own way; where the log does not say, the truth is taken as continuous. A given
        // sensor's numbers may be wrong, so that this is told with them free.
        val best = if (fits.last().score > fits[0].score + HELD) fits.last() else fits[0]
        if (given == null) return best
        val free = BooleanArray(best.free.size) { it == ResponseModel.FIRST }
        return Fitting.fit(best.model, given.numbers(best.model), free, used, search.longest)
    }

    private fun starts(model: ResponseModel): List<DoubleArray> =
        doubleArrayOf(0.7, 3.0, 12.0, 50.0).map { steps ->
            val numbers = DoubleArray(model.parameters.size)
            numbers[ResponseModel.TIME_CONSTANT] = steps * series.period
            numbers[ResponseModel.GAIN] = 1.0
            numbers
        }

    /** The weighing of all causes on top of [base]. */
    private inner class Weighing(private val base: ModelFit, private val spikes: List<Int>) {
        private val baseHeldOut = HeldOut.score(base, used)
        private val terms = terms()
        private val first = terms.map { search.attempt(base, baseHeldOut, it) }

        /** What was chosen, one after the other. */
        val chosen = forward()

        /** The model with all that was chosen. */
        val last = chosen.lastOrNull()?.fit ?: base

        fun result(): DiagnosisResult {
            val loose = Loose(last)
            val outliers = loose.pValue * (terms.size + 1) < settings.level
            val sets = sets(chosen, last)
            val left = Structure(last, used, search.longest).dependences()
            val verdict = verdict(sets, outliers, left.first(), chosen)
            val named = verdict is Verdict.Named || verdict is Verdict.Ambiguous
            val size = loose.size().takeIf { outliers }
            val sensor = ExtendedSensor(last, size)
            val extended = if (named) sensor.spec("extended") else null
            warn(left, named)
            return DiagnosisResult(
                verdict,
                candidates(size, loose.pValue),
                assessment(base, baseHeldOut),
                if (named) assessment(last, HeldOut.score(last, used)) else null,
                settings.base ?: ExtendedSensor(base, null).spec("base"),
                extended,
                (verdict as? Verdict.Ambiguous)?.let { v ->
                    Manoeuvres.of(v.sets.filter { it.size > 1 }.flatten().toSet())
                },
                left,
                spikes,
                warnings + if (named) sensor.losses else emptyList(),
            )
        }

        private fun warn(left: List<Dependence>, named: Boolean) {
            val most = left.first()
            if (named && most.adjusted < settings.structureLevel) {
                warnings += "Structure is left beside what was named: the residuals depend on ${most.description}."
            }
            val off = spikes.size
            if (off >
                0
            ) {
                warnings +=
                    "$off single reading${if (off == 1) " is" else "s are"} far off and left out of the fits."
            }
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
            val moving = median(series.speed) > 0.02
            if (moving && spread > 0.03) add(Term(Cause.FLOW_DEPENDENT_RESPONSE))
            if (scales.warmth.any { abs(it) > 0.05 }) add(Term(Cause.TEMPERATURE_DEPENDENT_RESPONSE))
            for ((name, column) in scales.centred) {
                if (name != Conditions.HEADING && column.any { it != 0.0 }) add(Term(Cause.CROSS_SENSITIVITY, name))
            }
            add(Term(Cause.DRIFT))
            add(Term(Cause.OFFSET_STEPS))
            add(Term(Cause.HYSTERESIS))
            if (scales.resolution > 0.3 * sqrt(base.variance)) add(Term(Cause.QUANTISATION))
            add(Term(Cause.SATURATION))
            if (moving && spread > 0.03) add(Term(Cause.POSITION_OFFSET))
        }

        /** The trials chosen one after the other; each fit holds all before it. */
        private fun forward(): List<Trial> {
            val chosen = ArrayList<Trial>()
            var trials = first
            var fit = base
            var heldOut = baseHeldOut
            while (chosen.size < settings.mostCauses) {
                val adjusted = Evidence.holm(trials.map { it.pValue })
                val worthy = trials.indices.filter { i ->
                    adjusted[i] < settings.level && trials[i].heldOut.logLikelihood > heldOut.logLikelihood
                }.map { trials[it] }
                // A wrong number of the base makes everything else look significant: it comes first, if it is one.
                val own = worthy.filter { it.term.cause in BASE_NUMBERS }
                val best = own.ifEmpty { worthy }.maxByOrNull { it.worth } ?: break
                chosen += best
                fit = best.fit
                heldOut = best.heldOut
                val taken = chosen.map { it.term.key }
                val rest = terms.filter { it.key !in taken && compatible(it, chosen) }
                if (chosen.size < settings.mostCauses) trials = rest.map { search.attempt(fit, heldOut, it) }
            }
            return pruned(chosen)
        }

        private fun compatible(term: Term, chosen: List<Trial>) =
            chosen.none { it.term.cause == Cause.TWO_PATH_RESPONSE } || term.cause != Cause.SECOND_ORDER_RESPONSE

        /** [chosen] without what the later ones have made needless. */
        private fun pruned(chosen: List<Trial>): List<Trial> {
            if (chosen.size < 2) return chosen
            val full = chosen.last().fit
            val needless = chosen.dropLast(1).filter { trial ->
                val without = search.without(full, trial.term)
                Evidence.pValue(full.score - without.score, trial.degrees) * terms.size > settings.level
            }
            if (needless.isEmpty()) return chosen
            val kept = chosen.filter { it !in needless }
            var fit = base
            var heldOut = baseHeldOut
            return kept.map { trial ->
                search.attempt(fit, heldOut, trial.term.copy(times = emptyList())).also {
                    fit = it.fit
                    heldOut = it.heldOut
                }
            }
        }

        /** For each chosen cause, those that would explain what it explains as well on this track. */
        private fun sets(chosen: List<Trial>, last: ModelFit): List<List<Cause>> = chosen.map { trial ->
            val others = chosen.filter { it !== trial }.map { it.term.key }
            val rest = if (chosen.size == 1) base else search.without(last, trial.term)
            val likely = first.filter { it.pValue < 0.01 || chosen.size == 1 }.map { it.term.copy(times = emptyList()) }
            val trials = if (chosen.size == 1) {
                first
            } else {
                likely.filter { it.key !in others }
                    .map { if (it.key == trial.term.key) null else search.attempt(rest, baseHeldOut, it) }
                    .filterNotNull()
            }
            val own = if (chosen.size == 1) trial.worth else last.score - rest.score - 2 * trial.degrees
            val same = trials.filter { it.term.key != trial.term.key && own - it.worth < settings.separation }
                .sortedByDescending { it.worth }
            (listOf(trial.term.cause) + same.map { it.term.cause }).distinct()
        }

        private fun verdict(
            sets: List<List<Cause>>,
            outliers: Boolean,
            left: Dependence,
            chosen: List<Trial>,
        ): Verdict {
            insufficient()?.let { return it }
            val all = sets + if (outliers) listOf(listOf(Cause.OUTLIERS)) else emptyList()
            val structured = left.adjusted < settings.structureLevel
            val least = chosen.minOfOrNull { it.ratio } ?: 0.0
            return when {
                structured && left.ratio > LEFT * least -> Verdict.Unexplained(
                    "the residuals depend on ${left.description}",
                )
                all.isEmpty() -> Verdict.Consistent
                all.any { it.size > 1 } -> Verdict.Ambiguous(all)
                else -> Verdict.Named(all.map { it.single() })
            }
        }

        private fun insufficient(): Verdict? {
            if (series.size < FEWEST_ROWS) return Verdict.InsufficientData("there are ${series.size} rows only")
            if (listOfNotNull(series.values, series.reference).all { column -> column.all { it == column[0] } }) {
                return Verdict.InsufficientData("neither the readings nor the truth ever change")
            }
            val seen = base.free[ResponseModel.TIME_CONSTANT] &&
                base.numbers[ResponseModel.TIME_CONSTANT] > series.period / 2
            val error = if (seen) errors(base)[ResponseModel.TIME_CONSTANT] else 0.0
            if (error > 1) return Verdict.InsufficientData("the truth changes too little to show any lag")
            return null
        }

        private fun candidates(size: SpikeSize?, outlierP: Double): List<Candidate> {
            val p = first.map { it.pValue } + outlierP
            val adjusted = Evidence.holm(p)
            val list = first.mapIndexed { i, trial ->
                Candidate(
                    trial.term.cause,
                    trial.term.condition,
                    estimates(trial.fit, listOf(trial.term)),
                    rmse(trial.fit),
                    trial.heldOut.rmse,
                    trial.heldOut.logLikelihood,
                    trial.pValue,
                    adjusted[i],
                    predicted(trial.fit),
                ) to trial.worth
            }
            val outliers = Candidate(
                Cause.OUTLIERS,
                null,
                size?.let {
                    listOf(
                        Estimate("probability", "", it.probability, null),
                        Estimate("size", "sensor units", it.size, null),
                    )
                }
                    .orEmpty(),
                rmse(base),
                baseHeldOut.rmse,
                baseHeldOut.logLikelihood,
                outlierP,
                adjusted.last(),
                predicted(base),
            )
            return list.sortedByDescending { it.second }.map { it.first } + outliers
        }

        private fun assessment(fit: ModelFit, heldOut: HeldOutScore) = ModelAssessment(
            estimates(fit, fit.model.terms, withBase = true),
            rmse(fit),
            heldOut.rmse,
            heldOut.logLikelihood,
            predicted(fit),
            sqrt(fit.variance),
            fit.noise.share,
            fit.noise.time,
            fit.whitened.let { z -> DoubleArray(z.size) { z[it] / sqrt(maxOf(fit.variance, 1e-300)) } },
        )
    }

    /** Single readings that the model of [fit] leaves far off, among all rows. */
    private inner class Loose(private val fit: ModelFit) {
        private val z = DoubleArray(series.size).also { out ->
            val all = BooleanArray(series.size) { true }
            CorrelatedNoise(series.times, fit.noise.share, fit.noise.time, all).whiten(fit.residuals, out)
        }
        private val spikes = Spikes.of(z)
        private val mixture = Spikes.ratio(z)

        /** Of there being outliers, by their number or by the tails of all residuals. */
        val pValue: Double = Evidence.poissonTail(spikes.size, series.size * BEYOND).let { lone ->
            val far = mixture.size > FARTHEST * sqrt(fit.variance)
            if (far) minOf(lone, Evidence.pValue(mixture.ratio, 3)) else lone
        }

        fun size(): SpikeSize =
            SpikeSize.of(spikes, fit.residuals, sqrt(fit.variance)) ?: SpikeSize(mixture.share, mixture.size)
    }

    private fun rmse(fit: ModelFit): Double {
        var sum = 0.0
        for (i in used.indices) if (used[i]) sum += fit.residuals[i] * fit.residuals[i]
        return sqrt(sum / maxOf(used.count { it }, 1))
    }

    private fun predicted(fit: ModelFit) = DoubleArray(series.size) { series.values[it] - fit.residuals[it] }

    /** Standard error of every parameter on the scale it is fitted on; 0 where it was not fitted. */
    private fun errors(fit: ModelFit): DoubleArray {
        val columns = fit.jacobian
        val system = SymmetricSystem.of(columns, fit.whitened)
        val errors = DoubleArray(fit.numbers.size)
        val free = fit.free.indices.filter { fit.free[it] }
        free.forEachIndexed { k, i -> errors[i] = sqrt(maxOf(system.inverseDiagonal(k), 0.0) * fit.variance) }
        return errors
    }

    private fun estimates(fit: ModelFit, terms: List<Term>, withBase: Boolean = false): List<Estimate> {
        val errors = errors(fit)
        val indices = (if (withBase) 0 until ResponseModel.BASE - 1 else listOf(0)) +
            terms.flatMap { term ->
                fit.model.slotOrNull(term)?.let { (it until it + fit.model.width(term)).toList() }.orEmpty()
            }
        return indices.map { i ->
            val parameter = fit.model.parameters[i]
            val reach = NORMAL_95 * errors[i]
            val value = fit.numbers[i]
            val ends = if (parameter.logarithmic) {
                value * exp(-minOf(reach, 50.0)) to value * exp(minOf(reach, 50.0))
            } else {
                value -
                    reach to
                    value + reach
            }
            val interval = if (fit.free[i] &&
                reach.isFinite()
            ) {
                stillwater.model.Interval(ends.first, ends.second)
            } else {
                null
            }
            Estimate(parameter.name, parameter.unit, value, interval)
        }
    }

    private companion object {
        const val HELD = 6.0
        val BASE_NUMBERS = setOf(Cause.TIME_CONSTANT, Cause.GAIN_OFFSET)
        const val BEYOND = 4e-5
        const val FARTHEST = 4.5
        const val FEWEST_ROWS = 60
        const val NORMAL_95 = 1.96
        const val LEFT = 0.25
    }
}
