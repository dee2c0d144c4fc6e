package stillwater.diagnose

import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.floor
import kotlin.math.hypot
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * The water where nobody knows it: values at the nodes of a grid around the track, a Gaussian process between them.
 *
 * A reading is y = Σ a β + e: a are the bilinear weights of the nodes along the track, as late as a dead time says and
 * seen through a lag; β ~ N(0, s² C) with C Matérn 3/2 of length ℓ; e is noise with correlation exp(−Δt/T). All
 * linear, so the likelihood with β integrated out costs one factorisation of the nodes' matrix.
 *
 * @property spacing side of the grid's cells, m.
 */
internal class UnknownField(val series: MeasuredSeries, val spacing: Double) {
    private val n = series.size
    private val nodes = HashMap<Long, Int>()
    private val places = ArrayList<DoubleArray>()

    init {
        for (i in 0 until n) weights(series.x[i], series.y[i], create = true) { _, _ -> }
    }

    /** Number of nodes. */
    val size: Int get() = places.size

    private inline fun weights(x: Double, y: Double, create: Boolean, take: (Int, Double) -> Unit) {
        val column = floor(x / spacing)
        val row = floor(y / spacing)
        val u = x / spacing - column
        val v = y / spacing - row
        for (k in 0 until 4) {
            val c = column + k % 2
            val r = row + k / 2
            val weight = (if (k % 2 == 0) 1 - u else u) * (if (k / 2 == 0) 1 - v else v)
            if (weight < 1e-9) continue
            val key = (c.toLong() shl 32) xor (r.toLong() and 0xffffffffL)
            val node = nodes[key] ?: if (create) {
                places += doubleArrayOf(c * spacing, r * spacing)
                (places.size - 1).also { nodes[key] = it }
            } else {
                -1
            }
            if (node >= 0) take(node, weight)
        }
    }

    /** Rows of the nodes' weights, whitened for noise of correlation time [noiseTime], s; 0 is white. */
    fun rows(response: BlindResponse, noiseTime: Double): NodeRows {
        val state = DoubleArray(size)
        val before = DoubleArray(size)
        val rows = NodeRows(n)
        val active = ArrayList<Int>()
        var cursor = 0
        for (i in 0 until n) {
            val dt = if (i == 0) 0.0 else series.times[i] - series.times[i - 1]
            val restart = i == 0 || dt > series.gap
            val fade = if (restart || response.timeConstant <= 0) 0.0 else exp(-dt / response.timeConstant)
            for (k in active) state[k] *= fade
            val wanted = series.times[i] - response.deadTime - dt / 2 * fade
            while (cursor < n - 2 && series.times[cursor + 1] < wanted) cursor++
            while (cursor > 0 && series.times[cursor] > wanted) cursor--
            val share = ((wanted - series.times[cursor]) / (series.times[cursor + 1] - series.times[cursor])).coerceIn(0.0, 1.0)
            val x = series.x[cursor] + share * (series.x[cursor + 1] - series.x[cursor])
            val y = series.y[cursor] + share * (series.y[cursor + 1] - series.y[cursor])
            weights(x, y, create = false) { node, weight ->
                if (state[node] == 0.0) active += node
                state[node] += (1 - fade) * weight
            }
            active.removeAll { k -> (abs(state[k]) < FAINT).also { if (it) state[k] = 0.0 } }
            rows.add(active, state, before, if (restart || noiseTime <= 0) 0.0 else exp(-dt / noiseTime))
        }
        return rows
    }

    /** The value of the field [beta] at each row's place, length n. */
    fun along(beta: DoubleArray): DoubleArray = DoubleArray(n) { i ->
        var sum = 0.0
        weights(series.x[i], series.y[i], create = false) { node, weight -> sum += weight * beta[node] }
        sum
    }

    /** The inverse of Matérn's correlation between the nodes for [length], m, and the logarithm of its determinant. */
    fun precision(length: Double): Pair<Array<DoubleArray>, Double> {
        val k = size
        val matrix = Array(k) { i ->
            DoubleArray(k) { j ->
                val r = sqrt(3.0) * hypot(places[i][0] - places[j][0], places[i][1] - places[j][1]) / length
                (1 + r) * exp(-r) + if (i == j) 1e-6 else 0.0
            }
        }
        val factor = DenseCholesky(matrix)
        return factor.inverse() to -factor.logDeterminant
    }

    private companion object {
        const val FAINT = 1e-4
    }
}

