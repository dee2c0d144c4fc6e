package stillwater.simulation

import stillwater.field.FieldMap
import kotlin.math.abs
import kotlin.math.sqrt

/**
 * How far a map is from the water, over the cells that have readings.
 *
 * @property cells how many these are.
 * @property mean absolute difference, sensor units; NaN without any cell.
 * @property rootMeanSquare difference, sensor units; NaN without any cell.
 * @property largest absolute difference, sensor units; NaN without any cell.
 */
data class MapErrors(val cells: Int, val mean: Double, val rootMeanSquare: Double, val largest: Double) {
    companion object {
        /** Of [map] against the true value [truth] of each cell, over the cells of which [counts] holds. */
        fun of(map: FieldMap, counts: (Int) -> Boolean = { map.readings(it) > 0 }, truth: (Int) -> Double): MapErrors {
            var sum = 0.0
            var squares = 0.0
            val cells = (0 until map.grid.size).filter(counts)
            var largest = if (cells.isEmpty()) Double.NaN else 0.0
            for (cell in cells) {
                val error = abs(map.value(cell) - truth(cell))
                sum += error
                squares += error * error
                largest = maxOf(largest, error)
            }
            return MapErrors(cells.size, sum / cells.size, sqrt(squares / cells.size), largest)
        }
    }
}

/**
 * How a map's bounds hold, over the cells that have readings and bounds narrower than the prior's.
 *
 * @property cells how many these are.
 * @property holding share of them whose bounds hold the true value, 0 to 1; NaN without any.
 * @property meanWidth of the bounds, sensor units; NaN without any.
 */
data class BoundsHolding(val cells: Int, val holding: Double, val meanWidth: Double) {
    companion object {
        /** Of [map] against the true value [truth] of each cell. */
        fun of(map: FieldMap, truth: (Int) -> Double): BoundsHolding {
            val bounded = (0 until map.grid.size).filter {
                map.readings(it) > 0 && map.upper(it) - map.lower(it) < map.prior.width
            }
            val holding = bounded.count { truth(it) in map.lower(it)..map.upper(it) }
            return BoundsHolding(
                bounded.size,
                holding.toDouble() / bounded.size,
                bounded.sumOf { map.upper(it) - map.lower(it) } / bounded.size,
            )
        }
    }
}
