package stillwater.survey

import stillwater.model.Grid
import stillwater.model.Position
import kotlin.math.abs
import kotlin.math.ceil
import kotlin.math.cos
import kotlin.math.floor
import kotlin.math.log10
import kotlin.math.pow
import kotlin.math.sin

/**
 * What the user said about the grid; all that is left null is chosen from the log.
 *
 * @property cell side of a cell, m. @property columns number of columns. @property rows number of rows.
 * @property rotation angle of the grid's first axis, rad, counter-clockwise from east.
 */
data class GridWish(
    val cell: Double? = null,
    val columns: Int? = null,
    val rows: Int? = null,
    val rotation: Double = 0.0,
)

/** A grid that cannot be laid over a survey as wished; the message says why. */
class UnfitGrid(message: String) : Exception(message)

/**
 * Lays a grid over a survey.
 *
 * The side of a cell is 1, 2 or 5 times a power of ten. It is a little below the larger of two lengths: what the boat covers in
 * ten readings, so that the windows of the bounded filter fill in each cell, and the mean distance between tracks,
 * area / length, so that the map has few holes. A grid gets at least ten and at most 100 cells along its longer side.
 */
class GridChoice(private val statistics: SurveyStatistics, private val track: Track) {
    /** The grid for [wish]. @throws UnfitGrid if there is none that holds every reading; the message says why. */
    fun grid(wish: GridWish): Grid {
        val extent = extent(wish.rotation)
        return if (wish.columns != null && wish.rows != null) {
            fitted(extent, wish.columns, wish.rows, wish.rotation)
        } else {
            snapped(extent, wish.cell ?: side(extent), wish.rotation)
        }
    }

    /** Extent along the grid's own axes, m. */
    private data class Extent(val left: Double, val right: Double, val bottom: Double, val top: Double) {
        val width get() = right - left
        val height get() = top - bottom
        val longer get() = maxOf(width, height)
    }

    private fun extent(rotation: Double): Extent {
        if (rotation == 0.0) return statistics.run { Extent(west, east, south, north) }
        // The thinned track may miss an extreme by the way of a few readings; one step's way is added all round.
        val c = cos(rotation)
        val s = sin(rotation)
        var extent = Extent(
            Double.POSITIVE_INFINITY,
            Double.NEGATIVE_INFINITY,
            Double.POSITIVE_INFINITY,
            Double.NEGATIVE_INFINITY,
        )
        for (i in 0 until track.size) {
            val along = c * track.xs[i] + s * track.ys[i]
            val across = c * track.ys[i] - s * track.xs[i]
            extent = Extent(
                minOf(extent.left, along),
                maxOf(extent.right, along),
                minOf(extent.bottom, across),
                maxOf(extent.top, across),
            )
        }
        val missed = if (track.stride == 1L) 0.0 else track.stride * statistics.steps.median * speed()
        return extent.run { Extent(left - missed, right + missed, bottom - missed, top + missed) }
    }

    private fun speed() = statistics.speeds.median.let { if (it.isNaN()) 0.0 else it }

    private fun side(extent: Extent): Double {
        val alongTrack = READINGS_A_CELL * speed() * statistics.steps.median
        val betweenTracks = if (statistics.distance > 0) extent.width * extent.height / statistics.distance else 0.0
        val wanted = maxOf(alongTrack, betweenTracks, extent.longer / MOST_CELLS_A_SIDE)
        val largest = maxOf(extent.longer / FEWEST_CELLS_A_SIDE, extent.longer / MOST_CELLS_A_SIDE)
        if (extent.longer <= 0) return 1.0
        val side = nice(minOf(wanted, largest))
        val needed = alongTrack * READINGS_NEEDED / READINGS_A_CELL
        // 1, 2, 5, 10: from one to the next it is at most a factor 2.5, which leads to exactly one of them.
        return if (side >= needed) side else nice(NEXT * side)
    }

    /** The number of 1, 2 or 5 times a power of ten below [length], or a little (a fifth) above; at least a centimetre. */
    private fun nice(length: Double): Double {
        val power = floor(log10(maxOf(length, SMALLEST)))
        val mantissa = maxOf(length, SMALLEST) / 10.0.pow(power)
        val step = when {
            mantissa * ABOVE < 2 -> 1.0
            mantissa * ABOVE < 5 -> 2.0
            mantissa * ABOVE < 10 -> 5.0
            else -> 10.0
        }
        // Whole powers of ten are divided by rather than multiplied with: 2 / 10 is 0.2, 2 * 0.1 may not be.
        return if (power < 0) step / 10.0.pow(abs(power)) else step * 10.0.pow(power)
    }

