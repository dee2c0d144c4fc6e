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

    @Test
    fun aLoneJumpIsLeftOut() {
        assertEquals(
            listOf(ReadingVerdict.PASSED, ReadingVerdict.HELD, ReadingVerdict.PASSED),
            listOf(7.0, 11.0, 7.1).map { take(it) },
        )
        assertEquals(listOf(7.0, 7.1), taken)
        assertEquals(1, gate.lone)
    }

    @Test
    fun aJumpThatTheNextReadingConfirmsPassesWhole() {
        listOf(7.0, 11.0).forEach { take(it) }
        assertEquals(ReadingVerdict.CONFIRMED, take(11.5))
        assertEquals(listOf(7.0, 11.0, 11.5), taken)
        assertEquals(0, gate.leftOut)
    }

    @Test
    fun jumpsThatDoNotAgreeAreLoneEach() {
        listOf(7.0, 11.0, 2.0, 14.0).forEach { take(it) }
        assertEquals(listOf(7.0), taken)
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
        listOf(0.0, 1.0).forEach { assertEquals(ReadingVerdict.PASSED, take(it)) }
    }
}
