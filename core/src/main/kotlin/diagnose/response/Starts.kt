package stillwater.diagnose.response

import stillwater.diagnose.Cause
import stillwater.diagnose.algebra.squares
import kotlin.math.abs
import kotlin.math.sqrt

/**
 * Where a fit of a model with one more cause begins: several places, because some causes have more than one optimum.
 */
internal class Starts(
    private val fit: ModelFit,
    private val model: ResponseModel,
    private val term: Term,
    private val small: Boolean = false,
) {
    private val series = model.series
    private val scales = model.scales
    private val tau = fit.numbers[ResponseModel.TIME_CONSTANT]
    private val spread = sqrt(squares(fit.residuals) / maxOf(series.size, 1))

    /** The places, as full sets of numbers; a time constant that is not fitted stays as it is. */
    fun all(): List<DoubleArray> = kept(places())

    /**
     * Places far from where a fit's first steps lead, for responses that a lag and water which suits it may hide. Of 163
     * fits that gained more than 3 in twice the log-likelihood one was likelier from any other place of [all], by 4
     * (docs/performance.md, "Beginnings").
     */
    fun far(): List<DoubleArray> = kept(
        when (term.cause) {
            Cause.SECOND_ORDER_RESPONSE -> listOf(behind(EQUAL))
            Cause.DEAD_TIME -> listOf(series.period, tau / 3).map(::late)
            // 195263 is found from there alone, where it gains nothing yet.
            Cause.POSITION_OFFSET -> of(term.cause)
            // A dead band holds readings back, as a longer lag does.
            Cause.HYSTERESIS -> listOf(0.05 to 0.7, 0.12 to 0.45).map { (width, share) ->
                with(width * scales.range).also { it[ResponseModel.TIME_CONSTANT] = share * tau }
            }
            else -> emptyList()
        },
    )

    private fun kept(places: List<DoubleArray>) = places.onEach { numbers ->
        if (!fit.free[ResponseModel.TIME_CONSTANT]) numbers[ResponseModel.TIME_CONSTANT] = tau
        model.parameters.forEachIndexed { i, parameter ->
            numbers[i] = numbers[i].coerceIn(parameter.lower, parameter.upper)
        }
    }

    private fun places(): List<DoubleArray> = when {
        small && term.cause in IN_PROPORTION -> listOf(with(STEPS.getValue(term.cause)))
        small && term.cause == Cause.DRIFT -> listOf(with(scales.range / series.duration))
        small && term.cause == Cause.CROSS_SENSITIVITY -> listOf(with(scales.range / extent()))
        small && term.cause == Cause.DEAD_TIME -> listOf(0.3, 1.0).map { inPlace(it * series.period) }
        small && term.cause == Cause.SECOND_ORDER_RESPONSE -> listOf(0.1, 0.5, 1.5).map { inPlace(it * series.period) }
        small && term.cause == Cause.TWO_PATH_RESPONSE -> listOf(3.0, 8.0, 25.0).map { ratio ->
            with(ratio, SHARE).also { it[ResponseModel.TIME_CONSTANT] = tau / (1 + SHARE * (ratio - 1)) }
        }
        small && term.cause == Cause.POSITION_OFFSET ->
            listOf(inPlace(0.3 * series.period, scales.ordinarySpeed * 0.3 * series.period))
        small && term.cause == Cause.SLEW_LIMIT -> rates(listOf(0.75, 0.9, 0.97, 0.99, 0.998)).map { with(it) }
        else -> of(term.cause)
    }

    /** From the least to the most of the condition that the reading may show, in its unit. */
    private fun extent(): Double {
        val column = scales.centred.getValue(term.condition.orEmpty())
        return column.max() - column.min()
    }

    private fun of(cause: Cause): List<DoubleArray> = when (cause) {
        Cause.ASYMMETRIC_RESPONSE -> listOf(0.2, -0.2).map { with(it) }
        Cause.SECOND_ORDER_RESPONSE -> listOf(0.1, 0.35, EQUAL).map(::behind)
        Cause.TWO_PATH_RESPONSE -> listOf(
            Triple(0.8, 5.0, 0.15),
            Triple(0.9, 20.0, 0.1),
            Triple(0.4, 4.0, 0.5),
        ).map { (first, ratio, share) -> with(ratio, share).also { it[ResponseModel.TIME_CONSTANT] = tau * first } }
        Cause.DEAD_TIME -> {
            val late = listOf(series.period, tau / 3, tau, 3 * tau)
            val early = listOf(-series.period / 3, -series.period, -3 * series.period)
            (if (term.isEitherWay) early + late else late).map(::late)
        }
        Cause.SLEW_LIMIT -> rates().map { with(it) }
        Cause.FLOW_DEPENDENT_RESPONSE -> listOf(0.2, -0.2).map { with(it) }
        Cause.TEMPERATURE_DEPENDENT_RESPONSE -> listOf(0.02, -0.02).map { with(it) }
        Cause.HYSTERESIS -> listOf(0.5, 1.5, 4.0).map { with(it * spread) } + with(0.03 * scales.range)
        Cause.QUANTISATION -> listOf(0.15, 0.3, 0.45).map { with(it * scales.resolution) }
        Cause.SATURATION -> {
            val sorted = series.shown(series.values).sortedArray()
            val low = sorted[(0.01 * sorted.size).toInt()]
            val high = sorted[(0.99 * (sorted.size - 1)).toInt()]
            listOf(with(low, ResponseModel.FAR_END), with(-ResponseModel.FAR_END, high), with(low, high))
        }
        Cause.POSITION_OFFSET -> listOf(1.0, -1.0).map { with(it * scales.ordinarySpeed * series.period) } +
            with(tau * scales.ordinarySpeed / 2)
        Cause.OFFSET_STEPS, Cause.CROSS_SENSITIVITY, Cause.DRIFT -> listOf(extended())
        else -> listOf(extended())
    }

    /** A second lag of [share] of the first. */
    private fun behind(share: Double) =
        with(tau * share).also { it[ResponseModel.TIME_CONSTANT] = tau * (1 - share / 2) }

    /** A delay of [delay] s, of which some is in the time constant so far. */
    private fun late(delay: Double) = with(delay).also { it[ResponseModel.TIME_CONSTANT] = maxOf(tau - delay, tau / 3) }

    /** A delay of [delay] s, which is the new number where that is not [value], taken off the time constant. */
    private fun inPlace(delay: Double, value: Double = delay) =
        with(value).also { it[ResponseModel.TIME_CONSTANT] = maxOf(tau - delay, tau / 2) }

    private fun rates(shares: List<Double> = listOf(0.5, 0.75, 0.9, 0.97)): List<Double> {
        val shown = DoubleArray(series.size - 1) { i ->
            abs(fit.predicted[i + 1] - fit.predicted[i]) /
                (series.times[i + 1] - series.times[i])
        }.sortedArray()
        return shares.map { maxOf(shown[(it * (shown.size - 1)).toInt()], 1e-9 * scales.range) }
    }

    /** The numbers fitted so far, in the places they have in [model]; new ones neutral. */
    private fun extended(): DoubleArray = model.carried(fit.model, fit.numbers)

    private fun with(vararg values: Double): DoubleArray = extended().also { numbers ->
        val at = model.slot(term)
        values.forEachIndexed { k, value -> numbers[at + k] = value }
    }

    companion object {
        /** Where a fit of [model], a lag alone, begins. */
        fun ofLags(model: ResponseModel): List<DoubleArray> = doubleArrayOf(0.7, 3.0, 12.0, 50.0).map { rows ->
            DoubleArray(model.parameters.size).also {
                it[ResponseModel.TIME_CONSTANT] = rows * model.series.period
                it[ResponseModel.GAIN] = 1.0
            }
        }

        /** Causes whose effect is nearly in proportion to a number, and a small value of it. */
        private val STEPS = mapOf(
            Cause.ASYMMETRIC_RESPONSE to 0.1,
            Cause.FLOW_DEPENDENT_RESPONSE to 0.1,
            Cause.TEMPERATURE_DEPENDENT_RESPONSE to 0.01,
        )
        private val IN_PROPORTION = STEPS.keys

        /** The second lag over the first, where the two are nearly equal. */
        private const val EQUAL = 0.8

        /** A small share of the slow path. */
        private const val SHARE = 0.01
    }
}
