package stillwater.estimate

import org.junit.jupiter.api.Test
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Position
import stillwater.model.Reading
import kotlin.test.assertEquals
import kotlin.test.assertSame

class CellEstimatorTest {
    /** Writes down what it is given. */
    private class Recorder(grid: Grid) : CellEstimator(grid, Interval.UNIT) {
        val taken = ArrayList<String>()

        override fun take(cell: Int, entered: Boolean, seconds: Double, value: Double, conditions: Conditions) {
            taken += "$cell${if (entered) " entered" else ""} at $seconds: $value"
        }

        fun at(seconds: Double, x: Double, value: Double = 1.0) = update(BoatTime(seconds), x, 0.5, value)
    }

    private val recorder = Recorder(Grid.unit(3, 1))
    private val map get() = recorder.map

    @Test
    fun noticesWhichCellTheBoatEnters() {
        for ((i, x) in listOf(0.2, 0.8, 1.5, 1.6, 0.1).withIndex()) recorder.at(i.toDouble(), x)
        assertEquals(
            listOf(
                "0 entered at 0.0: 1.0",
                "0 at 1.0: 1.0",
                "1 entered at 2.0: 1.0",
                "1 at 3.0: 1.0",
                "0 entered at 4.0: 1.0",
            ),
            recorder.taken,
        )
        assertEquals(listOf(2, 1, 0), List(3) { map.visits(it) })
        assertEquals(listOf(3, 2, 0), List(3) { map.readings(it) })
    }

    @Test
    fun equalStampsAreTaken() {
        recorder.at(5.0, 0.5)
        assertEquals(ReadingUse.USED, recorder.at(5.0, 0.5))
        assertEquals(2, map.readings(0))
        assertEquals(0L, map.rejected)
    }

    @Test
    fun timeGoingBackIsRejectedAndForgotten() {
        recorder.at(5.0, 0.5)
        assertEquals(ReadingUse.OUT_OF_ORDER, recorder.at(4.9, 1.5))
        assertEquals(ReadingUse.USED, recorder.at(5.0, 0.5))
        assertEquals(1L, map.rejected)
        assertEquals(listOf(1, 0, 0), List(3) { map.visits(it) })
        assertEquals(2, recorder.taken.size)
    }

    @Test
    fun whatIsNotFiniteIsRejectedWhereverItIs() {
        recorder.at(0.0, 0.5)
        var rejected = 0L
        for (bad in listOf(Double.NaN, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY)) {
            assertEquals(ReadingUse.NOT_FINITE, recorder.at(bad, 0.5))
            assertEquals(ReadingUse.NOT_FINITE, recorder.at(1.0, bad))
            assertEquals(ReadingUse.NOT_FINITE, recorder.at(1.0, 0.5, bad))
            assertEquals(ReadingUse.NOT_FINITE, recorder.update(BoatTime(1.0), 0.5, bad, 1.0))
            rejected += 4
            assertEquals(rejected, map.rejected)
        }
        // Neither the time nor the place of the last one taken has changed.
        assertEquals(ReadingUse.USED, recorder.at(0.5, 0.6))
        assertEquals(listOf("0 entered at 0.0: 1.0", "0 at 0.5: 1.0"), recorder.taken)
    }

    @Test
    fun infinitiesThatWouldCancelAreRejectedToo() {
        val use = recorder.update(BoatTime(0.0), Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY, 1.0)
        assertEquals(ReadingUse.NOT_FINITE, use)
    }

    @Test
    fun hugeNumbersAreNumbers() {
        assertEquals(ReadingUse.OUTSIDE, recorder.update(BoatTime(0.0), 1e308, 1e308, 1.0))
        assertEquals(ReadingUse.USED, recorder.update(BoatTime(1.7e308), 0.5, 0.5, 1.7e308))
    }

    @Test
    fun comingBackFromOutsideIsAnEntry() {
        recorder.at(0.0, 0.5)
        for (x in listOf(-0.1, 3.0, 99.0)) assertEquals(ReadingUse.OUTSIDE, recorder.at(1.0, x))
        recorder.at(2.0, 0.5)
        assertEquals(3L, map.outside)
        assertEquals(0L, map.rejected)
        assertEquals(2, map.visits(0))
        assertEquals(2, map.readings(0))
    }

    @Test
    fun aReadingWithoutAValueStillTellsThatTheBoatLeft() {
        recorder.at(0.0, 0.5)
        // In the same cell: the boat has not left.
        recorder.at(1.0, 0.6, Double.NaN)
        recorder.at(2.0, 0.7)
        assertEquals(1, map.visits(0))
        // In the next cell, and back.
        recorder.at(3.0, 1.5, Double.NaN)
        recorder.at(4.0, 0.5)
        assertEquals(2, map.visits(0))
        assertEquals(0, map.visits(1))
        // In the next cell, where the sensor recovers: one entry.
        recorder.at(5.0, 1.5, Double.NaN)
        recorder.at(6.0, 1.5)
        assertEquals(1, map.visits(1))
        // Off the grid, and back.
        recorder.at(7.0, -5.0, Double.NaN)
        recorder.at(8.0, 1.5)
        assertEquals(2, map.visits(1))
        // An old one, or one without a time, tells nothing.
        recorder.at(1.0, 2.5, Double.NaN)
        recorder.at(Double.NaN, 2.5, Double.NaN)
        recorder.at(9.0, 1.5)
        assertEquals(2, map.visits(1))
        assertEquals(6L, map.rejected)
        assertEquals(0L, map.outside)
    }

    @Test
    fun aReadingIsTakenAsItsParts() {
        val before = map
        assertEquals(ReadingUse.USED, recorder.update(Reading(BoatTime(3.0), Position(2.5, 0.5), 7.0)))
        assertEquals(listOf("2 entered at 3.0: 7.0"), recorder.taken)
        assertSame(before, map)
    }
}
