package stillwater.mission

import org.junit.jupiter.api.Test
import stillwater.model.BoatTime
import stillwater.model.Interval
import stillwater.model.Position
import stillwater.model.Reading
import kotlin.test.assertEquals

class PlausibilityGateTest {
    private val taken = ArrayList<Double>()
    private val gate = PlausibilityGate(Interval(0.0, 15.0), 2.0) { taken.add(it.value) }
    private var seconds = 0.0

    private fun take(value: Double, x: Double = 0.0) =
        gate.take(Reading(BoatTime(seconds++), Position(x, 0.0), value))

    /** The first reading has none before it and waits for the second. */
    private fun begin() {
        assertEquals(listOf(ReadingVerdict.HELD, ReadingVerdict.CONFIRMED), listOf(6.5, 7.0).map { take(it) })
        assertEquals(listOf(6.5, 7.0), taken)
        taken.clear()
    }

    @Test
    fun aLoneJumpIsLeftOut() {
        begin()
        assertEquals(listOf(ReadingVerdict.HELD, ReadingVerdict.PASSED), listOf(11.0, 7.1).map { take(it) })
        assertEquals(listOf(7.1), taken)
        assertEquals(1, gate.lone)
    }

    @Test
    fun aFirstReadingThatTheSecondDoesNotConfirmIsLeftOut() {
        listOf(11.0, 7.0, 7.1).forEach { take(it) }
        assertEquals(listOf(7.0, 7.1), taken)
        assertEquals(1, gate.lone)
    }

    /** Small cells and a slow probe: each reading waits in vain, but the next is compared with it. */
    @Test
    fun aBoatThatLeavesEveryCellBeforeTheNextReadingLosesOnlyTheFirst() {
        for (value in listOf(7.0, 7.1, 7.2, 7.3)) {
            take(value)
            gate.giveUp()
        }
        assertEquals(listOf(7.1, 7.2, 7.3), taken)
        assertEquals(1, gate.lone)
        assertEquals(0, gate.waiting)
    }

    /** What a fast probe says lies on its way, however large its steps; a reading beside the way is left out. */
    @Test
    fun aProbeThatMovesFastLosesNothing() {
        begin()
        listOf(9.5, 12.0, 14.5, 14.6).forEach { take(it) }
        assertEquals(listOf(9.5, 12.0, 14.5, 14.6), taken)
        assertEquals(0, gate.leftOut)
        listOf(10.0, 4.0, 3.0).forEach { take(it) }
        assertEquals(listOf(10.0, 4.0, 3.0), taken.drop(4))
        assertEquals(0, gate.lone)
    }

    @Test
    fun aConfirmingReadingIsNotConfirmedByItself() {
        begin()
        assertEquals(listOf(ReadingVerdict.HELD, ReadingVerdict.HELD), listOf(9.5, 14.9).map { take(it) })
        assertEquals(ReadingVerdict.PASSED, take(9.6))
        assertEquals(listOf(9.5, 9.6), taken)
    }

    /** [values] through a gate to which four equal readings are a stuck probe. */
    private fun stuckAfterFour(vararg values: Double): PlausibilityGate {
        taken.clear()
        val gate = PlausibilityGate(Interval(0.0, 15.0), 2.0, stuckAfter = 4) { taken.add(it.value) }
        for (value in values) gate.take(Reading(BoatTime(seconds++), Position(0.0, 0.0), value))
        return gate
    }

    @Test
    fun aProbeThatSaysTheSameTooOftenIsStuckSinceTheFirst() {
        assertEquals(2, stuckAfterFour(7.0, 7.1, 7.1, 7.1).same.size)
        assertEquals(listOf(7.0, 7.1), taken)
        // Three are borne.
        stuckAfterFour(7.0, 7.1, 7.1, 7.1, 7.2, 7.3)
        assertEquals(listOf(7.0, 7.1, 7.1, 7.1, 7.2, 7.3), taken)
        val gate = stuckAfterFour(7.0, 7.1, 7.1, 7.1, 7.1, 7.1, 7.2, 7.3)
        assertEquals(listOf(7.0, 7.1, 7.2, 7.3), taken)
        assertEquals(4, gate.stuck)
        // It gets stuck on its way, at a value that has to be confirmed.
        stuckAfterFour(7.0, 7.1, 11.0, 11.0, 11.0, 11.0, 11.1, 11.2)
        assertEquals(listOf(7.0, 7.1, 11.0, 11.1, 11.2), taken)
    }

