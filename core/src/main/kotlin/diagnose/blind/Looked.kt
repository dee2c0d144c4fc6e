package stillwater.diagnose.blind

import stillwater.diagnose.algebra.dot
import kotlin.math.sqrt

/**
 * Columns of readings made independent of each other, with the water free to take what it can of each: their products
 * are Wa · MWb, where M takes off what the water takes. What is nearly a sum of those before is left out.
 */
internal class Looked(private val fit: BlindFit, private val n: Int) {
    /**
     * A sum of what was added, whitened and, as [unlike], less what the water takes of it; of unit product. [new] is what
     * of the sum is new, in sensor units; [chance] its product with whitened residuals of which nothing is due to it.
     */
    class Direction(val new: DoubleArray, val white: DoubleArray, val unlike: DoubleArray, val chance: Double)

    /** What was added and is new. */
    val directions = ArrayList<Direction>()

    /**
     * Adds [column], which [isNew] or something that the model has, and whose product with whitened residuals is [chance]
     * where nothing is due to it.
     */
    fun add(column: DoubleArray, isNew: Boolean, chance: (DoubleArray) -> Double = { 0.0 }) {
        val new = if (isNew) column.copyOf() else DoubleArray(n)
        val white = fit.whitened(column)
        val unlike = fit.unlike(column)
        val before = dot(white, unlike)
        var left = chance(white)
        repeat(2) {
            for (other in directions) {
                val share = dot(unlike, other.white)
                left -= share * other.chance
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
        directions += Direction(new, white, unlike, left * scale)
    }

    private companion object {
        const val NEW = 1e-4
    }
}
