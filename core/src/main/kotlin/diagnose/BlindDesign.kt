package stillwater.diagnose

/**
 * The waves as the sensor shows them, whitened, and their normal equations: all that is needed to integrate the water
 * out.
 *
 * @param shown each wave as the sensor shows it, not whitened; flat-prior columns last. Retained.
 * @param loops how the columns and the halves of the sums are gone through.
 * @property noise what whitens. @property size number of columns.
 */
internal class BlindDesign(shown: Array<DoubleArray>, val noise: BlindNoise, loops: Loops) {
    val size: Int = shown.size
    private val n = shown[0].size
    private val columns = arrayOfNulls<DoubleArray>(size).also { out ->
        loops.each(size) { k -> out[k] = DoubleArray(n).also { noise.whiten(shown[k], it) } }
    }.requireNoNulls()

    /** The lower half of RᵀR, row by row. */
    val gram: Array<DoubleArray> = Array(size) { DoubleArray(it + 1) }

    init {
        val count = (n + STRETCH - 1) / STRETCH
        val halves = arrayOf(0 until count / 2, count / 2 until count)
        val parts = arrayOf(gram, Array(size) { DoubleArray(it + 1) })
        loops.each(halves.size) { half ->
            val rows = Array(STRETCH) { DoubleArray(size) }
            for (stretch in halves[half]) add(rows, stretch * STRETCH, parts[half])
        }
        for (a in 0 until size) for (b in 0..a) gram[a][b] += parts[1][a][b]
    }

    /** Adds the products of the rows that begin at [from], which are put into [rows] first, to [sums]. */
    private fun add(rows: Array<DoubleArray>, from: Int, sums: Array<DoubleArray>) {
        val count = minOf(STRETCH, n - from)
        for (k in 0 until size) {
            val column = columns[k]
            for (i in 0 until count) rows[i][k] = column[from + i]
        }
        for (i in count until STRETCH) rows[i].fill(0.0)
        for (i in 0 until count step AT_ONCE) {
            val first = rows[i]
            val second = rows[i + 1]
            val third = rows[i + 2]
            val fourth = rows[i + 3]
            for (a in 0 until size) products(sums[a], a, first, second, third, fourth)
        }
    }

    /**
     * Adds what column [a] of four rows is with the columns up to it. The compiler does several of them in one step
     * where each row is a parameter of its own.
     */
    private fun products(
        sum: DoubleArray,
        a: Int,
        first: DoubleArray,
        second: DoubleArray,
        third: DoubleArray,
        fourth: DoubleArray,
    ) {
        val w = first[a]
        val x = second[a]
        val y = third[a]
        val z = fourth[a]
        for (b in 0 until a + 1) sum[b] += w * first[b] + x * second[b] + y * third[b] + z * fourth[b]
    }

    /** Row [i] of R, length [size]; new. */
    fun row(i: Int): DoubleArray = DoubleArray(size) { columns[it][i] }

    /** Rᵀ [z], length [size]. */
    fun transposed(z: DoubleArray): DoubleArray {
        val out = DoubleArray(size)
        for (k in 0 until size step 4) {
            val a = columns[k]
            val b = columns[minOf(k + 1, size - 1)]
            val c = columns[minOf(k + 2, size - 1)]
            val d = columns[minOf(k + 3, size - 1)]
            var p = 0.0
            var q = 0.0
            var r = 0.0
            var s = 0.0
            for (i in 0 until n) {
                val w = z[i]
                p += a[i] * w
                q += b[i] * w
                r += c[i] * w
                s += d[i] * w
            }
            out[k] = p
            if (k + 1 < size) out[k + 1] = q
            if (k + 2 < size) out[k + 2] = r
            if (k + 3 < size) out[k + 3] = s
        }
        return out
    }

    /** R [beta], length n. */
    fun times(beta: DoubleArray): DoubleArray {
        val out = DoubleArray(n)
        for (k in 0 until size step 4) {
            val last = size - 1
            val a = columns[k]
            val b = columns[minOf(k + 1, last)]
            val c = columns[minOf(k + 2, last)]
            val d = columns[minOf(k + 3, last)]
            val p = beta[k]
            val q = if (k + 1 <= last) beta[k + 1] else 0.0
            val r = if (k + 2 <= last) beta[k + 2] else 0.0
            val s = if (k + 3 <= last) beta[k + 3] else 0.0
            for (i in 0 until n) out[i] += p * a[i] + q * b[i] + r * c[i] + s * d[i]
        }
        return out
    }

    private companion object {
        const val STRETCH = 64
        const val AT_ONCE = 4
    }
}
