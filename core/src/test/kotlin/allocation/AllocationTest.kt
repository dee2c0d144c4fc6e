package stillwater.allocation

import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestFactory
import stillwater.estimate.AveragingFilter
import stillwater.estimate.BayesianMap
import stillwater.estimate.BoundedExtendedFilter
import stillwater.estimate.BoundedFilter
import stillwater.estimate.BoundedFilterSettings
import stillwater.estimate.CrossingPolicy
import stillwater.estimate.ExponentialFilter
import stillwater.estimate.FieldEstimator
import stillwater.estimate.IntervalFilter
import stillwater.estimate.IntervalFilterSettings
import stillwater.estimate.MapFusion
import stillwater.estimate.SelfCalibratingEstimator
import stillwater.field.FieldMap
import stillwater.field.SpatialCorrelation
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.model.WaterArea
import stillwater.plan.BoundedExtendedPlanner
import stillwater.plan.BoundedExtendedPlannerSettings
import stillwater.plan.BoundedPlanner
import stillwater.plan.BoundedPlannerSettings
import stillwater.plan.BudgetedPlanner
import stillwater.plan.CellsHome
import stillwater.plan.Execution
import stillwater.plan.GridRegion
import stillwater.plan.InformationPlanner
import stillwater.plan.InformationPlannerSettings
import stillwater.plan.Lawnmower
import stillwater.plan.LawnmowerPattern
import stillwater.plan.PathChoice
import stillwater.plan.Planner
import stillwater.plan.PolygonRrt
import stillwater.plan.PolygonRrtSettings
import stillwater.plan.RandomWalk
import stillwater.plan.RegionPlanner
import stillwater.plan.StopCondition
import stillwater.plan.TravelCost
import stillwater.plan.WalkSteps
import stillwater.plan.WaterHome
import stillwater.plan.WaterRoutes
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.random.Random
import kotlin.test.assertTrue

/** Rule 3 of the design: hot loops allocate nothing. */
class AllocationTest {
    private val grid = Grid(Position(-3.0, 7.0), columns = 10, rows = 10, cellWidth = 2.0, rotation = 0.3)
    private var sink = 0.0

    @Test
    fun theMeterSeesASingleObjectPerCall() {
        var kept: Any? = null
        val bytes = AllocationMeter.bytes { kept = Position(it.toDouble(), 0.0) }
        assertTrue(kept is Position)
        // The smallest object of the JVM has 16 bytes.
        assertTrue(bytes >= 16L * AllocationMeter.CALLS, "$bytes bytes")
    }

    @Test
    fun theMeterSeesOneObjectInAHundredCalls() {
        var kept: Any? = null
        val bytes = AllocationMeter.bytes { if (it % 100 == 0) kept = Position(0.0, 0.0) }
        assertTrue(kept is Position)
        assertTrue(bytes >= 16L * AllocationMeter.CALLS / 100, "$bytes bytes")
    }

    @TestFactory
    fun sensorStep(): List<DynamicTest> {
        val stages = listOf(
            SensorStage.Lag(9.5),
            SensorStage.Slew(0.01),
            SensorStage.LimitedLag(9.5, 0.01),
            SensorStage.Noise(0.002),
            SensorStage.Quantum(0.005),
            SensorStage.Asymmetric(7.0, 13.0),
            SensorStage.Delay(2.5),
            SensorStage.TwoPath(2.0, 40.0, 0.3),
            SensorStage.Combined(9.5, 1.0, 0.5, 20.0, 0.03, 1.3, 4.0, 0.2),
            SensorStage.FlowLag(9.5, 1.0, 0.5),
            SensorStage.TemperatureLag(9.5, 20.0, 0.03),
            SensorStage.Calibration(1.1, 0.4),
            SensorStage.Cross("salinity", 30.0, 0.2),
            SensorStage.Drifting(1e-3),
            SensorStage.Jumps(listOf(3.0, 40.0), listOf(0.5, 0.2)),
            SensorStage.Backlash(0.2),
            SensorStage.Range(-1.0, 2.0),
            SensorStage.Outlying(0.1, 1.0),
        )
        val sensors = stages.map { it.toString() to it.build(0.5, Random(1)) } +
            ("the chain of all" to SensorSpec("all", stages).build(0.5, Random(1)))
        return sensors.map { (name, sensor) ->
            dynamicTest(name) {
                AllocationMeter.assertNone(name) {
                    val input = if (it % 50 == 49) Double.NaN else 0.001 * it
                    sink += sensor.step(input, 0.1 + 0.01 * (it % 3), Conditions.NONE)
                }
            }
        }
    }

