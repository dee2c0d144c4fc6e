package stillwater.diagnose.evidence

import stillwater.diagnose.Estimate
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.ModelAssessment
import stillwater.diagnose.algebra.SymmetricSystem
import stillwater.diagnose.independentResiduals
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.Parameter
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.Term
import stillwater.diagnose.response.baseNumbers
import stillwater.model.Interval
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Fits as the answer shows them: numbers with intervals, residuals. [used] are the rows that were fitted; [isOpen] whether
 * how the truth goes on between them was not told by the log for certain.
 */
internal class FitReport(
    private val series: MeasuredSeries,
    private val used: BooleanArray,
    private val isOpen: Boolean = true,
) {
    private val bounded = LinkedHashSet<String>()

    /** Numbers that ended where the search may not go on, one sentence each. */
    val warnings: List<String> get() = bounded.toList()

    /** Root mean square of [fit]'s residuals over the rows in use, sensor units. */
    fun rmse(fit: ModelFit): Double {
        var sum = 0.0
        for (i in used.indices) if (used[i]) sum += fit.residuals[i] * fit.residuals[i]
        return sqrt(sum / maxOf(used.count { it }, 1))
    }

    /** What the model of [fit] shows along the log, sensor units. */
    fun predicted(fit: ModelFit): DoubleArray = fit.predicted

    /** [fit] as the answer shows it. */
    fun assessment(fit: ModelFit, heldOut: HeldOutScore) = ModelAssessment(
        estimates(fit, fit.model.terms, withBase = true, isAnswer = true),
        rmse(fit),
        heldOut.rmse,
        heldOut.logLikelihood,
        predicted(fit),
        sqrt(fit.variance),
        fit.noise.share,
        fit.noise.time,
        fit.whitened.let { z -> DoubleArray(z.size) { z[it] / sqrt(maxOf(fit.variance, 1e-300)) } },
        independentResiduals(used),
    )

    /**
     * The time constant and the numbers of [terms], with gain and offset where [withBase]; a number at the end of its
     * search is warned of where [isAnswer].
     */
    fun estimates(
        fit: ModelFit,
        terms: List<Term>,
        withBase: Boolean = false,
        isAnswer: Boolean = false,
    ): List<Estimate> {
        val errors = errors(fit)
        val indices = (if (withBase) 0 until ResponseModel.BASE - 1 else listOf(0)) +
            terms.flatMap { term ->
                val own = fit.model.slotOrNull(term)?.let { (it until it + fit.model.width(term)).toList() }.orEmpty()
                    .filter { it !in fit.model.firstStates }
                if (withBase) own else term.cause.baseNumbers.filter { it != ResponseModel.TIME_CONSTANT } + own
            }
        val pair = LagPair.of(fit)
        // An end of the range that the sensor does not have is no number.
        return indices.filter { abs(fit.numbers[it]) < ResponseModel.NO_END }.map { place ->
            val i = pair?.inOrder(place) ?: place
            val parameter = fit.model.parameters[place]
            val value = value(fit, i)
            if (isAnswer && value < fit.numbers[i]) bounded += SLOWEST
            Estimate(parameter.name, parameter.unit, value, interval(fit, i, errors[i], pair, isAnswer))
        }
    }

    /** Number [i] of [fit], as the model has it: no path is slower than a log of this length shows. */
    private fun value(fit: ModelFit, i: Int) =
        if (fit.model.parameters[i].name == SLOW_RATIO) fit.model.slowRatio(fit.numbers) else fit.numbers[i]

    private fun interval(fit: ModelFit, i: Int, error: Double, pair: LagPair?, isAnswer: Boolean): Interval? {
        val parameter = fit.model.parameters[i]
        val value = fit.numbers[i]
        if (!fit.free[i]) return null
        if (parameter.atLower(value) || parameter.atUpper(value)) {
            if (isAnswer) {
                bounded += "${parameter.name} ends at ${if (parameter.atLower(value)) "the least" else "the most"} " +
                    "that is looked for: its interval is open to that side."
            }
            return beside(fit, i)
        }
        val reach = NORMAL_95 * error
        pair?.takeIf { it.isAlike(i, reach) }?.let { return it.interval(i, used) }
        if (!reach.isFinite() || reach == 0.0) return null
        if (!parameter.logarithmic) {
            val open = open(fit, i, parameter)
            return Interval(parameter.possible(value - reach - open.first), value + reach + open.second)
        }
        // What is shorter than rows does not show.
        return if (reach < FAR) Interval(value * exp(-reach), value * exp(reach)) else null
    }

    /**
     * What the way the log is sampled leaves open of [parameter], number [i], downward and upward. Sharp steps of the
     * truth may each have come a row later where it is held, a row sooner where it is held until the next, else half a row
     * either way; of others the ways that are about as likely count.
     */
    private fun open(fit: ModelFit, i: Int, parameter: Parameter): Pair<Double, Double> = when {
        parameter.name != "dead_time_s" -> 0.0 to 0.0
        fit.model.scales.unknown?.isSharp != true -> otherWays(fit, i)
        // What a second lag is ahead by the delay makes up for.
        fit.model.steps == Steps.HELD -> series.period * (1 + fit.model.secondLead) to 0.0
        fit.model.steps == Steps.UNTIL_NEXT -> 0.0 to series.period
        else -> series.period / 2 to series.period / 2
    }

    /** How far number [i] of [fit], a delay, is less and more with the truth held otherwise, where that is as likely. */
    private fun otherWays(fit: ModelFit, i: Int): Pair<Double, Double> {
        // Of a sensor that shows the truth within a row, what is held until the next is a delay of a row like any other.
        val isAtOnce = fit.numbers[ResponseModel.TIME_CONSTANT] < series.period / 2
        if (!isOpen || isAtOnce) return 0.0 to 0.0
        val value = fit.numbers[i]
        val others = Steps.entries.filter { it != fit.model.steps }.mapNotNull { steps ->
            val start = fit.numbers.copyOf().also { numbers ->
                numbers[i] = maxOf(value + (steps.lead - fit.model.steps.lead) * series.period, 0.0)
            }
            val model = ResponseModel(fit.model.series, fit.model.terms, steps, fit.model.scales)
            val other = Fitting.fit(model, start, fit.free, used, fit.noise.time, noise = fit.noise)
            other.numbers[i].takeIf { other.score > fit.score - AS_LIKELY }
        }
        return maxOf(value - (others.minOrNull() ?: value), 0.0) to maxOf((others.maxOrNull() ?: value) - value, 0.0)
    }

    /**
     * From the end of the search at which number [i] of [fit] is to where the likelihood has fallen by what a one-sided
     * 95 % allows, the other numbers fitted anew; at most the whole way to the other end.
     */
    private fun beside(fit: ModelFit, i: Int): Interval {
        val parameter = fit.model.parameters[i]
        val isLower = parameter.atLower(fit.numbers[i])
        val end = if (isLower) parameter.lower else parameter.upper
        val free = fit.free.copyOf().also { it[i] = false }
        val numbers = fit.numbers.copyOf()
        var step = if (parameter.logarithmic) ln(2.0) else (parameter.upper - parameter.lower) * SMALLEST_PART
        var value = end
        repeat(MOST_STEPS) {
            value = when {
                parameter.logarithmic -> end * exp(if (isLower) step else -step)
                isLower -> end + step
                else -> end - step
            }
            if (value !in parameter.lower..parameter.upper) return Interval(parameter.lower, parameter.upper)
            numbers[i] = value
            val moved = Fitting.fit(fit.model, numbers, free, used, fit.noise.time, noise = fit.noise)
            if (fit.score - moved.score > ONE_SIDED_95) return oneSided(isLower, end, value)
            step *= 2
        }
        return oneSided(isLower, end, value)
    }

    private fun oneSided(isLower: Boolean, end: Double, value: Double) =
        if (isLower) Interval(end, value) else Interval(value, end)

    /** Standard error of every parameter on the scale it is fitted on; 0 where it was not fitted or does not show. */
    private fun errors(fit: ModelFit): DoubleArray {
        val columns = fit.jacobian
        val system = SymmetricSystem.of(columns, fit.whitened)
        val errors = DoubleArray(fit.numbers.size)
        val free = fit.free.indices.filter { fit.free[it] }
        free.forEachIndexed { k, i -> errors[i] = sqrt(maxOf(system.inverseDiagonal(k), 0.0) * fit.variance) }
        return errors
    }

    /** Standard error of the time constant of [fit], on a logarithmic scale. */
    fun timeConstantError(fit: ModelFit): Double = errors(fit)[ResponseModel.TIME_CONSTANT]

    companion object {
        private const val NORMAL_95 = 1.96

        private const val SLOWEST =
            "The slow path is as slow as is looked for in a log of this length, an eighth of it: it may be slower."

        /** Number [i] of [numbers] where it is that of a path slower than [model] takes it to be, told of in [words]; else null. */
        fun slowest(model: ResponseModel, numbers: DoubleArray, i: Int, words: MutableList<String>): Estimate? {
            val parameter = model.parameters[i]
            if (parameter.name != SLOW_RATIO || model.slowRatio(numbers) >= numbers[i]) return null
            words += SLOWEST
            return Estimate(parameter.name, parameter.unit, model.slowRatio(numbers), null)
        }

        private const val SLOW_RATIO = "slow_ratio"

        /** Twice a log-likelihood ratio by which another way is less likely and still may be. */
        private const val AS_LIKELY = 6.0

        /** Chi-square with one degree of freedom at 90 %: 95 % to one side. */
        private const val ONE_SIDED_95 = 2.71

        /** Logarithm of the factor either way from which a number does not show. */
        private const val FAR = 7.0
        private const val SMALLEST_PART = 1e-4
        private const val MOST_STEPS = 14
    }
}
