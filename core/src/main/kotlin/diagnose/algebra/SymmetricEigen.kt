package stillwater.diagnose.algebra

import stillwater.diagnose.Loops
import kotlin.math.abs
import kotlin.math.hypot
import kotlin.math.sqrt

/**
 * Eigenvalues and eigenvectors of a symmetric matrix of some hundred rows.
 *
 * Reflections leave a band of three diagonals, whose rotations are noted and then done to the vectors in stretches of
 * columns: what runs along a row is done several columns in a step, and a stretch of all rows stays in the processor's
 * cache.
 *
 * Source: Golub and Van Loan 2013, Matrix Computations, sections 8.3.1 and 8.3.2 (symmetric QR with Wilkinson's shift).
 *
 * @param matrix all elements, row by row; modified. @param loops how the stretches are gone through.
 */
internal class SymmetricEigen(private val matrix: Array<DoubleArray>, private val loops: Loops = Loops.IN_TURN) {
    private val n = matrix.size

    /** The eigenvalues, in no order. */
    val values = DoubleArray(n)

    /** The eigenvector of length one of each. */
    val vectors: Array<DoubleArray>
    private val beside = DoubleArray(n)

    /** Rotations of a vector and the next that were noted, and are not done to the vectors yet. */
    private val first = IntArray(NOTED)
    private val cosine = DoubleArray(NOTED)
    private val sine = DoubleArray(NOTED)
    private var noted = 0

    init {
        val reflections = List(maxOf(n - 2, 0), ::reflected)
        for (i in maxOf(n - 2, 0) until n) values[i] = matrix[i][i]
        if (n > 1) beside[n - 2] = matrix[n - 1][n - 2]
        vectors = transposed(product(reflections))
        diagonalised()
    }

    /** Has all below the diagonal's neighbour in column [k] vanish; returns √2 times the reflection's unit vector. */
    private fun reflected(k: Int): DoubleArray {
        values[k] = matrix[k][k]
        val v = DoubleArray(n) { if (it > k) matrix[it][k] else 0.0 }
        val length = sqrt(squares(v))
        beside[k] = if (v[k + 1] > 0) -length else length
        v[k + 1] -= beside[k]
        val size = sqrt(squares(v) / 2)
        if (!(size > 0)) return DoubleArray(n)
        for (i in k + 1 until n) v[i] /= size
        // With w = A v − v (vᵀA v)/2 the reflected matrix is A − v wᵀ − w vᵀ.
        val w = DoubleArray(n)
        added(matrix, v, w, k + 1)
        val half = dot(v, w) / 2
        for (i in k + 1 until n) w[i] -= half * v[i]
        for (i in k + 1 until n) subtract(matrix[i], v, w[i], w, v[i], k + 1)
        return v
    }

    /** Adds the rows of [rows] from [from] on, times [heights], to [out], from column [from] on. */
    private fun added(rows: Array<DoubleArray>, heights: DoubleArray, out: DoubleArray, from: Int) {
        var k = from
        while (k + 3 < n) {
            FourColumns(rows[k], rows[k + 1], rows[k + 2], rows[k + 3])
                .add(out, from, n, heights[k], heights[k + 1], heights[k + 2], heights[k + 3])
            k += 4
        }
        while (k < n) {
            val row = rows[k]
            val height = heights[k++]
            for (i in from until n) out[i] += height * row[i]
        }
    }

    private fun subtract(
        row: DoubleArray,
        one: DoubleArray,
        height: Double,
        two: DoubleArray,
        other: Double,
        from: Int,
    ) {
        for (i in from until n) row[i] -= height * one[i] + other * two[i]
    }

    /** The product of all [reflections], row by row. */
    private fun product(reflections: List<DoubleArray>): Array<DoubleArray> {
        val out = Array(n) { i -> DoubleArray(n).also { it[i] = 1.0 } }
        val along = DoubleArray(n)
        for (k in reflections.indices.reversed()) {
            val v = reflections[k]
            along.fill(0.0)
            added(out, v, along, k + 1)
            for (i in k + 1 until n) {
                val row = out[i]
                val height = v[i]
                for (j in k + 1 until n) row[j] -= height * along[j]
            }
        }
        return out
    }

    private fun transposed(rows: Array<DoubleArray>) = Array(n) { i -> DoubleArray(n) { rows[it][i] } }

    private fun diagonalised() {
        var last = n - 1
        var sweeps = 0
        while (last > 0) {
            if (isSmall(last - 1)) {
                beside[--last] = 0.0
                continue
            }
            var from = last - 1
            while (from > 0 && !isSmall(from - 1)) from--
            check(sweeps++ < MOST_SWEEPS * n) { "the eigenvalues of a matrix of $n rows were not found" }
            swept(from, last)
        }
        rotated()
    }

    private fun isSmall(k: Int) = abs(beside[k]) <= SMALL * (abs(values[k]) + abs(values[k + 1]))

    /** Chases the bulge of one shifted step through the rows [from] to [last]. */
    private fun swept(from: Int, last: Int) {
        val half = (values[last - 1] - values[last]) / 2
        val side = beside[last - 1]
        val reach = hypot(half, side)
        val shift = values[last] - side * side / (half + if (half < 0) -reach else reach)
        var x = values[from] - shift
        var z = beside[from]
        for (k in from until last) {
            val length = hypot(x, z)
            val c = if (length > 0) x / length else 1.0
            val s = if (length > 0) z / length else 0.0
            if (k > from) beside[k - 1] = length
            val a = values[k]
            val b = beside[k]
            val d = values[k + 1]
            values[k] = c * c * a + 2 * c * s * b + s * s * d
            values[k + 1] = s * s * a - 2 * c * s * b + c * c * d
            beside[k] = c * s * (d - a) + (c * c - s * s) * b
            if (k + 1 < last) {
                x = beside[k]
                z = s * beside[k + 1]
                beside[k + 1] *= c
            }
            note(k, c, s)
        }
    }

    private fun note(k: Int, c: Double, s: Double) {
        if (noted == NOTED) rotated()
        first[noted] = k
        cosine[noted] = c
        sine[noted++] = s
    }

    private fun rotated() {
        loops.each((n + STRETCH - 1) / STRETCH) { stretch ->
            val from = stretch * STRETCH
            val to = minOf(from + STRETCH, n)
            for (i in 0 until noted) rotate(vectors[first[i]], vectors[first[i] + 1], cosine[i], sine[i], from, to)
        }
        noted = 0
    }

    private fun rotate(one: DoubleArray, two: DoubleArray, c: Double, s: Double, from: Int, to: Int) {
        for (j in from until to) {
            val a = one[j]
            val b = two[j]
            one[j] = c * a + s * b
            two[j] = c * b - s * a
        }
    }

    private companion object {
        const val NOTED = 32_768
        const val STRETCH = 64
        const val MOST_SWEEPS = 60
        const val SMALL = 1.1e-16
    }
}