    /** Cells of [side] m whose borders lie on its multiples, around all of [extent]. */
    private fun snapped(extent: Extent, side: Double, rotation: Double): Grid {
        val left = floor(extent.left / side)
        val bottom = floor(extent.bottom / side)
        val columns = floor(extent.right / side) - left + 1
        val rows = floor(extent.top / side) - bottom + 1
        if (!(columns * rows <= Grid.MAX_CELLS)) {
            val size = if (columns * rows < LARGEST_COUNT) " of ${columns.toLong()} x ${rows.toLong()}," else ""
            throw UnfitGrid("cells of $side m would make a grid$size above ${Grid.MAX_CELLS} cells")
        }
        // Rounding may put a point on a border on its other side: the grid then gets one more cell there.
        return MARGINS.firstNotNullOfOrNull { margin ->
            val corner = origin((left - margin.west) * side, (bottom - margin.south) * side, rotation)
            val across = columns.toInt() + margin.west + margin.east
            val up = rows.toInt() + margin.south + margin.north
            if (across.toLong() * up > Grid.MAX_CELLS) return@firstNotNullOfOrNull null
            Grid(corner, across, up, side, side, rotation).takeIf { it.holds(extent) }
        } ?: throw UnfitGrid("cells of $side m are too small for positions ${farthest(extent)} m from the origin")
    }

    /** So many cells around all of [extent], a little wider than it so that its upper edges lie inside. */
    private fun fitted(extent: Extent, columns: Int, rows: Int, rotation: Double): Grid =
        SPARE_METRES.firstNotNullOfOrNull { spare ->
            val width = sideFor(extent.width, columns, spare)
            val height = sideFor(extent.height, rows, spare)
            // A transect has no height (or width) of its own: square cells.
            val cellWidth = if (width > 0) {
                width
            } else if (height > 0) {
                height
            } else {
                1.0
            }
            val cellHeight = if (height > 0) height else cellWidth
            val left = (extent.left + extent.right - columns * cellWidth) / 2
            val bottom = (extent.bottom + extent.top - rows * cellHeight) / 2
            Grid(origin(left, bottom, rotation), columns, rows, cellWidth, cellHeight, rotation)
                .takeIf { it.holds(extent) }
        } ?: throw UnfitGrid("no $columns x $rows cells can be laid ${farthest(extent)} m from the origin")

    /** [length] / [count], rounded up to a whole number of [spare] m and a little more. */
    private fun sideFor(length: Double, count: Int, spare: Double) =
        if (length > 0) (ceil(length / count / spare) + 1) * spare else 0.0

    /** Whether every point known lies in this grid: all readings, or those of the thinned track where it is turned. */
    private fun Grid.holds(extent: Extent): Boolean = if (rotation == 0.0) {
        // Without a turn rounding keeps the order of the coordinates, so the extremes speak for all.
        cellAt(extent.left, extent.bottom) != Grid.OUTSIDE && cellAt(extent.right, extent.top) != Grid.OUTSIDE
    } else {
        (0 until track.size).all { cellAt(track.xs[it], track.ys[it]) != Grid.OUTSIDE }
    }

    private fun farthest(extent: Extent) =
        extent.run { maxOf(maxOf(abs(left), abs(right)), maxOf(abs(bottom), abs(top))) }

    private fun origin(along: Double, across: Double, rotation: Double) =
        Position(cos(rotation) * along - sin(rotation) * across, sin(rotation) * along + cos(rotation) * across)

    private companion object {
        const val READINGS_A_CELL = 10
        const val READINGS_NEEDED = 8
        const val NEXT = 2.5
        const val FEWEST_CELLS_A_SIDE = 10
        const val MOST_CELLS_A_SIDE = 100
        const val SMALLEST = 0.01
        const val ABOVE = 1.2
        const val LARGEST_COUNT = 1e15

        /** What a fitted grid's cells are rounded up to, m; the first that holds every reading is taken. */
        val SPARE_METRES = listOf(1e-6, 1e-5, 1e-4, 1e-3)

        /** Cells to add west, east, south and north of a snapped grid, the fewest first. */
        val MARGINS = List(1 shl 4) { Margin(it and 1, it shr 1 and 1, it shr 2 and 1, it shr 3 and 1) }
            .sortedBy { it.west + it.east + it.south + it.north }
    }
}

/** Cells added on each side of a grid. */
private class Margin(val west: Int, val east: Int, val south: Int, val north: Int)
