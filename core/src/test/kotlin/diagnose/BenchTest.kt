package stillwater.diagnose

import org.junit.jupiter.api.Tag
import stillwater.diagnose.evidence.LooseReadings
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.reference.CalibrationPoint
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.Term
import stillwater.diagnose.response.UnknownTruth
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertIs
import kotlin.test.assertTrue

/** Logs as a laboratory makes them: a probe moved between samples, or a reference that is an instrument itself. */
class BenchTest {
    private val random = java.util.Random(20260917)
    private val n = 500

    private fun water(time: Double) = 6 + sin(time / 9) + 0.7 * sin(time / 23 + 1)

    /** What a lag of [lag] s shows of the water each second, without noise. */
    private fun lagged(lag: Double): DoubleArray {
        val per = 20
        var state = water(0.0)
        return DoubleArray(n) { row ->
            if (row > 0) {
                for (k in 0 until per) {
                    state += (1 - exp(-1.0 / per / lag)) * (water(row - 1 + (k + 0.5) / per) - state)
                }
            }
            state
        }
    }

    private fun noisy(column: DoubleArray, spread: Double, random: java.util.Random = this.random) =
        DoubleArray(column.size) { column[it] + spread * random.nextGaussian() }

    private fun log(values: DoubleArray, reference: DoubleArray): MeasuredSeries {
        val still = DoubleArray(values.size)
        return MeasuredSeries(DoubleArray(values.size) { it.toDouble() }, still, still, values, reference)
    }

    @Test
    fun aReferenceWithALagOfItsOwnMakesNoSecondPath() {
        val result = Diagnosis(log(noisy(lagged(12.0), 0.015), noisy(lagged(4.0), 0.003))).run()
        val reason = assertIs<Verdict.Unexplained>(result.verdict).what
        assertContains(reason, Regex("ahead of the reference by 4(\\.\\d)? s"))
    }

    @Test
    fun wildReadingsBesideNoiseThatWandersAreNoChangesThatLast() {
        val wild = (20 until n step 40).toList()
        val truth = DoubleArray(n) { sin(it / 9.0) }
        val values = noisy(truth, 0.02)
        wild.forEach { values[it] += 3 + random.nextDouble() }
        val series = log(values, truth)
        val used = BooleanArray(n) { it !in wild }
        val model = ResponseModel(series, emptyList(), Steps.EVEN, Scales(series))
        val noise = CorrelatedNoise(series.times, 0.3, 10.0, used)
        val promptly = doubleArrayOf(series.period / 50, 1.0, 0.0, 0.0)
        val loose = LooseReadings(Fitting.at(model, promptly, BooleanArray(promptly.size), noise))
        assertEquals(emptyList(), loose.lasting)
        assertTrue(loose.pValue < 1e-6, "${loose.pValue}")
    }

    /** A probe moved between samples at any instant within a row: what a lag of 6 s shows, a share of it [slow] s. */
    private fun moved(slow: Double, share: Double): MeasuredSeries {
        val moves = List(24) { 20 * it + 5 + random.nextDouble() }
        val levels = List(moves.size + 1) { 3 * random.nextDouble() }
        fun level(time: Double) = levels[moves.count { it <= time }]
        var fast = level(0.0)
        var late = fast
        val per = 50
        val shown = DoubleArray(n) { row ->
            if (row > 0) {
                for (k in 0 until per) {
                    val water = level(row - 1 + (k + 0.5) / per)
                    fast += (1 - exp(-1.0 / per / 6)) * (water - fast)
                    late += (1 - exp(-1.0 / per / slow)) * (water - late)
                }
            }
            (1 - share) * fast + share * late
        }
        return log(noisy(shown, 0.01), DoubleArray(n) { level(it.toDouble()) })
    }

    @Test
    fun whatShowsOnPlateausIsNamedWheneverEachStepCame() {
        assertEquals(Verdict.Named(listOf(Cause.TWO_PATH_RESPONSE)), Diagnosis(moved(60.0, 0.04)).run().verdict)
        assertEquals(Verdict.Consistent, Diagnosis(moved(60.0, 0.0)).run().verdict)
    }

