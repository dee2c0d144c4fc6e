package stillwater.diagnose.evidence

import stillwater.diagnose.Cause
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.Term
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.ln
import kotlin.math.round
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class RoundingNullTest {
    private val n = 500

    /** Water so slow that rounding errs the same way for many rows. */
    private val truth = DoubleArray(n) { sin(it / 60.0) + 0.5 * sin(it / 37.0 + 1) }
    private val rounding = Term(Cause.QUANTISATION)
    private val drift = Term(Cause.DRIFT)
    private val used = BooleanArray(n) { true }

    /** Readings of a lag of 3 rows under noise of [spread] with [rate] units of drift a row, rounded to tenths. */
    private fun log(seed: Int, spread: Double, rate: Double): MeasuredSeries {
        val random = Random(seed)
        var s = truth[0]
        val values = DoubleArray(n) { i ->
            s += (truth[i] - s) / 3
            val normal = sqrt(-2 * ln(1 - random.nextDouble())) * cos(2 * PI * random.nextDouble())
            STEP * round((s + rate * i + spread * normal) / STEP)
        }
        return MeasuredSeries(DoubleArray(n) { it.toDouble() }, DoubleArray(n), DoubleArray(n), values, truth)
    }

    private fun fit(series: MeasuredSeries, terms: List<Term>, numbers: List<Double>): ModelFit {
        val model = ResponseModel(series, terms, Steps.HELD, Scales(series))
        val start = (listOf(3.0, 1.0, 0.0, 0.0) + numbers).toDoubleArray()
        return Fitting.fit(model, start, BooleanArray(start.size) { true }, used, LONGEST)
    }

    /** What drift gains in [series] as [RoundingNull] counts it, and by the likelihood alone. */
    private fun gains(series: MeasuredSeries, spread: Double): Pair<Double, Double> {
        val without = fit(series, listOf(rounding), listOf(spread))
        val full = fit(series, listOf(rounding, drift), listOf(spread, 0.0))
        return RoundingNull(without, LONGEST).gain(full, drift) to full.score - without.score
    }

    @Test
    fun whatIsNotThereGainsNoMoreBesideCoarseRoundingThanByChance() {
        val gains = (1..LOGS).map { gains(log(it, COARSE, 0.0), COARSE) }
        val counted = gains.map { it.first }
        val alone = gains.map { it.second }
        // The likelihood alone takes rounding's phase for a drift: this is what the null is for.
        assertTrue(alone.average() > MEAN, "$alone counted $counted")
        assertTrue(counted.average() < MEAN, "$counted where the likelihood says $alone")
        // One in a thousand each, one degree of freedom.
        assertTrue(counted.all { it < 10.8 }, "$counted")
    }

    @Test
    fun whatIsThereStillGainsMuch() {
        // Ten steps over the log; fifteen is a p-value of one in ten thousand.
        val gain = gains(log(1, COARSE, 10 * STEP / n), COARSE).first
        assertTrue(gain > 15, "$gain")
    }

    @Test
    fun fineRoundingIsNoNullOfItsOwn() {
        val (counted, alone) = gains(log(1, 2 * STEP, STEP / n), 2 * STEP)
        // What the first step of the fit explains, against the whole: near the optimum they are the same.
        assertEquals(alone, counted, 0.25 * alone + 0.5)
    }

    @Test
    fun theSameLogGainsTheSame() {
        val series = log(3, COARSE, 0.0)
        assertEquals(gains(series, COARSE), gains(series, COARSE))
    }

    private companion object {
        const val STEP = 0.1

        /** Noise before rounding of a tenth of a step: coarse. */
        const val COARSE = 0.01
        const val LONGEST = 25.0
        const val LOGS = 12

        /** The mean of twelve χ² of one degree is within 1 ± 0.41; four standard deviations. */
        const val MEAN = 2.6
    }
}
