package stillwater.diagnose

import org.hipparchus.special.Erf
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln

/**
 * Where jumps of the readings would explain most of what [state] leaves, [z] whitened.
 *
 * Looked at are even places and the rows that surprise most: under noise that wanders a jump shows at its own row
 * alone.
 */
internal class BlindJumps(private val state: BlindState, private val z: DoubleArray) {
    private val times = state.model.series.times
    private val duration = state.model.series.duration
    private val n = z.size
    private val stride = maxOf(n / PLACES, 1)
    private val edge = JumpPlaces.edge(n)
    private val striking by lazy { (edge until n - edge).sortedByDescending { abs(z[it]) }.take(STRIKING) }

    /**
     * How many places a jump may be at: rows next to each other count as far as they can be told apart. No fewer than
     * the even places, by which a drift is less often taken for the best of many jumps.
     */
    private val count: Double by lazy {
        val scan = JumpScan.of(n, edge, LOOKED) { rows ->
            val looked = known((rows + rows.map { it + 1 }).distinct().sorted())
            rows.map { row ->
                val one = looked.getValue(row)
                val next = looked.getValue(row + 1)
                JumpScan.angle(one.length, next.length, one.product(next))
            }
        }
        maxOf(scan.single(CLEAR) / Evidence.pValue(CLEAR, 1), minOf(PLACES, n / 10).toDouble())
    }

    /** What the best of all places gains by chance, for [jumps] jumps. */
    fun searched(jumps: Int): Double = if (jumps == 0) 0.0 else jumps * 2 * ln(count)

    /**
     * The best place, s after the first row, and what is unlike water of a jump there, where [rest] is to be explained;
     * not near those [taken]. Null where there is no room.
     */
    fun best(rest: DoubleArray, taken: List<Double>): Pair<Double, DoubleArray>? {
        val explained = BlindJump.Rest(state.fit, rest)

        fun best(rows: List<Int>): Int? {
            val jumps = known(rows.sorted())
            return rows.maxByOrNull { row ->
                val jump = jumps.getValue(row)
                jump.product(explained).let { it * it } / maxOf(jump.length, LEAST)
            }
        }

        fun isFree(row: Int) = taken.all { abs(it - (times[row] - times[0])) > duration / PLACES }
        val rows = ((edge until n - edge step stride) + striking).distinct().filter(::isFree)
        var row = best(rows) ?: return null
        var reach = stride
        while (reach > 0) {
            val step = maxOf(reach / FINER, 1)
            val near = (maxOf(row - reach, edge)..minOf(row + reach, n - edge - 1)) step step
            row = checkNotNull(best((near.filter(::isFree) + row).distinct()))
            reach = if (step > 1) step else 0
        }
        return (times[row] + times[row - 1]) / 2 - times[0] to column(row)
    }

    private val found = HashMap<Int, BlindJump>()

    /** Jumps at [rows], which ascend; each is found once. */
    @Synchronized
    private fun known(rows: List<Int>): Map<Int, BlindJump> {
        val new = rows.filter { it !in found }
        if (new.isNotEmpty()) state.fit.jumps(new).forEachIndexed { k, jump -> found[new[k]] = jump }
        return rows.associateWith(found::getValue)
    }

    private fun column(row: Int) = state.fit.unlike(DoubleArray(n) { if (it >= row) 1.0 else 0.0 })

    companion object {
        private const val PLACES = 48
        private const val STRIKING = 40
        private const val LOOKED = 24
        private const val FINER = 6
        private const val LEAST = 1e-9

        /** Twice a gain in log-likelihood about where jumps are told from chance. */
        private const val CLEAR = 20.0

        /** Ranks of the rows that tell how heavy the tails are; the farthest of all may be an effect. */
        private val RANKS = 2..40

        /**
         * By how much a [gain], twice that in log-likelihood, is larger than under normal noise one as unlikely is, at
         * least 1, where [z] is left: a line through the squares of the rows that surprise most, over normal ones, in
         * logarithms, and no less than any of these rows is larger.
         */
        fun tails(z: DoubleArray, gain: Double): Double {
            val used = z.filter { it != 0.0 }
            val variance = used.sumOf { it * it } / maxOf(used.size, 1)
            if (used.size < FEWEST || !(variance > 0) || !(gain > 0)) return 1.0
            val sorted = used.map { it * it / variance }.sortedDescending()
            val found = RANKS.map { ln(maxOf(sorted[it - 1], LEAST)) }
            val normal = RANKS.map { rank -> ln(2.0) + 2 * ln(Erf.erfcInv((rank - 0.5) / used.size)) }
            val middle = normal.average()
            val steepness = normal.indices.sumOf { (normal[it] - middle) * found[it] } /
                normal.sumOf { (it - middle) * (it - middle) }
            val slope = maxOf(steepness, 1.0)
            val asNormal = exp((ln(gain) - found.average()) / slope + middle)
            val larger = normal.indices.maxOf { exp(found[it] - normal[it]) }
            return maxOf(gain / asNormal, larger, 1.0)
        }

        private const val FEWEST = 60
    }
}