    /** Two lags in a row of 8 and 3 s, stepped once a row by [share] of the row before and the rest of the row itself. */
    private fun twice(share: Double, random: java.util.Random): MeasuredSeries {
        val moves = List(n / 40) { 40 * it + 20 + random.nextInt(20) }
        val levels = List(moves.size + 1) { 5 + 20 * random.nextDouble() }
        val truth = DoubleArray(n) { row -> levels[moves.count { it <= row }] }
        var first = truth[0]
        var second = first
        val shown = DoubleArray(n) { i ->
            if (i > 0) {
                first += (1 - exp(-1.0 / 8)) * (share * truth[i - 1] + (1 - share) * truth[i] - first)
                second += (1 - exp(-1.0 / 3)) * (first - second)
            }
            second
        }
        return log(noisy(shown, 0.11, random), noisy(truth, 0.022, random))
    }

    @Test
    @Tag("long")
    fun aSecondLagBehindSharpStepsIsAsLongHoweverTheyAreHeld() {
        for (share in listOf(0.0, 1.0)) {
            val result = Diagnosis(twice(share, java.util.Random(1))).run()
            assertEquals(Verdict.Named(listOf(Cause.SECOND_ORDER_RESPONSE)), result.verdict)
            val numbers = result.effects.single().parameters
            // A tenth, the bar; three standard errors of the first lag. Steps taken the wrong way are 24 % off.
            assertEquals(8.0, numbers.first { it.name == "time_constant_s" }.value, 0.25)
            assertEquals(3.0, numbers.first { it.name == "second_time_constant_s" }.value, 0.3)
        }
    }

    @Test
    fun wildReadingsOnPlateausAreNotGatheredWhereTheTruthStandsStill() {
        val log = moved(60.0, 0.0)
        for (row in listOf(37, 90, 171, 239, 311, 402, 460)) log.values[row] += 0.2
        assertEquals(Verdict.Named(listOf(Cause.OUTLIERS)), Diagnosis(log).run().verdict)
    }

    @Test
    fun aTruthThatNeverMovesShowsNoLag() {
        val result = Diagnosis(log(noisy(DoubleArray(FEW) { 8.2 }, 0.015), DoubleArray(FEW) { 8.2 })).run()
        assertIs<Verdict.InsufficientData>(result.verdict)
    }

    @Test
    fun aTruthThatStandsStillIsNotInDoubt() {
        // A cubic through numbers that are no sums of powers of two is off by errors of arithmetic.
        val truth = DoubleArray(n) { if (it < n / 2) 9.1 else 0.3 }
        val unknown = UnknownTruth.of(log(truth, truth))
        assertTrue(unknown.isInDoubt(n / 2))
        assertFalse((10 until n / 2 - 10).any(unknown::isInDoubt))
    }

    @Test
    fun whatIsInDoubtIsSeenAsMuchLaterAsTheReadingsAre() {
        val truth = DoubleArray(n) { if (it < n / 2) 9.1 else 0.3 }
        val seen = UnknownTruth.of(log(truth, truth)).seen(20.0)
        assertTrue(seen.isInDoubt(n / 2 + 20))
        assertFalse(seen.isInDoubt(n / 2))
    }

    @Test
    fun anOffsetThatIsRightInFreshWaterIsNotWrongAtSea() {
        val salinity = DoubleArray(n) { 34 + sin(it / 40.0) }
        val truth = DoubleArray(n) { water(it.toDouble()) }
        val values = noisy(DoubleArray(n) { truth[it] + 0.1 * salinity[it] }, 0.01)
        val times = DoubleArray(n) { it.toDouble() }
        val series = MeasuredSeries(times, times, times, values, truth, mapOf("salinity" to salinity))
        val used = BooleanArray(n) { true }
        val given = ResponseModel(series, emptyList(), Steps.EVEN, Scales(series))
        val promptly = doubleArrayOf(series.period / 50, 1.0, 0.0, 0.0)
        val base = Fitting.fit(given, promptly, BooleanArray(promptly.size), used, longest = 20.0)
        val term = Term(Cause.CROSS_SENSITIVITY, "salinity")
        val model = ResponseModel(series, listOf(term), Steps.EVEN, Scales(series))
        val free = BooleanArray(model.parameters.size) { it == ResponseModel.OFFSET || it == model.slot(term) }
        val fit = Fitting.fit(model, promptly.copyOf(free.size), free, used, longest = 20.0)
        // Of water of the log's own salinities the offset is 3.3 to 3.5.
        assertEquals(3.4, fit.numbers[ResponseModel.OFFSET], 0.05)
        assertTrue(CalibrationPoint.isPossible(fit, base, listOf(ResponseModel.OFFSET)))
    }

    private companion object {
        const val FEW = 100
    }
}
