package stillwater.plan

import stillwater.model.Grid
import stillwater.model.Position
import stillwater.model.WaterArea
import kotlin.math.ceil
import kotlin.math.hypot

/** What ways lead round. */
internal fun interface Obstacle {
    /** Whether it is in the way of the straight leg, m. */
    fun blocks(fromX: Double, fromY: Double, toX: Double, toY: Double): Boolean

    /** Whether it may be in the way of a leg from ([x], [y]) that is no longer than [reach], m; true where unknown. */
    fun isNear(x: Double, y: Double, reach: Double): Boolean = true
}

/**
 * Where a boat did not get in, as for a reef that no chart has: cells that ways and plans leave out for a while.
 *
 * They are the map's cells and as large ones about it, as far as the water goes: what is in the way may lie off the
 * map. So they have numbers of their own, which [at] gives. A closed cell opens again [WAIT] s after it was closed:
 * what kept the boat out may have been a current. Where it did not get in again, all wait for twice as long each
 * further time; where it did, all are open. Confined to one thread; no call allocates but [mapCells] and [offMap].
 *
 * @property map the map's cells.
 * @param water which the cells cover, if they are at most [WaterRoutes.MAX_POINTS] and the map is not turned; else they
 *   are the map's.
 * @param berth that ways give closed cells, m; a fifth of a cell at most.
 */
internal class ClosedCells(val map: Grid, water: WaterArea? = null, berth: Double = 0.0) : Obstacle {
    private val cells = water?.let { about(map, it) } ?: map
    private val times = IntArray(cells.size)
    private val until = DoubleArray(cells.size) { Double.NEGATIVE_INFINITY }
    private val step = minOf(map.cellWidth, map.cellHeight) / SAMPLES
    private val berth = minOf(berth, minOf(map.cellWidth, map.cellHeight) / MOST_BERTH)

    /** How many of the [known] are among a cell and those up to [BESIDE] columns and rows off. */
    private val beside = IntArray(cells.size)

    /** All cells that were closed and not [reached] since, be they open again or not. */
    val known = object : Obstacle {
        override fun blocks(fromX: Double, fromY: Double, toX: Double, toY: Double) =
            blocks(fromX, fromY, toX, toY, knowns) { times[it] > 0 }

        override fun isNear(x: Double, y: Double, reach: Double) = this@ClosedCells.isNear(x, y, reach)
    }

    /** How many those are. */
    var knowns = 0
        private set

    /** Cells that are closed now. */
    var count = 0
        private set

    /** Counts what was closed and opened, so that others see that something was. */
    var version = 0
        private set

    /** The cell at ([x], [y]), m; [Grid.OUTSIDE] where there is none. */
    fun at(x: Double, y: Double): Int = cells.cellAt(x, y)

    /** How far ([x], [y]), m, is from the middle of its cell, in cells; NaN where there is none. */
    fun offMiddle(x: Double, y: Double): Double {
        val cell = at(x, y)
        if (cell == Grid.OUTSIDE) return Double.NaN
        return hypot((x - cells.centerX(cell)) / cells.cellWidth, (y - cells.centerY(cell)) / cells.cellHeight)
    }

    /** Whether [cell], which may be [Grid.OUTSIDE], is closed. */
    fun isClosed(cell: Int): Boolean = cell != Grid.OUTSIDE && until[cell] > Double.NEGATIVE_INFINITY

    /** Whether [cell], which may be [Grid.OUTSIDE], is among the [known]. */
    fun isKnown(cell: Int): Boolean = cell != Grid.OUTSIDE && times[cell] > 0

    /** Middles of those among the [known] that are off the map, m. Allocates. */
    fun offMap(): List<Position> {
        if (version == 0) return emptyList()
        return times.indices.filter { times[it] > 0 }.map { Position(cells.centerX(it), cells.centerY(it)) }
            .filter { map.cellAt(it) == Grid.OUTSIDE }
    }

    /** The map's cells among the [known]. Allocates. */
    fun mapCells(): List<Int> =
        if (version == 0) emptyList() else (0 until map.size).filter { times[at(map.centerX(it), map.centerY(it))] > 0 }

    /** [cell] was not got into, [now] in s. */
    fun close(cell: Int, now: Double) {
        if (!isClosed(cell)) count++
        if (times[cell] == 0) know(cell, 1)
        times[cell]++
        until[cell] = now + WAIT * (1L shl minOf(times[cell] - 1, MOST_DOUBLINGS))
        version++
        if (times[cell] > 1) closeOthers(until[cell])
    }

    /** A cell was tried again, and in vain: most likely what is in the way of the others has not gone either. */
    private fun closeOthers(time: Double) {
        for (cell in until.indices) {
            if (times[cell] == 0) continue
            if (!isClosed(cell)) count++
            until[cell] = maxOf(until[cell], time)
        }
    }

    /** The boat is in the midst of [cell], which may be [Grid.OUTSIDE]. */
    fun reached(cell: Int) {
        if (cell == Grid.OUTSIDE || times[cell] == 0) return
        times[cell] = 0
        know(cell, -1)
        version++
        // What was in the way has gone, or others were taken for what was beside them.
        for (other in until.indices) open(other)
    }

