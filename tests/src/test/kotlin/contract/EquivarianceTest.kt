package stillwater.contract

import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestFactory
import stillwater.estimate.BoundedFilterSettings
import stillwater.estimate.CrossingPolicy
import stillwater.estimate.FieldEstimator
import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.run.FilterKind
import kotlin.math.abs
import kotlin.math.pow
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** A filter must not care whether oxygen is in mg/l or in percent, or which way the axis points. */
class EquivarianceTest {
    private val grid = Grid.unit(3, 2)

    /** Readings with values that sums and powers of two keep exact, so that no comparison is decided by rounding. */
    private class Readings(random: Random, grid: Grid) {
        val prior = Interval(-4.0 * random.nextInt(1, 4), 2.0 * random.nextInt(1, 8))
        val epsilon = random.nextInt(0, 64) * 2.0.pow(-8)
        val median = 1 + 2 * random.nextInt(3)
        val slope = random.nextInt(2, 6)
        val clear = random.nextBoolean()
        val samples: List<Triple<Double, Int, Double>>

        init {
            var time = if (random.nextBoolean()) 1.6e9 else 0.0
            var cell = 0
            var value = 0.0
            samples = List(150) {
                time += random.nextInt(0, 16) * 2.0.pow(-4)
                if (random.nextInt(12) == 0) cell = random.nextInt(grid.size)
                value = if (random.nextInt(10) == 0) dyadic(random) else value + dyadic(random) / 64
                Triple(time, cell, value)
            }
        }

        private fun dyadic(random: Random) = random.nextInt(-(8 shl 10), 8 shl 10) * 2.0.pow(-10)

        override fun toString() = "$prior, epsilon $epsilon, windows $median $slope, clear $clear, $samples"

        fun settings(policy: CrossingPolicy, scale: Double) =
            BoundedFilterSettings(epsilon * abs(scale), median, slope, clear, policy)

        fun feed(estimator: FieldEstimator, scale: Double, shift: Double) {
            val grid = estimator.map.grid
            for ((time, cell, value) in samples) {
                estimator.update(BoatTime(time), grid.centerX(cell), grid.centerY(cell), scale * value + shift)
            }
        }
    }

    private class Subject(val kind: FilterKind, val policy: CrossingPolicy, val scale: Double, val shift: Double) {
        // The interval filter allows for 64 roundings of a reading of up to 128, magnified up to 2000 times by the
        // shortest step. Means and exponential averages round up to 150 times at magnitude 100.
        // The self-calibrating estimator's two-parameter fits rest on seven nodes of which two lie on one diagonal: the
        // mirrored survey has them on the other, and where the surface is no parabola, as for these readings that are
        // no sensor's, its fit ends near the mirrored one only. The Bayesian map stands on it.
        val valueTolerance = when {
            kind == FilterKind.INTERVAL -> 1e-8
            scale < 0 && (kind == FilterKind.SELF_CALIBRATING || kind == FilterKind.BAYESIAN) -> abs(scale) * MIRRORED
            else -> 1e-11
        }

        // Bounds that are readings are exact.
        val boundTolerance = when (kind) {
            // Sums of squares, weighted by each other: some hundred roundings, magnified by the ratios.
            FilterKind.BOUNDED_EXTENDED -> valueTolerance
            FilterKind.INTERVAL, FilterKind.SELF_CALIBRATING, FilterKind.BAYESIAN -> valueTolerance
            else -> 0.0
        }

        fun run(readings: Readings, grid: Grid, transformed: Boolean): FieldMap {
            val a = if (transformed) scale else 1.0
            val b = if (transformed) shift else 0.0
            val ends = listOf(a * readings.prior.lower + b, a * readings.prior.upper + b).sorted()
            val estimator = kind.estimator(grid, Interval(ends[0], ends[1]), readings.settings(policy, a))
            readings.feed(estimator, a, b)
            return estimator.map
        }
    }

