package stillwater.estimate

import org.junit.jupiter.api.Test
import stillwater.model.BoatTime
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.property.between
import stillwater.property.drawn
import stillwater.property.forEvery
import kotlin.math.pow
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class AveragingFilterTest {
    private val grid = Grid.unit(4, 3)
    private val prior = Interval(-2.0, 6.0)

    @Test
    fun averagesByHand() {
        val arithmetic = AveragingFilter(Grid.unit(1, 1), Interval.UNIT)
        val exponential = ExponentialFilter(Grid.unit(1, 1), Interval.UNIT, oldWeight = 0.5)
        for ((i, value) in listOf(1.0, 0.0, 0.25).withIndex()) {
            arithmetic.update(BoatTime(i.toDouble()), 0.5, 0.5, value)
            exponential.update(BoatTime(i.toDouble()), 0.5, 0.5, value)
        }
        assertEquals(1.25 / 3, arithmetic.map.value(0), 1e-16)
        // ((0.5 + 1)/2 + 0)/2 = 0.375; (0.375 + 0.25)/2 = 0.3125: halves, exact.
        assertEquals(0.3125, exponential.map.value(0), 0.0)
    }

    @Test
    fun theMeanAgreesWithAListPerCell() {
        forEvery(drawn { Walk(it, grid) }) { walk ->
            val filter = AveragingFilter(grid, prior)
            walk.feed(filter)
            for (cell in 0 until grid.size) {
                val values = walk.valuesIn(cell)
                val expected = if (values.isEmpty()) prior.midpoint else values.average()
                // Sums of at most 300 numbers below 10.
                assertEquals(expected, filter.map.value(cell), 1e-12)
                assertUntouchedBounds(filter, cell)
            }
        }
    }

    @Test
    fun theExponentialAverageAgreesWithItsWeights() {
        forEvery(drawn { Walk(it, grid) }, drawn { it.between(0.0, 0.99) }) { walk, w ->
            val filter = ExponentialFilter(grid, prior, w)
            walk.feed(filter)
            for (cell in 0 until grid.size) {
                val values = walk.valuesIn(cell)
                val n = values.size
                // wⁿ · midpoint + Σ (1 − w) wⁿ⁻ⁱ · vᵢ, the recursion written out.
                val expected = w.pow(n) * prior.midpoint +
                    values.withIndex().sumOf { (i, value) -> (1 - w) * w.pow(n - 1 - i) * value }
                // At most 300 roundings at magnitude 10, each damped by w.
                assertEquals(expected, filter.map.value(cell), 1e-12)
                assertUntouchedBounds(filter, cell)
            }
        }
    }

    @Test
    fun theExponentialAverageStartsAtThePriorsMidpoint() {
        val filter = ExponentialFilter(Grid.unit(1, 1), Interval(0.0, 10.0))
        filter.update(BoatTime(0.0), 0.5, 0.5, 10.0)
        // 0.9 · 5 + 0.1 · 10, the default weight of the original.
        assertEquals(5.5, filter.map.value(0), 1e-15)
    }

    @Test
    fun theWeightIsBelowOne() {
        for (weight in listOf(-0.1, 1.0, 1.5, Double.NaN)) {
            val error = assertFailsWith<IllegalArgumentException> { ExponentialFilter(grid, prior, weight) }
            assertEquals("oldWeight ($weight) must be in [0, 1)", error.message)
        }
        val last = ExponentialFilter(Grid.unit(1, 1), prior, oldWeight = 0.0)
        last.update(BoatTime(0.0), 0.5, 0.5, 3.0)
        assertEquals(3.0, last.map.value(0), 0.0)
    }

    private fun assertUntouchedBounds(filter: FieldEstimator, cell: Int) {
        assertEquals(prior.lower, filter.map.lower(cell), 0.0)
        assertEquals(prior.upper, filter.map.upper(cell), 0.0)
    }

    /** Readings at random places of the grid. */
    private class Walk(random: Random, private val grid: Grid) {
        private val cells = List(random.nextInt(1, 300)) { random.nextInt(grid.size) }
        private val values = cells.map { random.between(-10.0, 10.0) }

        fun feed(filter: FieldEstimator) {
            for ((i, cell) in cells.withIndex()) {
                val use = filter.update(BoatTime(i.toDouble()), grid.centerX(cell), grid.centerY(cell), values[i])
                assertTrue(use == ReadingUse.USED)
            }
        }

        fun valuesIn(cell: Int): List<Double> = values.filterIndexed { i, _ -> cells[i] == cell }

        override fun toString() = "cells $cells, values $values"
    }
}
