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
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class CrossingsTest {
    private val crossings = Crossings().apply { areHeeded = true }

    private val place = Place(width = 10.0, height = 10.0)
    private var seconds = 0.0

    /** What a reading a second later counts for, in the cell of ([along], [across]) by its number in a row of cells. */
    private fun slot(along: Double, deviation: Double, across: Double = 5.0, elapsed: Double = 1.0): Int {
        seconds += elapsed
        place.set(along, across, deviation, isNearBorder = grid.distanceToBorder(along, across) < deviation)
        return crossings.slot(slotOf(along, across), seconds, place)
    }

    private fun slotOf(along: Double, across: Double) = (along / 10).toInt() + 100 * (across / 10).toInt()

    private fun assertTimed(from: Double, until: Double) {
        assertTrue(crossings.isTimed)
        assertEquals(from, crossings.from - seconds, 1e-9)
        assertEquals(until, crossings.until - seconds, 1e-9)
    }

    @Test
    fun placesOfWhichNothingIsSaidAreTakenAtTheirWord() {
        for (along in listOf(8.0, 9.0, 11.0, 12.0, 9.0)) {
            assertEquals(slotOf(along, 5.0), slot(along, Double.NaN))
            assertFalse(crossings.isTimed)
        }
    }

    @Test
    fun theTimeFromOneCellToTheNextIsSpentInWaterOfItsOwnWherePlacesAreKnownBadly() {
        val ways = listOf(7.0, 9.0, 10.5, 12.0, 13.0, 18.0, 21.5, 22.5)
        val found = ways.map { slot(it, deviation = 1.2) }
        assertEquals(listOf(0, Crossings.PASSED_OVER, Crossings.PASSED_OVER), found.take(3))
        assertTrue(found[3] < LagBank.NONE && found[6] < LagBank.NONE && found[3] != found[6], "$found")
        assertEquals(listOf(1, 1, 2), listOf(found[4], found[5], found[7]))
        // A boat that came near to a border and turned back.
        val back = listOf(21.0, 22.0, 23.0).map { slot(it, deviation = 1.2) }
        assertTrue(back[1] < LagBank.NONE)
        assertEquals(2, back[2])
        assertFalse(crossings.isTimed)
    }

    @Test
    fun placesThatAreKnownWellTellWhenTheBoatCrossed() {
        for (along in listOf(7.1, 8.3)) slot(along, deviation = 0.0)
        assertFalse(crossings.isTimed)
        assertEquals(0, slot(9.5, deviation = 0.0))
        assertEquals(1, slot(10.7, deviation = 0.0))
        assertTimed(-0.7 / 1.2, -0.7 / 1.2)
        // Two borders, across a corner: from the first to the second it was in a cell without a reading.
        slot(18.0, deviation = 0.0, across = 8.5)
        assertEquals(102, slot(21.0, deviation = 0.0, across = 11.0))
        assertTimed(-1 / 2.5, -1 / 3.0)
    }

    @Test
    fun theTimeAllowsForErrorsOfPlacesWhereBordersAreHeeded() {
        for (along in listOf(7.0, 8.2)) slot(along, deviation = 0.1)
        slot(9.4, deviation = 0.1)
        assertEquals(1, slot(10.6, deviation = 0.1))
        assertTimed(-0.5 - 0.2 / 1.2, -0.5 + 0.2 / 1.2)
        // One too near to the border is passed over, and the way from the last to the next counts.
        slot(19.8, deviation = 0.1, elapsed = 1.0)
        assertEquals(Crossings.PASSED_OVER, slot(19.95, deviation = 0.1))
        assertEquals(2, slot(20.8, deviation = 0.1))
        assertTimed(-0.8 * 2 - 0.2 * 2, -0.8 * 2 + 0.2 * 2)
    }

    @Test
    fun takenAtTheirWordPlacesTellOneTime() {
        crossings.areHeeded = false
        for (along in listOf(7.0, 8.2, 9.4)) slot(along, deviation = 0.1)
        assertEquals(1, slot(10.6, deviation = 0.1))
        assertTimed(-0.5, -0.5)
        // Known too badly for that: as if right after the last reading.
        for (along in listOf(17.0, 18.2, 19.4)) slot(along, deviation = 0.5)
        assertEquals(2, slot(20.6, deviation = 0.5))
        assertFalse(crossings.isTimed)
    }

    @Test
    fun behindAPauseTheBoatMayHaveComeAnyWay() {
        for (along in listOf(7.0, 8.2, 9.4)) slot(along, deviation = 0.0)
        assertTrue(slot(10.6, deviation = 0.0, elapsed = 3.0) < LagBank.NONE)
        assertFalse(crossings.isTimed)
    }

    @Test
    fun behindAnInterruptionThereIsNoWayToAllowFor() {
        assertEquals(0, slot(5.0, deviation = 1.0))
        crossings.leave()
        assertEquals(Crossings.PASSED_OVER, slot(10.5, deviation = 1.0))
        assertEquals(1, slot(15.0, deviation = 1.0))
    }

    private val grid = Grid(Position(0.0, 0.0), 6, 6, 10.0)

    /** A lag of 8 s in even cells; mean error and estimator. */
    private fun survey(seed: Int, conditions: Conditions): Pair<Double, SelfCalibratingEstimator> {
        val random = Random(seed)
        val truths = DoubleArray(grid.size) { random.nextDouble(2.0, 13.0) }
        val estimator = sail(random, conditions) { x, y -> truths[grid.cellAt(x, y)] }
        return (0 until grid.size).sumOf { abs(estimator.map.value(it) - truths[it]) } / grid.size to estimator
    }

    /** A lag of 8 s on a lawnmower's way at 1 m/s through [water], a reading a second, and [between] s from row to row. */
    private fun sail(
        random: Random,
        conditions: Conditions,
        between: Int = 0,
        water: (x: Double, y: Double) -> Double,
    ): SelfCalibratingEstimator {
        val estimator = SelfCalibratingEstimator(grid, Interval(0.0, 15.0))
        var state = water(0.5, 5.0)
        // Fixes' errors as a track filter leaves them: they change within some ten seconds.
        var off = 0.0
        val leg = 60 + between
        for (second in 0 until 12 * leg) {
            val row = second / leg % 6
            val along = minOf(second % leg, 59) + 0.5
            val x = if (row % 2 == 0) along else 60 - along
            val y = 10.0 * row + 5 + (if (row < 5) 1 else -5) * maxOf(0, second % leg - 59) * 10.0 / (between + 1)
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
            val known = Conditions(mapOf(Conditions.POSITION_DEVIATION to 0.56))
            // Each step is short for that from row to row, too.
            val without = sail(Random(seed), Conditions.NONE, between = 9, water)
            val with = sail(Random(seed), known, between = 9, water)
            assertEquals(false, with.isExplained)
            // What was fitted in between with borders heeded leaves nothing behind but where a search began.
            assertEquals(without.timeConstant, with.timeConstant, 1e-9, "seed $seed")
            for (cell in 0 until grid.size) {
                assertEquals(without.map.value(cell), with.map.value(cell), 1e-9, "cell $cell")
            }
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
