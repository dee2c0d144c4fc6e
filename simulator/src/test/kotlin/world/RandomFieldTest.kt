package stillwater.world

import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.MethodSource
import stillwater.field.CellField
import stillwater.model.Grid
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotEquals
import kotlin.test.assertTrue

class RandomFieldTest {
    private val grid = Grid.unit(10, 10)

    private fun CellField.values() = List(grid.size) { truth(it) }

    /** Correlation of the values of cells that share an edge, over [FIELDS] fields. */
    private fun correlationOfNeighbours(kind: RandomField): Double {
        val pairs = (0 until FIELDS).flatMap { seed ->
            val field = kind.draw(grid, Random(seed))
            (0 until grid.size).filter { it % grid.columns > 0 }.map { field.truth(it - 1) to field.truth(it) }
        }
        val mean = pairs.map { it.second }.average()
        val covariance = pairs.map { (a, b) -> (a - mean) * (b - mean) }.average()
        return covariance / pairs.map { (_, b) -> (b - mean) * (b - mean) }.average()
    }

    @ParameterizedTest
    @MethodSource("kinds")
    fun theSameStreamGivesTheSameFieldAndAnotherADifferentOne(kind: RandomField) {
        assertEquals(kind.draw(grid, Random(5)).values(), kind.draw(grid, Random(5)).values())
        assertNotEquals(kind.draw(grid, Random(5)).values(), kind.draw(grid, Random(6)).values())
    }

    @ParameterizedTest
    @MethodSource("kinds")
    fun valuesLieWithinThePriorOnGridsOfEveryShape(kind: RandomField) {
        for (shape in listOf(Grid.unit(1, 1), Grid.unit(1, 7), Grid.unit(7, 1), Grid.unit(3, 5), grid)) {
            for (seed in 0 until FIELDS) {
                val field = kind.draw(shape, Random(seed))
                assertEquals(shape, field.grid)
                for (cell in 0 until shape.size) {
                    assertTrue(field.truth(cell) in 0.0..1.0, "${field.truth(cell)} in $shape")
                }
            }
        }
    }

    @Test
    fun uniformCellsHaveTheMomentsOfTheUniformDistribution() {
        val values = (0 until FIELDS).flatMap { UniformField.draw(grid, Random(it)).values() }
        // Mean 1/2, variance 1/12; four standard errors: 1/√(12 n), and for the variance √(1/180 n).
        assertEquals(0.5, values.average(), 4 / sqrt(12.0 * values.size))
        assertEquals(1 / 12.0, values.map { (it - 0.5) * (it - 0.5) }.average(), 4 / sqrt(180.0 * values.size))
    }

    @Test
    fun uniformCellsDoNotDependOnTheirNeighbours() {
        // Four standard errors of the correlation of unrelated numbers, 1/√n for n pairs.
        assertEquals(0.0, correlationOfNeighbours(UniformField), 4 / sqrt(FIELDS * 90.0))
    }

    @Test
    fun aMixtureOfGaussiansSpansZeroToOneExactly() {
        for (seed in 0 until FIELDS) {
            val values = GaussianMixtureField.draw(grid, Random(seed)).values()
            assertEquals(0.0, values.min(), "seed $seed")
            assertEquals(1.0, values.max(), "seed $seed")
        }
    }

    @Test
    fun gaussianFieldsAreSmooth() {
        // One Gaussian of 1 cell, the sharpest there is, correlates by exp(-1/4) = 0.78 over one cell.
        assertTrue(correlationOfNeighbours(GaussianMixtureField) > 0.78)
        assertTrue(correlationOfNeighbours(OriginalGaussianField) > 0.78)
    }

    @Test
    fun aFieldOfOneCellIsHalfWay() {
        assertEquals(listOf(0.5), GaussianMixtureField.draw(Grid.unit(1, 1), Random(1)).values())
    }

    @Test
    fun theOriginalsFieldIsNotScaledButClipped() {
        val highest = (0 until FIELDS).map { OriginalGaussianField.draw(grid, Random(it)).values().max() }
        assertTrue(highest.any { it == 1.0 }, "some bumps are higher than 1")
        assertTrue(highest.any { it < 1.0 }, "some are not")
        // Far from all bumps it is 0 but for their tails: 5/√(2π) · exp(-5²/2·2²) = 0.088 at five cells from the widest.
        val lowest = (0 until FIELDS).map { OriginalGaussianField.draw(grid, Random(it)).values().min() }
        assertTrue(lowest.average() < 0.088, "${lowest.average()}")
    }

    private companion object {
        const val FIELDS = 50

        @JvmStatic
        fun kinds() = listOf(UniformField, GaussianMixtureField, OriginalGaussianField)
    }
}
