package stillwater.model

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

class PlanTest {
    private fun plan(count: Int, capacity: Int = 1) = Plan(capacity).apply {
        for (i in 0 until count) add(i.toDouble(), 10.0 - i)
    }

    @Test
    fun keepsWaypointsInOrderWhileItGrows() {
        val plan = plan(count = 100)
        assertEquals(100, plan.size)
        assertEquals(List(100) { Position(it.toDouble(), 10.0 - it) }, plan.waypoints())
        assertEquals(99.0, plan.x(99), 0.0)
        assertEquals(-89.0, plan.y(99), 0.0)
    }

    @Test
    fun aNewPlanIsEmpty() {
        assertEquals(0, Plan().size)
        assertEquals(emptyList(), Plan().waypoints())
    }

    @Test
    fun clearForgetsAllAndTheBufferIsUsedAgain() {
        val plan = plan(count = 5)
        plan.clear()
        assertEquals(0, plan.size)
        assertFailsWith<IndexOutOfBoundsException> { plan.x(0) }
        plan.add(7.0, 8.0)
        assertEquals(listOf(Position(7.0, 8.0)), plan.waypoints())
    }

    @Test
    fun truncateKeepsTheFirst() {
        val plan = plan(count = 5)
        plan.truncate(9)
        assertEquals(5, plan.size)
        plan.truncate(2)
        assertEquals(listOf(Position(0.0, 10.0), Position(1.0, 9.0)), plan.waypoints())
        plan.truncate(-3)
        assertEquals(0, plan.size)
    }

    @Test
    fun whatIsBeyondTheEndIsNeverShown() {
        val plan = plan(count = 3, capacity = 16)
        for (index in listOf(-1, 3, 15, Int.MAX_VALUE)) {
            assertFailsWith<IndexOutOfBoundsException>("x($index)") { plan.x(index) }
            assertFailsWith<IndexOutOfBoundsException>("y($index)") { plan.y(index) }
        }
    }

    @Test
    fun aCopyOfTheWaypointsStandsOnItsOwn() {
        val plan = plan(count = 2)
        val before = plan.waypoints()
        plan.clear()
        plan.add(9.0, 9.0)
        assertEquals(listOf(Position(0.0, 10.0), Position(1.0, 9.0)), before)
    }

    @Test
    fun needsRoomForOneWaypoint() {
        for (capacity in listOf(0, -1)) {
            val error = assertFailsWith<IllegalArgumentException> { Plan(capacity) }
            assertEquals("capacity ($capacity) must be at least 1", error.message)
        }
    }
}