    /** Opens what has been closed for long enough, [now] in s. */
    fun expire(now: Double) {
        if (count > 0) for (cell in until.indices) if (isClosed(cell) && until[cell] <= now) open(cell)
    }

    /** Nothing else is left to do: opens what was closed only once. Answers whether that was any cell. */
    fun openOnceMore(): Boolean {
        val before = count
        for (cell in until.indices) if (times[cell] == 1) open(cell)
        return count < before
    }

    private fun open(cell: Int) {
        if (!isClosed(cell)) return
        until[cell] = Double.NEGATIVE_INFINITY
        count--
        version++
    }

    private fun know(cell: Int, change: Int) {
        knowns += change
        val column = cell % cells.columns
        val row = cell / cells.columns
        for (r in maxOf(0, row - BESIDE)..minOf(cells.rows - 1, row + BESIDE)) {
            for (c in maxOf(0, column - BESIDE)..minOf(cells.columns - 1, column + BESIDE)) {
                beside[r * cells.columns + c] += change
            }
        }
    }

    /** Closed cells are among the [known]. */
    override fun isNear(x: Double, y: Double, reach: Double): Boolean {
        if (knowns == 0) return false
        // The berth is taken to both axes.
        if (reach + 2 * berth > BESIDE * minOf(cells.cellWidth, cells.cellHeight)) return true
        val cell = at(x, y)
        return cell == Grid.OUTSIDE || beside[cell] > 0
    }

    /** Whether the straight leg, m, comes too near to a closed cell; the one that it begins in does not count. */
    override fun blocks(fromX: Double, fromY: Double, toX: Double, toY: Double): Boolean =
        blocks(fromX, fromY, toX, toY, count) { isClosed(it) }

    private inline fun blocks(
        fromX: Double,
        fromY: Double,
        toX: Double,
        toY: Double,
        cells: Int,
        isShut: (Int) -> Boolean,
    ): Boolean {
        if (cells == 0) return false
        val own = at(fromX, fromY)
        val samples = samples(fromX, fromY, toX, toY)
        for (i in 1..samples) {
            val share = i.toDouble() / samples
            // A boat that was held up lies near to the cell that was closed for it.
            val berth = if (i <= SAMPLES / 2) 0.0 else berth
            val x = fromX + share * (toX - fromX)
            val y = fromY + share * (toY - fromY)
            for (corner in 0 until CORNERS) {
                val cell = at(x + if (corner % 2 == 0) berth else -berth, y + if (corner < 2) berth else -berth)
                if (cell != Grid.OUTSIDE && cell != own && isShut(cell)) return true
            }
        }
        return false
    }

    /**
     * The first cell on the straight leg, m, but the one that it begins in; that one where the leg does not leave it.
     */
    fun ahead(fromX: Double, fromY: Double, toX: Double, toY: Double): Int {
        val own = at(fromX, fromY)
        val samples = samples(fromX, fromY, toX, toY)
        for (i in 1..samples) {
            val share = i.toDouble() / samples
            val cell = at(fromX + share * (toX - fromX), fromY + share * (toY - fromY))
            if (cell != Grid.OUTSIDE && cell != own) return cell
        }
        return own
    }

    private fun samples(fromX: Double, fromY: Double, toX: Double, toY: Double): Int {
        val length = hypot(toX - fromX, toY - fromY)
        return if (length.isFinite()) ceil(minOf(length / step, MOST_SAMPLES)).toInt() else 0
    }

    companion object {
        /** Time for which a cell is closed at first, s. */
        const val WAIT = 600.0

        /** Beyond any mission. */
        private const val MOST_DOUBLINGS = 20

        /** Of a leg, in a cell's side. */
        private const val SAMPLES = 4
        private const val CORNERS = 4
        private const val BESIDE = 2
        private const val MOST_SAMPLES = 10_000.0

        /** The ways' points are half a cell apart: one at least passes between a closed cell and the next. */
        private const val MOST_BERTH = 5.0

        private fun about(map: Grid, water: WaterArea): Grid? {
            if (map.rotation != 0.0) return null
            val left = maxOf(0.0, ceil((map.origin.x - water.west) / map.cellWidth))
            val down = maxOf(0.0, ceil((map.origin.y - water.south) / map.cellHeight))
            val right = ceil((water.east - map.origin.x) / map.cellWidth)
            val up = ceil((water.north - map.origin.y) / map.cellHeight)
            val columns = left + maxOf(right, map.columns.toDouble())
            val rows = down + maxOf(up, map.rows.toDouble())
            if (!(columns * rows <= WaterRoutes.MAX_POINTS)) return null
            val origin = Position(map.origin.x - left * map.cellWidth, map.origin.y - down * map.cellHeight)
            return Grid(origin, columns.toInt(), rows.toInt(), map.cellWidth, map.cellHeight)
        }
    }
}
