package stillwater.run

import stillwater.field.CellField

/**
 * The cells of a field that are above, or below, every cell they share an edge with.
 *
 * A boat that comes from a neighbour always enters such a cell from the same side of its value, so that a slow sensor
 * tightens one of its bounds and hardly ever the other.
 */
object LocalExtremes {
    /** For each cell of [field] whether it is a local extreme. */
    fun of(field: CellField): BooleanArray = BooleanArray(field.grid.size) { cell ->
        val neighbours = neighbours(field, cell)
        neighbours.isNotEmpty() &&
            (neighbours.all { it < field.truth(cell) } || neighbours.all { it > field.truth(cell) })
    }

    private fun neighbours(field: CellField, cell: Int): List<Double> {
        val columns = field.grid.columns
        val column = cell % columns
        return listOfNotNull(
            (cell - 1).takeIf { column > 0 },
            (cell + 1).takeIf { column < columns - 1 },
            (cell - columns).takeIf { it >= 0 },
            (cell + columns).takeIf { it < field.grid.size },
        ).map { field.truth(it) }
    }
}
