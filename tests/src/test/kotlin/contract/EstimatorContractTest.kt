package stillwater.contract

import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.TestFactory
import stillwater.estimate.BoundedFilterSettings
import stillwater.estimate.CrossingPolicy
import stillwater.estimate.FieldEstimator
import stillwater.estimate.ReadingUse
import stillwater.model.BoatTime
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Position
import stillwater.run.FilterKind
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertSame
import kotlin.test.assertTrue

/** What every estimator must do whatever the readings, run on every [FilterKind] with every policy. */
class EstimatorContractTest {
    private class Subject(val name: String, val kind: FilterKind, val settings: BoundedFilterSettings) {
        fun build(grid: Grid, prior: Interval): FieldEstimator = kind.estimator(grid, prior, settings)

        /** What is learned of the sensor changes the values of all cells, and none of their counts. */
        fun assertUntouched(before: CellContent, after: CellContent, sample: Sample) {
            val learns = kind == FilterKind.SELF_CALIBRATING || kind == FilterKind.BOUNDED_EXTENDED
            val learned = kind.seesUnvisited || (learns && before.readings > 0)
            val expected = if (learned) {
                before.copy(value = after.value, lower = after.lower, upper = after.upper)
            } else {
                before
            }
            assertEquals(expected, after, "$sample")
        }
    }

    private val subjects = FilterKind.entries.flatMap { kind ->
        CrossingPolicy.entries.flatMap { policy ->
            listOf(true, false).map { clear ->
                Subject(
                    "${kind.label}, $policy, ${if (clear) "cleared" else "not cleared"}",
                    kind,
                    BoundedFilterSettings(epsilon = 0.0, medianWindow = 1, slopeWindow = 2, clear, policy),
                )
            }
        }
    }

    private fun forEveryEstimator(cases: Int, law: (FieldEstimator, Stream, Subject) -> Unit): List<DynamicTest> =
        subjects.map { subject ->
            dynamicTest(subject.name) {
                forEvery(cases, ::Stream) { law(subject.build(it.grid, it.prior), it, subject) }
            }
        }

    private class Sample(val time: Double, val x: Double, val y: Double, val value: Double) {
        val finite get() = time.isFinite() && x.isFinite() && y.isFinite() && value.isFinite()

        override fun toString() = "($time $x $y $value)"
    }

    /** Readings of every sort: steady runs in one cell, jumps, off the grid, not finite, huge, back in time. */
    private class Stream(random: Random) {
        val grid = Grid(
            Position(random.between(-50.0, 50.0), random.between(-50.0, 50.0)),
            columns = random.nextInt(1, 5),
            rows = random.nextInt(1, 5),
            cellWidth = random.between(0.5, 3.0),
            cellHeight = random.between(0.5, 3.0),
            rotation = random.between(-4.0, 4.0),
        )
        val prior = Interval(random.between(-3.0, 0.0), random.between(0.0, 3.0))
        val samples: List<Sample>

        init {
            var time = if (random.nextBoolean()) 1.6e9 else 0.0
            var cell = 0
            samples = List(random.nextInt(1, 150)) {
                if (random.nextInt(6) == 0) cell = random.nextInt(grid.size)
                if (random.nextInt(5) > 0) time += random.nextDouble()
                val x = grid.centerX(cell)
                val y = grid.centerY(cell)
                when (random.nextInt(20)) {
                    0 -> Sample(random.hostile(time - 5, time), x, y, 0.5)
                    1 -> Sample(time, random.hostile(x - 20, x + 20), y, 0.5)
                    2 -> Sample(time, x, random.hostile(y - 20, y + 20), 0.5)
                    in 3..5 -> Sample(time, x, y, random.hostile(-5.0, 5.0))
                    else -> Sample(time, x, y, random.between(-4.0, 4.0))
                }
            }
        }

        override fun toString() = "$grid, $prior, $samples"
    }

    private fun FieldEstimator.take(sample: Sample) = update(BoatTime(sample.time), sample.x, sample.y, sample.value)

    @TestFactory
    fun keepsOneMapForLife() = forEveryEstimator(cases = 20) { estimator, stream, _ ->
        val map = estimator.map
        for (sample in stream.samples) {
            estimator.take(sample)
            assertSame(map, estimator.map)
        }
        assertSame(stream.grid, map.grid)
        assertSame(stream.prior, map.prior)
    }

