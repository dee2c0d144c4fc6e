package stillwater.model

import org.junit.jupiter.api.Test
import stillwater.property.between
import stillwater.property.drawn
import stillwater.property.forEvery
import java.awt.geom.Line2D
import java.awt.geom.Path2D
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class WaterAreaTest {
    private val square = ring(0.0 to 0.0, 10.0 to 0.0, 10.0 to 10.0, 0.0 to 10.0)
    private val island = ring(4.0 to 4.0, 6.0 to 4.0, 6.0 to 6.0, 4.0 to 6.0)
    private val lake = WaterArea(square, listOf(island))

    private fun ring(vararg corners: Pair<Double, Double>) = corners.map { (x, y) -> Position(x, y) }

    @Test
    fun waterIsInsideTheShoreAndOutsideTheIslands() {
        assertTrue(Position(1.0, 1.0) in lake)
        assertFalse(Position(5.0, 5.0) in lake, "on the island")
        assertFalse(Position(11.0, 5.0) in lake, "beyond the shore")
        assertFalse(lake.contains(Double.NaN, 1.0))
    }

    @Test
    fun aLegIsClearOnlyOutsideOfTheMargin() {
        assertTrue(lake.isClear(1.0, 1.0, 9.0, 1.0, margin = 0.9))
        assertFalse(lake.isClear(1.0, 1.0, 9.0, 1.0, margin = 1.1), "the shore is 1 m away")
        assertFalse(lake.isClear(1.0, 5.0, 9.0, 5.0, margin = 0.0), "the island is in the way")
        assertTrue(lake.isClear(1.0, 3.0, 9.0, 3.0, margin = 0.9))
        assertFalse(lake.isClear(1.0, 3.0, 9.0, 3.0, margin = 1.1), "the island is 1 m away")
        assertFalse(lake.isClear(4.5, 5.0, 5.5, 5.0, margin = 0.0), "all of it is on the island")
        assertFalse(lake.isClear(1.0, 1.0, Double.NaN, 1.0, margin = 0.0))
    }

    @Test
    fun whichWayRoundARingRunsDoesNotMatterNorThatItIsClosed() {
        val turned = WaterArea(square.asReversed() + square.last(), listOf(island.asReversed()))
        forEvery(drawn { Position(it.between(-1.0, 11.0), it.between(-1.0, 11.0)) }) { place ->
            assertEquals(place in lake, place in turned, "$place")
        }
        assertEquals(lake.edges, turned.edges)
    }

    /** A star-shaped lake with an island, of any size and anywhere. */
    private class Case(random: Random) {
        val middle = Position(random.between(-1e3, 1e3), random.between(-1e3, 1e3))
        val size = random.between(1.0, 500.0)
        val shore = star(random, random.nextInt(3, 14), size)
        val island = star(random, random.nextInt(3, 9), size / 4)
        val from = place(random)
        val to = place(random)
        val margin = if (random.nextBoolean()) 0.0 else size * random.between(0.0, 0.1)

        private fun place(random: Random): Position =
            middle.moved(size * random.between(-1.0, 1.0), size * random.between(-1.0, 1.0))

        private fun star(random: Random, corners: Int, radius: Double) = List(corners) {
            val r = radius * random.between(0.5, 1.0)
            Position(middle.x + r * cos(2 * PI * it / corners), middle.y + r * sin(2 * PI * it / corners))
        }

        override fun toString() = "$shore, island $island, $from to $to, margin $margin"
    }

    private fun path(ring: List<Position>) = Path2D.Double().apply {
        moveTo(ring[0].x, ring[0].y)
        for (corner in ring.drop(1)) lineTo(corner.x, corner.y)
        closePath()
    }

    private fun legs(ring: List<Position>) = ring.zip(ring.drop(1) + ring.first())

    /** The JDK's own geometry is the oracle; its sense of what lies on an edge itself may differ, which chance never draws. */
    @Test
    fun agreesWithTheJdk() = forEvery(drawn(::Case), cases = 500) { case ->
        val area = WaterArea(case.shore, listOf(case.island))
        val isWater = path(case.shore).contains(case.from.x, case.from.y) &&
            !path(case.island).contains(case.from.x, case.from.y)
        assertEquals(isWater, case.from in area)
        val edges = legs(case.shore) + legs(case.island)
        val leg = Line2D.Double(case.from.x, case.from.y, case.to.x, case.to.y)
        val crosses = edges.any { (a, b) -> leg.intersectsLine(a.x, a.y, b.x, b.y) }
        val near = edges.minOf { (a, b) ->
            minOf(
                minOf(leg.ptSegDist(a.x, a.y), leg.ptSegDist(b.x, b.y)),
                minOf(
                    Line2D.ptSegDist(a.x, a.y, b.x, b.y, case.from.x, case.from.y),
                    Line2D.ptSegDist(a.x, a.y, b.x, b.y, case.to.x, case.to.y),
                ),
            )
        }
        val isClear = isWater && !crosses && near > case.margin
        assertEquals(isClear, area.isClear(case.from.x, case.from.y, case.to.x, case.to.y, case.margin))
    }

    private fun refusal(shore: List<Position>, vararg keepOuts: List<Position>) =
        assertFailsWith<IllegalArgumentException> { WaterArea(shore, keepOuts.toList()) }.message.orEmpty()

    @Test
    fun saysWhatIsWrongWithAnOutline() {
        val bow = ring(0.0 to 0.0, 10.0 to 10.0, 10.0 to 0.0, 0.0 to 10.0)
        assertTrue("the shore crosses or touches itself: edge 1" in refusal(bow + Position(-5.0, 3.0)), refusal(bow))
        assertEquals(
            "the shore crosses or touches itself: edge 1 (0.0 m, 0.0 m) to (10.0 m, 10.0 m) meets edge 3 " +
                "(10.0 m, 0.0 m) to (0.0 m, 10.0 m)",
            refusal(bow),
            "a square whose corners were named in the wrong order",
        )
        assertEquals(
            "the shore encloses no area: its corners lie on one line",
            refusal(ring(0.0 to 0.0, 10.0 to 5.0, 20.0 to 10.0, 30.0 to 15.0)),
        )
        assertEquals("the shore has 2 different corners; it needs 3", refusal(ring(0.0 to 0.0, 1.0 to 0.0, 0.0 to 0.0)))
        assertEquals(
            "the shore has a corner that is not finite",
            refusal(ring(0.0 to 0.0, 1.0 to 0.0, Double.NaN to 1.0)),
        )
        val spike = ring(0.0 to 0.0, 10.0 to 0.0, 10.0 to 10.0, 10.0 to 5.0, 0.0 to 10.0)
        assertTrue("crosses or touches itself" in refusal(spike), refusal(spike))
        val away = island.map { it.moved(20.0, 0.0) }
        assertEquals(
            "keep-out 2, which starts at (24.0 m, 4.0 m), lies outside the shore",
            refusal(square, island, away),
        )
        val all = ring(-1.0 to -1.0, 11.0 to -1.0, 11.0 to 11.0, -1.0 to 11.0)
        assertEquals(
            "keep-out 1, which starts at (-1.0 m, -1.0 m), leaves no water inside the shore",
            refusal(square, all),
        )
    }

    @Test
    fun aKeepOutMayReachOverTheShoreAndIntoAnother() {
        val zone = ring(8.0 to 8.0, 12.0 to 8.0, 12.0 to 12.0, 8.0 to 12.0)
        val other = ring(7.0 to 7.0, 9.0 to 7.0, 9.0 to 9.0, 7.0 to 9.0)
        val area = WaterArea(square, listOf(zone, other))
        assertFalse(Position(8.5, 8.5) in area, "in both")
        assertFalse(Position(9.5, 9.5) in area)
        assertTrue(Position(6.0, 9.5) in area)
    }
}
