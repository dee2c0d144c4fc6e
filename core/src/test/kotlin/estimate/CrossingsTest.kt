package stillwater.estimate

import org.junit.jupiter.api.Test
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Position
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class CrossingsTest {
    private val crossings = Crossings().apply { areHeeded = true }

    private fun slots(vararg readings: Pair<Int, Byte>) = readings.map { (slot, place) -> crossings.slot(slot, place) }

    @Test
    fun placesOfWhichNothingIsSaidAreTakenAtTheirWord() {
        val exact = Crossings.EXACT
        assertEquals(listOf(0, 0, 1, 1, 0), slots(0 to exact, 0 to exact, 1 to exact, 1 to exact, 0 to exact))
    }

    @Test
    fun theTimeFromOneCellToTheNextIsSpentInWaterOfItsOwn() {
        val (sure, near) = Crossings.SURE to Crossings.NEAR
        val found = slots(0 to sure, 0 to near, 1 to near, 1 to sure, 1 to sure, 2 to sure, 2 to sure)
        assertEquals(listOf(0, Crossings.PASSED_OVER, Crossings.PASSED_OVER), found.take(3))
        assertTrue(found[3] < LagBank.NONE && found[5] < LagBank.NONE && found[3] != found[5], "$found")
        assertEquals(listOf(1, 2), listOf(found[4], found[6]))
        // A boat that came near to a border and turned back.
        val back = slots(2 to near, 2 to sure, 2 to sure)
        assertTrue(back[1] < LagBank.NONE)
        assertEquals(2, back[2])
    }

    @Test
    fun behindAnInterruptionThereIsNoWayToAllowFor() {
        assertEquals(0, slots(0 to Crossings.SURE)[0])
        crossings.leave()
        assertEquals(1, slots(1 to Crossings.NEAR, 1 to Crossings.SURE)[1])
    }

    private val grid = Grid(Position(0.0, 0.0), 6, 6, 10.0)

    /** A lag of 8 s in even cells; mean error and estimator. */
    private fun survey(seed: Int, conditions: Conditions): Pair<Double, SelfCalibratingEstimator> {
        val random = Random(seed)
        val truths = DoubleArray(grid.size) { random.nextDouble(2.0, 13.0) }
        val estimator = sail(random, conditions) { x, y -> truths[grid.cellAt(x, y)] }
        return (0 until grid.size).sumOf { abs(estimator.map.value(it) - truths[it]) } / grid.size to estimator
    }

    /** A lag of 8 s on a lawnmower's way at 1 m/s through [water], a reading a second. */
    private fun sail(
        random: Random,
        conditions: Conditions,
        water: (x: Double, y: Double) -> Double,
    ): SelfCalibratingEstimator {
        val estimator = SelfCalibratingEstimator(grid, Interval(0.0, 15.0))
        var state = water(0.5, 5.0)
        // Fixes' errors as a track filter leaves them: they change within some ten seconds.
        var off = 0.0
        for (second in 0 until 720) {
            val row = second / 60 % 6
            val along = second % 60 + 0.5
            val x = if (row % 2 == 0) along else 60 - along
            val y = 10.0 * row + 5
            state += (1 - exp(-1 / 8.0)) * (water(x, y) - state)
            off += 0.1 * (0.0 - off) + 0.6 * (random.nextDouble() + random.nextDouble() - 1)
            val value = state + 0.05 * (random.nextDouble() + random.nextDouble() - 1)
            estimator.update(BoatTime(second.toDouble()), x + off, y, value, conditions)
        }
        return estimator
    }

    @Test
    fun aMapIsBetterForKnowingHowWellPlacesAreKnown() {
        for (seed in 541..543) {
            val (blind, _) = survey(seed, Conditions.NONE)
            val (knowing, estimator) = survey(seed, Conditions(mapOf(Conditions.POSITION_DEVIATION to 0.56)))
            assertTrue(knowing < blind / 2, "seed $seed: $knowing against $blind")
            assertTrue(estimator.isExplained)
            // Half a metre at the borders leaves some percent of a time constant open.
            assertEquals(8.0, estimator.timeConstant, 0.8)
            assertTrue(estimator.unplaced in 60..240, "${estimator.unplaced} of 720")
        }
    }

    @Test
    fun whereWaterChangesWithinCellsTheMapIsTheSameAsWithoutKnowingHowWellPlacesAreKnown() {
        for (seed in 545..547) {
            val phase = Random(seed).nextDouble(6.0)
            val water = { x: Double, y: Double -> 7.5 + 3 * sin(x / 11 + phase) + 2 * cos(y / 17 - x / 29) }
            val without = sail(Random(seed), Conditions.NONE, water)
            val with = sail(Random(seed), Conditions(mapOf(Conditions.POSITION_DEVIATION to 0.56)), water)
            assertEquals(false, with.isExplained)
            // To the last bit: what was fitted in between with borders heeded leaves nothing behind.
            assertEquals(without.timeConstant, with.timeConstant, "seed $seed")
            for (cell in 0 until grid.size) assertEquals(without.map.value(cell), with.map.value(cell), "cell $cell")
        }
    }

    @Test
    fun otherConditionsChangeNothing() {
        val (without, one) = survey(544, Conditions.NONE)
        val (with, other) = survey(544, Conditions(mapOf(Conditions.SPEED to 1.0)))
        assertEquals(without, with)
        assertEquals(one.timeConstant, other.timeConstant)
        assertEquals(0, other.unplaced)
    }
}
