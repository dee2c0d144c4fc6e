package stillwater.diagnose

import org.junit.jupiter.api.Tag
import stillwater.diagnose.response.UnknownTruth
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** How somebody's simulation takes the truth between two rows is no cause, and hides none. */
class SteppedTruthTest {
    private val n = 800
    private val random = java.util.Random(11)
    private val smooth = DoubleArray(n) { 5 + sin(it / 14.0) + 0.7 * sin(it / 37.0 + 1) + 0.4 * sin(it / 9.0 + 2) }

    /** A random walk that is drawn back to its middle. */
    private fun rough() = DoubleArray(n).also { for (i in 1 until n) it[i] = 0.97 * it[i - 1] + random.nextGaussian() }

    /** A lag of [tau] rows stepped once a row by [share] of the row before and the rest of the row itself. */
    private fun stepped(truth: DoubleArray, tau: Double, share: Double): DoubleArray {
        var state = truth[0]
        return DoubleArray(truth.size) { i ->
            if (i > 0) state += (1 - exp(-1 / tau)) * (share * truth[i - 1] + (1 - share) * truth[i] - state)
            state
        }
    }

    private fun diagnosed(values: DoubleArray, reference: DoubleArray, base: SensorSpec? = null): DiagnosisResult {
        val times = DoubleArray(values.size) { it.toDouble() }
        val series = MeasuredSeries(times, DoubleArray(values.size), DoubleArray(values.size), values, reference)
        return Diagnosis(series, DiagnosisSettings(base)).run()
    }

    private fun noisy(values: DoubleArray, spread: Double) =
        DoubleArray(values.size) { values[it] + spread * random.nextGaussian() }

    @Test
    fun aSensorThatIsSteppedByTheRowBeforeHasNoDeadTime() {
        for (truth in listOf(smooth, rough())) {
            val result = diagnosed(noisy(stepped(truth, 8.0, 1.0), 0.01), truth)
            assertEquals(Verdict.Consistent, result.verdict)
            assertTrue(result.warnings.any { "held from each row until the next" in it }, "${result.warnings}")
            val tau = result.baseline.parameters.first { it.name == "time_constant_s" }.value
            assertEquals(8.0, tau, 0.1)
        }
    }

    @Test
    fun rowsThatAreMissingFromItsLogMakeNoDeadTime() {
        for (share in listOf(0.0, 1.0)) {
            val values = noisy(stepped(smooth, 8.0, share), 0.003)
            val kept = (0 until n).filter { it == 0 || random.nextInt(25) > 0 }
            fun of(column: (Int) -> Double) = DoubleArray(kept.size) { column(kept[it]) }
            val still = DoubleArray(kept.size)
            val series = MeasuredSeries(of { it.toDouble() }, still, still, of { values[it] }, of { smooth[it] })
            assertEquals(Verdict.Consistent, Diagnosis(series).run().verdict, "$share, ${n - kept.size} rows missing")
        }
    }

    @Test
    fun whatIsBesideATruthHeldUntilTheNextRowIsNamedAlone() {
        val values = noisy(stepped(smooth, 8.0, 1.0), 0.01)
        for (i in values.indices) values[i] += 2e-4 * i
        assertEquals(Verdict.Named(listOf(Cause.DRIFT)), diagnosed(values, smooth).verdict)
    }

    @Test
    fun aDeadTimeOfSomeRowsBesideItIsNamed() {
        val shown = stepped(smooth, 8.0, 1.0)
        val result = diagnosed(noisy(DoubleArray(n) { shown[maxOf(it - 3, 0)] }, 0.01), smooth)
        assertEquals(Verdict.Named(listOf(Cause.DEAD_TIME)), result.verdict)
        // In water as smooth as this the way of stepping does not show, and half a row is open.
        val late = result.effects.single().parameters.first { it.name == "dead_time_s" }
        assertTrue(3.0 in late.interval!!.lower..late.interval!!.upper, "$late")
        assertTrue(late.interval!!.upper - late.interval!!.lower < 1.2, "$late")
    }

    @Test
    @Tag("long")
    fun cellsOfEvenWaterSteppedByTheRowBeforeHaveNoDeadTimeAtUnevenTimes() {
        val times = DoubleArray(n) { it + 0.6 * random.nextDouble() }
        val cells = DoubleArray(n / 6) { random.nextDouble() }
        val truth = DoubleArray(n) { cells[(times[it] / 6.3).toInt()] }
        var state = truth[0]
        val values = DoubleArray(n) { i ->
            if (i > 0) state += (times[i] - times[i - 1]) / 9 * (truth[i - 1] - state)
            state + 0.001 * random.nextGaussian()
        }
        val still = DoubleArray(n)
        assertEquals(Verdict.Consistent, Diagnosis(MeasuredSeries(times, still, still, values, truth)).run().verdict)
    }

    @Test
    fun aRoughTruthThatGoesStraightBetweenRowsLeavesNothingUnexplained() {
        val truth = rough()
        assertEquals(Verdict.Consistent, diagnosed(noisy(stepped(truth, 8.0, 0.5), 0.01), truth).verdict)
    }

