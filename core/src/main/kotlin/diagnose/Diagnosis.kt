package stillwater.diagnose

import kotlin.math.abs

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
 * @param progress told how much is done, a share within 0..1 that grows; at most a few hundred times.
 */
public class Diagnosis(
    private val series: MeasuredSeries,
    private val settings: DiagnosisSettings = DiagnosisSettings(),
    private val progress: (Double) -> Unit = {},
) {
    private val scales = Scales(series)
    private val used = BooleanArray(series.size) { true }
    private val search = CauseSearch(series, scales, used, settings)
    private var trials = 0

    /** The answer. Without a reference the field is inferred together with the sensor. */
    public fun run(): DiagnosisResult {
        if (series.reference == null) return BlindDiagnosis(series, settings, progress).run().also { progress(1.0) }
        val first = weighing(null)
        // Whether steps are held shows only once the response is right: the other way is tried with what was named, and
        // with each beginning of it, because what came after may make up for the wrong way.
        val doubtful = first.chosen.any { turned(it.fit).score > it.fit.score + HELD }
        return (if (doubtful) better(first) else first).result().also { progress(1.0) }
    }

    /** [first] or the weighing with steps the other way, whichever explains the log better for its numbers. */
    private fun better(first: Weighing): Weighing {
        val rows = used.copyOf()
        val second = weighing(!first.last.model.held)
        if (second.explained > first.explained) return second
        rows.copyInto(used)
        return first
    }

    /** [fit] with steps held if they are not, and the other way round. */
    private fun turned(fit: ModelFit): ModelFit {
        val other = ResponseModel(series, fit.model.terms, !fit.model.held, scales)
        return Fitting.fit(other, fit.numbers, fit.free, used, search.longest, guess = fit.noise)
    }

    private fun weighing(held: Boolean?): Weighing {
        used.fill(true)
        val rough = base(held)
        // Rounding moves readings by up to half a step: what is within a step need not be wild.
        val spikes = Spikes.of(rough.whitened).filter { abs(rough.residuals[it]) > scales.resolution }
        spikes.forEach { used[it] = false }
        return Weighing(search, if (spikes.isEmpty()) rough else base(held), used, spikes, settings, ::tell)
    }

    /** One more trial is done; a search of [terms] terms takes one round of them or several. */
    private fun tell(terms: Int) {
        trials++
        progress(trials / (trials + maxOf(terms.toDouble() - trials, terms / 2.0)))
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

    private companion object {
        /** Twice the log-likelihood by which steps must look held. */
        const val HELD = 6.0
    }
}
