package stillwater.diagnose

import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertTrue

class BlindDiagnosisTest {
    private val n = 900

    /** A way that crosses itself often, in all directions, at up to 1 m/s. */
    private val x = DoubleArray(n) { 15 * sin(it / 19.0) }
    private val y = DoubleArray(n) { 15 * sin(it / 25.0 + 1) }
    private val truth = DoubleArray(n) { sin(x[it] / 4) + sin(y[it] / 5 + 1) + sin((x[it] + y[it]) / 7) }

    private fun log(vararg stages: SensorStage, scale: Double = 1.0): MeasuredSeries {
        val sensor = SensorSpec("hidden", stages.toList() + SensorStage.Noise(0.004)).build(truth[0], Random(7))
        val values = DoubleArray(n) { scale * sensor.step(truth[it], 1.0, Conditions.NONE) }
        return MeasuredSeries(DoubleArray(n) { it.toDouble() }, x, y, values, null)
    }

    private fun causes(verdict: Verdict): List<Cause> = when (verdict) {
        is Verdict.Named -> verdict.causes
        is Verdict.Ambiguous -> verdict.sets.flatten()
        else -> emptyList()
    }

    @Test
    fun aPlainLagIsFoundAndNothingElseIsNamed() {
        val result = Diagnosis(log(SensorStage.Lag(5.0))).run()
        val lag = setOf(Cause.TIME_CONSTANT, Cause.DEAD_TIME)
        assertTrue(causes(result.verdict).all { it in lag }, "${result.verdict}")
        // The sensor holds its input over a step, which is half a step less of a delay.
        assertEquals(5.0, result.baseline.parameters.first().value, 0.7)
    }

    @Test
    fun anAsymmetryIsNamedWithoutAReference() {
        val verdict = Diagnosis(log(SensorStage.Asymmetric(7.0, 4.0))).run().verdict
        assertContains(causes(verdict), Cause.ASYMMETRIC_RESPONSE)
    }

    @Test
    fun aJumpOfTheOffsetIsNamedWithoutAReference() {
        val verdict = Diagnosis(log(SensorStage.Lag(4.0), SensorStage.Jumps(listOf(250.0), listOf(0.3)))).run().verdict
        assertContains(causes(verdict), Cause.OFFSET_STEPS)
    }

    @Test
    fun aGivenLagIsACauseWhereItIsWrongAndNoneWhereItIsRight() {
        val log = log(SensorStage.Lag(5.0))
        fun answer(tau: Double): Verdict {
            val given = SensorSpec("believed", listOf(SensorStage.Lag(tau)))
            return Diagnosis(log, DiagnosisSettings(base = given)).run().verdict
        }
        assertContains(causes(answer(2.0)), Cause.TIME_CONSTANT)
        val own = Diagnosis(log).run().baseline.parameters.first().value
        assertEquals(Verdict.Consistent, answer(own))
    }

    @Test
    fun readingsTooSmallToReckonWithAreTooLittle() {
        assertIs<Verdict.InsufficientData>(Diagnosis(log(SensorStage.Lag(5.0), scale = 1e-200)).run().verdict)
    }

    @Test
    fun aNumberAtTheEndOfTheSearchHasAnOpenInterval() {
        val result = Diagnosis(log(SensorStage.Noise(0.004))).run()
        val tau = result.baseline.parameters.first()
        assertEquals(0.0, checkNotNull(tau.interval).lower, 0.05)
        assertTrue(checkNotNull(tau.interval).upper > tau.value)
    }

    @Test
    fun whatTwoChannelsLagAlikeIsToldFromTheSensorsOwn() {
        val slow = log(SensorStage.Delay(6.0))
        val quick = log(SensorStage.Delay(2.0))
        val lags = ChannelLags.of(slow, "oxygen", mapOf("temperature" to quick.values))
        // Half a second: rows are a second apart.
        assertEquals(2.0, checkNotNull(lags.common), 0.5)
        assertEquals(4.0, checkNotNull(lags.own), 0.5)
    }
}
