package stillwater.diagnosis

import org.junit.jupiter.api.Test
import stillwater.diagnose.Cause
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.test.assertEquals
import kotlin.test.assertNull

class CauseInWordsTest {
    private fun words(cause: Cause, vararg stages: SensorStage) =
        CauseInWords(SensorSpec("found", stages.toList()), " mg/L").of(cause)

    @Test
    fun whatAUserWouldMeasureIsSaid() {
        assertEquals(
            "rising 16.0 s, falling 22.1 s",
            words(Cause.ASYMMETRIC_RESPONSE, SensorStage.Asymmetric(16.0, 22.1)),
        )
        assertEquals("fast 5.01 s, slow 58.7 s", words(Cause.TWO_PATH_RESPONSE, SensorStage.TwoPath(5.01, 58.7, 0.15)))
        assertEquals(
            "8.00 s at 1.40 m/s, 5.66 s at twice that",
            words(Cause.FLOW_DEPENDENT_RESPONSE, SensorStage.FlowLag(8.0, 1.4, 0.5)),
        )
        assertEquals(
            "8.00 s at 14.2 °C, 8.16 s at one degree more",
            words(Cause.TEMPERATURE_DEPENDENT_RESPONSE, SensorStage.TemperatureLag(8.0, 14.2, -0.02)),
        )
        // 8 · √(1/4) and 8 / √(1/4).
        val paths = SensorStage.Combined(8.0, risingOverFalling = 0.25, slowOverFast = 5.0, slowShare = 0.2)
        assertEquals("rising 4.00 s, falling 16.0 s", words(Cause.ASYMMETRIC_RESPONSE, paths))
        assertEquals("fast 8.00 s, slow 40.0 s", words(Cause.TWO_PATH_RESPONSE, paths))
        val both = SensorStage.Combined(8.0, referenceSpeed = 1.4, exponent = 0.5, referenceTemperature = 14.2)
        assertEquals("8.00 s at 1.40 m/s, 5.66 s at twice that", words(Cause.FLOW_DEPENDENT_RESPONSE, both))
        assertEquals(
            "at 804 s and 1200 s",
            words(Cause.OFFSET_STEPS, SensorStage.Lag(3.0), SensorStage.Jumps(listOf(803.5, 1200.0), listOf(0.1, 0.0))),
        )
        assertEquals("steps of 0.0500 mg/L", words(Cause.QUANTISATION, SensorStage.Quantum(0.05)))
    }

    @Test
    fun numbersThatSayItThemselvesAreLeft() {
        assertNull(words(Cause.DEAD_TIME, SensorStage.Delay(2.0)))
        assertNull(words(Cause.ASYMMETRIC_RESPONSE, SensorStage.Lag(2.0)))
    }
}
