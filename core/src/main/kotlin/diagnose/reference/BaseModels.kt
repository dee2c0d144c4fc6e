package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Starts
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.Term
import stillwater.diagnose.response.UnknownTruth
import kotlin.math.abs

/**
 * Models without a cause of a log with a reference: a first-order lag with gain and offset, or the given sensor.
 *
 * @param used rows that are fitted; which they are may change. @param unknown what the reference leaves open.
 * @param lengthScale of what tells the truth halfway between rows, usual steps; 0 for a spline through these alone.
 */
internal class BaseModels(
    private val series: MeasuredSeries,
    private val settings: DiagnosisSettings,
    private val unknown: UnknownTruth,
    private val used: BooleanArray,
    lengthScale: Double,
) {
    private val longest = CauseSearch.longest(series, settings)
    private val calm =
        Scales(series, unknown, swing = series.reference?.let { ArmSwing(series, it) }, lengthScale = lengthScale)

    /** The base model as it looks with nothing known of gaps, sharp fronts and single wild readings. */
    val rough: ModelFit by lazy { of(null, null) }

    /** What the reference leaves open of the readings, which may be late by whole rows. */
    val shaken: UnknownTruth by lazy { if (unknown.isSharp) unknown.seen(late()) else unknown }

    /**
     * The base model. How much a gap or a sharp front shakes the reading is told by the lag, and that by what is left
     * of the log: each in turn.
     */
    fun settled(steps: Steps?): ModelFit {
        var last = if (steps == null) rough else of(steps, null)
        repeat(SETTLING) {
            if (scales(last, last.model.steps).shocks == null) return last
            last = of(steps, last)
        }
        return last.withOwnFade(used, longest)
    }

    /** What models share where the readings have lag and noise like those of [fit]. */
    fun scales(fit: ModelFit?, steps: Steps): Scales = fit?.scales(calm, shaken, steps.isHeld) ?: calm

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

    /**
     * The base model with [steps], as the log says where that is null. Lag and noise are as [rough].
     */
    fun of(steps: Steps?, rough: ModelFit?): ModelFit {
        val ways = listOf(Steps.EVEN, Steps.HELD) + listOfNotNull(Steps.UNTIL_NEXT.takeIf { unknown.isSharp })
        val fits = (steps?.let { listOf(it) } ?: ways).map { of(it, scales(rough, it)).withOwnFade(used, longest) }
        // Held steps are the simulator's own way; where the log does not say, the truth is taken as continuous. A given
        // sensor's numbers may be wrong, so that this is told with them free.
        val likeliest = fits.maxBy { it.score }
        val best = if (likeliest.score > fits[0].score + HELD) likeliest else fits[0]
        if (settings.base == null) return best
        val free = BooleanArray(best.free.size) { it in best.model.firstStates }
        val numbers = GivenSensor(settings.base, best.model.scales).numbers(best.model)
        return Fitting.fit(best.model, numbers, free, used, longest)
    }

    private fun of(steps: Steps, scales: Scales): ModelFit {
        val given = settings.base?.let { GivenSensor(it, scales) }
        val isConstant = given == null && ConstantTruth.isOf(series)
        // A sensor file does not say how noisily another quantity is measured that the sensor shows.
        val known = given?.terms.orEmpty().let { listOf(it, it.map(Term::quiet)) }
        val forms = (known + known.map { it.map(Term::begun) }).distinct()
        return forms.map { ResponseModel(series, it, steps, scales) }.flatMap { model ->
            val free = BooleanArray(model.parameters.size) { it < ResponseModel.BASE || it in model.firstStates }
            val starts = given?.let { listOf(it.numbers(model)) } ?: Starts.ofLags(model)
            val fits = starts.map { Fitting.fit(model, it, free, used, longest) }
            if (isConstant) listOf(ConstantTruth(series, used, longest).base(fits)) else fits
        }.maxBy { it.score - CauseSearch.OWN_START * it.model.firstStates.size }
    }

    companion object {
        /** Twice the log-likelihood by which steps must look held. */
        const val HELD = 6.0
        private const val SETTLING = 2

        /** Twice the log-likelihood by which readings must look late before they are shaken later. */
        private const val SHAKEN = 25.0

        /** Delays that are tried then, in time constants and in rows. */
        private val TIMES_LATE = listOf(-1.0, -0.3, 0.3, 1.0, 3.0)
        private val ROWS_LATE = listOf(-4.0, -1.5, 1.5, 4.0)
    }
}
