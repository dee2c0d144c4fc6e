package stillwater.run

import stillwater.estimate.MapFusion
import stillwater.field.CellField
import stillwater.model.Grid
import stillwater.model.Position
import stillwater.plan.BudgetedPlanner
import stillwater.plan.PlanOutcome
import stillwater.plan.Planner
import stillwater.plan.RandomWalk
import stillwater.plan.RegionPlanner
import stillwater.plan.StraightHome
import stillwater.sensor.SensorModel
import kotlin.math.abs
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class FleetTest {
    private val grid = Grid.unit(6, 4)
    private val field = CellField(grid, DoubleArray(grid.size) { it / 30.0 })
    private val perfect = SensorModel { input, _, _ -> input }
    private val score = MapScore(LocalExtremes.of(field))

    /** Plans one waypoint after another of [places], then nothing. */
    private class Waypoints(vararg places: Position) : Planner {
        private val left = ArrayDeque(places.toList())

        override fun plan(
            map: stillwater.field.FieldMap,
            from: Position,
            sensorValue: Double,
            stop: stillwater.plan.StopCondition,
            plan: stillwater.model.Plan,
        ): PlanOutcome {
            plan.clear()
            left.removeFirstOrNull()?.let { plan.add(it.x, it.y) }
            return if (plan.size > 0) PlanOutcome.Planned else PlanOutcome.NothingToGain
        }
    }

    private fun places(boat: Boat, moves: Int): List<Position> {
        val places = ArrayList<Position>()
        boat.onSample = { x, y -> places += Position(x, y) }
        repeat(moves) { boat.move(field) { boat.estimators.first().map } }
        return places
    }

    @Test
    fun aBoatInThePlaneSamplesEveryStepOfItsSpeedRoundCorners() {
        val planner = Waypoints(Position(2.5, 0.5), Position(2.5, 2.5))
        val boat = Boat(
            Position(0.5, 0.5),
            perfect,
            planner,
            listOf(RecordingEstimator(grid)),
            Travel(4, period = 0.5, speed = 1.0),
        )
        val along = places(boat, 4).map { it.x + it.y }
        // The first move stays at the start; then half a metre a sample, and 4 m to go in all.
        assertEquals(List(4) { 1.0 } + (1..8).map { 1.0 + 0.5 * it } + List(4) { 5.0 }, along)
        assertEquals(4.0, boat.odometer.metres, 1e-12, "sum of eight halves")
        assertEquals(4.0, boat.odometer.moves, 0.0)
        assertEquals(8.0, boat.odometer.seconds, 0.0)
    }

    @Test
    fun itWaitsAtTheEndOfAPlanForTheNextSample() {
        val planner = Waypoints(Position(1.2, 0.5), Position(3.5, 0.5))
        val boat = Boat(
            Position(0.5, 0.5),
            perfect,
            planner,
            listOf(RecordingEstimator(grid)),
            Travel(1, period = 1.0, speed = 1.0),
        )
        val found = places(boat, 5).map { it.x }
        // 0.7 m to the first waypoint take a whole second.
        listOf(0.5, 1.2, 2.2, 3.2, 3.5).zip(found) { due, x -> assertEquals(due, x, 1e-12, "rounding of sums") }
    }

    @Test
    fun readingsInTheDistanceAreTakenInTheCellsPassed() {
        val seen = RecordingEstimator(grid)
        val boat = Boat(
            Position(0.5, 0.5),
            perfect,
            Waypoints(Position(5.5, 0.5)),
            listOf(seen),
            Travel(2, period = 1.0, speed = 0.5),
        )
        places(boat, 6)
        assertEquals(listOf(0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5).drop(1), seen.records.map { it.cell }.drop(1))
    }

    @Test
    fun boatsKnowTogetherWhatEachHasSeen() {
        val boats = listOf(0, 20).map { start ->
            val planner = Waypoints(grid.center(start + 1), grid.center(start + 2))
            Boat(grid.center(start), perfect, planner, listOf(RecordingEstimator(grid)), Travel(1, 1.0))
        }
        val fusion = MapFusion { maps, into ->
            for (cell in 0 until grid.size) into.setValue(cell, maps.maxBy { abs(it.value(cell) - 0.5) }.value(cell))
        }
        val errors = Fleet(field, boats, listOf(fusion), score).run(intArrayOf(1, 3)).single()
        fun expected(seen: Set<Int>) =
            (0 until grid.size).sumOf { if (it in seen) 0.0 else abs(0.5 - field.truth(it)) } / grid.size
        assertEquals(expected(setOf(0, 20)), errors.mean[0], 1e-15, "rounding of a sum")
        assertEquals(expected(setOf(0, 1, 2, 20, 21, 22)), errors.mean[1], 1e-15, "rounding of a sum")
    }

    @Test
    fun boatsKeepToRegionsThatAreTheirsAlone() {
        val planners = List(4) { RegionPlanner(RandomWalk(Random(it))) }
        val boats = planners.mapIndexed { i, planner ->
            Boat(grid.center(i), perfect, planner, listOf(RecordingEstimator(grid)), Travel(1, 1.0))
        }
        val fusions = listOf(MapFusion.MEAN_OF_READINGS)
        Fleet(field, boats, fusions, score, RegionSharing(planners, grid, water = null)).run(intArrayOf(40))
        val regions = planners.map { checkNotNull(it.region) }
        for (cell in 0 until grid.size) assertEquals(1, regions.count { it.contains(cell % 6, cell / 6) })
        assertEquals(List(4) { 6 }, regions.map { it.size }, "no bounds: equal shares")
    }

    @Test
    fun aBoatWhoseBudgetIsSpentNeitherMovesNorSamples() {
        val home = grid.center(0)
        val odometer = Odometer()
        val travel = Travel(3, 1.0)
        val cost = BudgetKind.MOVES.cost(travel)
        val planner = BudgetedPlanner(
            Waypoints(grid.center(1), grid.center(2)),
            3.0,
            cost,
            { odometer.moves },
            StraightHome(home),
            home,
        )
        val seen = RecordingEstimator(grid)
        val boat = Boat(home, perfect, planner, listOf(seen), travel, odometer)
        places(boat, 10)
        assertTrue(boat.isDone)
        assertEquals(listOf(0, 1, 0).flatMap { cell -> List(3) { cell } }, seen.records.map { it.cell })
        assertEquals(3.0, odometer.moves, 0.0)
    }

    @Test
    fun travelRefusesNumbersOutOfRange() {
        assertFailsWith<IllegalArgumentException> { Travel(0, 1.0) }
        assertFailsWith<IllegalArgumentException> { Travel(1, 0.0) }
        assertFailsWith<IllegalArgumentException> { Travel(1, 1.0, Double.NaN) }
        assertFailsWith<IllegalArgumentException> { Budget(BudgetKind.TIME, 0.0) }
    }
}