    @TestFactory
    fun filterUpdate(): List<DynamicTest> {
        val settings = BoundedFilterSettings(epsilon = 1e-4, medianWindow = 5, slopeWindow = 7)
        val filters = listOf<Pair<String, FieldEstimator>>(
            "averaging" to AveragingFilter(grid, Interval.UNIT),
            "exponential" to ExponentialFilter(grid, Interval.UNIT),
            "interval" to IntervalFilter(grid, Interval.UNIT, IntervalFilterSettings(30.0, 0.01)),
            "bayesian" to BayesianMap(grid, Interval.UNIT),
            "self-calibrating" to SelfCalibratingEstimator(grid, Interval.UNIT),
            "bounded-extended" to BoundedExtendedFilter(grid, Interval.UNIT),
            "bounded, uncleared" to BoundedFilter(grid, Interval.UNIT, settings.copy(clearOnEntry = false)),
        ) + CrossingPolicy.entries.map {
            "bounded, $it" to BoundedFilter(grid, Interval.UNIT, settings.copy(crossing = it))
        }
        return filters.map { (name, filter) ->
            dynamicTest(name) {
                var seconds = 0.0
                val call = Call {
                    val cell = it / 20 % grid.size
                    seconds += 0.1
                    // In order and not, inside and outside, values and none, rising and falling.
                    val time = if (it % 97 == 0) seconds - 50 else seconds
                    val x = if (it % 89 == 0) 1e6 else grid.centerX(cell)
                    val value = if (it % 83 == 0) Double.NaN else 0.5 + 0.4 * kotlin.math.sin(it * 0.03)
                    filter.update(BoatTime(time), x, grid.centerY(cell), value, Conditions.NONE)
                }
                // A filter that keeps its first readings works otherwise when it has no room for more.
                repeat(3000, call::run)
                AllocationMeter.assertNone(name, call)
                // The calls did something.
                assertTrue((0 until grid.size).sumOf { filter.map.readings(it) } > AllocationMeter.CALLS)
                assertTrue(filter.map.outside > 0 && filter.map.rejected > 0)
            }
        }
    }

    @TestFactory
    fun filterUpdateAll(): List<DynamicTest> {
        val filters = listOf<Pair<String, FieldEstimator>>(
            "averaging" to AveragingFilter(grid, Interval.UNIT),
            "bounded" to BoundedFilter(grid, Interval.UNIT, BoundedFilterSettings(epsilon = 1e-4)),
        )
        return filters.map { (name, filter) ->
            dynamicTest(name) {
                val times = DoubleArray(10)
                val values = DoubleArray(10)
                var seconds = 0.0
                AllocationMeter.assertNone(name) {
                    for (i in times.indices) {
                        times[i] = seconds++
                        values[i] = kotlin.math.sin(0.1 * i * it)
                    }
                    filter.updateAll(times, grid.centerX(it % grid.size), grid.centerY(it % grid.size), values, 10)
                }
                assertTrue(filter.map.readings(0) > 0 && filter.map.rejected == 0L)
            }
        }
    }

    @Test
    fun bayesianMapBroughtUpToDate() {
        // More cells than are done at once, so that blocks are chosen and data gathered.
        val large = Grid.unit(20, 20)
        val estimator = BayesianMap(large, Interval.UNIT)
        var readings = 0
        AllocationMeter.assertNone("a reading and the map") {
            val cell = readings / 5 % large.size
            val value = 0.5 + 0.4 * kotlin.math.sin(0.1 * cell)
            estimator.update(BoatTime(1.0 * readings++), large.centerX(cell), large.centerY(cell), value)
            sink += estimator.map.value(cell)
        }
        assertTrue(estimator.map.readings(0) > 0)
    }

