package stillwater.estimate

import org.junit.jupiter.api.Test
import stillwater.model.BoatTime
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

class BoundedFilterTest {
    private fun filter(
        epsilon: Double = 0.01,
        crossing: CrossingPolicy = CrossingPolicy.PLAIN,
        clearOnEntry: Boolean = true,
        prior: Interval = Interval.UNIT,
    ) = BoundedFilter(
        Grid.unit(2, 1),
        prior,
        BoundedFilterSettings(epsilon, medianWindow = 3, slopeWindow = 3, clearOnEntry, crossing),
    )

    private var seconds = 0.0

    /** One reading a second. */
    private fun BoundedFilter.feed(cell: Int, vararg values: Double) {
        for (value in values) update(BoatTime(seconds++), cell + 0.5, 0.5, value)
    }

    private fun BoundedFilter.assertBelieves(cell: Int, lower: Double, upper: Double, conflicts: Int) {
        // The bounds are readings or the prior's ends: exact. The value is one rounding off its half sum.
        assertEquals(lower, map.lower(cell), 0.0, "lower")
        assertEquals(upper, map.upper(cell), 0.0, "upper")
        assertEquals((lower + upper) / 2, map.value(cell), 1e-16, "value")
        assertEquals(conflicts, map.conflicts(cell), "conflicts")
    }

    @Test
    fun aRiseRaisesTheLowerBoundOnceTheWindowsAreFull() {
        val filter = filter()
        // Three samples make a median, three medians a slope: five samples.
        filter.feed(0, 0.1, 0.2, 0.3, 0.4)
        filter.assertBelieves(0, 0.0, 1.0, conflicts = 0)
        // Medians .2, .3, .4: slope .1 a second. The bound is the raw sample, not the median.
        filter.feed(0, 0.5)
        filter.assertBelieves(0, 0.5, 1.0, conflicts = 0)
        // Median of .4, .5, .55 is .5.
        filter.feed(0, 0.55)
        filter.assertBelieves(0, 0.55, 1.0, conflicts = 0)
    }

    @Test
    fun aFallLowersTheUpperBound() {
        val filter = filter()
        filter.feed(0, 0.9, 0.8, 0.7, 0.6, 0.5)
        filter.assertBelieves(0, 0.0, 0.5, conflicts = 0)
    }

    @Test
    fun theSlopeThatCountsIsThatOfTheMedians() {
        val filter = filter()
        filter.feed(0, 0.1, 0.2, 0.3, 0.4, 0.5)
        // An outlier far below: the samples .4, .5, −.9 fall, their medians .3, .4, .4 rise.
        filter.feed(0, -0.9)
        filter.assertBelieves(0, 0.5, 1.0, conflicts = 0)
    }

    @Test
    fun aWorkedConflictUnderEachPolicy() {
        // Up to .5, then down. Medians: .2 .3 .4 .45 .45 .40 .35; slopes of three: .1, .075, .025, −.025, −.05.
        // The first fall counts at the eighth sample, .35, which is below the lower bound .5.
        val values = doubleArrayOf(0.10, 0.20, 0.30, 0.40, 0.50, 0.45, 0.40)
        for ((policy, lower, conflictsAfterTwo) in listOf(
            Triple(CrossingPolicy.PLAIN, 0.50, 2),
            Triple(CrossingPolicy.SOFT, 0.35, 2),
            Triple(CrossingPolicy.RESET, 0.00, 1),
        )) {
            val filter = filter(crossing = policy)
            filter.feed(0, *values)
            filter.assertBelieves(0, 0.5, 1.0, conflicts = 0)
            filter.feed(0, 0.35)
            filter.assertBelieves(0, lower, 0.35, conflicts = 1)
            // The ninth, .30: under SOFT below the lower bound .35 again, under RESET within [0, .35].
            filter.feed(0, 0.30)
            val second = if (policy == CrossingPolicy.SOFT) 0.30 else lower
            filter.assertBelieves(0, second, 0.30, conflicts = conflictsAfterTwo)
        }
    }

    @Test
    fun theMirrorImageOfTheWorkedConflict() {
        val values = doubleArrayOf(0.90, 0.80, 0.70, 0.60, 0.50, 0.55, 0.60, 0.65)
        for ((policy, upper) in listOf(
            CrossingPolicy.PLAIN to 0.50,
            CrossingPolicy.SOFT to 0.65,
            CrossingPolicy.RESET to 1.00,
        )) {
            val filter = filter(crossing = policy)
            filter.feed(0, *values)
            filter.assertBelieves(0, 0.65, upper, conflicts = 1)
        }
    }

    @Test
    fun aResetBeyondThePriorFollowsTheEvidence() {
        for ((policy, upper, conflicts) in listOf(
            Triple(CrossingPolicy.PLAIN, 1.0, 2),
            Triple(CrossingPolicy.SOFT, 1.3, 2),
            Triple(CrossingPolicy.RESET, 1.3, 2),
        )) {
            val filter = filter(crossing = policy)
            filter.feed(0, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3)
            filter.assertBelieves(0, 1.3, upper, conflicts)
        }
    }

    @Test
    fun aConflictIsCountedOnlyWhenABoundMoves() {
        val filter = filter()
        filter.feed(0, 0.10, 0.20, 0.30, 0.40, 0.50, 0.45, 0.40, 0.35)
        // Rising again below the lower bound: nothing new, no conflict.
        filter.feed(0, 0.36, 0.38, 0.40, 0.42)
        filter.assertBelieves(0, 0.50, 0.35, conflicts = 1)
    }

