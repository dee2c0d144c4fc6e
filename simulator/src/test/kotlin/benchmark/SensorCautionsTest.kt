package stillwater.benchmark

import org.junit.jupiter.api.Test
import stillwater.run.Preset
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.io.path.Path
import kotlin.io.path.listDirectoryEntries
import kotlin.io.path.readText
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** What is said of a sensor whose numbers are not those of fields from 0 to 1. */
class SensorCautionsTest {
    private fun cautions(vararg stages: SensorStage): List<String> = cautions(SensorSpec("tried", stages.toList()))

    private fun cautions(sensor: SensorSpec) = SensorCautions.of(Preset.REPORT.settings().copy(sensor = sensor))

    private fun told(vararg unfit: String) = listOf(
        "the water of the fields is within 0 to 1, and numbers of the sensor are not made for that: " +
            "${unfit.joinToString("; ")}. Nothing was scaled: numbers in sensor units have to be the fields'",
    )

    @Test
    fun aSensorOfALogIsToldInOneSentence() {
        val sensor = arrayOf(
            SensorStage.Lag(12.0),
            SensorStage.Jumps(listOf(600.0, 900.0), listOf(0.4, -1.9)),
            SensorStage.Range(upper = 9.85),
            SensorStage.Quantum(0.12),
        )
        val expected = told(
            "an offset of -1.9 would be 1.9 times the range",
            "the end of its range at 9.85 is outside and has no effect",
            "steps of 0.12 would be 12 % of it",
        )
        assertEquals(expected, cautions(*sensor))
    }

    @Test
    fun eachKindOfNumberHasALimitOfItsOwn() {
        // 2000 moves of 10 readings, a second each.
        val drift = SensorStage.Drifting(-1e-4)
        for ((stage, words) in listOf(
            SensorStage.Range(-5.0, 20.0) to "the ends of its range at -5 and 20 are outside and have no effect",
            SensorStage.Range(2.0, 20.0) to "below 2 it ends, and shows nothing of them",
            SensorStage.Noise(0.6) to "noise of 0.6 would be 60 % of it",
            SensorStage.Wander(3.0, 10.0) to "noise of 3 would be 3 times the range",
            SensorStage.Backlash(0.8) to "hysteresis of 0.8 would be 80 % of it",
            SensorStage.Outlying(0.01, 4.0) to "outliers of 4 would be 4 times the range",
            SensorStage.Calibration(1.0, 30.0) to "an offset of 30 would be 30 times the range",
            drift to "in the time of a trial a drift of -2 would be 2 times the range",
            SensorStage.Slew(
                1.5,
            ) to "a rate of 1.5 a second is the whole range between two readings and limits nothing",
        )) {
            assertEquals(told(words), cautions(stage), "$stage")
        }
    }

    @Test
    fun behindAGainNumbersAreThoseOfWhatIsShown() {
        val shown = arrayOf(SensorStage.Calibration(15.0, 1.0), SensorStage.Range(0.0, 15.0), SensorStage.Quantum(0.12))
        assertEquals(told("the end of its range at 0 is outside and has no effect"), cautions(*shown))
    }

    @Test
    fun sensorsMadeForTheFieldsAreNot() {
        for (preset in Preset.entries) assertEquals(emptyList(), SensorCautions.of(preset.settings()), preset.label)
        val files = Path("../docs/sensors").listDirectoryEntries("*.json")
        assertTrue(files.size >= 10, "$files")
        for (file in files) assertEquals(emptyList(), cautions(SensorSpec.fromJson(file.readText())), "$file")
    }
}
