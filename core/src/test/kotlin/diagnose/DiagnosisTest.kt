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

class DiagnosisTest {
    private val n = 700
    private val truth = DoubleArray(n) { 5 + sin(it / 9.0) + 0.7 * sin(it / 23.0 + 1) + 0.4 * sin(it / 5.7) }

    /** A log of a sensor of [stages] in the truth, with noise of 0.01 and a reading each second on a still bench. */
    private fun log(vararg stages: SensorStage): MeasuredSeries {
        val sensor = SensorSpec("hidden", stages.toList() + SensorStage.Noise(0.01)).build(truth[0], Random(7))
        val values = DoubleArray(n) { sensor.step(truth[it], 1.0, Conditions.NONE) }
        return MeasuredSeries(DoubleArray(n) { it.toDouble() }, DoubleArray(n), DoubleArray(n), values, truth)
    }

    @Test
    fun aPlainLagWithGainAndOffsetIsConsistent() {
        val result = Diagnosis(log(SensorStage.Lag(6.0), SensorStage.Calibration(0.9, 0.3))).run()
        assertEquals(Verdict.Consistent, result.verdict)
        // Six standard errors: the fit's own 95 % interval has a half width of about 0.04 s.
        assertEquals(6.0, result.baseline.parameters.first().value, 0.12)
    }

    @Test
    fun aDriftIsNamedOrCannotBeToldFromJumps() {
        val verdict = Diagnosis(log(SensorStage.Lag(6.0), SensorStage.Drifting(1e-4))).run().verdict
        val causes = when (verdict) {
            is Verdict.Named -> verdict.causes
            is Verdict.Ambiguous -> verdict.sets.flatten()
            else -> emptyList()
        }
        assertContains(causes, Cause.DRIFT)
    }

    @Test
    fun anAsymmetryIsNamedAndTheExtendedSensorHasIt() {
        val result = Diagnosis(log(SensorStage.Asymmetric(8.0, 5.0))).run()
        assertEquals(Verdict.Named(listOf(Cause.ASYMMETRIC_RESPONSE)), result.verdict)
        val lag = assertIs<SensorStage.Asymmetric>(result.extendedSensor?.stages?.first())
        // A tenth, the bar for numbers of strong effects.
        assertEquals(8.0, lag.rising, 0.8)
        assertEquals(5.0, lag.falling, 0.5)
    }

    @Test
    fun aWrongGivenTimeConstantIsACause() {
        val given = SensorSpec("believed", listOf(SensorStage.Lag(4.0)))
        val result = Diagnosis(log(SensorStage.Lag(6.0)), DiagnosisSettings(base = given)).run()
        assertEquals(Verdict.Named(listOf(Cause.TIME_CONSTANT)), result.verdict)
    }

    @Test
    fun aGivenSensorThatIsRightIsConsistent() {
        val given = SensorSpec("believed", listOf(SensorStage.Lag(6.0), SensorStage.Calibration(0.9, 0.3)))
        val log = log(SensorStage.Lag(6.0), SensorStage.Calibration(0.9, 0.3))
        assertEquals(Verdict.Consistent, Diagnosis(log, DiagnosisSettings(base = given)).run().verdict)
    }

    @Test
    fun outliersAreNamedAndTheirSizeIsFound() {
        val result = Diagnosis(log(SensorStage.Lag(6.0), SensorStage.Outlying(0.02, 0.5))).run()
        assertEquals(Verdict.Named(listOf(Cause.OUTLIERS)), result.verdict)
        assertTrue(result.spikes.isNotEmpty())
    }

    @Test
    fun aFewRowsAreInsufficient() {
        val few = MeasuredSeries(
            DoubleArray(30) { it.toDouble() },
            DoubleArray(30),
            DoubleArray(30),
            DoubleArray(30) { truth[it] + 0.01 * (it % 3) },
            truth.copyOf(30),
        )
        assertIs<Verdict.InsufficientData>(Diagnosis(few).run().verdict)
    }
}
