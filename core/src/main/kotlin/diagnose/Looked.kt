package stillwater.diagnose

import kotlin.math.sqrt

/**
 * Columns of readings made independent of each other, with the water free to take what it can of each: their products
 * are Wa · MWb, where M takes off what the water takes. What is nearly a sum of those before is left out.
 */
internal class Looked(private val fit: BlindFit, private val n: Int) {
    /** [column] of readings, [white] whitened, [unlike] the same less what the water takes of it; of unit product. */
    class Direction(val column: DoubleArray, val white: DoubleArray, val unlike: DoubleArray)

    /** What was added and is new. */
    val directions = ArrayList<Direction>()

    /** Adds [column]. */
    fun add(column: DoubleArray) {
        val c = column.copyOf()
        val white = fit.whitened(c)
        val unlike = fit.unlike(c)
        val before = dot(white, unlike)
        repeat(2) {
            for (other in directions) {
                val share = dot(unlike, other.white)
                for (i in 0 until n) {
                    c[i] -= share * other.column[i]
                    white[i] -= share * other.white[i]
                    unlike[i] -= share * other.unlike[i]
                }
            }
        }
        val size = dot(white, unlike)
        if (!(size > NEW * before && size > 0)) return
        val scale = 1 / sqrt(size)
        for (i in 0 until n) {
            c[i] *= scale
            white[i] *= scale
            unlike[i] *= scale
        }
        directions += Direction(c, white, unlike)
    }

    private companion object {
        const val NEW = 1e-4
    }
}
