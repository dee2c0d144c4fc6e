package stillwater.diagnose.blind

import stillwater.diagnose.Loops
import stillwater.diagnose.algebra.Combination
import stillwater.diagnose.algebra.FourColumns
import stillwater.diagnose.algebra.dot

/**
 * The waves as the sensor shows them, whitened, and their normal equations: all that is needed to integrate the water
 * out.
 *
 * May be used on several threads at once.
 *
 * @property size number of columns. @property noise what whitens. @property loops how the columns and the halves of the
 *   sums are gone through. @param memory keeps the columns for as long as there is room. @param write writes the
 *   columns of R, flat-prior columns last; the same each time.
 */
internal class BlindDesign(
    val size: Int,
    val noise: BlindNoise,
    val loops: Loops,
    private val memory: BlindMemory,
    private val write: (List<DoubleArray>) -> Unit,
) {
    private val n = noise.spread.size

    /** What [task] makes of the columns of R, which are found again where they are not in memory. */
    private inline fun <T> ofColumns(task: (List<DoubleArray>) -> T): T {
        val columns = columns()
        try {
            return task(columns)
        } finally {
            memory.left(this, columns)
        }
    }

    @Synchronized
    private fun columns(): List<DoubleArray> =
        memory.taken(this) ?: memory.space(this).also {
            write(it)
            memory.keep(this, it)
        }

    /** The lower half of RᵀR, row by row. */
    val gram: Array<DoubleArray> = Array(size) { DoubleArray(it + 1) }

    init {
        val count = (n + STRETCH - 1) / STRETCH
        val halves = arrayOf(0 until count / 2, count / 2 until count)
        val parts = arrayOf(gram, Array(size) { DoubleArray(it + 1) })
        ofColumns { columns ->
            loops.each(halves.size) { half ->
                val rows = Array(STRETCH) { DoubleArray(size) }
                for (stretch in halves[half]) add(columns, rows, stretch * STRETCH, parts[half])
            }
        }
        for (a in 0 until size) for (b in 0..a) gram[a][b] += parts[1][a][b]
    }

    /** Adds the products of the rows that begin at [from], which are put into [rows] first, to [sums]. */
    private fun add(columns: List<DoubleArray>, rows: Array<DoubleArray>, from: Int, sums: Array<DoubleArray>) {
        val count = minOf(STRETCH, n - from)
        for (k in 0 until size) {
            val column = columns[k]
            for (i in 0 until count) rows[i][k] = column[from + i]
        }
        for (i in count until STRETCH) rows[i].fill(0.0)
        // So many sums stay in the processor's cache while all rows are added to them.
        for (some in 0 until size step SUMS) {
            for (i in 0 until count step AT_ONCE) add(rows, i, sums, some, minOf(some + SUMS, size))
        }
    }

    /** Adds the products of the four [rows] from [i] on to the [sums] from [start] until [end]. */
    private fun add(rows: Array<DoubleArray>, i: Int, sums: Array<DoubleArray>, start: Int, end: Int) {
        val first = rows[i]
        val second = rows[i + 1]
        val third = rows[i + 2]
        val fourth = rows[i + 3]
        val four = FourColumns(first, second, third, fourth)
        for (a in start until end) four.add(sums[a], 0, a + 1, first[a], second[a], third[a], fourth[a])
    }

    /** The rows [from] until [to] of R, column by column; new. */
    fun rows(from: Int, to: Int): Array<DoubleArray> =
        ofColumns { all -> Array(size) { all[it].copyOfRange(from, to) } }

    /** Rᵀ of jumps of one unit at each of [rows], which stay, whitened; rows ascend. */
    fun jumps(rows: List<Int>): List<DoubleArray> {
        val out = rows.map { DoubleArray(size) }
        ofColumns { columns ->
            loops.each(HALVES) { half ->
                val all = DoubleArray(n)
                for (k in half * size / HALVES until (half + 1) * size / HALVES) {
                    noise.jumps(columns[k], all)
                    for (j in rows.indices) out[j][k] = all[rows[j]]
                }
            }
        }
        return out
    }

    private class Product(val right: DoubleArray, val transposed: DoubleArray)

    @Volatile
    private var last: Product? = null

    /** Rᵀ [z], length [size]; new. Of what was asked for last it is known: often the same residuals come again. */
    fun transposed(z: DoubleArray): DoubleArray {
        val known = last?.takeIf { z.contentEquals(it.right) } ?: Product(z.copyOf(), products(z)).also { last = it }
        return known.transposed.copyOf()
    }

    /** Rᵀ of each of [all], new: two of them together, so that the columns are gone through half as often. */
    fun transposed(all: List<DoubleArray>): List<DoubleArray> {
        val out = all.map { DoubleArray(size) }
        val pairs = all.size / 2
        ofColumns { columns ->
            loops.each(HALVES) { half ->
                for (pair in 0 until pairs) {
                    val one = 2 * pair
                    for (k in half * size / HALVES until (half + 1) * size / HALVES step PAIRED) {
                        val end = minOf(k + PAIRED, (half + 1) * size / HALVES)
                        dots(columns, k, end, all[one], all[one + 1], out[one], out[one + 1])
                    }
                }
            }
        }
        if (all.size % 2 == 1) products(all.last()).copyInto(out.last())
        return out
    }

    /** What [y] and [z] are with four columns from [k] on, or with those before [end] where they are fewer. */
    private fun dots(
        columns: List<DoubleArray>,
        k: Int,
        end: Int,
        y: DoubleArray,
        z: DoubleArray,
        ofY: DoubleArray,
        ofZ: DoubleArray,
    ) {
        if (k + PAIRED > end) {
            for (j in k until end) {
                ofY[j] = dot(columns[j], y)
                ofZ[j] = dot(columns[j], z)
            }
            return
        }
        val a = columns[k]
        val b = columns[k + 1]
        val c = columns[k + 2]
        val d = columns[k + 3]
        var p = 0.0
        var q = 0.0
        var r = 0.0
        var s = 0.0
        var t = 0.0
        var u = 0.0
        var v = 0.0
        var w = 0.0
        for (i in 0 until n) {
            val one = y[i]
            val two = z[i]
            p += a[i] * one
            q += b[i] * one
            r += c[i] * one
            s += d[i] * one
            t += a[i] * two
            u += b[i] * two
            v += c[i] * two
            w += d[i] * two
        }
        ofY[k] = p
        ofY[k + 1] = q
        ofY[k + 2] = r
        ofY[k + 3] = s
        ofZ[k] = t
        ofZ[k + 1] = u
        ofZ[k + 2] = v
        ofZ[k + 3] = w
    }

    private fun products(z: DoubleArray): DoubleArray {
        val out = DoubleArray(size)
        val groups = (size + TOGETHER - 1) / TOGETHER
        ofColumns { columns ->
            loops.each(HALVES) { half ->
                val own = half * groups / HALVES until (half + 1) * groups / HALVES
                for (group in own) dots(columns, group * TOGETHER, z, out)
            }
        }
        return out
    }

    /** What [z] is with eight columns from [k] on: each sum waits for its own row before alone. */
    private fun dots(columns: List<DoubleArray>, k: Int, z: DoubleArray, out: DoubleArray) {
        if (k + TOGETHER > size) {
            for (j in k until size) out[j] = dot(columns[j], z)
            return
        }
        val a = columns[k]
        val b = columns[k + 1]
        val c = columns[k + 2]
        val d = columns[k + 3]
        val e = columns[k + 4]
        val f = columns[k + 5]
        val g = columns[k + 6]
        val h = columns[k + 7]
        var p = 0.0
        var q = 0.0
        var r = 0.0
        var s = 0.0
        var t = 0.0
        var u = 0.0
        var v = 0.0
        var w = 0.0
        for (i in 0 until n) {
            val height = z[i]
            p += a[i] * height
            q += b[i] * height
            r += c[i] * height
            s += d[i] * height
            t += e[i] * height
            u += f[i] * height
            v += g[i] * height
            w += h[i] * height
        }
        out[k] = p
        out[k + 1] = q
        out[k + 2] = r
        out[k + 3] = s
        out[k + 4] = t
        out[k + 5] = u
        out[k + 6] = v
        out[k + 7] = w
    }

    /** R [beta], length n. */
    fun times(beta: DoubleArray): DoubleArray = ofColumns { Combination.of(it, beta, n, loops) }

    /** The same of each of [betas]. */
    fun times(betas: Array<DoubleArray>): Array<DoubleArray> = ofColumns { Combination.of(it, betas, n, loops) }

    private companion object {
        const val STRETCH = 64
        const val AT_ONCE = 4
        const val SUMS = 12

        /** Parts of the work that may be done at the same time. */
        const val HALVES = 2
        const val TOGETHER = 8
        const val PAIRED = 4
    }
}
