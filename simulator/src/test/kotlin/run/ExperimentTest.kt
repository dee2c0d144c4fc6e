package stillwater.run

import kotlinx.coroutines.runBlocking
import stillwater.estimate.BoundedFilter
import stillwater.field.CellField
import stillwater.model.Grid
import stillwater.plan.BoundedPlanner
import stillwater.plan.PolygonRrtSettings
import stillwater.world.RandomField
import stillwater.world.Seeds
import stillwater.world.UniformField
import java.util.concurrent.ConcurrentLinkedQueue
import java.util.concurrent.atomic.AtomicInteger
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotEquals
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

class ExperimentTest {
    private fun ExperimentResult.table() =
        curves.associate { Triple(it.field, it.planner, it.filter) to it.summaries }

    @Test
    fun theNumberOfThreadsDoesNotChangeTheResult() {
        for (threads in listOf(2, 5)) {
            val together = run(settings, threads)
            assertEquals(alone.table(), together.table(), "$threads threads")
            assertEquals(alone.extremeCells, together.extremeCells)
        }
    }

    @Test
    fun anotherSeedGivesAnotherResult() {
        assertNotEquals(alone.table(), run(settings.copy(seed = 2)).table())
    }

    @Test
    fun curvesComeByFieldPlannerAndFilterInTheOrderAskedFor() {
        val asked = settings.copy(
            filters = listOf(FilterKind.EXPONENTIAL, FilterKind.BOUNDED),
            planners = listOf(PlannerKind.LAWNMOWER, PlannerKind.BOUNDED),
        )
        val expected = listOf("uniform", "gaussian").flatMap { field ->
            asked.planners.flatMap { planner -> asked.filters.map { Triple(field, planner, it) } }
        }
        assertEquals(expected, run(asked).curves.map { Triple(it.field, it.planner, it.filter) })
    }

    @Test
    fun aCombinationsCurveDoesNotDependOnWhatElseIsRun() {
        val few = settings.copy(environments = 2)
        val all = run(few).table()
        for (planner in PlannerKind.entries) {
            for (filter in FilterKind.entries) {
                val one = run(
                    few.copy(
                        fields = mapOf("gaussian" to few.fields.getValue("gaussian")),
                        planners = listOf(planner),
                        filters = listOf(filter),
                    ),
                ).table()
                assertEquals(all.filterKeys { it == Triple("gaussian", planner, filter) }, one)
            }
        }
    }

    @Test
    fun moreBoatsLeaveTheCurveOfOneAsItWas() {
        val few = settings.copy(filters = listOf(FilterKind.BOUNDED, FilterKind.AVERAGING), environments = 2)
        val one = run(few).curves.map { it.summaries }
        val fleets = run(few.copy(boats = listOf(3, 1)))
        assertEquals(one, fleets.curves.filter { it.boats == 1 }.map { it.summaries })
        assertNotEquals(one, fleets.curves.filter { it.boats == 3 }.map { it.summaries })
    }

    @Test
    fun moreEnvironmentsLeaveTheFirstOnesAsTheyWere() {
        val fields = ConcurrentLinkedQueue<CellField>()
        val kind = RandomField { grid, random -> UniformField.draw(grid, random).also { fields += it } }
        fun drawn(environments: Int): List<Double> {
            fields.clear()
            run(short.copy(fields = mapOf("uniform" to kind), environments = environments))
            return fields.take(environments).map { it.truth(0) }
        }
        assertEquals(drawn(2), drawn(3).take(2))
    }

    @Test
    fun allCombinationsMeetTheSameFields() {
        val fields = ConcurrentLinkedQueue<List<Double>>()
        val kind = RandomField { grid, random ->
            UniformField.draw(grid, random).also { field -> fields += List(grid.size) { field.truth(it) } }
        }
        for (planner in PlannerKind.entries) {
            run(short.copy(fields = mapOf("uniform" to kind), planners = listOf(planner)))
        }
        assertEquals(settings.environments, fields.toSet().size)
    }

