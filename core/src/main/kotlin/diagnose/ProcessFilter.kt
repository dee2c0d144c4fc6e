package stillwater.diagnose

import kotlin.math.ln
import kotlin.math.sqrt

/**
 * The Kalman filter of a sum of up to four independent Gauss-Markov processes and white noise, whose gains do not depend on
 * the data: with the innovations over their deviations it whitens, at O(n) a column.
 *
 * @param white variance of the white part of each row. @param used rows that are not passed over. @param processes at most
 *   four.
 */
internal class ProcessFilter(white: Double, private val used: BooleanArray, processes: List<Process>) {
    /**
     * A process that is [first] in variance before the log, of which [keep] stays from the row before, that grows by
     * [added] in variance before each row, and of which a row shows [seen] times as much; null for all of it.
     */
    class Process(val keep: DoubleArray, val added: DoubleArray, val first: Double, val seen: DoubleArray? = null)

    private val n = used.size
    private val scale = DoubleArray(n)
    private val keeps = List(MOST) { k -> processes.getOrNull(k)?.keep ?: DoubleArray(n) }
    private val seens = List(MOST) { k -> processes.getOrNull(k)?.let { it.seen ?: ones() } ?: DoubleArray(n) }
    private val gains = List(MOST) { DoubleArray(n) }

    private val isTwo = processes.size <= 2

    private fun ones() = DoubleArray(n) { 1.0 }

    /** Sum over the rows in use of ln of the innovation's variance. */
    val logDeterminant: Double

    init {
        require(processes.size <= MOST) { "expected at most $MOST processes, found ${processes.size}" }
        val count = processes.size
        val variance = Array(count) { a -> DoubleArray(count) { b -> if (a == b) processes[a].first else 0.0 } }
        val common = DoubleArray(count)
        var sum = 0.0
        for (i in 0 until n) {
            for (a in 0 until count) {
                for (b in 0 until count) variance[a][b] *= keeps[a][i] * keeps[b][i]
                variance[a][a] += processes[a].added[i]
            }
            if (!used[i]) continue
            var innovation = white
            for (a in 0 until count) {
                common[a] = 0.0
                for (b in 0 until count) common[a] += variance[a][b] * seens[b][i]
                innovation += seens[a][i] * common[a]
            }
            for (a in 0 until count) {
                gains[a][i] = common[a] / innovation
                for (b in 0 until count) variance[a][b] -= gains[a][i] * common[b]
            }
            scale[i] = 1 / sqrt(innovation)
            sum += ln(innovation)
        }
        logDeterminant = sum
    }

    private val keepA = keeps[0]
    private val keepB = keeps[1]
    private val keepC = keeps[2]
    private val keepD = keeps[3]
    private val seenA = seens[0]
    private val seenB = seens[1]
    private val seenC = seens[2]
    private val seenD = seens[3]
    private val gainA = gains[0]
    private val gainB = gains[1]
    private val gainC = gains[2]
    private val gainD = gains[3]

    /** The mean over [rows] rows in use of [share] over the innovation's variance. */
    fun fresh(share: Double, rows: Int): Double = share * squares(scale) / maxOf(rows, 1)

    /** Whitens [column] into [out], which may be the same, both of length n; rows not in use become 0. */
    fun whiten(column: DoubleArray, out: DoubleArray) {
        if (isTwo) return whitenTwo(column, out)
        var a = 0.0
        var b = 0.0
        var c = 0.0
        var d = 0.0
        for (i in column.indices) {
            a *= keepA[i]
            b *= keepB[i]
            c *= keepC[i]
            d *= keepD[i]
            if (used[i]) {
                val innovation = column[i] - (seenA[i] * a + seenB[i] * b) - (seenC[i] * c + seenD[i] * d)
                out[i] = innovation * scale[i]
                a += gainA[i] * innovation
                b += gainB[i] * innovation
                c += gainC[i] * innovation
                d += gainD[i] * innovation
            } else {
                out[i] = 0.0
            }
        }
    }

    private fun whitenTwo(column: DoubleArray, out: DoubleArray) {
        var a = 0.0
        var b = 0.0
        for (i in column.indices) {
            a *= keepA[i]
            b *= keepB[i]
            if (used[i]) {
                val innovation = column[i] - seenA[i] * a - seenB[i] * b
                out[i] = innovation * scale[i]
                a += gainA[i] * innovation
                b += gainB[i] * innovation
            } else {
                out[i] = 0.0
            }
        }
    }

    /** Writes Wᵀ [whitened] into [out], which may be the same, where whitening is W. */
    fun turned(whitened: DoubleArray, out: DoubleArray) {
        var a = 0.0
        var b = 0.0
        var c = 0.0
        var d = 0.0
        for (i in whitened.indices.reversed()) {
            val own = if (used[i]) {
                gainA[i] * a + gainB[i] * b + (gainC[i] * c + gainD[i] * d) + scale[i] * whitened[i]
            } else {
                0.0
            }
            out[i] = own
            a = keepA[i] * (a - seenA[i] * own)
            b = keepB[i] * (b - seenB[i] * own)
            c = keepC[i] * (c - seenC[i] * own)
            d = keepD[i] * (d - seenD[i] * own)
        }
    }

    private companion object {
        const val MOST = 4
    }
}
