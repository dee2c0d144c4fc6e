package stillwater.sensor

import org.junit.jupiter.api.Test
import stillwater.model.Conditions
import kotlin.math.exp
import kotlin.random.Random
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class SensorSpecTest {
    private val every = SensorSpec(
        "everything",
        listOf(
            SensorStage.Lag(9.491221581029903),
            SensorStage.Slew(0.01),
            SensorStage.Noise(0.002),
            SensorStage.Quantum(0.005),
        ),
    )

    @Test
    fun everyStageComesBackFromJsonAsItWent() {
        assertEquals(every, SensorSpec.fromJson(every.toJson()))
        val beyond = listOf(
            SensorStage.LimitedLag(9.5, 0.01),
            SensorStage.Asymmetric(7.0, 13.0),
            SensorStage.Delay(2.5),
            SensorStage.TwoPath(2.0, 40.0, 0.3),
            SensorStage.Combined(9.5, 1.0, 0.5, 20.0, 0.03, 1.3, 4.0, 0.2),
            SensorStage.FlowLag(9.5, 1.0, 0.5),
            SensorStage.TemperatureLag(9.5, 20.0, 0.03),
            SensorStage.Calibration(1.1, -0.4),
            SensorStage.Cross("salinity", 30.0, 0.2),
            SensorStage.Drifting(1e-3),
            SensorStage.Jumps(listOf(3.0, 40.0), listOf(0.5, -0.5)),
            SensorStage.Backlash(0.2),
            SensorStage.Range(null, 12.5),
            SensorStage.Outlying(0.01, 3.0),
        )
        for (stage in every.stages + beyond) {
            val spec = SensorSpec("one", listOf(stage))
            assertEquals(spec, SensorSpec.fromJson(spec.toJson()))
        }
        val perfect = SensorSpec("", emptyList())
        assertEquals(perfect, SensorSpec.fromJson(perfect.toJson()))
    }

    @Test
    fun jsonNamesTypesAndUnits() {
        val expected = """
            {
              "name": "everything",
              "stages": [
                {
                  "type": "first-order-lag",
                  "time_constant_s": 9.491221581029903
                },
                {
                  "type": "slew-limit",
                  "rate_per_s": 0.01
                },
                {
                  "type": "noise",
                  "standard_deviation": 0.002
                },
                {
                  "type": "quantisation",
                  "step": 0.005
                }
              ]
            }
        """.trimIndent()
        assertEquals(expected, every.toJson())
    }

    @Test
    fun stagesActInTheirOrder() {
        val lagThenQuantum = SensorSpec("a", listOf(SensorStage.Lag(1.0), SensorStage.Quantum(1.0)))
        val quantumThenLag = SensorSpec("b", listOf(SensorStage.Quantum(1.0), SensorStage.Lag(1.0)))
        // After τ the lag shows (1 − 1/e) of 0.9: 0.569, which rounds to 1; 0.9 rounds to 1, of which it shows 0.632.
        assertEquals(1.0, lagThenQuantum.build(0.0, Random(1)).step(0.9, 1.0, Conditions.NONE), 0.0)
        val second = quantumThenLag.build(0.0, Random(1)).step(0.9, 1.0, Conditions.NONE)
        // One rounding of a number below 1.
        assertEquals(1 - exp(-1.0), second, 1e-15)
    }

    @Test
    fun aSensorWithoutStagesIsPerfect() {
        val perfect = SensorSpec("perfect", emptyList()).build(0.0, Random(1))
        for (input in listOf(3.5, -1e9, 0.0)) assertEquals(input, perfect.step(input, 1.0, Conditions.NONE), 0.0)
    }

    @Test
    fun aSensorStartsSettled() {
        val sensor = SensorSpec("slow", listOf(SensorStage.Lag(100.0), SensorStage.Slew(0.001)))
            .build(7.25, Random(1))
        assertEquals(7.25, sensor.step(7.25, 1.0, Conditions.NONE), 0.0)
    }

    @Test
    fun aSensorStartsSettledThroughAllItsStages() {
        val stages = listOf(
            SensorStage.Calibration(2.0, 1.0),
            SensorStage.Lag(100.0),
            SensorStage.Range(null, 6.0),
            SensorStage.Delay(10.0),
        )
        // 2 × 2 + 1 is what the lag and the dead time start at; 2 × 4 + 1 is beyond the range.
        assertEquals(5.0, SensorSpec("low", stages).build(2.0, Random(1)).step(2.0, 1.0, Conditions.NONE), 0.0)
        assertEquals(6.0, SensorSpec("high", stages).build(4.0, Random(1)).step(4.0, 1.0, Conditions.NONE), 0.0)
    }

    @Test
    fun stagesShareTheRandomNumbersOfTheirSensor() {
        val spec = SensorSpec("noisy", listOf(SensorStage.Noise(1.0)))
        val first = spec.build(0.0, Random(9))
        val second = spec.build(0.0, Random(9))
        val other = spec.build(0.0, Random(10))
        val firsts = List(20) { first.step(0.0, 1.0, Conditions.NONE) }
        assertEquals(firsts, List(20) { second.step(0.0, 1.0, Conditions.NONE) })
        assertTrue(firsts != List(20) { other.step(0.0, 1.0, Conditions.NONE) })
    }

    @Test
    fun aStartThatIsNotFiniteIsRefusedEvenWithoutStages() {
        assertFailsWith<IllegalArgumentException> { SensorSpec("", emptyList()).build(Double.NaN, Random(1)) }
    }

    @Test
    fun impossibleStagesAreRefusedWhenBuilt() {
        assertFailsWith<IllegalArgumentException> { SensorStage.Lag(-1.0) }
        assertFailsWith<IllegalArgumentException> { SensorStage.Slew(0.0) }
        assertFailsWith<IllegalArgumentException> { SensorStage.Noise(Double.NaN) }
        assertFailsWith<IllegalArgumentException> { SensorStage.Quantum(0.0) }
        assertFailsWith<IllegalArgumentException> { SensorStage.Asymmetric(1.0, 0.0) }
        assertFailsWith<IllegalArgumentException> { SensorStage.Asymmetric(Double.NaN, 1.0) }
        assertFailsWith<IllegalArgumentException> { SensorStage.Delay(-1.0) }
        assertFailsWith<IllegalArgumentException> { SensorStage.TwoPath(2.0, 1.0, 0.5) }
        assertFailsWith<IllegalArgumentException> { SensorStage.TwoPath(1.0, 2.0, 1.5) }
        assertFailsWith<IllegalArgumentException> { SensorStage.FlowLag(1.0, 0.0, 0.5) }
        assertFailsWith<IllegalArgumentException> { SensorStage.FlowLag(0.0, 1.0, 0.5) }
        assertFailsWith<IllegalArgumentException> { SensorStage.TemperatureLag(1.0, 20.0, 3.0) }
        assertFailsWith<IllegalArgumentException> { SensorStage.Calibration(0.0, 0.0) }
        assertFailsWith<IllegalArgumentException> { SensorStage.Cross(" ", 0.0, 1.0) }
        assertFailsWith<IllegalArgumentException> { SensorStage.Drifting(Double.NaN) }
        assertFailsWith<IllegalArgumentException> { SensorStage.Jumps(listOf(2.0, 2.0), listOf(1.0, 1.0)) }
        assertFailsWith<IllegalArgumentException> { SensorStage.Jumps(listOf(2.0), emptyList()) }
        assertFailsWith<IllegalArgumentException> { SensorStage.Backlash(-1.0) }
        assertFailsWith<IllegalArgumentException> { SensorStage.Range(2.0, 2.0) }
        assertFailsWith<IllegalArgumentException> { SensorStage.Outlying(1.5, 1.0) }
    }

    @Test
    fun whatIsWrongIsSaidInOneLine() {
        fun stage(json: String) = """{"name": "x", "stages": [{"type": "noise", "standard_deviation": 1}, $json]}"""
        for ((json, words) in listOf(
            stage("""{"type": "warp", "factor": 9}""") to
                listOf(
                    "type",
                    "asymmetric-lag, combined-lag, correlated-noise, cross-sensitivity, dead-time, drift, first-order",
                    "stages[1]",
                ),
            stage("""{"type": "first-order-lag", "time_constant_s": -2}""") to
                listOf("time_constant_s (-2.0 s) must be above 0", "stages[1]"),
            stage("""{"type": "dead-time", "dead_time_s": 1e300}""") to
                listOf("stages[1].dead_time_s: expected at most 1.0E9 s (32 years"),
            stage("""{"type": "gain-offset", "gain": 1e300, "offset": 1}""") to
                listOf("1:102: stages[1].gain: expected a number within -1.0E15..1.0E15, found 1.0E300"),
            stage("""{"type": "drift", "rate_per_s": -1e16}""") to
                listOf("stages[1].rate_per_s: expected a number within -1.0E15..1.0E15, found -1.0E16"),
            stage("""{"type": "offset-steps", "times_s": [1, 1e10], "offsets": [1, 2]}""") to
                listOf("stages[1].times_s[1]: expected at most 1.0E9 s"),
            stage("""{"type": "offset-steps", "times_s": [1, 2], "offsets": [1, 1e200]}""") to
                listOf("stages[1].offsets[1]: expected a number within"),
            stage("""{"type": "first-order-lag"}""") to listOf("time_constant_s", "stages[1]"),
            stage("""{"type": "first-order-lag", "time_constant_s": NaN}""") to listOf("time_constant_s"),
            stage("""{"type": "first-order-lag", "time_constant_s": "ten"}""") to listOf("time_constant_s", "ten"),
            stage("""{"type": "first-order-lag", "tau": 9}""") to listOf("tau"),
            stage("""{"time_constant_s": 9}""") to listOf("type", "first-order-lag", "stages[1]"),
            """{"name": "x"}""" to listOf("stages"),
            """{"stages": []}""" to listOf("name"),
            """{"name": "x", "stages": [], "colour": 1}""" to listOf("colour"),
            """{"name": "x", "stages": {}}""" to listOf("stages"),
            "tau = 9.5" to listOf("sensor spec"),
            "" to listOf("sensor spec"),
            "[]" to listOf("sensor spec"),
            "null" to listOf("sensor spec"),
            """{"name": "x", "stages": [""" to listOf("sensor spec"),
        )) {
            val message = assertFailsWith<IllegalArgumentException>(json) {
                SensorSpec.fromJson(json)
            }.message.orEmpty()
            assertFalse('\n' in message, "one line: $message")
            assertTrue(message.startsWith("not a sensor spec: "), message)
            for (word in words) assertContains(message, word, message = "of $json")
        }
    }
}
