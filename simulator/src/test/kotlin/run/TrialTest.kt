package stillwater.run

import stillwater.estimate.BoundedFilter
import stillwater.estimate.BoundedFilterSettings
import stillwater.field.CellField
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.plan.Planner
import stillwater.sensor.FirstOrderLag
import stillwater.sensor.SensorModel
import kotlin.math.pow
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

/** One boat in a field of three cells in a row: 0.2, 0.8, 0.4. Cell 1 is a local extreme, and so are 0 and 2. */
class TrialTest {
    private val grid = Grid.unit(3, 1)
    private val field = CellField(grid, doubleArrayOf(0.2, 0.8, 0.4))
    private val perfect = SensorModel { input, _, _ -> input }

    private fun trial(
        planner: Planner,
        vararg estimators: RecordingEstimator,
        sensor: SensorModel = perfect,
        samples: Int = 2,
        period: Double = 1.0,
        truth: CellField = field,
    ) = Trial(truth, sensor, planner, estimators.toList(), samples, period)

    @Test
    fun theFirstMoveIsTheStayInTheStartCellAndWholePlansAreRun() {
        val planner = ScriptedPlanner(grid, listOf(1, 2), listOf(1), listOf(0, 1))
        val seen = RecordingEstimator(grid)
        trial(planner, seen).run(start = 0, checkpoints = intArrayOf(6))
        assertEquals(listOf(0, 0, 1, 1, 2, 2, 1, 1, 0, 0, 1, 1), seen.records.map { it.cell })
        assertEquals(listOf(0, 2, 1), planner.asked.map { it.second }, "asked where each plan ended")
    }

    @Test
    fun timesAscendByThePeriodFromTheFirst() {
        val seen = RecordingEstimator(grid)
        trial(ScriptedPlanner(grid, listOf(1)), seen, samples = 3, period = 0.5).run(0, intArrayOf(2))
        assertEquals(listOf(0.5, 1.0, 1.5, 2.0, 2.5, 3.0), seen.records.map { it.seconds })
    }

    @Test
    fun readingsFollowTheClosedFormOfTheLag() {
        val alpha = 0.25
        val period = 2.0
        val seen = RecordingEstimator(grid)
        val lag = FirstOrderLag(FirstOrderLag.timeConstant(alpha, period), initial = 0.2)
        trial(ScriptedPlanner(grid, listOf(1, 2)), seen, sensor = lag, samples = 4, period = period)
            .run(0, intArrayOf(3))
        // s ← ψ + (s − ψ)(1 − α)ⁿ after n readings in a cell of truth ψ.
        val leftFirst = 0.8 + (0.2 - 0.8) * (1 - alpha).pow(4)
        val expected = List(4) { 0.2 } +
            (1..4).map { 0.8 + (0.2 - 0.8) * (1 - alpha).pow(it) } +
            (1..4).map { 0.4 + (leftFirst - 0.4) * (1 - alpha).pow(it) }
        assertEquals(expected.size, seen.records.size)
        // The rounding of a dozen steps with numbers below 1: 12 · 2⁻⁵³, and as much again for the powers.
        expected.zip(seen.records) { value, record -> assertEquals(value, record.value, 3e-15) }
    }

    @Test
    fun errorsAreTakenAfterTheMoveOfEachCheckpoint() {
        val seen = RecordingEstimator(grid)
        val errors = trial(ScriptedPlanner(grid, listOf(1, 2)), seen).run(0, intArrayOf(1, 2, 3)).single()
        // The map starts at 0.5 everywhere and then has the truth of each cell passed: sums 0.4, 0.1, 0 over 3 cells.
        val expected = listOf((0.3 + 0.1) / 3, 0.1 / 3, 0.0)
        // Rounding of a sum of three numbers below 1.
        expected.zip(errors.mean.toList()) { due, found -> assertEquals(due, found, 1e-15) }
    }

