package stillwater.diagnose.evidence

/** Which two jumps together explain most: of two that undo each other, either by itself may explain next to nothing. */
internal object JumpPairs {
    private const val LEAST = 1e-9

    /**
     * The two of [rows], which ascend, at least [apart] rows from each other, of which jumps gain most; null where there is
     * no room. [shares] are the jumps' products with what is to be explained, [lengths] their square sums, and [common] is
     * the product of those at two places of the list.
     */
    fun best(
        rows: List<Int>,
        apart: Int,
        shares: DoubleArray,
        lengths: DoubleArray,
        common: (Int, Int) -> Double,
    ): Pair<Int, Int>? {
        var best: Pair<Int, Int>? = null
        var most = 0.0
        for (i in rows.indices) {
            for (j in i + 1 until rows.size) {
                if (rows[j] - rows[i] < apart) continue
                val gain = gain(shares[i], shares[j], lengths[i], lengths[j], common(i, j))
                if (gain > most) {
                    most = gain
                    best = rows[i] to rows[j]
                }
            }
        }
        return best
    }

    /**
     * What two jumps gain, bᵀ G⁻¹ b, with b their [first] and [second] share and G their inner products, of square sums
     * [one] and [two] and the product [common]; 0 where they are nearly the same.
     */
    fun gain(first: Double, second: Double, one: Double, two: Double, common: Double): Double {
        if (!(one > LEAST) || !(two > LEAST)) return 0.0
        val area = one * two - common * common
        if (area < LEAST * one * two) return 0.0
        return (first * first * two + second * second * one - 2 * first * second * common) / area
    }
}
