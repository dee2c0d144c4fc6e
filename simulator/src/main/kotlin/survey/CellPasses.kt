package stillwater.survey

import stillwater.model.Grid
import kotlin.math.hypot

/**
 * How the means of successive passes through one cell differ.
 *
 * @property pairs number of pairs of successive passes.
 * @property meanDifference mean absolute difference of their mean readings, sensor units; NaN without pairs.
 */
data class PassAgreement(val pairs: Long, val meanDifference: Double)

/**
 * Compares successive passes through the same cell, those in opposite directions and those in the same direction.
 *
 * A slow sensor drags old water along: opposite passes disagree more than passes in one direction, by the same water.
 * A pass counts if it has two readings and gets [SHORTEST] of a cell's side ahead; directions are opposite (or the
 * same) within 60 degrees. Confined to one thread; memory grows with the cells visited.
 */
class CellPasses(private val grid: Grid) {
    private class Pass(val mean: Double, val dx: Double, val dy: Double)

    private class Sum {
        var pairs = 0L
        var total = 0.0

        fun agreement() = PassAgreement(pairs, if (pairs == 0L) Double.NaN else total / pairs)
    }

    private val lastPasses = HashMap<Int, Pass>()
    private val entries = HashMap<Int, Int>()
    private val oppositeSum = Sum()
    private val sameSum = Sum()
    private var cell = Grid.OUTSIDE
    private var enterX = 0.0
    private var enterY = 0.0
    private var lastX = 0.0
    private var lastY = 0.0
    private var sum = 0.0
    private var count = 0

    /** Number of cells entered more than once. */
    val revisitedCells: Int get() = entries.values.count { it > 1 }

    /** Number of cells entered. */
    val visitedCells: Int get() = entries.size

    /** Passes in opposite directions. */
    val opposite: PassAgreement get() = oppositeSum.agreement()

    /** Passes in the same direction. */
    val same: PassAgreement get() = sameSum.agreement()

    /** Takes the reading [value] at ([x], [y]), local frame, m. */
    fun add(x: Double, y: Double, value: Double) {
        val here = grid.cellAt(x, y)
        if (here != cell) {
            finish()
            cell = here
            enterX = x
            enterY = y
            if (here != Grid.OUTSIDE) entries.merge(here, 1, Int::plus)
        }
        sum += value
        count++
        lastX = x
        lastY = y
    }

    /** Ends the pass under way; call it after the last reading. */
    fun finish() {
        val dx = lastX - enterX
        val dy = lastY - enterY
        val length = hypot(dx, dy)
        if (cell != Grid.OUTSIDE && count >= 2 && length >= SHORTEST * minOf(grid.cellWidth, grid.cellHeight)) {
            val pass = Pass(sum / count, dx / length, dy / length)
            lastPasses.put(cell, pass)?.let { compare(it, pass) }
        }
        sum = 0.0
        count = 0
    }

    private fun compare(before: Pass, after: Pass) {
        val cosine = before.dx * after.dx + before.dy * after.dy
        val side = if (cosine < -HALF) {
            oppositeSum
        } else if (cosine > HALF) {
            sameSum
        } else {
            return
        }
        side.pairs++
        side.total += kotlin.math.abs(after.mean - before.mean)
    }

    private companion object {
        const val SHORTEST = 0.3
        const val HALF = 0.5
    }
}
