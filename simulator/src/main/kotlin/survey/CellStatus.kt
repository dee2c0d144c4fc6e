package stillwater.survey

import stillwater.field.FieldMap
import stillwater.run.FilterKind

/**
 * What a filter knows about a cell.
 *
 * @property label word in files.
 */
enum class CellStatus(val label: String) {
    /** The boat was never here. */
    UNVISITED("unvisited"),

    /** There is a value from readings, and no bound. */
    MEASURED("measured"),

    /** Both bounds are set, the lower not above the upper. */
    BOTH("both"),

    /** The lower bound lies above the upper one: the evidence contradicts itself. */
    CROSSED("crossed"),

    /** One bound is set; the other end is that of the range taken for the water. */
    ONE_SIDED("one-sided"),

    /** Visited, but no slope here counted. */
    NONE("none"),

    /** The boat was never here; the cells around narrow the range to half of the water's at least. */
    INFERRED("inferred"),
    ;

    /** Whether anything in the cell rests on readings; where not, there is no value to show. */
    val isMeasured: Boolean get() = this != UNVISITED && this != NONE
}

/** What the water of a cell lies between, sensor units; [lower] is above [upper] where the evidence contradicts itself. */
data class CellBounds(val lower: Double, val upper: Double)

/** What the filter [kind] knows about [cell]. */
internal fun FieldMap.status(kind: FilterKind, cell: Int): CellStatus {
    if (visits(cell) == 0) {
        val isNarrow = kind.seesUnvisited && upper(cell) - lower(cell) <= prior.width / 2
        return if (isNarrow) CellStatus.INFERRED else CellStatus.UNVISITED
    }
    if (!kind.givesBounds) return CellStatus.MEASURED
    val below = lower(cell) > prior.lower
    val above = upper(cell) < prior.upper
    return when {
        lower(cell) > upper(cell) -> CellStatus.CROSSED
        below && above -> CellStatus.BOTH
        below || above -> CellStatus.ONE_SIDED
        kind.valueIsMidpoint -> CellStatus.NONE
        else -> CellStatus.MEASURED
    }
}

/** Whether the value of [cell] by the filter [kind] is the middle between a bound and where the water's range ends. */
internal fun FieldMap.isHalfKnown(kind: FilterKind, cell: Int): Boolean =
    kind.valueIsMidpoint && status(kind, cell) == CellStatus.ONE_SIDED

/** Value of [cell] by the filter [kind], sensor units; NaN where nothing was measured. */
internal fun FieldMap.measuredValue(kind: FilterKind, cell: Int): Double =
    if (status(kind, cell).isMeasured) value(cell) else Double.NaN

/** Indices of the cells of which the filter [kind] has something to show: those the boat entered and those inferred. */
internal fun FieldMap.shownCells(kind: FilterKind): List<Int> =
    (0 until grid.size).filter { visits(it) > 0 || status(kind, it) == CellStatus.INFERRED }

/** Indices of the cells the boat entered. */
internal fun FieldMap.visitedCells(): List<Int> = (0 until grid.size).filter { visits(it) > 0 }

/**
 * Visited cells of a filter with bounds by what it knows of them.
 *
 * @property visited all of them. @property both bounded both ways, in order. @property crossed lower above upper.
 * @property oneSided one bound. @property measured no bound, but a value of their own. @property none neither.
 * @property conflicts times evidence contradicted a bound.
 */
data class BoundCounts(
    val visited: Int,
    val both: Int,
    val crossed: Int,
    val oneSided: Int,
    val measured: Int,
    val none: Int,
    val conflicts: Long,
) {
    companion object {
        /** The counts of [field], the map of a filter of [kind]. */
        fun of(field: FieldMap, kind: FilterKind = FilterKind.BOUNDED): BoundCounts {
            val visited = field.visitedCells()
            val counts = visited.groupingBy { field.status(kind, it) }.eachCount()
            fun count(status: CellStatus) = counts[status] ?: 0
            return BoundCounts(
                visited.size,
                count(CellStatus.BOTH),
                count(CellStatus.CROSSED),
                count(CellStatus.ONE_SIDED),
                count(CellStatus.MEASURED),
                count(CellStatus.NONE),
                visited.sumOf { field.conflicts(it).toLong() },
            )
        }
    }
}
