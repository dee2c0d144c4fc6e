package stillwater.estimate

import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestFactory
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

class UndoableSensorTest {
    private val rows = 600
    private val fine = 20
    private fun water(time: Double) = 5 + sin(time / 13) + 0.6 * sin(time / 29 + 1) + 0.3 * sin(time / 8.1)
    private fun speed(time: Double) = 1 + 0.5 * sin(time / 40)
    private fun temperature(time: Double) = 15 + 6 * sin(time / 70)
    private val times = DoubleArray(rows) { it.toDouble() }
    private val truth = DoubleArray(rows) { water(times[it]) }
    private val conditions = mapOf(
        Conditions.SPEED to DoubleArray(rows) { speed(times[it]) },
        Conditions.TEMPERATURE to DoubleArray(rows) { temperature(times[it]) },
    )

    /** What a sensor of [stages] shows each second, stepped in twentieths, with noise of 0.003. */
    private fun readings(stages: List<SensorStage>): TrackSeries {
        val sensor = SensorSpec("", stages).build(truth[0], Random(1))
        val noise = java.util.Random(5)
        val values = DoubleArray(rows) { row ->
            var shown = truth[0]
            // The log begins when the sensor does.
            for (k in if (row == 0) IntRange.EMPTY else 1..fine) {
                val time = times[row] - 1 + k / fine.toDouble()
                val now = Conditions(
                    mapOf(Conditions.SPEED to speed(time), Conditions.TEMPERATURE to temperature(time)),
                )
                // The midpoint of the fine step: a held input is half a step early.
                shown = sensor.step(water(time - 0.5 / fine), 1.0 / fine, now)
            }
            shown + 0.003 * noise.nextGaussian()
        }
        return TrackSeries(times, times, DoubleArray(rows), values)
    }

    private fun rootMeanSquare(values: DoubleArray): Double =
        sqrt((SETTLED until rows).sumOf { (values[it] - truth[it]).let { e -> e * e } } / (rows - SETTLED))

    @TestFactory
    fun whatASensorDidIsUndone(): List<DynamicTest> = listOf(
        listOf(SensorStage.TwoPath(4.0, 30.0, 0.3)),
        listOf(SensorStage.TwoPath(4.0, 30.0, 0.0)),
        listOf(SensorStage.FlowLag(6.0, 1.0, 0.8)),
        listOf(SensorStage.TemperatureLag(6.0, 15.0, 0.08)),
        listOf(SensorStage.Combined(6.0, 1.0, 0.6, 15.0, 0.05, 1.4)),
        listOf(SensorStage.Combined(5.0, 1.0, 0.6, slowOverFast = 6.0, slowShare = 0.25)),
        listOf(SensorStage.Lag(6.0), SensorStage.Cross(Conditions.TEMPERATURE, 12.0, 0.1)),
        listOf(SensorStage.Lag(6.0), SensorStage.Jumps(listOf(150.3, 400.3), listOf(0.6, -0.4))),
        listOf(
            SensorStage.Lag(6.0),
            SensorStage.Drifting(2e-3),
            SensorStage.Calibration(0.8, 0.7),
            SensorStage.Drifting(-1e-3),
        ),
    ).map { stages ->
        dynamicTest("$stages") {
            val series = readings(stages)
            val sensor = UndoableSensor.of(SensorSpec("", stages))
            val track = TrackCorrector(sensor.calibrated(series, conditions))
                .correct(listOf(LikelyResponse(listOf(sensor.response), 1.0)))
            // A lag of 6 s makes an error of 0.4. Noise is amplified some five times where the water changes fastest.
            assertTrue(rootMeanSquare(series.values) > 0.2, "${rootMeanSquare(series.values)}")
            assertTrue(rootMeanSquare(track.values) < 0.02, "${rootMeanSquare(track.values)}")
            val inside = (SETTLED until rows).count { truth[it] in track.lower[it]..track.upper[it] }
            // 95 % were nominal; neighbours are alike, so that a sixth of the rows are independent.
            assertTrue(inside > 0.85 * (rows - SETTLED), "$inside of ${rows - SETTLED} inside")
        }
    }

