package stillwater.plan

import stillwater.model.WaterArea
import kotlin.math.ceil

/** Where the points of a lattice over [area] are, [resolution] m apart. */
internal class RouteLattice(area: WaterArea, private val resolution: Double) {
    val columns: Int
    val rows: Int
    private val westmost: Double
    private val southmost: Double

    init {
        val wide = ceil((area.east - area.west) / resolution)
        val high = ceil((area.north - area.south) / resolution)
        require(wide * high <= WaterRoutes.MAX_POINTS) {
            "a resolution of $resolution m makes ${wide.toLong()} x ${high.toLong()} points; " +
                "${WaterRoutes.MAX_POINTS} are allowed"
        }
        columns = maxOf(1, wide.toInt())
        rows = maxOf(1, high.toInt())
        westmost = (area.west + area.east - (columns - 1) * resolution) / 2
        southmost = (area.south + area.north - (rows - 1) * resolution) / 2
    }

    val size get() = columns * rows

    fun x(point: Int) = westmost + point % columns * resolution

    fun y(point: Int) = southmost + point / columns * resolution

    /** Calls [use] with the points within two steps of the lattice, or with the [margin]'s more. */
    inline fun forNear(x: Double, y: Double, margin: Double, use: (Int) -> Unit) {
        if (!x.isFinite() || !y.isFinite()) return
        val reach = NEAR + ceil(margin / resolution).toInt()
        val column = Math.round((x - westmost) / resolution).coerceIn(0L, columns - 1L).toInt()
        val row = Math.round((y - southmost) / resolution).coerceIn(0L, rows - 1L).toInt()
        for (r in maxOf(0, row - reach)..minOf(rows - 1, row + reach)) {
            for (c in maxOf(0, column - reach)..minOf(columns - 1, column + reach)) use(r * columns + c)
        }
    }

    companion object {
        const val NEAR = 2

        fun points(area: WaterArea, resolution: Double): Double =
            ceil((area.east - area.west) / resolution) * ceil((area.north - area.south) / resolution)
    }
}