    private val changes = listOf(4.0 to 0.0, 1.0 to 96.0, 0.125 to -3.0, -1.0 to 0.0, -2.0 to 40.0, -0.5 to -7.0)

    @TestFactory
    fun readingsInOtherUnitsGiveTheMapInOtherUnits(): List<DynamicTest> = FilterKind.entries.flatMap { kind ->
        val policies = if (kind == FilterKind.BOUNDED) CrossingPolicy.entries else listOf(CrossingPolicy.PLAIN)
        policies.flatMap { policy ->
            changes.map { (scale, shift) ->
                dynamicTest("${kind.label}, $policy, $scale z + $shift") {
                    val subject = Subject(kind, policy, scale, shift)
                    forEvery(cases = 60, { Readings(it, grid) }) { assertEquivariant(subject, it) }
                }
            }
        }
    }

    private fun assertEquivariant(subject: Subject, readings: Readings) {
        val plain = content(subject.run(readings, grid, transformed = false))
        val changed = content(subject.run(readings, grid, transformed = true))
        val (a, b) = subject.scale to subject.shift
        for ((old, new) in plain.zip(changed)) {
            assertEquals(a * old.value + b, new.value, subject.valueTolerance)
            // A negative scale swaps bounds.
            assertEquals(a * (if (a > 0) old.lower else old.upper) + b, new.lower, subject.boundTolerance)
            assertEquals(a * (if (a > 0) old.upper else old.lower) + b, new.upper, subject.boundTolerance)
            assertEquals(
                listOf(old.visits, old.readings, old.conflicts),
                listOf(new.visits, new.readings, new.conflicts),
            )
        }
    }

    @Test
    fun theReadingsMoveBoundsAndCrossThem() {
        var moved = 0
        var conflicts = 0
        forEvery(cases = 60, { Readings(it, grid) }) { readings ->
            val cells = content(Subject(FilterKind.BOUNDED, CrossingPolicy.PLAIN, 1.0, 0.0).run(readings, grid, false))
            moved += cells.count { it.lower > readings.prior.lower || it.upper < readings.prior.upper }
            conflicts += cells.sumOf { it.conflicts }
        }
        // Or the law would be true of nothing.
        assertTrue(moved > 60 && conflicts > 60, "$moved bounds moved, $conflicts conflicts")
    }

    @TestFactory
    fun averagesStayBetweenThePriorAndTheReadings(): List<DynamicTest> =
        FilterKind.entries.filterNot { it.givesBounds }.map { kind ->
            dynamicTest(kind.label) {
                forEvery(cases = 100, { Readings(it, grid) }) { readings ->
                    val map = Subject(kind, CrossingPolicy.PLAIN, 1.0, 0.0).run(readings, grid, transformed = false)
                    for (cell in 0 until grid.size) {
                        val hull = readings.samples.filter { it.second == cell }.map { it.third } + map.prior.midpoint
                        // Up to 150 roundings at magnitude 10.
                        assertTrue(
                            map.value(cell) in hull.min() - 1e-12..hull.max() + 1e-12,
                            "${map.value(cell)} of $hull",
                        )
                    }
                }
            }
        }

    @TestFactory
    fun averagesComeToAValueThatStays(): List<DynamicTest> = FilterKind.entries.filterNot {
        it.givesBounds
    }.map { kind ->
        dynamicTest(kind.label) {
            val estimator = kind.estimator(grid, Interval.UNIT, BoundedFilterSettings(0.0))
            val random = Random(SEED)
            for (i in 0 until 20_000) {
                val value = if (i < 20) random.nextDouble() else 0.75
                estimator.update(BoatTime(i.toDouble()), 0.5, 0.5, value)
            }
            // Twenty others below 1 in a mean of 20 000 weigh 1e-3; in an exponential average nothing.
            assertEquals(0.75, estimator.map.value(0), 1e-3)
        }
    }

    private companion object {
        /** Sensor units: a hundredth of the readings' spread. */
        const val MIRRORED = 0.1
    }
}
