package stillwater.estimate

import org.junit.jupiter.api.Test
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.property.between
import stillwater.sensor.SensorModel
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertNotEquals
import kotlin.test.assertTrue

/** When a [SelfCalibratingEstimator] writes the cells of its map, and with what. */
class WrittenCellsTest {
    private val grid = Grid.unit(10, 10)

    /** Goes up and down the rows, ten readings a cell, one a second, with noise of 0.002 and a resolution of 0.005. */
    private inner class Boat(sensor: List<SensorStage>, seed: Int) {
        private val random = Random(seed)
        val truths = DoubleArray(grid.size) { random.between(0.0, 1.0) }
        private val sensor: SensorModel =
            SensorSpec("", sensor + SensorStage.Noise(0.002) + SensorStage.Quantum(0.005)).build(truths[0], random)
        private var seconds = 0.0

        fun cell(move: Int): Int {
            val place = move % grid.size
            val row = place / grid.columns
            return row * grid.columns + if (row % 2 == 0) place % 10 else 9 - place % 10
        }

        fun stay(cell: Int, read: (seconds: Double, value: Double) -> Unit) = repeat(10) {
            seconds++
            read(seconds, sensor.step(truths[cell], 1.0, Conditions.NONE))
        }
    }

    private fun SelfCalibratingEstimator.take(cell: Int, seconds: Double, value: Double) =
        update(BoatTime(seconds), grid.centerX(cell), grid.centerY(cell), value)

    @Test
    fun whatIsAskedForMeanwhileChangesNothing() {
        val sensors = listOf(
            listOf(SensorStage.Lag(9.5)),
            listOf(SensorStage.Asymmetric(13.0, 7.0)),
            listOf(SensorStage.Delay(2.0), SensorStage.Lag(9.5)),
            listOf(SensorStage.Lag(9.5), SensorStage.Lag(9.5)),
            listOf(SensorStage.Slew(0.05)),
            // No model has two paths.
            listOf(SensorStage.TwoPath(4.0, 40.0, 0.3)),
        )
        for (sensor in sensors) {
            val boat = Boat(sensor, seed = 3)
            val random = Random(4)
            val asked = SelfCalibratingEstimator(grid, Interval.UNIT)
            val left = SelfCalibratingEstimator(grid, Interval.UNIT)
            for (move in 0 until 250) {
                val cell = boat.cell(move)
                boat.stay(cell) { seconds, value ->
                    asked.take(cell, seconds, value)
                    left.take(cell, seconds, value)
                    if (random.nextInt(3) == 0) asked.map
                    if (random.nextInt(5) == 0) asked.timeConstant + asked.noise + asked.relativeUncertainty
                    if (random.nextInt(50) == 0) asked.sensor()
                }
            }
            assertEquals(left.sensor(), asked.sensor())
            for (at in 0 until grid.size) {
                assertEquals(left.map.value(at), asked.map.value(at), "cell $at, $sensor")
                assertEquals(left.map.lower(at), asked.map.lower(at), "cell $at, $sensor")
                assertEquals(left.map.upper(at), asked.map.upper(at), "cell $at, $sensor")
            }
        }
    }

    @Test
    fun waterThatIsSeenLateIsWrittenAsItsVisitLeftIt() {
        // Once the sensor is known no cell that was left is off by ten deviations of the noise, at any reading. Before, some
        // were written when filters of one dead time had left them and those of another had not: 0.023 off with seed 6.
        for (seed in 1..6) {
            val boat = Boat(listOf(SensorStage.Delay(2.0), SensorStage.Lag(9.5)), seed)
            val estimator = SelfCalibratingEstimator(grid, Interval.UNIT)
            for (move in 0 until 100) {
                val cell = boat.cell(move)
                boat.stay(cell) { seconds, value ->
                    estimator.take(cell, seconds, value)
                    if (move < 93) return@stay
                    for (left in 80 until move - 1) {
                        val at = boat.cell(left)
                        val off = abs(estimator.map.value(at) - boat.truths[at])
                        assertTrue(off < 0.02, "seed $seed, move $move, cell $left: $off")
                    }
                }
            }
        }
    }

    @Test
    fun everyCellFollowsWhatIsLearnedElsewhere() {
        val boat = Boat(listOf(SensorStage.Lag(9.5)), seed = 5)
        val estimator = SelfCalibratingEstimator(grid, Interval.UNIT)
        for (move in 0 until 300) boat.cell(move).let { cell -> boat.stay(cell) { t, z -> estimator.take(cell, t, z) } }
        val before = estimator.map.copy()
        for (move in 0 until grid.size / SelfCalibratingEstimator.REFRESHED) {
            boat.stay(move % 2) { seconds, value -> estimator.take(move % 2, seconds, value) }
        }
        for (cell in 0 until grid.size) assertNotEquals(before.upper(cell), estimator.map.upper(cell), "cell $cell")
    }
}
