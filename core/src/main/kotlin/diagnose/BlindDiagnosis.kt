package stillwater.diagnose

import stillwater.model.Conditions
import stillwater.model.Interval
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/** A cause tried on a log without a reference, along the water that was inferred. */
internal class BlindTrial(
    val term: Term,
    val numbers: DoubleArray,
    val model: ResponseModel,
    val column: DoubleArray,
    val amount: Double,
    val error: Double,
    val ratio: Double,
    val pValue: Double,
    val agrees: Boolean,
) {
    val worth: Double get() = ratio - 2
}

/**
 * The diagnosis of a log without a reference: the field is a Gaussian process that is inferred with the sensor.
 *
 * Each cause changes the readings along the inferred water by a column; its size is estimated with the field, the
 * mean and
 * the time constant free, so that what the field could imitate counts for nothing. A cause must be significant for all
 * causes tried and its size must agree between the two halves of the log.
 */
internal class BlindDiagnosis(private val series: MeasuredSeries, private val settings: DiagnosisSettings) {
    private val n = series.size
    private val search = BlindSearch(series)
    private val delay = search.best()
    private val lag = search.fit(BlindResponse(delay.response.deadTime, 0.0), delay.scales)
    private val none = search.fit(BlindResponse(0.0, 0.0), delay.scales)
    private val water = series.withReference(lag.water())
    private val scales = Scales(water)
    private val start = doubleArrayOf(maxOf(lag.response.timeConstant, series.period / 50), 1.0, 0.0, 0.0)
    private val plain = ResponseModel(water, emptyList(), false, scales)
    private val shown = DoubleArray(n).also { plain.predict(start, it) }
    private val all = BooleanArray(n) { true }

    /** The answer. */
    fun run(): DiagnosisResult {
        val free = ArrayList<DoubleArray>()
        for (column in nuisances()) offBasis(lag.whiten(column), free)?.let { free += it }
        val terms = terms()
        val first = terms.mapNotNull { attempt(it, free) }
        val chosen = ArrayList<BlindTrial>()
        var trials = first
        while (chosen.size < settings.mostCauses) {
            val adjusted = Evidence.holm(trials.map { it.pValue })
            val best =
                trials.filterIndexed { i, t -> adjusted[i] < settings.level && t.agrees }.maxByOrNull { it.worth }
                    ?: break
            chosen += best
            offBasis(best.column, free)?.let { free += it }
            val taken = chosen.map { it.term.key }
            trials = terms.filter { it.key !in taken }.mapNotNull { attempt(it, free) }
        }
        return result(first, chosen)
    }

    private fun result(first: List<BlindTrial>, chosen: List<BlindTrial>): DiagnosisResult {
        val seen = minOf(delay.score - none.score, SCORE * sure(none))
        // What a lag does to the amplitude could as well be the water's smoothness: only a reference tells them apart.
        val responseSet = if (seen > LAG_SEEN) listOf(Cause.TIME_CONSTANT, Cause.DEAD_TIME) else null
        val verdict = verdict(first, chosen, seen, responseSet)
        val named = verdict is Verdict.Named || verdict is Verdict.Ambiguous
        val extended = chosen.lastOrNull()?.takeIf { named }
        val base = assessment(listOf(timeConstant()), lag.predicted())
        return DiagnosisResult(
            verdict,
            candidates(first),
            base,
            extended?.let { extendedAssessment(chosen) } ?: base.takeIf { named },
            spec("base", null),
            if (named) spec("extended", extended) else null,
            (verdict as? Verdict.Ambiguous)?.let { v ->
                Manoeuvres.of(v.sets.filter { it.size > 1 }.flatten().toSet())
            },
            emptyList(),
            emptyList(),
            warnings(seen, responseSet != null, verdict !is Verdict.InsufficientData),
        )
    }

    private val foretold = delay.foretold(STRETCHES)

    /** How sure the log's stretches are that the delay foretells them better than [other]: Student's t. */
    private fun sure(other: BlindFit): Double {
        val others = other.foretold(STRETCHES)
        return Evidence.t(DoubleArray(STRETCHES) { foretold[it] - others[it] })
    }

