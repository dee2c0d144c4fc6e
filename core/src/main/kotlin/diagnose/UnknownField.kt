package stillwater.diagnose

import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.hypot
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * The water where nobody knows it: its values at nodes along the track, a Gaussian process in place and time.
 *
 * A reading is y = Σ a β + e: a are the weights of the two nodes beside a moment, as late as a dead time says and seen
 * through a lag; β ~ N(0, s² C) with C Matérn 3/2 of r, r² = (Δx² + Δy²)/ℓ² + Δt²/T²; e is noise whose correlation
 * fades.
 * All linear, so the likelihood with β integrated out costs one factorisation of the nodes' matrix. Passes over the
 * same
 * water are tied by C.
 */
internal class UnknownField(val series: MeasuredSeries, most: Int) {
    private val n = series.size
    private val stride = maxOf(1, (n + most - 1) / most)

    /** Number of nodes: every few rows, and the last. */
    val size: Int = if ((n - 1) % stride == 0) (n - 1) / stride + 1 else (n - 1) / stride + 2
    private val at = IntArray(size) { minOf(it * stride, n - 1) }
    private val times = DoubleArray(size) { series.times[at[it]] }
    private val x = smooth(series.x)
    private val y = smooth(series.y)

    /** Usual distance between neighbouring nodes, m. */
    val spacing: Double = median(DoubleArray(size - 1) { hypot(x[it + 1] - x[it], y[it + 1] - y[it]) })

    /** Positions at the nodes as means over the rows around them: fixes jitter. */
    private fun smooth(column: DoubleArray) = DoubleArray(size) { k ->
        val reach = minOf(stride / 2 + 1, at[k], n - 1 - at[k])
        var sum = 0.0
        for (i in at[k] - reach..at[k] + reach) sum += column[i]
        sum / (2 * reach + 1)
    }

    /** Rows of the nodes' weights, whitened for noise of correlation time [noiseTime], s; 0 is white. */
    fun rows(response: BlindResponse, noiseTime: Double): NodeRows {
        val state = DoubleArray(size)
        val before = DoubleArray(size)
        val rows = NodeRows(n)
        val active = ArrayList<Int>()
        var node = 0
        for (i in 0 until n) {
            val dt = if (i == 0) 0.0 else series.times[i] - series.times[i - 1]
            val restart = i == 0 || dt > series.gap
            val fade = if (restart || response.timeConstant <= 0) 0.0 else exp(-dt / response.timeConstant)
            for (k in active) state[k] *= fade
            val wanted = series.times[i] - response.deadTime - dt / 2 * fade
            while (node < size - 2 && times[node + 1] < wanted) node++
            while (node > 0 && times[node] > wanted) node--
            val share = ((wanted - times[node]) / (times[node + 1] - times[node])).coerceIn(0.0, 1.0)
            for (side in 0..1) {
                val weight = (1 - fade) * if (side == 0) 1 - share else share
                if (weight <= 0) continue
                if (state[node + side] == 0.0) active += node + side
                state[node + side] += weight
            }
            active.removeAll { k -> (abs(state[k]) < FAINT).also { if (it) state[k] = 0.0 } }
            rows.add(active, state, before, if (restart || noiseTime <= 0) 0.0 else exp(-dt / noiseTime))
        }
        return rows
    }

    /** The value of the field [beta] at each row, length n. */
    fun along(beta: DoubleArray): DoubleArray {
        var node = 0
        return DoubleArray(n) { i ->
            while (node < size - 2 && times[node + 1] < series.times[i]) node++
            val share = (series.times[i] - times[node]) / (times[node + 1] - times[node])
            (1 - share) * beta[node] + share * beta[node + 1]
        }
    }

    /**
     * The inverse of Matérn's correlation between the nodes for [length], m, and [duration], s, and the logarithm of
     * its
     * determinant.
     */
    fun precision(length: Double, duration: Double): Pair<Array<DoubleArray>, Double> {
        val matrix = Array(size) { i ->
            DoubleArray(size) { j ->
                val away = hypot(x[i] - x[j], y[i] - y[j]) / length
                val later = (times[i] - times[j]) / duration
                val r = sqrt(3.0) * hypot(away, later)
                (1 + r) * exp(-r) + if (i == j) 1e-5 else 0.0
            }
        }
        val factor = DenseCholesky(matrix)
        return factor.inverse() to -factor.logDeterminant
    }

    private companion object {
        const val FAINT = 1e-3
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

    /** Adds [times] RowsᵀRows, of the rows for which [use] holds, to the lower half of [matrix]. */
    inline fun addSquare(matrix: Array<DoubleArray>, times: Double = 1.0, use: (Int) -> Boolean = { true }) {
        for (i in columns.indices) {
            if (!use(i)) continue
            val c = columns[i]
            val w = weights[i]
            for (k in c.indices) {
                val target = matrix[c[k]]
                for (l in c.indices) if (c[l] <= c[k]) target[c[l]] += times * w[k] * w[l]
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