    @Test
    fun aLineThatWasHitDoesNotSetAStuckProbeFree() {
        // Far off, and near enough to be water; before the probe is known to be stuck, and after.
        for (hit in listOf(12.0, 7.2)) {
            stuckAfterFour(7.0, 7.1, 7.1, hit, 7.1, 7.1, 7.3, 7.4)
            assertEquals(listOf(7.0, 7.1, 7.3, 7.4), taken, "hit $hit")
            val gate = stuckAfterFour(7.0, 7.1, 7.1, 7.1, 7.1, hit, 7.1, hit, 7.1, 7.3, 7.4)
            assertEquals(listOf(7.0, 7.1, 7.3, 7.4), taken, "hit $hit")
            assertEquals(11, gate.passed + gate.leftOut)
        }
    }

    @Test
    fun readingsThatChangeEverySecondTimeAreNoStuckProbe() {
        val gate = stuckAfterFour(7.0, 7.1, 7.1, 7.2, 7.1, 7.2, 7.1, 7.2, 7.1, 7.3)
        assertEquals(listOf(7.0, 7.1, 7.1, 7.2, 7.1, 7.2, 7.1, 7.2, 7.1, 7.3), taken)
        assertEquals(0, gate.leftOut)
    }

    @Test
    fun aStuckProbeStaysStuckOverBordersAndRestarts() {
        val gate = stuckAfterFour(7.0, 7.1, 7.1)
        // The boat leaves the cell.
        gate.giveUp()
        assertEquals(1, gate.stuck)
        val next = PlausibilityGate(gate.range, 2.0, stuckAfter = 4) { taken.add(it.value) }
        next.resume(7.1, gate.held, gate.same, gate.run)
        val verdicts = listOf(7.1, 7.1, 7.3, 7.4).map {
            next.take(Reading(BoatTime(seconds++), Position(0.0, 0.0), it))
        }
        assertEquals(
            listOf(ReadingVerdict.SAME, ReadingVerdict.STUCK, ReadingVerdict.SAME, ReadingVerdict.PASSED),
            verdicts,
        )
        assertEquals(listOf(7.0, 7.1, 7.3, 7.4), taken)
    }

    @Test
    fun aJumpThatTheNextReadingConfirmsPassesWhole() {
        begin()
        take(11.0)
        assertEquals(ReadingVerdict.CONFIRMED, take(11.5))
        assertEquals(listOf(11.0, 11.5), taken)
        assertEquals(0, gate.leftOut)
    }

    @Test
    fun jumpsThatDoNotAgreeAreLoneEach() {
        begin()
        listOf(11.0, 2.0, 14.0).forEach { take(it) }
        assertEquals(emptyList(), taken)
        assertEquals(2, gate.lone)
        assertEquals(14.0, gate.held?.value)
    }

    @Test
    fun whatNoWaterHasIsCountedByReason() {
        assertEquals(ReadingVerdict.OUT_OF_RANGE, take(15.1))
        assertEquals(ReadingVerdict.OUT_OF_RANGE, take(-0.1))
        assertEquals(ReadingVerdict.WITHOUT_VALUE_OR_PLACE, take(Double.NaN))
        assertEquals(ReadingVerdict.WITHOUT_VALUE_OR_PLACE, take(7.0, x = Double.NaN))
        assertEquals(2, gate.outOfRange)
        assertEquals(2, gate.withoutValueOrPlace)
        assertEquals(4, gate.leftOut)
        // The ends belong to the range.
        listOf(0.0, 15.0, 15.0).forEach { take(it) }
        assertEquals(listOf(15.0, 15.0), taken)
        assertEquals(2, gate.outOfRange)
    }
}