    @TestFactory
    fun plannerDecision(): List<DynamicTest> {
        val bounded = Execution.entries.flatMap { execution ->
            PathChoice.entries.map { choice ->
                val settings =
                    BoundedPlannerSettings(horizon = 6, expansions = 40, execution = execution, choice = choice)
                "$settings" to BoundedPlanner(Random(1), settings)
            }
        }
        val planners = WalkSteps.entries.map { "walk, $it" to RandomWalk(Random(1), it) } +
            LawnmowerPattern.entries.map { "lawnmower, $it" to Lawnmower(it) } + bounded
        val water = WaterArea(grid.outline(), listOf(listOf(grid.center(44), grid.center(45), grid.center(55))))
        val rrt = PolygonRrtSettings(iterations = 20)
        val home = grid.center(0)
        val decorated = listOf<Pair<String, Planner>>(
            "information" to InformationPlanner(Random(1)),
            "information, far" to InformationPlanner(Random(1), InformationPlannerSettings(horizon = 2, moves = 9)),
            "polygon-rrt" to PolygonRrt(Random(1), null, rrt),
            "polygon-rrt over water" to PolygonRrt(Random(1), water, rrt),
            "budgeted" to BudgetedPlanner(
                RandomWalk(Random(1)),
                1e9,
                TravelCost(1.0, 0.0),
                { 0.0 },
                CellsHome(grid, 0),
                home,
            ),
            "budgeted, home through the water" to BudgetedPlanner(
                PolygonRrt(Random(1), water, rrt),
                1e9,
                TravelCost(1.0, 0.0),
                { 0.0 },
                WaterHome(WaterRoutes(water, 0.0, 1.0), grid.center(0)),
                home,
            ),
            "bounded-extended" to BoundedExtendedPlanner(Random(1), BoundedExtendedPlannerSettings(6, 40)),
            "in a region" to RegionPlanner(RandomWalk(Random(1))).apply { region = GridRegion(2, 3, 5, 4) },
        )
        return (planners + decorated).map { (name, planner) ->
            dynamicTest(name) { assertDecisionsAllocateNothing(name, planner) }
        }
    }

    private fun Grid.outline() =
        listOf(corners(0)[0], corners(columns - 1)[1], corners(size - 1)[2], corners(size - columns)[3])

    @TestFactory
    fun fusion(): List<DynamicTest> {
        val random = Random(4)
        val maps = Array(3) { FieldMap(grid, Interval.UNIT) }
        for (map in maps) {
            for (cell in 0 until grid.size) {
                map.setBounds(cell, 0.4 * random.nextDouble(), 0.6 + 0.4 * random.nextDouble())
                repeat(cell % 3) { map.countReading(cell) }
            }
        }
        val into = FieldMap(grid, Interval.UNIT)
        return listOf(MapFusion.INTERSECTION, MapFusion.INVERSE_VARIANCE, MapFusion.MEAN_OF_READINGS)
            .mapIndexed { index, fusion ->
                dynamicTest("fusion $index") { AllocationMeter.assertNone("fusion") { fusion.fuse(maps, into) } }
            }
    }

    private fun assertDecisionsAllocateNothing(name: String, planner: Planner) {
        val map = FieldMap(grid, Interval.UNIT)
        val random = Random(2)
        map.correlation = SpatialCorrelation { columns, rows -> 1.0 / (1 + columns * columns + rows * rows) }
        for (cell in 0 until grid.size) map.setBounds(cell, 0.4 * random.nextDouble(), 0.6 + 0.4 * random.nextDouble())
        // The caller's positions: a boat has one anyway.
        val centers = List(grid.size) { grid.center(it) }
        val plan = Plan()
        var at = 0
        var moves = 0L
        AllocationMeter.assertNone(name) {
            planner.plan(map, centers[at], 0.5, StopCondition.NEVER, plan)
            moves += plan.size
            at = grid.cellAt(plan.x(plan.size - 1), plan.y(plan.size - 1))
        }
        assertTrue(moves >= AllocationMeter.ROUNDS * AllocationMeter.CALLS, "$moves moves")
    }
}
