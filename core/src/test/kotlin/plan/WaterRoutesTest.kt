package stillwater.plan

import org.junit.jupiter.api.Test
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.model.WaterArea
import stillwater.property.drawn
import stillwater.property.forEvery
import kotlin.math.hypot
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class WaterRoutesTest {
    private val plan = Plan()

    @Test
    fun goesStraightWhereNothingIsInTheWay() {
        val routes = WaterRoutes(WaterArea(rectangle(0.0, 0.0, 10.0, 10.0)), margin = 0.5, resolution = 1.0)
        assertTrue(routes.start(1.0, 1.0))
        routes.wayBack(8.7, 6.3, plan)
        assertEquals(listOf(Position(1.0, 1.0)), plan.waypoints())
    }

    @Test
    fun goesRoundAnIslandByLittleMoreThanTheShortestWay() {
        val area = WaterArea(rectangle(0.0, 0.0, 20.0, 20.0), listOf(rectangle(8.0, 4.0, 12.0, 20.0)))
        val routes = WaterRoutes(area, margin = 0.0, resolution = 0.5)
        assertTrue(routes.start(2.0, 10.0))
        val from = Position(18.0, 10.0)
        routes.wayBack(from.x, from.y, plan)
        assertClear(area, 0.0, from, plan)
        // By the island's two southern corners.
        val shortest = 2 * hypot(6.0, 6.0) + 4
        assertTrue(length(from, plan) >= shortest, "${length(from, plan)}")
        // 8 % for eight directions, and the lattice's half metre at either corner.
        assertTrue(length(from, plan) <= 1.08 * shortest + 1, "${length(from, plan)} against $shortest")
    }

    @Test
    fun everyChannelWiderThanStatedIsFoundAndNoneThatIsTooNarrow() {
        val margin = 1.0
        for (resolution in listOf(0.7, 1.0, 1.5)) {
            val found = WaterRoutes(twoBasins(2 * margin + 2 * resolution + 0.01), margin, resolution)
            assertTrue(found.start(10.0, 10.0))
            found.wayBack(50.0, 3.0, plan)
            assertTrue(plan.size > 0, "resolution $resolution")
            val none = WaterRoutes(twoBasins(2 * margin - 0.01), margin, resolution)
            assertTrue(none.start(10.0, 10.0))
            none.wayBack(50.0, 3.0, plan)
            assertEquals(0, plan.size, "resolution $resolution")
        }
    }

    @Test
    fun everyWayKeepsTheMarginAndIsAsLongAsStatedAtMost() = forEvery(drawn(::Lake), cases = 150) { lake ->
        val random = Random(lake.seed)
        val start = lake.place(random) ?: return@forEvery
        val routes = WaterRoutes(lake.area, lake.margin, 1.0)
        if (!routes.start(start.x, start.y)) return@forEvery
        repeat(5) {
            val point = random.nextInt(routes.points)
            routes.wayTo(point, plan)
            assertEquals(routes.distance(point).isFinite(), plan.size > 0)
            if (plan.size > 0) {
                assertClear(lake.area, lake.margin, start, plan)
                // Sums of the same numbers in another order.
                assertTrue(length(start, plan) <= routes.distance(point) * (1 + 1e-12))
                assertEquals(Position(routes.x(point), routes.y(point)), plan.waypoints().last())
            }
            val from = lake.place(random) ?: return@repeat
            routes.wayBack(from.x, from.y, plan)
            assertClear(lake.area, lake.margin, from, plan)
            if (plan.size > 0) assertEquals(start, plan.waypoints().last())
        }
    }

    /** Also round what is in the way, of which a look from afar says that it is not near. */
    @Test
    fun waysFoundInPartsAreTheSame() = forEvery(drawn(::Lake)) { lake ->
        val random = Random(lake.seed)
        val start = lake.place(random) ?: return@forEvery
        val closed = ClosedCells(lake.grid, lake.area, random.nextDouble(2.0))
        repeat(random.nextInt(6)) {
            val cell = lake.grid.center(random.nextInt(lake.grid.size))
            closed.close(closed.at(cell.x, cell.y), 0.0)
        }
        val whole = WaterRoutes(lake.area, lake.margin, 2.5)
        whole.avoided = Obstacle { fromX, fromY, toX, toY -> closed.blocks(fromX, fromY, toX, toY) }
        val parts = whole.others().apply { avoided = closed }
        assertEquals(whole.start(start.x, start.y), parts.begin(start.x, start.y))
        while (parts.find(7) == 7) assertTrue(parts.find(0) == 0)
        for (point in 0 until whole.points) assertEquals(whole.distance(point), parts.distance(point))
    }

    @Test
    fun leavesTheMarginOverWaterOnly() {
        val area = WaterArea(rectangle(0.0, 0.0, 20.0, 20.0))
        val routes = WaterRoutes(area, margin = 3.0, resolution = 1.0)
        assertTrue(routes.start(10.0, 10.0))
        val from = Position(0.5, 10.0)
        routes.wayBack(from.x, from.y, plan)
        assertTrue(plan.size > 0)
        assertClear(area, 0.0, from, plan)
        assertFalse(routes.start(-1.0, 10.0), "on land")
        assertFalse(routes.start(Double.NaN, 10.0))
    }

    @Test
    fun refusesALatticeThatIsTooFine() {
        val area = WaterArea(rectangle(0.0, 0.0, 1e4, 1e4))
        val message = assertFailsWith<IllegalArgumentException> { WaterRoutes(area, 0.0, 1.0) }.message
        assertEquals("a resolution of 1.0 m makes 10000 x 10000 points; 250000 are allowed", message)
    }
}
