package stillwater.run

import org.junit.jupiter.api.Test
import stillwater.field.CellField
import stillwater.field.FieldMap
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.sensor.SensorModel
import kotlin.test.assertEquals
import kotlin.test.assertSame

/** What a boat of a trial tells its sensor of how fast it goes. */
class BoatSpeedTest {
    private val grid = Grid.unit(4, 1)
    private val field = CellField(grid, DoubleArray(4) { 0.5 })
    private val told = ArrayList<Conditions>()
    private val sensor = SensorModel { input, _, conditions -> input.also { told += conditions } }

    private fun speeds(travel: Travel, moves: Int, vararg plans: List<Int>): List<Double> {
        val planner = ScriptedPlanner(grid, *plans)
        val boat = Boat(grid.center(0), sensor, planner, listOf(RecordingEstimator(grid)), travel, tellsSpeed = true)
        repeat(moves) { boat.move(field) { FieldMap(grid, Interval.UNIT) } }
        return told.map { it[Conditions.SPEED] }
    }

    @Test
    fun fromCellToCellItIsTheWayOfAMoveInItsTime() {
        val speeds = speeds(Travel(samplesPerMove = 2, period = 2.5), 5, listOf(1, 2), listOf(0))
        assertEquals(listOf(0.0, 0.2, 0.2, 0.4, 0.0), speeds.chunked(2) { it.distinct().single() })
        assertSame(told[2], told[5], "made anew although the speed is the same")
    }

    @Test
    fun alongWaypointsItIsTheBoatsUntilItWaits() {
        val speeds = speeds(Travel(samplesPerMove = 2, period = 1.0, speed = 0.75), 3, listOf(2))
        // At rest first; 2 m at 0.75 m/s are two samples and two thirds of a third.
        assertEquals(listOf(0.0, 0.0, 0.75, 0.75, 0.5, 0.0), speeds)
    }

    @Test
    fun aSensorThatDoesNotAskIsToldNothing() {
        val planner = ScriptedPlanner(grid, listOf(1))
        val boat = Boat(grid.center(0), sensor, planner, listOf(RecordingEstimator(grid)), Travel(1, 1.0))
        repeat(2) { boat.move(field) { FieldMap(grid, Interval.UNIT) } }
        told.forEach { assertSame(Conditions.NONE, it) }
    }
}