    @Test
    fun slopesUpToEpsilonDoNotCount() {
        // Quarters: the slope is exactly a quarter a second.
        val values = doubleArrayOf(0.0, 0.25, 0.5, 0.75, 1.0)
        val prior = Interval(-4.0, 4.0)
        for ((epsilon, lower) in listOf(0.25 to -4.0, 0.2499 to 1.0, 0.0 to 1.0)) {
            val filter = filter(epsilon, prior = prior)
            filter.feed(0, *values)
            filter.assertBelieves(0, lower, 4.0, conflicts = 0)
        }
        for ((epsilon, upper) in listOf(0.25 to 4.0, 0.2499 to -1.0)) {
            val filter = filter(epsilon, prior = prior)
            filter.feed(0, *DoubleArray(5) { -values[it] })
            filter.assertBelieves(0, -4.0, upper, conflicts = 0)
        }
    }

    @Test
    fun aConstantSensorTeachesNothingEvenWithoutEpsilon() {
        val filter = filter(epsilon = 0.0)
        filter.feed(0, *DoubleArray(50) { 0.1 })
        filter.assertBelieves(0, 0.0, 1.0, conflicts = 0)
    }

    @Test
    fun epsilonIsPerSecondWhateverTheSamplingRate() {
        // Steps of .01 every 0.1 s are 0.1 a second: above an epsilon of .05, though each step is below it.
        val filter = filter(epsilon = 0.05)
        for (i in 0 until 5) filter.update(BoatTime(0.1 * i), 0.5, 0.5, 0.01 * i)
        filter.assertBelieves(0, 0.04, 1.0, conflicts = 0)
    }

    @Test
    fun equalStampsHaveNoSlope() {
        val filter = filter(epsilon = 0.0)
        for (i in 0 until 10) {
            assertEquals(ReadingUse.USED, filter.update(BoatTime(3.0), 0.5, 0.5, 0.1 * i))
        }
        filter.assertBelieves(0, 0.0, 1.0, conflicts = 0)
    }

    @Test
    fun clearedWindowsWaitInTheNextCell() {
        val filter = filter()
        filter.feed(0, 0.1, 0.2, 0.3, 0.4, 0.5)
        filter.feed(1, 0.6, 0.7, 0.8, 0.9)
        filter.assertBelieves(1, 0.0, 1.0, conflicts = 0)
        filter.feed(1, 0.95)
        filter.assertBelieves(1, 0.95, 1.0, conflicts = 0)
        filter.assertBelieves(0, 0.5, 1.0, conflicts = 0)
        // Coming back clears too.
        filter.feed(0, 0.96, 0.97, 0.98, 0.99)
        filter.assertBelieves(0, 0.5, 1.0, conflicts = 0)
    }

    @Test
    fun unclearedWindowsCarryTheSlopeOverTheBorder() {
        val filter = filter(clearOnEntry = false)
        filter.feed(0, 0.1, 0.2, 0.3, 0.4, 0.5)
        // The first sample in the new cell already falls, yet the medians .3, .4, .45 rise: a bound that may be wrong.
        filter.feed(1, 0.45)
        filter.assertBelieves(1, 0.45, 1.0, conflicts = 0)
        filter.assertBelieves(0, 0.5, 1.0, conflicts = 0)
    }

    @Test
    fun aGapWithoutValuesElsewhereClearsTheWindows() {
        val filter = filter()
        filter.feed(0, 0.1, 0.2, 0.3, 0.4)
        filter.feed(1, Double.NaN)
        filter.feed(0, 0.5)
        filter.assertBelieves(0, 0.0, 1.0, conflicts = 0)
    }

    @Test
    fun windowsOfOneSampleAndTwoMediansAreTheActualChange() {
        val settings = BoundedFilterSettings(epsilon = 0.0, medianWindow = 1, slopeWindow = 2)
        val filter = BoundedFilter(Grid.unit(2, 1), Interval.UNIT, settings)
        filter.feed(0, 0.5, 0.51)
        filter.assertBelieves(0, 0.51, 1.0, conflicts = 0)
    }

    @Test
    fun impossibleSettingsAreRefusedByName() {
        for ((message, make) in listOf<Pair<String, () -> Unit>>(
            "medianWindow (2 samples) must be odd and at least 1" to { BoundedFilterSettings(0.1, medianWindow = 2) },
            "medianWindow (-1 samples) must be odd and at least 1" to { BoundedFilterSettings(0.1, medianWindow = -1) },
            "slopeWindow (1 medians) must be at least 2" to { BoundedFilterSettings(0.1, slopeWindow = 1) },
            "epsilon (-0.1 sensor units/s) must be at least 0 and finite" to { BoundedFilterSettings(-0.1) },
            "epsilon (NaN sensor units/s) must be at least 0 and finite" to { BoundedFilterSettings(Double.NaN) },
            "epsilon (Infinity sensor units/s) must be at least 0 and finite" to {
                BoundedFilterSettings(Double.POSITIVE_INFINITY)
            },
        )) {
            assertEquals(message, assertFailsWith<IllegalArgumentException> { make() }.message)
        }
    }
}