/** How a sensor is late: [deadTime] and [timeConstant], s, at least 0. */
internal data class BlindResponse(val timeConstant: Double, val deadTime: Double)

/** Sparse rows of a design matrix, whitened one after the other. */
internal class NodeRows(private val n: Int) {
    /** Columns of each row. */
    val columns = ArrayList<IntArray>(n)

    /** Their weights. */
    val weights = ArrayList<DoubleArray>(n)

    /** Correlation with the row before. */
    val carried = DoubleArray(n)
    private var last = IntArray(0)

    /** Adds the row [state] at [active], less [correlation] times the row [before], which is left as [state]. */
    fun add(active: List<Int>, state: DoubleArray, before: DoubleArray, correlation: Double) {
        val all = (active + last.toList()).distinct().toIntArray()
        val scale = 1 / sqrt(1 - correlation * correlation)
        carried[columns.size] = correlation
        columns += all
        weights += DoubleArray(all.size) { (state[all[it]] - correlation * before[all[it]]) * scale }
        for (k in last) before[k] = 0.0
        for (k in active) before[k] = state[k]
        last = active.toIntArray()
    }

    /** [column] whitened as the rows are. */
    fun whiten(column: DoubleArray) = DoubleArray(n) { i ->
        val c = carried[i]
        if (c == 0.0) column[i] else (column[i] - c * column[i - 1]) / sqrt(1 - c * c)
    }

    /** Undoes [whiten]. */
    fun coloured(column: DoubleArray): DoubleArray {
        val out = DoubleArray(n)
        for (i in 0 until n) {
            val c = carried[i]
            out[i] = if (c == 0.0) column[i] else column[i] * sqrt(1 - c * c) + c * out[i - 1]
        }
        return out
    }

    /** Logarithm of the determinant of the whitening. */
    val logScale: Double get() = carried.sumOf { -0.5 * ln(1 - it * it) }

    /** Rowsᵀ [z] over [size] nodes. */
    fun transposed(z: DoubleArray, size: Int): DoubleArray {
        val out = DoubleArray(size)
        for (i in 0 until n) {
            val c = columns[i]
            val w = weights[i]
            for (k in c.indices) out[c[k]] += w[k] * z[i]
        }
        return out
    }

    /** Rows [beta]. */
    fun times(beta: DoubleArray) = DoubleArray(n) { i ->
        val c = columns[i]
        val w = weights[i]
        var sum = 0.0
        for (k in c.indices) sum += w[k] * beta[c[k]]
        sum
    }

    /** Adds RowsᵀRows to the lower half of [matrix]. */
    fun addSquare(matrix: Array<DoubleArray>) {
        for (i in 0 until n) {
            val c = columns[i]
            val w = weights[i]
            for (k in c.indices) {
                val target = matrix[c[k]]
                for (l in c.indices) if (c[l] <= c[k]) target[c[l]] += w[k] * w[l]
            }
        }
    }
}

/** L with L Lᵀ = [matrix], of which the lower half is read and replaced. Modified. */
internal class DenseCholesky(private val matrix: Array<DoubleArray>) {
    private val n = matrix.size

    /** Logarithm of the determinant. */
    val logDeterminant: Double

    init {
        var sum = 0.0
        for (i in 0 until n) {
            val row = matrix[i]
            for (j in 0..i) {
                val other = matrix[j]
                var value = row[j]
                for (k in 0 until j) value -= row[k] * other[k]
                row[j] = if (i == j) sqrt(maxOf(value, 1e-12)) else value / other[j]
            }
            sum += 2 * ln(row[i])
        }
        logDeterminant = sum
    }

    /** L⁻¹ [right]; new. */
    fun half(right: DoubleArray): DoubleArray {
        val out = right.copyOf()
        for (i in 0 until n) {
            var value = out[i]
            val row = matrix[i]
            for (k in 0 until i) value -= row[k] * out[k]
            out[i] = value / row[i]
        }
        return out
    }

    /** L⁻ᵀ [right]; new. */
    fun back(right: DoubleArray): DoubleArray {
        val out = right.copyOf()
        for (i in n - 1 downTo 0) {
            out[i] /= matrix[i][i]
            val row = matrix[i]
            for (k in 0 until i) out[k] -= row[k] * out[i]
        }
        return out
    }

    /** The inverse of what was factorised. */
    fun inverse(): Array<DoubleArray> {
        val columns = Array(n) { k -> back(half(DoubleArray(n) { if (it == k) 1.0 else 0.0 })) }
        return Array(n) { i -> DoubleArray(n) { j -> columns[j][i] } }
    }
}
