package stillwater.estimate

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.assertThrows
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.property.between
import stillwater.sensor.FirstOrderLag
import stillwater.sensor.SensorModel
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.ln
import kotlin.math.pow
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class SelfCalibratingEstimatorTest {
    private val grid = Grid.unit(6, 1)
    private val truths = doubleArrayOf(0.2, 0.9, 0.4, 0.7, 0.1, 0.8)

    /** Walks to and fro over the row, [stay] readings a cell, and gives [noise] to each. */
    private fun survey(
        estimator: FieldEstimator,
        sensor: SensorModel,
        random: Random,
        rounds: Int,
        noise: Double = 0.0,
        step: () -> Double = { 1.0 },
    ) {
        var time = 0.0
        repeat(rounds) { round ->
            for (i in truths.indices) {
                val cell = if (round % 2 == 0) i else truths.size - 1 - i
                repeat(10) {
                    val elapsed = step()
                    time += elapsed
                    val state = sensor.step(truths[cell], elapsed, Conditions.NONE)
                    // A rectangular distribution of standard deviation 1.
                    val reading = state + noise * random.between(-1.0, 1.0) * 3.0.pow(0.5)
                    estimator.update(BoatTime(time), cell + 0.5, 0.5, reading)
                }
            }
        }
    }

    @Test
    fun findsTimeConstantAndTruthsWithoutNoiseWhateverThePrior() {
        for (constant in listOf(3.0, 9.5, 40.0)) {
            for (guess in listOf(constant / 3, constant, 3 * constant)) {
                val estimator = SelfCalibratingEstimator(grid, Interval.UNIT, SelfCalibratingSettings(guess, 3.0))
                survey(estimator, FirstOrderLag(constant, 0.5), Random(1), rounds = 4)
                // The parabola's third order over nodes 0.001 apart, and the floor of the noise.
                assertEquals(constant, estimator.timeConstant, 1e-3 * constant, "guess $guess")
                assertTrue(estimator.isExplained)
                for (cell in truths.indices) assertEquals(truths[cell], estimator.map.value(cell), 1e-4)
            }
        }
    }

    @Test
    fun irregularSamplingIsNoHindrance() {
        val random = Random(2)
        val estimator = SelfCalibratingEstimator(grid, Interval.UNIT)
        // From a hundredth of the time constant to the whole of it.
        survey(estimator, FirstOrderLag(8.0, 0.5), random, rounds = 4) { 8 * 10.0.pow(random.between(-2.0, 0.0)) }
        assertEquals(8.0, estimator.timeConstant, 8e-3)
        for (cell in truths.indices) assertEquals(truths[cell], estimator.map.value(cell), 1e-4)
    }

    @Test
    fun uncertaintyAndNoiseAreWhatTheyAreInManySurveys() {
        var inside = 0
        var insideCells = 0
        var flagged = 0
        val surveys = 200
        repeat(surveys) { seed ->
            val random = Random(seed + 7_000)
            val estimator = SelfCalibratingEstimator(grid, Interval.UNIT)
            survey(estimator, FirstOrderLag(12.0, 0.5), random, rounds = 6, noise = 0.004)
            if (!estimator.isExplained) flagged++
            if (12.0 in estimator.timeConstantInterval()) inside++
            insideCells += truths.indices.count {
                truths[it] in estimator.map.lower(it)..estimator.map.upper(it)
            }
            // 360 readings tell a standard deviation to 4 %; four of those.
            assertEquals(0.004, estimator.noise, 0.004 * 0.16)
            assertTrue(estimator.relativeUncertainty in 1e-4..0.1, "${estimator.relativeUncertainty}")
        }
        // Beyond four standard deviations.
        assertEquals(0, flagged)
        // 95 % of 200, three standard deviations of the count (3.1) either way.
        assertTrue(inside in 181..199, "$inside of $surveys")
        // Cells of one survey share the time constant's error: 1200 of them count as 400 or more.
        assertTrue(insideCells / (6.0 * surveys) in 0.92..0.98, "$insideCells")
    }

    @Test
    fun findsTheSensorModelAndItsNumbers() {
        val lag = 9.5
        val sensors = listOf(
            SensorKind.FIRST_ORDER to listOf(SensorStage.Lag(lag)),
            SensorKind.ASYMMETRIC to listOf(SensorStage.Asymmetric(7.0, 13.0)),
            SensorKind.DEAD_TIME to listOf(SensorStage.Delay(3.0), SensorStage.Lag(lag)),
            SensorKind.SECOND_ORDER to listOf(SensorStage.Lag(4.0), SensorStage.Lag(8.0)),
            SensorKind.SLEW_LIMIT to listOf(SensorStage.Slew(0.08)),
        )
        val numbers = listOf(listOf(lag), listOf(7.0, 13.0), listOf(3.0, lag), listOf(12.0, 1 / 3.0), listOf(0.08))
        for ((index, sensor) in sensors.withIndex()) {
            val (kind, stages) = sensor
            val estimator = SelfCalibratingEstimator(grid, Interval.UNIT)
            survey(estimator, SensorSpec("", stages).build(0.5, Random(1)), Random(3), rounds = 14, noise = 0.002)
            val belief = estimator.sensor()
            assertEquals(kind, belief.chosen.kind, "$belief")
            assertTrue(belief.isExplained && belief.undecided.isEmpty(), "$belief")
            for ((number, parameter) in numbers[index].zip(belief.chosen.parameters)) {
                // Twice what 95 % are within: one in 10 000 is not.
                val reach = parameter.interval.width
                assertTrue(number in parameter.value - reach..parameter.value + reach, "$number: $belief")
                assertTrue(parameter.interval.width < 0.5 * number, "$belief")
            }
            // Seven visits of ten readings, each of noise 0.002, through a sensor that takes ten: 0.005 is ample.
            for (cell in truths.indices) assertEquals(truths[cell], estimator.map.value(cell), 0.01, "$kind, $cell")
        }
    }

    @Test
    fun findsASlewLimitThatActsForAReadingOrTwoAtATime() {
        // Neighbours differ by up to 0.013: at 0.01 a reading the sensor is there in two, if not in one.
        val steps = doubleArrayOf(0.5, 0.501, 0.503, 0.507, 0.512, 0.516, 0.513, 0.525, 0.538, 0.535)
        val row = Grid.unit(steps.size, 1)
        val estimator = SelfCalibratingEstimator(row, Interval.UNIT)
        val sensor = SensorSpec("", listOf(SensorStage.Slew(0.01))).build(0.5, Random(1))
        var time = 0.0
        repeat(120) { move ->
            val back = move % (2 * steps.size - 2)
            val cell = minOf(back, 2 * steps.size - 2 - back)
            repeat(10) {
                time++
                val reading = sensor.step(steps[cell], 1.0, Conditions.NONE)
                estimator.update(BoatTime(time), row.centerX(cell), row.centerY(cell), reading)
            }
        }
        val belief = estimator.sensor()
        assertEquals(SensorKind.SLEW_LIMIT, belief.chosen.kind, "$belief")
        assertTrue(belief.isExplained, "$belief")
        assertEquals(0.01, belief.chosen.parameters.single().value, 1e-4, "$belief")
        for (cell in steps.indices) assertEquals(steps[cell], estimator.map.value(cell), 1e-3, "$cell")
    }

    @Test
    fun saysSoWhenNoModelExplainsTheReadingsAndFallsBackOnBoundsWithoutOne() {
        val others = listOf(
            listOf(SensorStage.TwoPath(2.0, 60.0, 0.4)),
            listOf(SensorStage.Lag(9.5), SensorStage.Backlash(0.3)),
        )
        for ((index, stages) in others.withIndex()) {
            val estimator = SelfCalibratingEstimator(grid, Interval.UNIT)
            val modelFree = BoundedExtendedFilter(grid, Interval.UNIT)
            for (each in listOf(estimator, modelFree)) {
                survey(each, SensorSpec("", stages).build(0.5, Random(1)), Random(3), rounds = 12, noise = 0.002)
            }
            assertFalse(estimator.isExplained, "sensor $index: ${estimator.sensor()}")
            assertFalse(estimator.sensor().isExplained)
            for (cell in truths.indices) {
                val value = estimator.map.value(cell)
                // The last cells are not brought up to date with every reading.
                assertEquals(minOf(value, modelFree.map.lower(cell)), estimator.map.lower(cell), 1e-3)
                assertEquals(maxOf(value, modelFree.map.upper(cell)), estimator.map.upper(cell), 1e-3)
            }
        }
    }

    /** Whether a reading, an interruption or a fit that begins turns it, bounds that hold no longer change in all cells. */
    @Test
    fun allCellsFollowWhenReadingsAreNoLongerExplainedOrAreAgain() {
        var left = 0
        var begun = 0
        for (seed in 22..27) {
            val random = Random(seed)
            val row = Grid.unit(30, 1)
            val estimator = SelfCalibratingEstimator(row, Interval.UNIT, work = 300.0)
            val sensor = SensorSpec("", listOf(SensorStage.TwoPath(2.0, 60.0, 0.1))).build(0.5, random)
            val water = DoubleArray(row.size) { random.between(0.2, 0.8) }
            var before = List(row.size) { estimator.map.lower(it) to estimator.map.upper(it) }
            var wasExplained = true
            fun check(visited: Int, what: String): Boolean {
                val map = estimator.map
                val now = List(row.size) { map.lower(it) to map.upper(it) }
                val turned = estimator.isExplained != wasExplained
                wasExplained = estimator.isExplained
                val same = now.indices.count { now[it] == before[it] }
                before = now
                // Cells never visited, and few whose bounds are the prior's ends or a value either way.
                if (turned) assertTrue(same <= row.size - visited + 3, "seed $seed $what: $same the same")
                return turned
            }
            var time = 0.0
            for (visit in 0 until 4 * row.size) {
                val cell = if (visit / row.size % 2 == 0) visit % row.size else row.size - 1 - visit % row.size
                repeat(6) {
                    time++
                    val state = sensor.step(water[cell], 1.0, Conditions.NONE) + 0.01 * random.between(-1.0, 1.0)
                    estimator.update(BoatTime(time), cell + 0.5, 0.5, state)
                    if (check(minOf(visit, row.size), "reading $time")) begun++
                }
                if (visit % 3 == 0) {
                    time++
                    estimator.update(BoatTime(time), -1.0, 0.5, 0.5)
                    if (check(minOf(visit, row.size), "left $time")) left++
                }
            }
        }
        assertTrue(left > 0 && begun > 0, "$left $begun")
    }

    @Test
    fun waterThatChangesWithinCellsIsFlaggedAndItsValuesDoNotRunAway() {
        for (seed in 931..936) {
            val random = Random(seed)
            val row = Grid.unit(12, 3)
            val estimator = SelfCalibratingEstimator(row, Interval(0.0, 20.0))
            val sensor = FirstOrderLag(6.0, 10.0)
            val phase = random.between(0.0, 6.0)
            val water = { x: Double, y: Double -> 10 + 3 * sin(phase + x / 1.5) * cos(y / 2) }
            var time = 0.0
            for (line in 0 until 3) {
                for (step in 0 until 120) {
                    time++
                    val x = if (line % 2 == 0) (step + 0.5) / 10 else 12 - (step + 0.5) / 10
                    val state = sensor.step(water(x, line + 0.5), 1.0, Conditions.NONE)
                    estimator.update(BoatTime(time), x, line + 0.5, state + 0.02 * random.between(-1.0, 1.0))
                }
            }
            val worst = (0 until row.size).maxOf {
                abs(estimator.map.value(it) - water(row.centerX(it), row.centerY(it)))
            }
            // The water's own range is 6; the nearest lag model is up to 10 off.
            assertFalse(estimator.isExplained, "seed $seed: ${estimator.sensor()}")
            assertTrue(worst < 3.0, "seed $seed: $worst off")
        }
    }

    @Test
    fun aSecondParameterFarBeyondItsEndDoesNotHangTheSearch() {
        // Second order at no second lag, with a surface that would have it far below none: seeds 1 to 4 of 500 moves.
        for (seed in 1..4) {
            val random = Random(seed)
            val square = Grid.unit(10, 10)
            val field = DoubleArray(square.size) { random.between(0.0, 1.0) }
            val stages = listOf(SensorStage.TwoPath(4.0, 40.0, 0.3))
            val sensor = SensorSpec("", stages).build(0.5, random)
            val estimator = SelfCalibratingEstimator(square, Interval.UNIT)
            var time = 0.0
            repeat(300) { move ->
                val row = move % 100 / 10
                val cell = row * 10 + if (row % 2 == 0) move % 10 else 9 - move % 10
                repeat(10) {
                    time++
                    val reading = sensor.step(field[cell], 1.0, Conditions.NONE) + 0.002 * random.between(-1.0, 1.0)
                    estimator.update(BoatTime(time), square.centerX(cell), square.centerY(cell), reading)
                }
            }
            for (cell in 0 until square.size) assertTrue(estimator.map.value(cell).isFinite())
        }
    }

    @Test
    fun aBoatThatLeftTheGridComesBackWithAnUnknownSensor() {
        val estimator = SelfCalibratingEstimator(grid, Interval.UNIT)
        val sensor = FirstOrderLag(10.0, 0.5)
        var time = 0.0
        fun stay(x: Double, truth: Double) = repeat(10) {
            time++
            estimator.update(BoatTime(time), x, 0.5, sensor.step(truth, 1.0, Conditions.NONE))
        }
        repeat(12) { round ->
            for (i in truths.indices) stay(i + 0.5, truths[i])
            // Another water each time, outside.
            stay(-0.5, if (round % 2 == 0) 5.0 else -5.0)
        }
        assertEquals(10.0, estimator.timeConstant, 0.01)
        for (cell in truths.indices) assertEquals(truths[cell], estimator.map.value(cell), 1e-3)
    }

    @Test
    fun aReadingNoWaterHasIsLeftOutAndCounted() {
        val plain = SelfCalibratingEstimator(grid, Interval.UNIT)
        val estimator = SelfCalibratingEstimator(grid, Interval.UNIT)
        val sensor = FirstOrderLag(10.0, 0.5)
        for (k in 0 until 120) {
            val cell = k / 10 % 6
            val value = sensor.step(truths[cell], 1.0, Conditions.NONE)
            estimator.update(BoatTime(k.toDouble()), cell + 0.5, 0.5, value)
            plain.update(BoatTime(k.toDouble()), cell + 0.5, 0.5, value)
            if (k == 55) estimator.update(BoatTime(k.toDouble()), cell + 0.5, 0.5, 1e300)
        }
        assertEquals(1, estimator.map.conflicts(5))
        assertEquals(plain.timeConstant, estimator.timeConstant)
        for (cell in truths.indices) assertEquals(plain.map.value(cell), estimator.map.value(cell))
    }

    @Test
    fun knowsThatItDoesNotKnowTheTimeConstantInStillWater() {
        val estimator = SelfCalibratingEstimator(grid, Interval.UNIT, SelfCalibratingSettings(10.0, 3.0))
        val random = Random(5)
        for (k in 0 until 400) {
            estimator.update(BoatTime(k.toDouble()), k / 10 % 6 + 0.5, 0.5, 0.5 + 0.002 * random.between(-1.0, 1.0))
        }
        // Little more is known than before: ln 3 = 1.1.
        assertTrue(estimator.relativeUncertainty > 0.3 * ln(3.0), "${estimator.relativeUncertainty}")
        for (cell in 0 until 6) assertTrue(abs(estimator.map.value(cell) - 0.5) < 0.05)
    }

    @Test
    fun refusesImpossibleSettings() {
        assertThrows<IllegalArgumentException> { SelfCalibratingSettings(timeConstant = 0.0) }
        assertThrows<IllegalArgumentException> { SelfCalibratingSettings(factor = 1.0) }
        assertThrows<IllegalArgumentException> { SelfCalibratingSettings(recalled = 15) }
    }
}
