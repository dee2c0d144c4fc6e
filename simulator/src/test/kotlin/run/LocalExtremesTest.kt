package stillwater.run

import stillwater.field.CellField
import stillwater.model.Grid
import kotlin.test.Test
import kotlin.test.assertEquals

class LocalExtremesTest {
    /** The extremes of a field written row by row, the first at the bottom. */
    private fun extremes(vararg rows: String): List<Int> {
        val truths = rows.map { row -> row.split(' ').map { it.toDouble() } }
        val field = CellField(Grid.unit(truths[0].size, truths.size), truths.flatten().toDoubleArray())
        val found = LocalExtremes.of(field)
        return found.indices.filter { found[it] }
    }

    @Test
    fun aCellAboveOrBelowAllItsNeighboursIsAnExtreme() {
        // 0 is below 0.5 and 0.6; 1 above 0.1, 0.4 and 0.2; 4 below all four; 8 above 0.8 and 0.3. 3 has 0.7 above.
        assertEquals(listOf(0, 1, 4, 8), extremes("0.1 0.5 0.4", "0.6 0.2 0.3", "0.7 0.8 0.9"))
    }

    @Test
    fun cornersCountAsNoNeighbours() {
        assertEquals((0 until 9).toList(), extremes("0.9 0.4 0.9", "0.4 0.5 0.4", "0.9 0.4 0.9"))
    }

    @Test
    fun theEndOfARowIsNoNeighbourOfTheNextRowsStart() {
        // Cell 2 is below cell 3 in the numbering only.
        assertEquals(listOf(0, 2, 3, 5), extremes("0.1 0.2 0.3", "0.9 0.8 0.1"))
    }

    @Test
    fun equalNeighboursMakeNoExtreme() {
        assertEquals(emptyList(), extremes("0.5 0.5", "0.5 0.5"))
        assertEquals(listOf(2), extremes("0.5 0.5 0.6"))
    }

    @Test
    fun inALineThereAreTwoNeighboursAtMost() {
        assertEquals(listOf(0, 1, 2, 4), extremes("0.1 0.9 0.2 0.3 0.4"))
        assertEquals(listOf(0, 1, 2, 4), extremes("0.1", "0.9", "0.2", "0.3", "0.4"))
    }

    @Test
    fun aSingleCellIsNoExtreme() {
        assertEquals(emptyList(), extremes("0.5"))
    }
}