    @Test
    @Tag("long")
    fun aTruthHeldOverStepsIsNoWrongTimeConstantOfAGivenSensor() {
        val base = SensorSpec("given", listOf(SensorStage.Lag(60.0)))
        for (share in listOf(0.0, 1.0)) {
            val truth = DoubleArray(3000) { 5 + sin(it / 14.0) + 0.7 * sin(it / 37.0 + 1) }
            assertEquals(Verdict.Consistent, diagnosed(noisy(stepped(truth, 60.0, share), 0.002), truth, base).verdict)
        }
    }

    @Test
    fun whatASensorHasSeenWhereItsReadingIsMissingIsNoCause() {
        val isRead = BooleanArray(n) { it % 5 != 2 }
        for (share in listOf(0.0, 1.0)) {
            val truth = rough()
            val values = noisy(stepped(truth, 8.0, share), 0.01)
            for (i in values.indices) if (!isRead[i]) values[i] = 1e3
            val times = DoubleArray(n) { it.toDouble() }
            val still = DoubleArray(n)
            val result = Diagnosis(MeasuredSeries(times, still, still, values, truth, isRead = isRead)).run()
            assertEquals(Verdict.Consistent, result.verdict, "$share")
            assertEquals(n * 4 / 5, result.baseline.predicted.size)
            assertEquals(8.0, result.baseline.parameters.first { it.name == "time_constant_s" }.value, 0.1)
        }
    }

    @Test
    fun aTruthThatIsMissingHereAndThereIsNoCause() {
        val truth = DoubleArray(n).also { for (i in 1 until n) it[i] = 0.7 * it[i - 1] + 0.3 * smooth[i] }
        val values = noisy(stepped(truth, 8.0, 0.0), 0.003)
        val times = DoubleArray(n) { it.toDouble() }
        for (i in 30 until n step 31) truth[i] = Double.NaN
        for (i in 17 until n step 23) values[i] = Double.NaN
        val still = DoubleArray(n)
        val series = MeasuredSeries.ofMissing(times, still, still, values, truth, emptyMap())
        assertEquals(n, series.size)
        val result = Diagnosis(series).run()
        assertEquals(Verdict.Consistent, result.verdict)
        assertEquals(
            (0 until n).count {
                values[it].isFinite() && truth[it].isFinite()
            },
            result.baseline.predicted.size,
        )
        // Over a longer gap nobody knows how the truth went.
        for (i in 300 until 310) truth[i] = Double.NaN
        assertTrue(n > MeasuredSeries.ofMissing(times, still, still, values, truth, emptyMap()).size)
    }

    @Test
    fun aWildReadingBesideATruthInDoubtIsNoJump() {
        val truth = rough()
        val fine = 20
        var state = truth[0]
        val shown = DoubleArray(n) { i ->
            if (i > 0) {
                repeat(fine) { k ->
                    val water = truth[i - 1] + (k + 0.5) / fine * (truth[i] - truth[i - 1])
                    state += (1 - exp(-1.0 / fine / 12)) * (water - state)
                }
            }
            state
        }
        val values = noisy(shown, 0.002)
        val times = DoubleArray(n) { it.toDouble() }
        val unknown = UnknownTruth.of(MeasuredSeries(times, times, DoubleArray(n), values, truth))
        val doubtful = (20 until n - 20).filter(unknown::isInDoubt)
        val wild = listOf(doubtful.first(), doubtful[doubtful.size / 2], doubtful.last())
        for (row in wild) values[row] += 0.15
        val result = diagnosed(values, truth)
        assertEquals(wild, result.spikes)
        assertTrue(result.effects.none { it.cause == Cause.OFFSET_STEPS }, "${result.verdict}")
    }

    @Test
    @Tag("long")
    fun aRoughTruthIsNotTakenForTheNoiseOfItsReference() {
        val truth = DoubleArray(n).also { for (i in 1 until n) it[i] = it[i - 1] + random.nextGaussian() }
        val shown = stepped(truth, 4.0, 0.0)
        val values = noisy(DoubleArray(n) { shown[maxOf(it - 3, 0)] }, 0.3)
        val result = diagnosed(values, noisy(truth, 0.1))
        assertEquals(Verdict.Named(listOf(Cause.DEAD_TIME)), result.verdict)
        assertEquals(3.0, result.effects.single().parameters.first { it.name == "dead_time_s" }.value, 0.15)
    }

    @Test
    fun aReferenceThatIsLateIsNoCauseOfAGivenSensorBesideTheOneItHas() {
        val fine = 50
        fun water(time: Double) = 5 + sin(time / 9) + 0.7 * sin(time / 23 + 1) + 0.3 * sin(time / 4.1 + 2)
        fun shown(lag: Double): DoubleArray {
            var state = water(0.0)
            return DoubleArray(n) { row ->
                if (row > 0) {
                    for (k in 0 until fine) {
                        state += (1 - exp(-1.0 / fine / lag)) * (water(row - 1 + (k + 0.5) / fine) - state)
                    }
                }
                state
            }
        }
        val base = SensorSpec("given", listOf(SensorStage.Lag(8.0), SensorStage.Calibration(1.1, 0.0)))
        val result = diagnosed(noisy(shown(8.0), 0.003), shown(0.3), base)
        assertEquals(Verdict.Named(listOf(Cause.GAIN_OFFSET)), result.verdict, "${result.warnings}")
    }
}