    @Test
    fun onlyErrorsInLocalExtremesCountAsSuch() {
        val four = Grid.unit(4, 1)
        // 0.1 and 0.9 at the ends are extremes, 0.3 and 0.6 between them are not.
        val slope = CellField(four, doubleArrayOf(0.1, 0.3, 0.6, 0.9))
        val seen = RecordingEstimator(four)
        val errors = trial(ScriptedPlanner(four, listOf(1)), seen, truth = slope).run(0, intArrayOf(1, 2)).single()
        // 0.5 is believed where nothing was read: errors 0.2, 0.1, 0.4, of which 0.4 in an extreme; then 0.1 and 0.4.
        assertEquals(0.7 / 4, errors.mean[0], 1e-15, "rounding of a sum")
        assertEquals(0.5 / 4, errors.mean[1], 1e-15, "rounding of a sum")
        assertEquals(0.4 / 4, errors.inExtremes[0], 1e-15, "rounding of a difference")
        assertEquals(0.4 / 4, errors.inExtremes[1], 1e-15, "rounding of a difference")
    }

    @Test
    fun coverageAndWidthAreThoseOfTheVisitedCells() {
        val filter = BoundedFilter(grid, Interval.UNIT, BoundedFilterSettings(0.0, medianWindow = 1, slopeWindow = 2))
        // Says 0.1 too much in the second cell and rises there: its lower bound is wrong.
        var steps = 0
        val above = SensorModel { input, _, _ -> if (++steps <= 2) input else input + 0.1 + 0.001 * steps }
        val errors = Trial(field, above, ScriptedPlanner(grid, listOf(1)), listOf(filter), 2, 1.0)
            .run(0, intArrayOf(1, 2)).single()
        // In the first cell there is no slope and so the prior's bounds.
        assertEquals(listOf(1.0, 0.5), errors.coverage.toList())
        assertEquals(1.0, errors.width[0])
        // Bounds [0, 1] and [0.9.., 1].
        assertEquals((1.0 + 1.0 - filter.map.lower(1)) / 2, errors.width[1], 1e-15, "rounding of a sum")
    }

    @Test
    fun theRunEndsWithTheLastCheckpoint() {
        val seen = RecordingEstimator(grid)
        trial(ScriptedPlanner(grid, listOf(1, 2, 1, 0)), seen).run(0, intArrayOf(1, 3))
        assertEquals(3 * 2, seen.records.size)
    }

    @Test
    fun theBoatStaysForAMoveWhereThereIsNothingToGainAndAsksAgain() {
        val planner = ScriptedPlanner(grid, listOf(), listOf(), listOf(1))
        val seen = RecordingEstimator(grid)
        trial(planner, seen, samples = 1).run(start = 2, checkpoints = intArrayOf(4))
        assertEquals(listOf(2, 2, 2, 1), seen.records.map { it.cell })
        assertEquals(3, planner.asked.size)
    }

    @Test
    fun everyEstimatorSeesTheSameReadingsAndThePlannerTheFirstsMap() {
        val planner = ScriptedPlanner(grid, listOf(1), listOf(2))
        val seen = List(3) { RecordingEstimator(grid) }
        val lag = FirstOrderLag(5.0, initial = 0.2)
        val errors = trial(planner, *seen.toTypedArray(), sensor = lag).run(0, intArrayOf(1, 3))
        fun told(estimator: RecordingEstimator) = estimator.records.map { Triple(it.seconds, it.cell, it.value) }
        assertEquals(told(seen[0]), told(seen[1]))
        assertEquals(told(seen[0]), told(seen[2]))
        assertEquals(listOf(true, true), planner.asked.map { it.first === seen[0].map })
        assertEquals(errors[0].mean.toList(), errors[2].mean.toList())
    }

    @Test
    fun thePlannerIsToldTheLastReading() {
        val planner = ScriptedPlanner(grid, listOf(1), listOf(2))
        val seen = RecordingEstimator(grid)
        trial(planner, seen, sensor = FirstOrderLag(5.0, initial = 0.2)).run(0, intArrayOf(3))
        assertEquals(listOf(seen.records[1].value, seen.records[3].value), planner.asked.map { it.third })
    }

    @Test
    fun aPlannerThatPlansAndSaysItDidNotIsABug() {
        val liar = Planner { map, from, value, stop, plan ->
            ScriptedPlanner(grid, listOf(1)).plan(map, from, value, stop, plan)
            stillwater.plan.PlanOutcome.Stopped
        }
        assertFailsWith<IllegalStateException> { trial(liar, RecordingEstimator(grid)).run(0, intArrayOf(2)) }
    }
}
