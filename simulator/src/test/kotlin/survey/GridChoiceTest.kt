package stillwater.survey

import org.junit.jupiter.api.Test
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

/** Every reading lies in the grid laid over the survey, however the borders of its cells round. */
class GridChoiceTest {
    private fun choice(points: List<Pair<Double, Double>>): GridChoice {
        val scan = SurveyScan()
        points.forEachIndexed { i, (x, y) -> scan.take(BoatTime(i.toDouble()), x, y, 1.0, Conditions.NONE) }
        return GridChoice(scan.statistics(), scan.track())
    }

    private fun outside(grid: Grid, points: List<Pair<Double, Double>>) =
        points.filter { (x, y) -> grid.cellAt(x, y) == Grid.OUTSIDE }

    @Test
    fun `points on the borders of cells of a tenth lie in the grid`() {
        val points = (17..30).map { it / 10.0 to 0.0 }
        for (degrees in listOf(0.0, 90.0, 180.0, -90.0, 45.0)) {
            val grid = choice(points).grid(GridWish(cell = 0.1, rotation = Math.toRadians(degrees)))
            assertEquals(emptyList(), outside(grid, points), "$grid")
        }
    }

    @Test
    fun `no reading is outside for any side, rotation and extent`() {
        val random = Random(20_160_519)
        repeat(3000) {
            val side = (SIDES + random.nextDouble(1e-3, 50.0)).random(random)
            val offset = listOf(0.0, 1e3, -1e6, 5e8).random(random)
            val points = List(2 + random.nextInt(20)) {
                // Half of them on borders of cells, where rounding decides.
                if (random.nextBoolean()) {
                    offset + random.nextInt(-40, 40) * side to random.nextInt(-40, 40) * side
                } else {
                    offset + random.nextDouble(-40.0, 40.0) * side to random.nextDouble(-40.0, 40.0) * side
                }
            }
            val degrees = listOf(0.0, 90.0, 180.0, -180.0, 45.0, random.nextDouble(-180.0, 180.0)).random(random)
            val rotation = Math.toRadians(degrees)
            val wishes = listOf(
                GridWish(cell = side, rotation = rotation),
                GridWish(columns = 1 + random.nextInt(30), rows = 1 + random.nextInt(30), rotation = rotation),
                GridWish(rotation = rotation),
            )
            for (wish in wishes) {
                val grid = choice(points).grid(wish)
                assertEquals(emptyList(), outside(grid, points), "$wish $grid")
            }
        }
    }

    @Test
    fun `a grid of too many cells, or of cells below what a double can tell apart, is refused`() {
        val far = listOf(1e9 to 0.0, 1e9 + 1 to 1.0)
        assertFailsWith<UnfitGrid> { choice(far).grid(GridWish(cell = 1e-5)) }
        assertFailsWith<UnfitGrid> { choice(listOf(-1e300 to 0.0, 1e300 to 1e300)).grid(GridWish(cell = 1.0)) }
    }

    private companion object {
        val SIDES = listOf(0.1, 0.2, 0.3, 0.7, 1.1, 1.0, 2.5)
    }
}
