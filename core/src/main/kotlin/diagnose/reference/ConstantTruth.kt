package stillwater.diagnose.reference

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.isFlat
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Starts
import stillwater.diagnose.three

/**
 * A reference that never changes, as of a probe that is left in one sample: what is added to the readings shows, and no gain,
 * nor a lag but by how a probe that came from elsewhere settled.
 *
 * A lag that is free makes up for a drift by settling for as long as the log goes on, and causes beside it explain the rest
 * (a drift was named a rate limit).
 *
 * @param used rows that are fitted.
 */
internal class ConstantTruth(
    private val series: MeasuredSeries,
    private val used: BooleanArray,
    private val longest: Double,
) {
    /** The likeliest of [fits] where the probe settled within the log; else a sensor that follows at once. */
    fun base(fits: List<ModelFit>): ModelFit {
        val best = fits.maxBy { it.score }
        val promptly = promptly(best.model)
        val isSettled = best.numbers[ResponseModel.TIME_CONSTANT] < series.duration * SETTLED
        return if (isSettled && best.score > promptly.score + SETTLES) best else promptly
    }

    private fun promptly(model: ResponseModel): ModelFit {
        val start = Starts.ofLags(model).first().also { it[ResponseModel.TIME_CONSTANT] = series.period / AT_ONCE }
        return Fitting.fit(model, start, BooleanArray(start.size) { it == ResponseModel.OFFSET }, used, longest)
    }

    companion object {
        /** Of the log: a lag that is longer has not settled in it. */
        private const val SETTLED = 0.1

        /** Twice the log-likelihood that a lag and a first state are to gain. */
        private const val SETTLES = 25.0

        /** Of a row: the lag of a sensor that has none. */
        private const val AT_ONCE = 50

        /** Whether [series] has such a reference. */
        fun isOf(series: MeasuredSeries): Boolean = series.reference?.let(::isFlat) == true

        /** What cannot be told, and what of the lag the [base] model has. */
        fun words(base: ModelFit): String =
            "the truth never changes, so that no gain can show, nor a lag" + (settled(base) ?: "")

        /** The same beside what was named. */
        fun caution(base: ModelFit): String =
            "The reference never changes: what is added to the readings shows, and no gain, nor a lag" +
                (settled(base) ?: if (follows(base)) ": the sensor is taken for one that follows at once" else "") + "."

        private fun follows(base: ModelFit) = base.numbers[ResponseModel.TIME_CONSTANT] < base.model.series.period / 2

        private fun settled(base: ModelFit) = base.numbers[ResponseModel.TIME_CONSTANT]
            .takeIf { !follows(base) && base.free[ResponseModel.TIME_CONSTANT] }
            ?.let { " but by how the first readings settled, as with one of ${three(it)} s" }
    }
}
