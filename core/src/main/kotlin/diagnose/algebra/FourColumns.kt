package stillwater.diagnose.algebra

/** Four columns of which sums are made; each must be a name of its own for the compiler to do several rows in one step. */
internal class FourColumns(
    private val one: DoubleArray,
    private val two: DoubleArray,
    private val three: DoubleArray,
    private val four: DoubleArray,
) {
    /** Adds the columns, times [w], [x], [y] and [z], to the rows [from] until [to] of [out]. */
    fun add(out: DoubleArray, from: Int, to: Int, w: Double, x: Double, y: Double, z: Double) {
        val a = one
        val b = two
        val c = three
        val d = four
        for (i in from until to) out[i] += w * a[i] + x * b[i] + y * c[i] + z * d[i]
    }
}
