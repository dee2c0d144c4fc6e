package stillwater.plan

import stillwater.model.WaterArea
import kotlin.math.sqrt

/**
 * Points laid over [area] in a lattice, and which of them clear legs join. Never changes.
 *
 * @property area the water.
 * @property margin smallest distance of a leg from land and keep-outs, m, at least 0.
 * @property resolution distance of the lattice's points, m, above 0.
 * @throws IllegalArgumentException if a number is out of its range, or the lattice would have too many points.
 */
internal class RouteGraph(val area: WaterArea, val margin: Double, val resolution: Double) {
    val lattice: RouteLattice

    /** Whether a point lies on the water and farther than the margin from land. */
    val clear: BooleanArray

    /** For each point and each of [STEPS] whether the leg there is clear, one bit each. */
    private val ways: ByteArray

    init {
        require(margin >= 0 && margin.isFinite()) { "margin ($margin m) must be at least 0 and finite" }
        require(resolution > 0 && resolution.isFinite()) { "resolution ($resolution m) must be above 0 and finite" }
        lattice = RouteLattice(area, resolution)
        clear = BooleanArray(lattice.size) { area.isClear(lattice.x(it), lattice.y(it), margin) }
        ways = ByteArray(lattice.size)
        for (point in clear.indices) if (clear[point]) join(point)
    }

    /** Calls [use] with each point that a clear leg joins to [point], and the length of the leg, m. */
    inline fun forJoined(point: Int, use: (Int, Double) -> Unit) {
        val bits = ways[point].toInt()
        for (step in 0 until STEPS) {
            if (bits shr step and 1 == 0) continue
            val to = point + ROW_STEPS[step] * lattice.columns + COLUMN_STEPS[step]
            use(to, resolution * (if (step < EDGE_STEPS) 1.0 else SQRT_2))
        }
    }

    private fun x(point: Int) = lattice.x(point)

    private fun y(point: Int) = lattice.y(point)

    private fun join(point: Int) {
        val column = point % lattice.columns
        val row = point / lattice.columns
        // Far from land every neighbour is clear too.
        val isOpen = area.distanceToOutline(x(point), y(point)) > margin + SQRT_2 * resolution * (1 + ROUNDING)
        var bits = 0
        for (step in 0 until STEPS) {
            val toColumn = column + COLUMN_STEPS[step]
            val toRow = row + ROW_STEPS[step]
            if (toColumn !in 0 until lattice.columns || toRow !in 0 until lattice.rows) continue
            val to = toRow * lattice.columns + toColumn
            if (isOpen ||
                (clear[to] && area.isClear(x(point), y(point), x(to), y(to), margin))
            ) {
                bits = bits or (1 shl step)
            }
        }
        ways[point] = bits.toByte()
    }

    companion object {
        /** Length of the longest leg over the resolution. */
        val SQRT_2 = sqrt(2.0)
        private const val STEPS = 8
        private const val EDGE_STEPS = 4
        private const val ROUNDING = 1e-9
        private val COLUMN_STEPS = intArrayOf(-1, 1, 0, 0, -1, -1, 1, 1)
        private val ROW_STEPS = intArrayOf(0, 0, -1, 1, -1, 1, -1, 1)
    }
}
