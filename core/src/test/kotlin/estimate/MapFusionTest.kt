package stillwater.estimate

import org.junit.jupiter.api.Test
import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.property.drawn
import stillwater.property.forEvery
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class MapFusionTest {
    private val grid = Grid.unit(4, 3)
    private val into = FieldMap(grid, Interval.UNIT)

    private fun map(cell: Int, value: Double, lower: Double, upper: Double, readings: Int) =
        FieldMap(grid, Interval.UNIT).apply {
            setValue(cell, value)
            setBounds(cell, lower, upper)
            repeat(readings) { countReading(cell) }
        }

    @Test
    fun certainBoundsAreIntersected() {
        val maps = arrayOf(map(5, 0.4, 0.2, 0.6, 3), map(5, 0.6, 0.3, 0.9, 4))
        MapFusion.INTERSECTION.fuse(maps, into)
        assertEquals(0.3, into.lower(5), 0.0)
        assertEquals(0.6, into.upper(5), 0.0)
        assertEquals(0.45, into.value(5), 1e-15, "rounding of a midpoint")
        assertEquals(7, into.readings(5))
        assertEquals(0.5, into.value(0), 0.0)
    }

    /** Two boats whose readings alternate in time know together what one boat with all of them would. */
    @Test
    fun intersectionIsWhatOneFilterOfBothBoatsReadingsWouldHave() = forEvery(drawn { it.nextInt() }) { seed ->
        val random = Random(seed)
        val settings = BoundedFilterSettings(epsilon = 1e-3)
        val one = BoundedFilter(grid, Interval.UNIT, settings)
        val other = BoundedFilter(grid, Interval.UNIT, settings)
        val both = BoundedFilter(grid, Interval.UNIT, settings)
        var seconds = 0.0
        repeat(60) {
            val own = if (random.nextBoolean()) one else other
            val cell = random.nextInt(grid.size)
            // Away first, so that each visit starts with clear windows in either filter.
            for (filter in listOf(own, both)) filter.update(BoatTime(seconds), -1.0, -1.0, 0.5)
            var value = random.nextDouble()
            val slope = 0.1 * (random.nextDouble() - 0.5)
            repeat(12) {
                seconds += 1.0
                value += slope
                for (filter in listOf(own, both)) {
                    filter.update(BoatTime(seconds), grid.centerX(cell), grid.centerY(cell), value)
                }
            }
        }
        MapFusion.INTERSECTION.fuse(arrayOf(one.map, other.map), into)
        for (cell in 0 until grid.size) {
            assertEquals(both.map.lower(cell), into.lower(cell), 0.0, "cell $cell")
            assertEquals(both.map.upper(cell), into.upper(cell), 0.0, "cell $cell")
            assertEquals(both.map.readings(cell), into.readings(cell), "cell $cell")
        }
    }

    @Test
    fun credibleIntervalsArePooledByInverseVariance() {
        val maps = arrayOf(map(2, 0.50, 0.40, 0.60, 5), map(2, 0.56, 0.54, 0.58, 5), map(3, 0.1, 0.05, 0.15, 5))
        MapFusion.INVERSE_VARIANCE.fuse(maps, into)
        // Weights 1/0.1² = 100 and 1/0.02² = 2500.
        assertEquals((100 * 0.50 + 2500 * 0.56) / 2600, into.value(2), 1e-15, "rounding")
        assertEquals(2 / sqrt(2600.0), into.upper(2) - into.lower(2), 1e-15, "rounding")
        assertEquals(0.1, into.value(3), 1e-15, "one boat's, rounded")
        assertEquals(0.05, into.lower(3), 1e-15, "one boat's, rounded")
        assertEquals(Interval.UNIT.midpoint, into.value(0), 0.0)
    }

    @Test
    fun anIntervalThatIsNoneDoesNotMakeAnotherNarrower() {
        // A boat that nothing told about the cell gives the prior's bounds.
        MapFusion.INVERSE_VARIANCE.fuse(arrayOf(map(1, 0.2, 0.0, 1.0, 9), map(1, 0.7, 0.6, 0.8, 3)), into)
        assertEquals(0.7, into.value(1), 1e-15, "rounding")
        assertEquals(0.2, into.upper(1) - into.lower(1), 1e-15, "rounding")
        MapFusion.INVERSE_VARIANCE.fuse(arrayOf(map(1, 0.2, 0.0, 1.0, 9), map(1, 0.6, 0.0, 1.0, 3)), into)
        assertEquals(0.3, into.value(1), 1e-15, "by readings; rounding")
        assertEquals(1.0, into.upper(1) - into.lower(1), 0.0)
    }

    @Test
    fun pooledIntervalsCoverWhatTheyShould() {
        // Three boats with independent normal errors: 95 % intervals of the pooled mean cover 95 %.
        val random = java.util.Random(6)
        var covered = 0
        val trials = 4000
        repeat(trials) {
            val maps = Array(3) { boat ->
                val sigma = 0.01 * (boat + 1)
                val value = 0.5 + sigma * random.nextGaussian()
                map(0, value, value - 1.96 * sigma, value + 1.96 * sigma, 1)
            }
            MapFusion.INVERSE_VARIANCE.fuse(maps, into)
            if (0.5 in into.lower(0)..into.upper(0)) covered++
        }
        // Standard deviation of the share: sqrt(0.95 · 0.05 / 4000) = 0.0034; four of them.
        assertEquals(0.95, covered.toDouble() / trials, 0.014)
    }

    @Test
    fun meansAreWeightedByReadings() {
        MapFusion.MEAN_OF_READINGS.fuse(arrayOf(map(7, 0.2, 0.0, 1.0, 1), map(7, 0.8, 0.0, 1.0, 3)), into)
        assertEquals(0.65, into.value(7), 1e-15, "rounding")
        assertEquals(0.5, into.value(6), 0.0)
        assertTrue(into.lower(7) == 0.0 && into.upper(7) == 1.0)
    }
}
