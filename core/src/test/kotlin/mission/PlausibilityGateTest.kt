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

    @Test
    fun aProbeThatSaysTheSameTooOftenIsStuckSinceTheFirst() {
        val gate = PlausibilityGate(Interval(0.0, 15.0), 2.0, stuckAfter = 4) { taken.add(it.value) }
        fun take(value: Double) = gate.take(Reading(BoatTime(seconds++), Position(0.0, 0.0), value))
        listOf(7.0, 7.1, 7.1, 7.1).forEach { take(it) }
        assertEquals(listOf(7.0, 7.1), taken)
        assertEquals(2, gate.same.size)
        // Three are borne.
        take(7.2)
        assertEquals(listOf(7.0, 7.1, 7.1, 7.1, 7.2), taken)
        val verdicts = List(6) { take(7.2) }
        assertEquals(List(2) { ReadingVerdict.SAME } + List(4) { ReadingVerdict.STUCK }, verdicts)
        // A line that was hit does not set a stuck probe free.
        take(12.0)
        assertEquals(ReadingVerdict.STUCK, take(7.2))
        take(7.4)
        assertEquals(listOf(7.4), taken.drop(5))
        assertEquals(7, gate.stuck)
        assertEquals(1, gate.lone)
        // The boat leaves the cell.
        take(7.4)
        gate.giveUp()
        take(7.5)
        assertEquals(listOf(7.5), taken.drop(6))
        assertEquals(8, gate.stuck)
        // It gets stuck on its way, at a value that has to be confirmed.
        val before = taken.size
        listOf(11.0, 11.0, 11.0, 11.0, 11.1).forEach { take(it) }
        assertEquals(listOf(11.0, 11.1), taken.drop(before))
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
