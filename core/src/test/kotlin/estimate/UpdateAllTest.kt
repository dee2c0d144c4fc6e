package stillwater.estimate

import org.junit.jupiter.api.Test
import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.property.drawn
import stillwater.property.forEvery
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/**
 * Readings handed over together leave the map that they leave one by one, bit for bit, whether it was asked for
 * meanwhile or not.
 */
class UpdateAllTest {
    private val grid = Grid.unit(3, 2)

    private fun estimators(random: Random): List<FieldEstimator> {
        val settings = BoundedFilterSettings(
            epsilon = 1e-3,
            medianWindow = if (random.nextBoolean()) 3 else 1 + 2 * random.nextInt(3),
            slopeWindow = if (random.nextBoolean()) 5 else random.nextInt(2, 7),
            clearOnEntry = random.nextInt(4) > 0,
            crossing = CrossingPolicy.entries.random(random),
        )
        return listOf(
            AveragingFilter(grid, Interval.UNIT),
            BoundedFilter(grid, Interval.UNIT, settings),
            IntervalFilter(grid, Interval.UNIT, IntervalFilterSettings(30.0, 0.01)),
            SelfCalibratingEstimator(grid, Interval.UNIT),
            BoundedExtendedFilter(grid, Interval.UNIT),
        )
    }

    @Test
    fun theMapIsTheSameAsOneByOne() {
        var unusable = 0L
        var conflicts = 0
        forEvery(drawn { it.nextLong() }, cases = 100) { seed ->
            val together = estimators(Random(seed))
            val single = estimators(Random(seed))
            val random = Random(seed + 1)
            var seconds = 0.0
            val isEven = random.nextBoolean()
            repeat(60) {
                val count = random.nextInt(0, 13)
                val times = DoubleArray(13) {
                    seconds += if (isEven) 0.5 else random.nextInt(3).toDouble()
                    seconds + sometimes(random, -30.0)
                }
                // A ramp either way with noise and outliers: bounds are set, contradicted and crossed.
                val slope = if (random.nextBoolean()) 0.02 else -0.03
                val values = DoubleArray(13) { slope * it + 0.1 * random.nextDouble() + sometimes(random, Double.NaN) }
                val x = random.nextDouble(-0.2, 3.0) + sometimes(random, Double.NaN)
                val y = random.nextDouble(0.0, 2.1)
                together.forEach { it.updateAll(times, x, y, values, count) }
                for (i in 0 until count) {
                    single.forEach { it.update(BoatTime(times[i]), x, y, values[i], Conditions.NONE) }
                    // Asking for a map may have cells written that were put off.
                    if (i % 3 == 0) single.forEach { it.map }
                }
            }
            together.zip(single) { one, other -> assertSame(one.map, other.map) }
            unusable += single[0].map.rejected + single[0].map.outside
            conflicts += (0 until grid.size).sumOf { single[1].map.conflicts(it) }
        }
        // Not only the readings that all can be used were compared.
        assertTrue(unusable > 100, "$unusable")
        assertTrue(conflicts > 1000, "$conflicts")
    }

    private fun sometimes(random: Random, value: Double) = if (random.nextInt(60) == 0) value else 0.0

    private fun assertSame(one: FieldMap, other: FieldMap) {
        for (cell in 0 until grid.size) {
            assertEquals(one.value(cell).toRawBits(), other.value(cell).toRawBits())
            assertEquals(one.lower(cell).toRawBits(), other.lower(cell).toRawBits())
            assertEquals(one.upper(cell).toRawBits(), other.upper(cell).toRawBits())
            assertEquals(one.visits(cell), other.visits(cell))
            assertEquals(one.readings(cell), other.readings(cell))
            assertEquals(one.conflicts(cell), other.conflicts(cell))
        }
        assertEquals(one.outside, other.outside)
        assertEquals(one.rejected, other.rejected)
    }
}