    @TestFactory
    fun saysWhatItDidWithAReadingAndCountsIt() = forEveryEstimator(cases = 100) { estimator, stream, _ ->
        val uses = HashMap<ReadingUse, Int>()
        var latest = Double.NEGATIVE_INFINITY
        for (sample in stream.samples) {
            // The contract, spelled out once more.
            val expected = when {
                !sample.finite -> ReadingUse.NOT_FINITE
                sample.time < latest -> ReadingUse.OUT_OF_ORDER
                stream.grid.cellAt(sample.x, sample.y) == Grid.OUTSIDE -> ReadingUse.OUTSIDE
                else -> ReadingUse.USED
            }
            if (expected == ReadingUse.USED || expected == ReadingUse.OUTSIDE) latest = sample.time
            assertEquals(expected, estimator.take(sample), "$sample")
            uses.merge(expected, 1, Int::plus)
        }
        val map = estimator.map
        fun count(use: ReadingUse) = uses[use] ?: 0
        assertEquals(count(ReadingUse.OUTSIDE).toLong(), map.outside)
        assertEquals((count(ReadingUse.NOT_FINITE) + count(ReadingUse.OUT_OF_ORDER)).toLong(), map.rejected)
        val readings = (0 until stream.grid.size).sumOf { map.readings(it) }
        assertEquals(count(ReadingUse.USED), readings)
        assertEquals(stream.samples.size.toLong(), readings + map.outside + map.rejected)
    }

    @TestFactory
    fun aReadingChangesItsOwnCellOnly() = forEveryEstimator(cases = 60) { estimator, stream, subject ->
        for (sample in stream.samples) {
            val before = content(estimator.map)
            val use = estimator.take(sample)
            val after = content(estimator.map)
            val own = if (use == ReadingUse.USED) stream.grid.cellAt(sample.x, sample.y) else Grid.OUTSIDE
            for (cell in after.indices) if (cell != own) subject.assertUntouched(before[cell], after[cell], sample)
            if (own != Grid.OUTSIDE) assertCountsGrow(before[own], after[own])
        }
    }

    private fun assertCountsGrow(before: CellContent, after: CellContent) {
        assertEquals(before.readings + 1, after.readings)
        assertTrue(after.visits - before.visits in 0..1, "$before to $after")
        assertTrue(after.conflicts - before.conflicts in 0..1, "$before to $after")
        assertTrue(after.visits in 1..after.readings, "$after")
        assertTrue(after.conflicts <= after.readings, "$after")
    }

    @TestFactory
    fun aCellNeverVisitedKeepsThePrior() = forEveryEstimator(cases = 60) { estimator, stream, subject ->
        for (sample in stream.samples) estimator.take(sample)
        for (cell in 0 until stream.grid.size) {
            if (estimator.map.readings(cell) > 0) continue
            val prior = stream.prior
            val untouched = CellContent(prior.midpoint, prior.lower, prior.upper, 0, 0, 0)
            val found = content(estimator.map)[cell]
            if (subject.kind.seesUnvisited) {
                // Of a cell never visited it says what the cells around do.
                assertEquals(untouched, found.copy(value = prior.midpoint, lower = prior.lower, upper = prior.upper))
                assertTrue(found.value in found.lower..found.upper, "$found")
            } else {
                assertEquals(untouched, found)
            }
        }
    }

    @TestFactory
    fun whatItBelievesIsANumber() = forEveryEstimator(cases = 100) { estimator, stream, _ ->
        for (sample in stream.samples) {
            estimator.take(sample)
            for (cell in content(estimator.map)) {
                assertTrue(
                    cell.value.isFinite() && cell.lower.isFinite() && cell.upper.isFinite(),
                    "$cell after $sample",
                )
            }
        }
    }

    @TestFactory
    fun theSameReadingsGiveTheSameMap() = forEveryEstimator(cases = 60) { estimator, stream, subject ->
        val other = subject.build(stream.grid, stream.prior)
        for (sample in stream.samples) estimator.take(sample)
        for (sample in stream.samples) other.take(sample)
        assertEquals(content(estimator.map), content(other.map))
    }

    @TestFactory
    fun whatCannotBeUsedLeavesNoTraceButItsCount() = forEveryEstimator(cases = 60) { estimator, stream, subject ->
        val clean = subject.build(stream.grid, stream.prior)
        var started = false
        for (sample in stream.samples) {
            // An old reading and one without a place, between any two: neither is taken, nor tells where the boat is.
            if (started) clean.update(BoatTime(-1e9), stream.grid.origin.x, stream.grid.origin.y, 9.0)
            clean.update(BoatTime(1.0), Double.NaN, 0.0, 9.0)
            clean.take(sample)
            val use = estimator.take(sample)
            if (use == ReadingUse.USED || use == ReadingUse.OUTSIDE) started = true
        }
        assertEquals(content(estimator.map), content(clean.map))
    }
}
