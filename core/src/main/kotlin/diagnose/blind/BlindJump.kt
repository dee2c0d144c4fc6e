package stillwater.diagnose.blind

import stillwater.diagnose.algebra.dot

/**
 * A jump of the readings by one unit at [row], which stays, less what the water of [fit] takes of it.
 *
 * With w the jump whitened it is w − R H⁻¹Rᵀw. Its products are told by what the jump is with the water's columns, so
 * that many places are looked at without making a column of each.
 *
 * @param pulled Rᵀw.
 */
internal class BlindJump(private val fit: BlindFit, private val row: Int, private val pulled: DoubleArray) {
    private val moved = fit.solved(pulled)

    private fun white() = fit.whitened(DoubleArray(fit.design.noise.spread.size) { if (it >= row) 1.0 else 0.0 })

    /** Its square sum. */
    val length: Double = product(this)

    /** The sum of its products with those of [other]. */
    fun product(other: BlindJump): Double {
        val own = white()
        return product(other, dot(own, if (other === this) own else other.white()))
    }

    /** The same with each of [others]. */
    fun products(others: List<BlindJump>): DoubleArray {
        val all = DoubleArray(fit.design.noise.spread.size)
        fit.design.noise.jumps(white(), all)
        return DoubleArray(others.size) { product(others[it], all[others[it].row]) }
    }

    /** The same with [other], where [white] is the product of both, whitened. */
    private fun product(other: BlindJump, white: Double): Double =
        white - dot(moved, other.pulled) - moved.indices.sumOf { fit.precisions[it] * moved[it] * other.moved[it] }

    /** The sum of its products with [rest]. */
    fun product(rest: Rest): Double = rest.jumps[row] - dot(moved, rest.pulled)

    /** Readings whitened, [white], as [fit] sees them. */
    class Rest(fit: BlindFit, white: DoubleArray) {
        /** What they are with jumps at each row, whitened. */
        val jumps: DoubleArray = DoubleArray(white.size).also { fit.design.noise.jumps(white, it) }

        /** What they are with the water's columns. */
        val pulled: DoubleArray = fit.design.transposed(white)
    }
}
