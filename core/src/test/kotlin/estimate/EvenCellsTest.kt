package stillwater.estimate

import org.junit.jupiter.api.Test
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Position
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.floor
import kotlin.math.pow
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class EvenCellsTest {
    private val grid = Grid(Position(0.0, 0.0), 12, 8, 10.0)

    /** Waves of 30 to 90 m, as a [Random] has them. */
    private fun smooth(random: Random): (Double, Double) -> Double {
        val waves = List(12) {
            val length = 30 * exp(random.nextDouble(1.1))
            val way = random.nextDouble(6.283)
            Triple(6.283 / length * cos(way), 6.283 / length * sin(way), random.nextDouble(6.283))
        }
        return { x, y -> 8 + waves.sumOf { (a, b, phase) -> 0.3 * sin(a * x + b * y + phase) } }
    }

    /**
     * A lag of [lag] s on a lawnmower's way at 1 m/s, a reading a second, noise of 0.02, resolution of 0.01; if
     * [change] is not 0 again from the start, with water changed by it.
     */
    private fun sail(
        random: Random,
        lag: Double,
        change: Double = 0.0,
        still: (x: Double, y: Double) -> Double,
    ) = SelfCalibratingEstimator(grid, Interval(4.0, 12.0)).also { estimator ->
        sail(estimator, random, lag, List(if (change == 0.0) 8 else 16) { it % 8 }) { row, x, y ->
            still(x, y) + if (row < 8) 0.0 else change
        }
    }

    /** The same on [rows] of the grid, one after the other, in water that [still] has during the first, second, ... */
    private fun sail(
        estimator: FieldEstimator,
        random: Random,
        lag: Double,
        rows: List<Int>,
        still: (turn: Int, x: Double, y: Double) -> Double,
    ) {
        var state = still(0, 0.5, 5.0)
        for (second in 0 until 120 * rows.size) {
            val turn = second / 120
            val along = second % 120 + 0.5
            val x = if (turn % 2 == 0) along else 120 - along
            val y = 10.0 * rows[turn] + 5
            state += (1 - exp(-1 / lag)) * (still(turn, x, y) - state)
            val noise = 0.02 * (random.nextDouble() + random.nextDouble() + random.nextDouble() - 1.5) * 2
            val value = floor((state + noise) * 100 + 0.5) / 100
            estimator.update(BoatTime(second.toDouble()), x, y, value, Conditions.NONE)
        }
    }

    @Test
    fun whereWaterChangesWithinCellsNothingIsSaidOfTheSensorAndBoundsHold() {
        for (seed in 601..606) {
            val random = Random(seed)
            val water = smooth(random)
            val estimator = sail(random, lag = 3.0 + 2 * (seed - 600), still = water)
            val belief = estimator.sensor()
            assertFalse(estimator.isExplained, "seed $seed: $belief")
            assertFalse(belief.areCellsEven, "seed $seed")
            assertTrue(belief.candidates.none { it.standing == SensorStanding.EXCLUDED }, "seed $seed: $belief")
            val map = estimator.map
            val held = (0 until grid.size).count {
                water(grid.centerX(it), grid.centerY(it)) in map.lower(it)..map.upper(it)
            }
            assertTrue(held >= 0.9 * grid.size, "seed $seed: $held of ${grid.size}")
        }
    }

    @Test
    fun evenCellsAreToldByTheirBorders() {
        for (seed in 611..614) {
            val random = Random(seed)
            val water = smooth(random)
            // The same water, the same in all of a cell.
            val estimator = sail(random, lag = 3.0 + 3 * (seed - 610)) { x, y ->
                val cell = grid.cellAt(x, y)
                water(grid.centerX(cell), grid.centerY(cell))
            }
            assertTrue(estimator.isExplained, "seed $seed: ${estimator.sensor()}")
            assertTrue(estimator.sensor().areCellsEven, "seed $seed")
        }
    }

    /** What visits disagree says nothing of where in their cells the water changes. */
    @Test
    fun evenCellsWhoseWaterChangedBetweenPassesAreEven() {
        val random = Random(631)
        val water = smooth(random)
        // Three times the noise.
        val estimator = sail(random, lag = 5.0, change = 0.06) { x, y ->
            val cell = grid.cellAt(x, y)
            water(grid.centerX(cell), grid.centerY(cell))
        }
        assertTrue(estimator.sensor().areCellsEven)
    }

    /** Fifteen times the noise: no sensor is learned, and why is not said of the cells' borders. */
    @Test
    fun waterThatChangedBetweenPassesIsToldFromUnevenCells() {
        var held = 0
        var all = 0
        for (seed in 651..654) {
            val random = Random(seed)
            val water = smooth(random)
            val estimator = sail(random, lag = 5.0, change = 0.3) { x, y ->
                val cell = grid.cellAt(x, y)
                water(grid.centerX(cell), grid.centerY(cell))
            }
            val belief = estimator.sensor()
            assertEquals(
                listOf(false, true, false),
                listOf(belief.isExplained, belief.areCellsEven, belief.isWaterSteady),
            )
            // What the map is of is the mean of both waters.
            val map = estimator.map
            held += (0 until grid.size).count {
                water(grid.centerX(it), grid.centerY(it)) + 0.15 in map.lower(it)..map.upper(it)
            }
            all += grid.size
        }
        assertTrue(held >= 0.95 * all, "$held of $all")
    }

    /** A Gaussian process says no less of visited cells than what reads them, and no more of those between. */
    @Test
    fun aMapOfTheWholeFieldHasBoundsWhereCellsAreNotEven() {
        var held = 0
        var all = 0
        var squares = 0.0
        var plain = 0.0
        for (seed in 661..664) {
            val random = Random(seed)
            val water = smooth(random)
            val estimator = BayesianMap(grid, Interval(4.0, 12.0))
            // Every other row of cells is left out.
            sail(estimator, random, lag = 6.0, rows = listOf(0, 2, 4, 6)) { _, x, y -> water(x, y) }
            val map = estimator.map
            assertFalse(estimator.isExplained, "seed $seed")
            for (cell in 0 until grid.size) {
                assertTrue(map.value(cell) in map.lower(cell)..map.upper(cell))
                // Those between two visited ones.
                if (cell / grid.columns !in listOf(1, 3, 5)) continue
                val truth = water(grid.centerX(cell), grid.centerY(cell))
                all++
                if (truth in map.lower(cell)..map.upper(cell)) held++
                squares += (map.value(cell) - truth).pow(2)
                plain += ((map.value(cell - grid.columns) + map.value(cell + grid.columns)) / 2 - truth).pow(2)
            }
        }
        assertTrue(held >= 0.95 * all, "$held of $all")
        // About as good as the mean of the cells below and above, and not drawn to the middle of the range.
        assertTrue(squares <= plain * 1.1 * 1.1, "${sqrt(squares / all)} for ${sqrt(plain / all)}")
    }

    /** Moved by a cell a way of one reading a cell, always the same, is as good as it was. */
    @Test
    fun staysOfOneReadingShowNoBorders() {
        val random = Random(641)
        val water = smooth(random)
        val estimator = SelfCalibratingEstimator(grid, Interval(4.0, 12.0))
        val circuit = (0..11).map { it to 0 } + (1..7).map { 11 to it } + (10 downTo 0).map { it to 7 } +
            (6 downTo 1).map { 0 to it }
        var state = 8.0
        for (second in 0 until 12 * circuit.size) {
            val (column, row) = circuit[second % circuit.size]
            val x = 10.0 * column + 5
            val y = 10.0 * row + 5
            state += (1 - exp(-1 / 2.0)) * (water(x, y) - state)
            val value = state + 0.02 * (random.nextDouble() - 0.5)
            estimator.update(BoatTime(second.toDouble()), x, y, value, Conditions.NONE)
        }
        assertTrue(estimator.sensor().areCellsEven)
    }

    @Test
    fun waterThatIsTheSameAllOverSaysNothingAgainstItsCells() {
        val estimator = sail(Random(621), lag = 10.0) { _, _ -> 8.0 }
        assertTrue(estimator.isExplained)
        assertEquals(8.0, estimator.map.value(17), 0.05)
    }
}
