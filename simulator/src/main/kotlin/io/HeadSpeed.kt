package stillwater.io

import kotlin.math.cos
import kotlin.math.hypot

/** How fast the boat goes in the first rows of a log, if its times are seconds. */
internal object HeadSpeed {
    private const val METRES_A_DEGREE = 111_195.0
    private const val FEWEST_STRETCHES = 5
    private const val LONGEST_STRETCH = 20

    /**
     * The median of the speeds over stretches of rows whose times grow, m/s; 0 where there are none. Stretches, because
     * a fix of few decimals stands for many rows and then jumps.
     */
    fun of(layout: CsvLayout, columns: CsvColumns): Double {
        val inDegrees = columns.latitude != CsvColumns.NONE
        if (!inDegrees && columns.y == CsvColumns.NONE) return 0.0
        val times = layout.numbers(columns.time)
        val norths = layout.numbers(if (inDegrees) columns.latitude else columns.y)
        val easts = layout.numbers(if (inDegrees) columns.longitude else columns.x)
        val rows = times.indices.filter { times[it].isFinite() && isPlace(easts[it], norths[it], inDegrees) }
        val stretch = (rows.size / FEWEST_STRETCHES).coerceIn(1, LONGEST_STRETCH)
        val ends = rows.filterIndexed { k, _ -> k % stretch == 0 }
        val speeds = ends.zipWithNext { a, b ->
            val north = norths[b] - norths[a]
            val east = easts[b] - easts[a]
            val metres = if (inDegrees) {
                METRES_A_DEGREE * hypot(north, east * cos(Math.toRadians(norths[a])))
            } else {
                hypot(north, east)
            }
            metres / (times[b] - times[a])
        }.filter { it >= 0 && it.isFinite() }.sorted()
        return if (speeds.isEmpty()) 0.0 else speeds[speeds.size / 2]
    }

    private fun isPlace(east: Double, north: Double, inDegrees: Boolean): Boolean {
        if (!east.isFinite() || !north.isFinite() || CellText.isCode(east) || CellText.isCode(north)) return false
        return !inDegrees || east != 0.0 || north != 0.0
    }
}
