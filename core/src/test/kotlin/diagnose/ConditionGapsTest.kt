package stillwater.diagnose

import stillwater.model.Conditions
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.cos
import kotlin.test.Test
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** What stands in for the numbers of a condition that are missing, where nothing can, and how many may be. */
class ConditionGapsTest {
    private val none = Double.NaN

    private fun seconds(rows: Int) = DoubleArray(rows) { it.toDouble() }

    private fun series(times: DoubleArray, name: String, column: DoubleArray): MeasuredSeries {
        val flat = DoubleArray(times.size)
        return MeasuredSeries(times, flat, flat, flat, null, mapOf(name to column))
    }

    @Test
    fun gapsAreBridgedStraightInTimeAndTheEndsStay() {
        val times = doubleArrayOf(0.0, 1.0, 2.0, 3.0, 6.0, 7.0)
        val column = doubleArrayOf(none, 2.0, none, none, 7.0, none)
        val found = series(times, Conditions.TEMPERATURE, column).temperature
        assertContentEquals(doubleArrayOf(2.0, 2.0, 3.0, 4.0, 7.0, 7.0), found)
        assertContentEquals(found, series(times, Conditions.SPEED, column).speed)
        assertEquals(4, ConditionGaps(times, column).missing)
    }

    @Test
    fun headingsGoTheShorterWayRound() {
        for (turns in -2..2) {
            val column = doubleArrayOf(PI - 0.2, none, none, none, -PI + 0.2 + turns * 2 * PI)
            val found = series(seconds(5), Conditions.HEADING, column).heading
            for (i in 0..4) assertEquals(cos(PI - 0.2 + 0.1 * i), cos(found[i]), 1e-12, "row $i, $turns turns more")
            assertTrue(found.take(4).all { abs(it - PI) < 0.21 }, found.joinToString())
        }
    }

    @Test
    fun moreThanHalfMissingIsTooMuch() {
        val times = seconds(100)
        fun every(rows: Int) = ConditionGaps(times, DoubleArray(100) { if (it % rows == 0) 1.0 else none })
        assertTrue(every(1).isMostlyKnown)
        assertTrue(every(2).isMostlyKnown)
        assertFalse(every(3).isMostlyKnown)
        val nothing = ConditionGaps(times, DoubleArray(100) { none })
        assertFalse(nothing.isMostlyKnown)
        assertTrue(nothing.isFar.all { it })
        assertContentEquals(DoubleArray(100), nothing.bridged)
    }

    @Test
    fun rowsInTheMiddleOfAGapAsLongAsOneOfTheLogAreFar() {
        fun far(rows: IntRange): List<Int> {
            val gaps = ConditionGaps(seconds(1000), DoubleArray(1000) { if (it in rows) none else 1.0 })
            return gaps.isFar.indices.filter { gaps.isFar[it] }
        }
        assertEquals(emptyList(), far(100..158))
        assertEquals(listOf(130, 131), far(100..161))
        assertEquals(emptyList(), far(970..999))
        assertEquals(listOf(999), far(969..999))
        assertEquals(listOf(0), far(0..30))
        // A row every minute: as many rows more.
        val minutes = DoubleArray(1000) { 60.0 * it }
        assertFalse(ConditionGaps(minutes, DoubleArray(1000) { if (it in 100..118) none else 1.0 }).isFar.any { it })
    }

    @Test
    fun aStopOfTheLogItselfIsNoGapOfTheCondition() {
        val times = DoubleArray(200) { if (it < 100) it.toDouble() else it + 3600.0 }
        val gaps = ConditionGaps(times, DoubleArray(200) { if (it == 100) none else it.toDouble() })
        assertFalse(gaps.isFar.any { it })
    }
}
