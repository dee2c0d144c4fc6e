package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import java.util.Random
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

/** A probe that is left in one sample tells of what is added to its readings, and of nothing else. Seeds fixed before the first run. */
class ConstantTruthTest {
    private val n = 900

    private fun diagnosed(
        seed: Long,
        conditions: Map<String, DoubleArray> = emptyMap(),
        given: SensorSpec? = null,
        added: (Int) -> Double,
    ): DiagnosisResult {
        val random = Random(seed)
        val values = DoubleArray(n) { 8 + added(it) + 0.02 * random.nextGaussian() }
        val still = DoubleArray(n)
        val times = DoubleArray(n) { it.toDouble() }
        val log = MeasuredSeries(times, still, still, values, DoubleArray(n) { 8.0 }, conditions)
        return Diagnosis(log, DiagnosisSettings(base = given)).run()
    }

    private fun named(result: DiagnosisResult) = assertIs<Verdict.Named>(result.verdict).causes

    /** A rate limit towards a value that nobody knows looks just so. */
    @Test
    fun aDriftIsADrift() {
        val result = diagnosed(3101) { 0.0005 * it }
        assertEquals(listOf(Cause.DRIFT), named(result))
        val rate = result.effects.single().parameters.single { it.name == "rate_per_s" }
        assertEquals(0.0005, rate.value, 2e-5)
        assertContains(
            result.warnings.joinToString(),
            "no gain, nor a lag: the sensor is taken for one that follows at once",
        )
    }

    @Test
    fun jumpsAndWhatElseAProbeShowsAreTold() {
        assertEquals(listOf(Cause.OFFSET_STEPS), named(diagnosed(3102) { if (it > 400) 0.3 else 0.0 }))
        val warmth = DoubleArray(n) { 15 + sin(it / 70.0) }
        val shown = diagnosed(3103, mapOf("temperature" to warmth)) { 0.05 * sin(it / 70.0) }
        assertEquals(listOf(Cause.CROSS_SENSITIVITY), named(shown))
    }

    @Test
    fun ofAGivenSensorTheOffsetAloneIsTold() {
        val result = diagnosed(3106, given = SensorSpec("given", listOf(SensorStage.Lag(3.0)))) { 1.0 }
        assertEquals(listOf(Cause.GAIN_OFFSET), named(result))
        val numbers = assertNotNull(result.extended).parameters.associateBy { it.name }
        assertEquals(1.0, numbers.getValue("gain").value)
        assertEquals(1.0, numbers.getValue("offset").value, 0.01)
        assertTrue(result.warnings.none { "at once" in it }, "the sensor given does not follow at once")
    }

    @Test
    fun aProbeThatCameFromElsewhereTellsItsLagAsItSettles() {
        val why = assertIs<Verdict.InsufficientData>(diagnosed(3104) { 2 * exp(-it / 60.0) }.verdict).why
        assertContains(why, Regex("nor a lag but by how the first readings settled, as with one of (59|60)(\\.\\d)? s"))
    }

    @Test
    fun nothingIsToldWhereNothingHappens() {
        val why = assertIs<Verdict.InsufficientData>(diagnosed(3105) { 0.0 }.verdict).why
        assertEquals("the truth never changes, so that no gain can show, nor a lag", why)
    }
}