    private fun warnings(seen: Double, ambiguous: Boolean, isEnough: Boolean) = buildList {
        if (settings.base != null) {
            add("The sensor given was not used: without a reference a lag is fitted in its place.")
        }
        add(
            "No reference: the water was inferred from revisits and smoothness, on ${search.field.size} nodes " +
                "${"%.3g".format(java.util.Locale.ROOT, search.field.spacing)} m apart.",
        )
        if (seen > LAG_SEEN && isEnough) {
            val sum = lag.response.timeConstant
            add("The readings lag the water by ${"%.3g".format(java.util.Locale.ROOT, sum)} s as a first-order lag.")
        }
        if (ambiguous && isEnough) {
            add(
                "A dead time of ${"%.3g".format(
                    java.util.Locale.ROOT,
                    delay.response.deadTime,
                )} s explains the same as the lag.",
            )
        }
    }

    private fun isFlat(column: DoubleArray) = column.all { it == column[0] }

    private fun verdict(
        first: List<BlindTrial>,
        chosen: List<BlindTrial>,
        seen: Double,
        responseSet: List<Cause>?,
    ): Verdict {
        if (n < FEWEST_ROWS) return Verdict.InsufficientData("there are $n rows only")
        if (isFlat(series.values)) return Verdict.InsufficientData("the readings never change")
        if (isFlat(series.x) && isFlat(series.y)) {
            return Verdict.InsufficientData("the boat never moves, so that no pass comes back to the same water")
        }
        val sets = chosen.mapIndexed { i, trial ->
            val others = if (i > 0) {
                emptyList()
            } else {
                first.filter {
                    it.term.key != trial.term.key && trial.worth - it.worth < settings.separation && it.ratio > 0
                }
            }
            val twin = if (trial.term.cause == Cause.DRIFT) listOf(Cause.TIME_VARYING_FIELD) else emptyList()
            (listOf(trial.term.cause) + twin + others.map { it.term.cause }).distinct()
        } + listOfNotNull(responseSet)
        if (sets.isEmpty()) {
            val probe = search.fit(BlindResponse(0.0, PROBE * series.period), delay.scales)
            val blind = seen < LAG_SEEN && none.score - probe.score < LAG_SEEN
            return if (blind) {
                Verdict.InsufficientData("passes over the same water are too few or too noisy to show a lag")
            } else {
                Verdict.Consistent
            }
        }
        return if (sets.any { it.size > 1 }) Verdict.Ambiguous(sets) else Verdict.Named(sets.map { it.single() })
    }

    /** What the response's numbers change, and an offset; the first state. */
    private fun nuisances(): List<DoubleArray> {
        val longer = DoubleArray(n)
        plain.predict(start.copyOf().also { it[0] *= STRETCH }, longer)
        return listOf(
            DoubleArray(n) { 1.0 },
            DoubleArray(n) { longer[it] - shown[it] },
            DoubleArray(n) { exp(-(series.times[it] - series.times[0]) / start[0]) },
        )
    }

    private fun terms(): List<Term> = buildList {
        // A second lag, a slow path, a dead time beside the lag or an offset along the track change what only a
        // reference shows: see [result].
        // A rate limit, a dead band and an end of the range act where the water turns, which nodes resolve worst.
        add(Term(Cause.ASYMMETRIC_RESPONSE))
        val spread = sqrt(scales.logSpeed.map { it * it }.average())
        if (spread > 0.03) add(Term(Cause.FLOW_DEPENDENT_RESPONSE))
        if (scales.warmth.any { abs(it) > 0.05 }) add(Term(Cause.TEMPERATURE_DEPENDENT_RESPONSE))
        for ((name, column) in scales.centred) {
            if (name != Conditions.HEADING && column.any { it != 0.0 }) add(Term(Cause.CROSS_SENSITIVITY, name))
        }
        add(Term(Cause.DRIFT))
    }

    /** [column], whitened, less what [basis] has of it, at unit length in the metric of what no field can imitate. */
    private fun offBasis(column: DoubleArray, basis: List<DoubleArray>): DoubleArray? {
        val rest = column.copyOf()
        for (direction in basis) {
            val share = lag.inner(rest.copyOf(), direction)
            for (i in 0 until n) rest[i] -= share * direction[i]
        }
        val before = sqrt(maxOf(dot(column, column), 1e-300))
        val length = sqrt(maxOf(lag.inner(rest.copyOf(), rest.copyOf()), 0.0))
        if (!(length > 1e-6 * before)) return null
        return DoubleArray(n) { rest[it] / length }
    }

    private fun attempt(term: Term, free: List<DoubleArray>): BlindTrial? {
        val model = ResponseModel(water, listOf(term), false, scales)
        val fit = Fitting.at(plain, start, BooleanArray(4), CorrelatedNoise.white(water, all))
        return Starts(fit, model, term, small = true).all().mapNotNull {
            trial(term, model, it, free)
        }.maxByOrNull { it.ratio }
    }

    private fun trial(term: Term, model: ResponseModel, numbers: DoubleArray, free: List<DoubleArray>): BlindTrial? {
        val changed = DoubleArray(n)
        model.predict(numbers, changed)
        val column = lag.whiten(DoubleArray(n) { changed[it] - shown[it] })
        val unit = offBasis(column, free) ?: return null
        val readings = lag.readings()
        val share = lag.inner(unit, readings)
        val square = lag.inner(readings, readings)
        val unlike = lag.unlike(unit)
        val inflation = Evidence.inflation(listOf(unlike), lag.residuals)
        val ratio = Evidence.ratio(square, square - share * share, n) / inflation
        val length = lag.inner(column, unit)
        val spread = sqrt(lag.variance * inflation)
        return BlindTrial(
            term,
            numbers,
            model,
            unit,
            share / length,
            spread / abs(length),
            ratio,
            maxOf(Evidence.pValue(ratio, 1), Evidence.student(between(unlike), STRETCHES - 1)),
            agrees(unlike),
        )
    }

    /**
     * How sure the log's stretches together are that the cause is there: Student's t of its size, with the size's own
     * spread between the stretches as the error, so that it holds whatever the noise is.
     */
    private fun between(unlike: DoubleArray): Double {
        val scores = DoubleArray(STRETCHES)
        val weights = DoubleArray(STRETCHES)
        for (i in 0 until n) {
            val stretch = (i.toLong() * STRETCHES / n).toInt()
            scores[stretch] += unlike[i] * lag.residuals[i]
            weights[stretch] += unlike[i] * unlike[i]
        }
        val size = scores.sum() / weights.sum()
        val error =
            scores.indices.sumOf { (scores[it] - size * weights[it]).let { e -> e * e } } * STRETCHES / (STRETCHES - 1)
        return scores.sum() / sqrt(maxOf(error, 1e-300))
    }

    /** Whether both halves of the log show the cause, in the same direction, and of sizes that do not contradict. */
    private fun agrees(unlike: DoubleArray): Boolean {
        val sizes = DoubleArray(2)
        val weights = DoubleArray(2)
        for (i in 0 until n) {
            val half = if (2 * i < n) 0 else 1
            sizes[half] += unlike[i] * lag.residuals[i]
            weights[half] += unlike[i] * unlike[i]
        }
        if (weights.any { it < 1e-3 * (weights[0] + weights[1]) }) return false
        val a = sizes[0] / weights[0]
        val b = sizes[1] / weights[1]
        return a * b > 0 && abs(a - b) < MOST_APART * abs(a + b) / 2
    }

    /** The lag's time, with an interval from how much stretches of the log differ about it. */
    private fun timeConstant(): Estimate {
        val tau = start[0]
        val longer = DoubleArray(n)
        plain.predict(start.copyOf().also { it[0] *= STRETCH }, longer)
        val column = delay.whiten(DoubleArray(n) { (longer[it] - shown[it]) / ln(STRETCH) })
        val reach = STUDENT_95 * errorOf(delay.unlike(column))
        val interval = if (reach < 20) Interval(tau * exp(-reach), tau * exp(reach)) else null
        return Estimate("time_constant_s", "s", tau, interval)
    }

    private fun errorOf(unlike: DoubleArray): Double {
        val scores = DoubleArray(STRETCHES)
        val weights = DoubleArray(STRETCHES)
        for (i in 0 until n) {
            val stretch = (i.toLong() * STRETCHES / n).toInt()
            scores[stretch] += unlike[i] * delay.residuals[i]
            weights[stretch] += unlike[i] * unlike[i]
        }
        val size = scores.sum() / weights.sum()
        val error =
            scores.indices.sumOf { (scores[it] - size * weights[it]).let { e -> e * e } } * STRETCHES / (STRETCHES - 1)
        return sqrt(error) / weights.sum()
    }

    private fun estimates(trial: BlindTrial): List<Estimate> {
        val at = trial.model.slotOrNull(trial.term) ?: return emptyList()
        return (0 until trial.model.width(trial.term)).map { k ->
            val parameter = trial.model.parameters[at + k]
            val linear = parameter.neutral.isFinite() && trial.model.width(trial.term) == 1
            if (!linear) return@map Estimate(parameter.name, parameter.unit, trial.numbers[at + k], null)
            val value = trial.amount * trial.numbers[at + k]
            val reach = NORMAL_95 * trial.error * abs(trial.numbers[at + k])
            Estimate(parameter.name, parameter.unit, value, Interval(value - reach, value + reach))
        }
    }

    private fun rmse(predicted: DoubleArray) = sqrt(
        series.values.indices.sumOf {
            (series.values[it] - predicted[it]).let { e -> e * e }
        } / n,
    )

    private fun assessment(parameters: List<Estimate>, predicted: DoubleArray): ModelAssessment {
        val spread = sqrt(maxOf(lag.variance, 1e-300))
        return ModelAssessment(
            parameters,
            rmse(predicted),
            // Nothing was held out: the field would have to be inferred anew without each block.
            Double.NaN,
            Double.NaN,
            predicted,
            spread,
            if (lag.scales.noiseTime > 0) 1.0 else 0.0,
            lag.scales.noiseTime,
            DoubleArray(n) { lag.residuals[it] / spread },
        )
    }

    private fun predicted(trial: BlindTrial): DoubleArray {
        val changed = DoubleArray(n)
        trial.model.predict(trial.numbers, changed)
        val base = lag.predicted()
        return DoubleArray(n) { base[it] + trial.amount * (changed[it] - shown[it]) }
    }

    private fun extendedAssessment(chosen: List<BlindTrial>): ModelAssessment {
        val sum = lag.predicted()
        for (trial in chosen) {
            val more = predicted(trial)
            val base = lag.predicted()
            for (i in 0 until n) sum[i] += more[i] - base[i]
        }
        return assessment(listOf(timeConstant()) + chosen.flatMap { estimates(it) }, sum)
    }

    private fun candidates(first: List<BlindTrial>): List<Candidate> {
        val adjusted = Evidence.holm(first.map { it.pValue })
        return first.mapIndexed { i, trial ->
            val shown = predicted(trial)
            Candidate(
                trial.term.cause,
                trial.term.condition,
                estimates(trial),
                rmse(shown),
                Double.NaN,
                Double.NaN,
                trial.pValue,
                adjusted[i],
                shown,
            ) to trial.worth
        }.sortedByDescending { it.second }.map { it.first }
    }

    private fun spec(name: String, trial: BlindTrial?): stillwater.sensor.SensorSpec {
        val model = trial?.model ?: plain
        val numbers = trial?.numbers?.copyOf() ?: start
        if (trial != null && trial.model.width(trial.term) == 1) {
            val at = trial.model.slot(trial.term)
            if (trial.model.parameters[at].neutral.isFinite()) {
                val parameter = trial.model.parameters[at]
                numbers[at] = (numbers[at] * trial.amount).coerceIn(parameter.lower, parameter.upper)
            }
        }
        val fit = Fitting.at(model, numbers, BooleanArray(numbers.size), CorrelatedNoise.white(water, all))
        return ExtendedSensor(fit, null).spec(name)
    }

    private companion object {
        const val LAG_SEEN = 12.0

        /** A t of 3 counts as a likelihood ratio of [LAG_SEEN]. */
        const val SCORE = 4.0
        const val PROBE = 5.0
        const val STRETCH = 1.1
        const val FEWEST_ROWS = 60
        const val NORMAL_95 = 1.96

        /** The same of Student's t with 11 degrees of freedom. */
        const val STUDENT_95 = 2.2
        const val STRETCHES = 12
        const val MOST_APART = 1.5
    }
}
