package stillwater.contract

import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestFactory
import stillwater.model.Conditions
import stillwater.model.JsonProblem
import stillwater.sensor.SensorModel
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

/** What every sensor must do, run on every [SensorStage] and on all of them in a row. */
class SensorContractTest {
    private val stages = listOf(
        SensorStage.Lag(9.5),
        SensorStage.Lag(1e-3),
        SensorStage.Slew(0.01),
        SensorStage.LimitedLag(9.5, 0.01),
        SensorStage.LimitedLag(1e-300, SensorSpec.LARGEST_NUMBER),
        SensorStage.Slew(SensorSpec.LARGEST_NUMBER),
        SensorStage.Noise(0.0),
        SensorStage.Noise(0.02),
        SensorStage.Wander(0.02, 12.0),
        SensorStage.Wander(SensorSpec.LARGEST_NUMBER, 1e-300),
        SensorStage.Quantum(0.005),
        SensorStage.Quantum(SensorSpec.LARGEST_NUMBER),
        SensorStage.Asymmetric(7.0, 13.0),
        SensorStage.Asymmetric(1e-300, SensorSpec.LONGEST_TIME),
        SensorStage.Delay(0.0),
        SensorStage.Delay(2.5),
        SensorStage.Delay(SensorSpec.LONGEST_TIME),
        SensorStage.TwoPath(2.0, 40.0, 0.3),
        SensorStage.Combined(9.5, 1.0, 0.5, 20.0, 0.03, 1.3, 4.0, 0.2),
        SensorStage.FlowLag(9.5, 1.0, 0.5),
        SensorStage.TemperatureLag(9.5, 20.0, 0.03),
        SensorStage.Calibration(-1.1, 0.4),
        SensorStage.Calibration(SensorSpec.LARGEST_NUMBER, -SensorSpec.LARGEST_NUMBER),
        SensorStage.Cross("salinity", 30.0, 0.2),
        SensorStage.Drifting(1e-3),
        SensorStage.Drifting(-SensorSpec.LARGEST_NUMBER),
        SensorStage.Jumps(listOf(3.0, 40.0), listOf(0.5, -SensorSpec.LARGEST_NUMBER)),
        SensorStage.Backlash(0.2),
        SensorStage.Range(-1.0, null),
        SensorStage.Outlying(0.1, SensorSpec.LARGEST_NUMBER),
    )
    private val specs = stages.map { SensorSpec("$it", listOf(it)) } +
        SensorSpec("none", emptyList()) +
        SensorSpec("all in a row", stages) +
        SensorSpec("all the other way", stages.reversed())

    /** What can be built but not read from a file. */
    private val beyond = listOf(
        SensorStage.Asymmetric(1e-300, 1e300),
        SensorStage.Delay(1e300),
        SensorStage.LimitedLag(1e-300, 1e300),
        SensorStage.Slew(1e300),
        SensorStage.Quantum(1e300),
        SensorStage.Wander(1e300, 1e300),
        SensorStage.Calibration(1e300, -1e300),
        SensorStage.Drifting(-1e300),
        SensorStage.Jumps(listOf(3.0, 40.0), listOf(0.5, -1e300)),
        SensorStage.Outlying(0.1, 1e300),
    ).map { SensorSpec("$it", listOf(it)) }

    private fun forEverySensor(law: (SensorSpec) -> Unit): List<DynamicTest> =
        (specs + beyond).map { spec -> dynamicTest(spec.name) { law(spec) } }

    private class Steps(random: Random) {
        val seed = random.nextInt()
        val inputs = List(60) { random.hostile(-5.0, 5.0) }
        val lengths = List(60) { random.hostile(-1.0, 20.0) }

        override fun toString() = "seed $seed, inputs $inputs, lengths $lengths"

        fun run(sensor: SensorModel): List<Double> =
            inputs.zip(lengths) { input, dt -> sensor.step(input, dt, Conditions.NONE) }
    }

    @Test
    fun noStageIsMissingFromTheTable() {
        assertEquals(SensorStage::class.java.permittedSubclasses.toSet(), stages.map { it.javaClass }.toSet<Class<*>>())
    }

    @TestFactory
    fun neverThrowsAndIsFiniteForFiniteInput() = forEverySensor { spec ->
        forEvery(cases = 200, ::Steps) { steps ->
            val sensor = spec.build(0.5, Random(steps.seed))
            for ((i, output) in steps.run(sensor).withIndex()) {
                if (steps.inputs[i].isFinite()) assertTrue(output.isFinite(), "step $i of ${steps.inputs[i]}: $output")
            }
        }
    }

    @TestFactory
    fun theLargestNumbersStayNumbers() = forEverySensor { spec ->
        val sensor = spec.build(-Double.MAX_VALUE, Random(1))
        for (input in listOf(Double.MAX_VALUE, -Double.MAX_VALUE, Double.MAX_VALUE, 0.0)) {
            for (dt in listOf(1.0, 1e-3, Double.MAX_VALUE)) {
                val output = sensor.step(input, dt, Conditions.NONE)
                assertTrue(output.isFinite(), "$output of $input after $dt s")
            }
        }
    }

    @TestFactory
    fun isTheSameWithTheSameSeed() = forEverySensor { spec ->
        forEvery(cases = 50, ::Steps) { steps ->
            assertEquals(
                steps.run(spec.build(0.5, Random(steps.seed))),
                steps.run(spec.build(0.5, Random(steps.seed))),
            )
        }
    }

    @TestFactory
    fun isTheSameAfterAJourneyThroughJson() = forEverySensor { spec ->
        if (spec in beyond) {
            assertFailsWith<JsonProblem> { SensorSpec.fromJson(spec.toJson()) }
            return@forEverySensor
        }
        val travelled = SensorSpec.fromJson(spec.toJson())
        assertEquals(spec, travelled)
        forEvery(cases = 20, ::Steps) { steps ->
            assertEquals(
                steps.run(spec.build(0.5, Random(steps.seed))),
                steps.run(travelled.build(0.5, Random(steps.seed))),
            )
        }
    }

    @TestFactory
    fun aStepWithoutALengthIsAStepOfNone() = forEverySensor { spec ->
        for (dt in listOf(-0.0, -1.0, Double.NaN, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY)) {
            val none = spec.build(0.5, Random(7))
            val odd = spec.build(0.5, Random(7))
            for (i in 0 until 20) {
                val input = 0.1 * i
                assertEquals(none.step(input, 0.0, Conditions.NONE), odd.step(input, dt, Conditions.NONE), "dt = $dt")
                assertEquals(none.step(input, 1.5, Conditions.NONE), odd.step(input, 1.5, Conditions.NONE), "dt = $dt")
            }
        }
    }

    @TestFactory
    fun twoSensorsShareNothing() = forEverySensor { spec ->
        forEvery(cases = 20, ::Steps) { steps ->
            val alone = steps.run(spec.build(0.5, Random(1)))
            val sensor = spec.build(0.5, Random(1))
            val other = spec.build(9.0, Random(2))
            val beside = steps.inputs.zip(steps.lengths) { input, dt ->
                other.step(-input, 0.3, Conditions.NONE)
                sensor.step(input, dt, Conditions.NONE)
            }
            assertEquals(alone, beside)
        }
    }
}
