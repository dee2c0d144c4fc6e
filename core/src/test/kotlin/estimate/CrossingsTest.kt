package stillwater.estimate

import org.junit.jupiter.api.Test
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Position
import kotlin.math.abs
import kotlin.math.exp
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class CrossingsTest {
    private val crossings = Crossings()

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

    /** A lag of 8 s on a lawnmower's way at 1 m/s, a reading a second; mean error and estimator. */
    private fun survey(seed: Int, conditions: Conditions): Pair<Double, SelfCalibratingEstimator> {
        val random = Random(seed)
        val truths = DoubleArray(grid.size) { random.nextDouble(2.0, 13.0) }
        val estimator = SelfCalibratingEstimator(grid, Interval(0.0, 15.0))
        var state = truths[0]
        // Fixes' errors as a track filter leaves them: they change within some ten seconds.
        var off = 0.0
        for (second in 0 until 720) {
            val row = second / 60 % 6
            val along = second % 60 + 0.5
            val x = if (row % 2 == 0) along else 60 - along
            val y = 10.0 * row + 5
            state += (1 - exp(-1 / 8.0)) * (truths[grid.cellAt(x, y)] - state)
            off += 0.1 * (0.0 - off) + 0.6 * (random.nextDouble() + random.nextDouble() - 1)
            val value = state + 0.05 * (random.nextDouble() + random.nextDouble() - 1)
            estimator.update(BoatTime(second.toDouble()), x + off, y, value, conditions)
        }
        return (0 until grid.size).sumOf { abs(estimator.map.value(it) - truths[it]) } / grid.size to estimator
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
    fun otherConditionsChangeNothing() {
        val (without, one) = survey(544, Conditions.NONE)
        val (with, other) = survey(544, Conditions(mapOf(Conditions.SPEED to 1.0)))
        assertEquals(without, with)
        assertEquals(one.timeConstant, other.timeConstant)
        assertEquals(0, other.unplaced)
    }
}
