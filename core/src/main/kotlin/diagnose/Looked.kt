package stillwater.diagnose

import kotlin.math.sqrt

/**
 * Columns of readings made independent of each other, with the water free to take what it can of each: their products
 * are Wa · MWb, where M takes off what the water takes. What is nearly a sum of those before is left out.
 */
internal class Looked(private val fit: BlindFit, private val n: Int) {
    /**
     * A sum of what was added, whitened and, as [unlike], less what the water takes of it; of unit product. [new] is what
     * of the sum is new, in sensor units.
     */
    class Direction(val new: DoubleArray, val white: DoubleArray, val unlike: DoubleArray)

    /** What was added and is new. */
    val directions = ArrayList<Direction>()

    /** Adds [column], which [isNew] or something that the model has. */
    fun add(column: DoubleArray, isNew: Boolean) {
        val new = if (isNew) column.copyOf() else DoubleArray(n)
        val white = fit.whitened(column)
        val unlike = fit.unlike(column)
        val before = dot(white, unlike)
        repeat(2) {
            for (other in directions) {
                val share = dot(unlike, other.white)
                for (i in 0 until n) {
                    new[i] -= share * other.new[i]
                    white[i] -= share * other.white[i]
                    unlike[i] -= share * other.unlike[i]
                }
            }
        }
        val size = dot(white, unlike)
        if (!(size > NEW * before && size > 0)) return
        val scale = 1 / sqrt(size)
        for (i in 0 until n) {
            new[i] *= scale
            white[i] *= scale
            unlike[i] *= scale
        }
        directions += Direction(new, white, unlike)
    }

    private companion object {
        const val NEW = 1e-4
    }
}