    /** As the diagnosis writes them: a sensor of which something is lost is undone but for that. */
    @Test
    fun whatIsLostDoesNotHinderTheRest() {
        val stages = listOf(
            SensorStage.Lag(8.0),
            SensorStage.Backlash(0.3),
            SensorStage.Calibration(-2.0, 1.0),
            SensorStage.Range(-19.0, null),
            SensorStage.Noise(0.02),
            SensorStage.Outlying(0.01, 6.0),
        )
        val sensor = UndoableSensor.of(SensorSpec("", stages))
        assertEquals(8.0, sensor.response.lags.single().rising)
        assertEquals(-19.0..Double.POSITIVE_INFINITY, sensor.range)
        assertEquals(0.3, sensor.play)
        // Behind a gain both are in the readings' units.
        val before = listOf(SensorStage.Range(null, 5.0), stages[2], stages[1])
        assertEquals(-9.0..Double.POSITIVE_INFINITY, UndoableSensor.of(SensorSpec("", before)).range)
        assertEquals(0.15, UndoableSensor.of(SensorSpec("", before)).play)
    }

    @Test
    fun whatCannotBeUndoneIsRefused() {
        val problem = assertFailsWith<IllegalArgumentException> {
            UndoableSensor.of(SensorSpec("", listOf(SensorStage.Range(0.0, 5.0), SensorStage.Lag(6.0))))
        }
        assertContains(problem.message.orEmpty(), "after a saturation cannot be undone")
        for ((unfit, stages) in listOf(
            1 to listOf(SensorStage.Delay(2.0), SensorStage.FlowLag(6.0, 1.0, 0.5), SensorStage.Slew(0.1)),
            1 to listOf(SensorStage.FlowLag(6.0, 1.0, 0.5), SensorStage.Delay(2.0), SensorStage.Noise(0.1)),
            1 to listOf(SensorStage.Drifting(1e-3), SensorStage.Lag(6.0)),
            3 to listOf(SensorStage.Lag(6.0), SensorStage.Noise(0.1), SensorStage.Lag(2.0), SensorStage.Lag(1.0)),
        )) {
            val found = assertFailsWith<UnfitStage> { UndoableSensor.of(SensorSpec("", stages)) }
            assertEquals(unfit, found.index, "$stages")
            assertTrue(found.message.orEmpty().isNotEmpty())
        }
    }

    @Test
    fun conditionsThatAreNeededAreNamed() {
        val sensor = UndoableSensor.of(
            SensorSpec("", listOf(SensorStage.FlowLag(6.0, 1.0, 0.5), SensorStage.Cross("salinity", 30.0, 0.1))),
        )
        assertEquals(setOf(Conditions.SPEED, "salinity"), sensor.needs)
    }

    @Test
    fun aResponseThatIsSoonerHasThatMuchLessDelay() {
        val response = Response(0.2, listOf(ResponseLag(6.0, 4.0), ResponseLag(1.0)))
        // Sums of a few numbers near 1.
        assertEquals(response.meanDelay - 0.5, response.sooner(0.5).meanDelay, 1e-12)
        assertEquals(0.1, response.sooner(0.1).deadTime, 1e-12)
        assertEquals(1.0, abs(response.sooner(0.5).lags[1].rising), 0.0)
    }

    @Test
    fun stepsThatAreHeldAreRecognisedAndGiveTheTimeConstantOfSuchSteps() {
        val noise = java.util.Random(3)
        fun read(held: Boolean): TrackSeries {
            val sensor = SensorSpec("", listOf(SensorStage.Lag(6.0))).build(truth[0], Random(1))
            val steps = if (held) 1 else fine
            val values = DoubleArray(rows) { row ->
                var shown = truth[0]
                for (k in if (row == 0) IntRange.EMPTY else 1..steps) {
                    val seen = if (held) times[row] else times[row] - 1 + (k - 0.5) / steps
                    shown = sensor.step(water(seen), 1.0 / steps, Conditions.NONE)
                }
                shown + 0.003 * noise.nextGaussian()
            }
            return TrackSeries(times, times, DoubleArray(rows), values)
        }
        for (held in listOf(true, false)) {
            val series = read(held)
            assertEquals(held, ReferenceLearner.isHeld(series, truth), "held $held")
            val learned = ReferenceLearner(series, truth, held).candidate(ResponseKind.FIRST_ORDER)
            // Half a step, 0.5 s, is what the wrong way would make of it.
            assertEquals(6.0, assertNotNull(learned).parameters.single(), 0.1)
        }
        // No simulation comes unevenly.
        val uneven = DoubleArray(rows) { times[it] + 0.2 * noise.nextDouble() }
        assertFalse(ReferenceLearner.isHeld(TrackSeries(uneven, times, DoubleArray(rows), read(true).values), truth))
    }

    private companion object {
        /** Rows until the sensor has forgotten how it began. */
        const val SETTLED = 100
    }
}