    @Test
    fun averagingWithTheBoundedPlannerIsReadAlongTheBoundedFiltersPath() {
        val one = settings.copy(
            fields = mapOf("uniform" to UniformField),
            filters = listOf(FilterKind.AVERAGING),
            planners = listOf(PlannerKind.BOUNDED),
            environments = 1,
        )
        val found = run(one).curves.single().summaries.map { it.mean }
        // The same by hand: a bounded filter leads, the averaging filter reads along.
        val seeds = Seeds(one.seed)
        val field = UniformField.draw(one.grid, seeds.random("field uniform", 0))
        val start = seeds.random("start uniform", 0).nextInt(one.grid.size)
        val trial = Trial(
            field,
            one.sensor.build(field.truth(start), seeds.random("noise uniform bounded bounded", 0)),
            BoundedPlanner(seeds.random("planner uniform bounded bounded", 0), one.plannerSettings.bounded),
            listOf(
                BoundedFilter(one.grid, one.prior, one.boundedFilter),
                FilterKind.AVERAGING.estimator(one.grid, one.prior, one.boundedFilter),
            ),
            one.samplesPerMove,
            one.period,
        )
        assertEquals(trial.run(start, one.checkpoints.toIntArray())[1].mean.toList(), found)
    }

    @Test
    fun theLawnmowerStartsInTheFirstCellTheOthersInTheSameRandomOne() {
        // After one move only the start cell is known, to a perfect sensor; what is left tells which it was.
        val perfect = settings.copy(
            fields = mapOf("uniform" to UniformField),
            filters = listOf(FilterKind.AVERAGING),
            sensor = settings.sensor.copy(stages = emptyList()),
            environments = 1,
            moves = 1,
            checkpoints = listOf(1),
        )
        val field = UniformField.draw(perfect.grid, Seeds(perfect.seed).random("field uniform", 0))
        val all = (0 until field.grid.size).map { kotlin.math.abs(0.5 - field.truth(it)) }
        val left = run(perfect).curves.associate { it.planner to it.summaries.single().mean * field.grid.size }
        // Rounding of a sum of 16 numbers below 1.
        assertEquals(all.sum() - all[0], left.getValue(PlannerKind.LAWNMOWER), 1e-14)
        assertEquals(left[PlannerKind.RANDOM_WALK], left[PlannerKind.BOUNDED])
        val start = all.indices.minBy { kotlin.math.abs(all.sum() - all[it] - left.getValue(PlannerKind.BOUNDED)) }
        assertNotEquals(0, start, "a random start, with this seed not the first cell")
    }

    @Test
    fun everyPieceOfWorkIsReportedOnce() {
        val done = AtomicInteger()
        val experiment = Experiment(short)
        runBlocking { experiment.run(2) { done.incrementAndGet() } }
        assertEquals(2 * settings.environments, experiment.size)
        assertEquals(experiment.size, done.get())
    }

    @Test
    fun theShareOfExtremeCellsIsTheFields() {
        val fixed = RandomField { grid, _ -> CellField(grid, DoubleArray(grid.size) { (it % 2).toDouble() }) }
        val stripes = settings.copy(
            fields = mapOf("stripes" to fixed),
            grid = Grid.unit(4, 1),
            planners = listOf(PlannerKind.RANDOM_WALK),
        )
        assertEquals(mapOf("stripes" to 1.0), run(stripes).extremeCells)
    }

    @Test
    fun aCombinationThatWasNotRunHasNoCurve() {
        val result = run(settings.copy(planners = listOf(PlannerKind.RANDOM_WALK)))
        assertNotNull(result.curve("uniform", PlannerKind.RANDOM_WALK, FilterKind.BOUNDED))
        assertNull(result.curve("uniform", PlannerKind.BOUNDED, FilterKind.BOUNDED))
        assertNull(result.curve("lake", PlannerKind.RANDOM_WALK, FilterKind.BOUNDED))
    }

    @Test
    fun errorsFallFromTheFirstMoveToTheLast() {
        for (curve in alone.curves) {
            val (first, _, last) = curve.summaries.map { it.mean }
            assertTrue(last < first, "${curve.field} ${curve.planner} ${curve.filter}: $first, $last")
        }
    }

    private companion object {
        /** Small, and with noise, so that a stream that is not a combination's own would show. */
        val settings = Preset.NOISY.settings().copy(
            filters = FilterKind.entries,
            planners = PlannerKind.entries,
            plannerSettings = PlannerSettings(polygonRrt = PolygonRrtSettings(iterations = 20)),
            grid = Grid.unit(4, 4),
            environments = 5,
            moves = 60,
            checkpoints = listOf(1, 20, 60),
        )

        /** Where it matters only which work is done. */
        val short = settings.copy(filters = listOf(FilterKind.AVERAGING), moves = 1, checkpoints = listOf(1))

        /** What they come to on one thread. */
        val alone by lazy { run(settings) }

        fun run(settings: ExperimentSettings, threads: Int = 1): ExperimentResult =
            runBlocking { Experiment(settings).run(threads) }
    }
}
