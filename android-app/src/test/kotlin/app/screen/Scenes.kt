package stillwater.app.screen

import stillwater.estimate.BoundedFilter
import stillwater.estimate.BoundedFilterSettings
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Position
import stillwater.sensor.FirstOrderLag
import kotlin.math.exp
import kotlin.math.hypot

/** What the map's tests and pictures show: a pond of 100 m by 60 m, half surveyed by a boat with a slow probe. */
internal object Scenes {
    private val grid =
        Grid(Position(-40.0, -30.0), columns = 20, rows = 12, cellWidth = 5.0, cellHeight = 5.0, rotation = 0.2)

    /** Lanes along the rows, there and back; mg/L of oxygen. */
    fun halfSurveyed(): MapScene {
        val filter = BoundedFilter(grid, Interval(4.0, 12.0), BoundedFilterSettings(epsilon = 0.002))
        val sensor = FirstOrderLag(TIME_CONSTANT, oxygen(grid.center(0)))
        val track = mutableListOf<Position>()
        var time = 0.0
        for (row in 0 until ROWS_DONE) {
            for (step in 0 until grid.columns) {
                val column = if (row % 2 == 0) step else grid.columns - 1 - step
                val center = grid.center(row * grid.columns + column)
                track += center
                repeat(SECONDS_A_CELL) {
                    time += 1.0
                    val value = sensor.step(oxygen(center), 1.0, Conditions.NONE)
                    filter.update(BoatTime(time), center.x, center.y, value)
                }
            }
        }
        val ahead = (ROWS_DONE until grid.rows step 2).flatMap { row ->
            if (row % 4 ==
                3
            ) {
                lane(row).reversed()
            } else {
                lane(row)
            }
        }
        return MapScene(
            map = filter.map.copy(),
            track = track,
            plan = ahead,
            fence = fence(),
            home = grid.center(0).moved(-6.0, 2.0),
            boat = track.last(),
            headingDeg = 350f,
            unit = "mg/L",
        )
    }

    private fun lane(row: Int) =
        listOf(0, grid.columns - 1).map { grid.center(row * grid.columns + it) }

    private fun fence(): List<Position> {
        val corner = { column: Double, row: Double ->
            val first = grid.center(0)
            val along = grid.center(1)
            val up = grid.center(grid.columns)
            Position(
                first.x + column * (along.x - first.x) + row * (up.x - first.x),
                first.y + column * (along.y - first.y) + row * (up.y - first.y),
            )
        }
        return listOf(corner(-2.5, -2.5), corner(21.5, -2.5), corner(21.5, 13.5), corner(-2.5, 13.5))
    }

    /** A plume in water that is otherwise even. */
    private fun oxygen(at: Position): Double = 9.0 - 4.0 * exp(-hypot(at.x - 5.0, at.y - 0.0) / 20.0)

    private const val ROWS_DONE = 7
    private const val SECONDS_A_CELL = 10
    private const val TIME_CONSTANT = 8.0
}
