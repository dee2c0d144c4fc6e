package stillwater.diagnosis

import stillwater.plot.Mark
import stillwater.plot.Series
import kotlin.math.atan2
import kotlin.math.cos
import kotlin.math.floor
import kotlin.math.sin

/**
 * Means of residuals in parts of what they may depend on, each where its rows are on average.
 *
 * @param residual of each row, sensor units. Retained, not modified. @param time of each row, s, ascending. Retained, not modified.
 * @param noise of the residuals.
 */
internal class ResidualMeans(
    private val residual: DoubleArray,
    private val time: DoubleArray,
    private val noise: CorrelatedNoise,
) {
    /** Joined means in twenty parts of [x] with as many rows each; rows with the same number are in one part. */
    fun inParts(x: DoubleArray): List<Series> {
        val order = x.indices.filter { x[it].isFinite() }.sortedBy { x[it] }
        val size = maxOf(1, (order.size + PARTS - 1) / PARTS)
        val parts = ArrayList<Part>()
        var from = 0
        while (from < order.size) {
            val to = end(order, x, from, size)
            val rows = order.subList(from, to)
            parts += part(rows.sumOf { x[it] } / rows.size, rows)
            from = to
        }
        val middles = column(parts) { it.x }
        return listOf(
            Series(MEAN, middles, column(parts) { it.mean }, mark = Mark.LINE_AND_POINTS),
            band(middles, parts),
        )
    }

    /** Where a part of [size] rows from [from] on ends: not among rows with the same number. */
    private fun end(order: List<Int>, x: DoubleArray, from: Int, size: Int): Int {
        val wanted = minOf(from + size, order.size)
        val same = x[order[wanted - 1]]
        var first = wanted - 1
        while (first > from && x[order[first - 1]] == same) first--
        var after = wanted
        while (after < order.size && x[order[after]] == same) after++
        return if (first > from && wanted - first < after - wanted) first else after
    }

    /**
     * Means in sectors of headings [degrees], 0 to 360, joined where sectors are beside each other: over headings that no row has
     * there is nothing to join.
     */
    fun inSectors(degrees: DoubleArray): List<Series> {
        val sectors = degrees.indices.filter { degrees[it].isFinite() }
            .groupBy { floor(degrees[it] / SECTOR + HALF).toInt().mod(PARTS) }
            .map { (sector, rows) -> sector to part(middle(rows.map { degrees[it] }), rows) }
            .sortedBy { it.second.x }
        val joined = ArrayList<Part>()
        val bars = ArrayList<Part>()
        sectors.forEachIndexed { k, (sector, part) ->
            val before = sectors.getOrNull(k - 1)
            if (before != null && (sector - before.first).mod(PARTS) != 1) joined += gap(before.second, part)
            joined += part
            val room = listOfNotNull(before?.second, sectors.getOrNull(k + 1)?.second).map {
                Math.abs(it.x - part.x) / 2
            }
            val half = minOf(BAR, room.minOrNull() ?: BAR)
            if (before != null) bars += gap(before.second, part)
            bars += part.copy(x = part.x - half)
            bars += part.copy(x = part.x + half)
        }
        return listOf(
            Series(MEAN, column(joined) { it.x }, column(joined) { it.mean }, mark = Mark.LINE_AND_POINTS),
            band(column(bars) { it.x }, bars),
        )
    }

    /** The direction of the sum of unit vectors. */
    private fun middle(degrees: List<Double>): Double {
        val turns = degrees.map(Math::toRadians)
        return Math.toDegrees(atan2(turns.sumOf(::sin), turns.sumOf(::cos))).mod(FULL_TURN)
    }

    private fun part(x: Double, rows: List<Int>) =
        Part(x, rows.sumOf { residual[it] } / rows.size, 2 * noise.ofMean(rows.sorted().map { time[it] }))

    private fun gap(before: Part, after: Part) = Part((before.x + after.x) / 2, Double.NaN, Double.NaN)

    /** A band without a line, so that the legend tells what it is. */
    private fun band(x: DoubleArray, parts: List<Part>) = Series(
        BAND,
        x,
        DoubleArray(x.size) { Double.NaN },
        column(parts) { it.mean - it.reach },
        column(parts) { it.mean + it.reach },
    )

    private fun column(parts: List<Part>, of: (Part) -> Double) = DoubleArray(parts.size) { of(parts[it]) }

    private data class Part(val x: Double, val mean: Double, val reach: Double)

    companion object {
        /** What the legend calls the means, and the band about them. */
        const val MEAN = "mean"
        const val BAND = "two standard errors"

        private const val PARTS = 20
        private const val FULL_TURN = 360.0
        private const val HALF = 0.5

        /** Width of a sector, degrees; the first is about 0, since boats sail along grids. */
        const val SECTOR = 18.0

        /** Half the width at which the band about a single sector is drawn, degrees. */
        private const val BAR = 3.0
    }
}
