package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.model.WaterArea
import stillwater.property.between
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertTrue

/** A rectangle's corners. */
internal fun rectangle(west: Double, south: Double, east: Double, north: Double): List<Position> =
    listOf(Position(west, south), Position(east, south), Position(east, north), Position(west, north))

/** Two basins of 20 m x 20 m joined by a channel 20 m long and [width] wide. */
internal fun twoBasins(width: Double): WaterArea = WaterArea(
    listOf(
        Position(0.0, 0.0), Position(20.0, 0.0), Position(20.0, 10 - width / 2), Position(40.0, 10 - width / 2),
        Position(40.0, 0.0), Position(60.0, 0.0), Position(60.0, 20.0), Position(40.0, 20.0),
        Position(40.0, 10 + width / 2), Position(20.0, 10 + width / 2), Position(20.0, 20.0), Position(0.0, 20.0),
    ),
)

/** A lake of any shape about 60 m wide with up to two islands or bathing zones, and a map over it. */
internal class Lake(random: Random) {
    val seed = random.nextInt()
    val margin = if (random.nextBoolean()) 0.0 else random.between(0.0, 2.0)
    private val shore = star(random, Position(0.0, 0.0), 30.0)
    private val keepOuts = List(random.nextInt(3)) {
        star(random, Position(random.between(-12.0, 12.0), random.between(-12.0, 12.0)), 6.0)
    }
    val area = WaterArea(shore, keepOuts)
    val grid = Grid(Position(-30.0, -30.0), 12, 12, 5.0)
    val map = FieldMap(grid, Interval.UNIT)

    init {
        for (cell in 0 until grid.size) if (random.nextInt(3) > 0) map.setBounds(cell, 0.0, random.nextDouble())
    }

    /** A place on the water, farther from land than the margin; null where chance finds none. */
    fun place(
        random: Random,
    ): Position? = List(200) { Position(random.between(-30.0, 30.0), random.between(-30.0, 30.0)) }
        .find { area.isClear(it.x, it.y, margin) }

    private fun star(random: Random, middle: Position, radius: Double): List<Position> {
        val corners = random.nextInt(4, 12)
        return List(corners) {
            val r = radius * random.between(0.5, 1.0)
            Position(middle.x + r * cos(2 * PI * it / corners), middle.y + r * sin(2 * PI * it / corners))
        }
    }

    override fun toString() = "shore $shore, keep-outs $keepOuts, margin $margin, seed $seed"
}

/** Checks every leg of [plan] from [from] on: on the water, and no nearer to land than [margin]. */
internal fun assertClear(area: WaterArea, margin: Double, from: Position, plan: Plan) {
    var x = from.x
    var y = from.y
    for (i in 0 until plan.size) {
        assertTrue(
            area.isClear(x, y, plan.x(i), plan.y(i), margin),
            "leg ${i + 1} from ($x, $y) to (${plan.x(i)}, ${plan.y(i)})",
        )
        x = plan.x(i)
        y = plan.y(i)
    }
}

/** Length of [plan] from [from] on, m. */
internal fun length(from: Position, plan: Plan): Double {
    val places = listOf(from) + plan.waypoints()
    return places.zipWithNext { a, b -> hypot(b.x - a.x, b.y - a.y) }.sum()
}
