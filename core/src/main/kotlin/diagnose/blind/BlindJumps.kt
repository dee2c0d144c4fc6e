package stillwater.diagnose.blind

import org.hipparchus.special.Erf
import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.evidence.JumpPairs
import stillwater.diagnose.evidence.JumpPlaces
import stillwater.diagnose.evidence.JumpScan
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

    /** Rows that are looked at first, which ascend. */
    private val rows: List<Int> by lazy {
        val striking = (edge until n - edge).sortedByDescending { abs(z[it]) }.take(STRIKING)
        ((edge until n - edge step stride) + striking).distinct().sorted()
    }

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
     * The best place, s after the first row, beside jumps at those [taken], and not near these, where [rest] is to be
     * explained. It is looked for about [now], too, if there is one. Null where there is no room.
     */
    fun best(rest: DoubleArray, taken: List<Double>, now: Double? = null): Double? {
        val others = Evidence.orthonormal(taken.map(::column))
        val explained = BlindJump.Rest(state.fit, Evidence.without(rest, others))
        val beside = others.map { BlindJump.Rest(state.fit, it) }

        fun gains(rows: List<Int>): Map<Int, Double> {
            val jumps = known(rows.sorted())
            return rows.associateWith { row ->
                val jump = jumps.getValue(row)
                val length = jump.length - beside.sumOf { other -> jump.product(other).let { it * it } }
                jump.product(explained).let { it * it } / maxOf(length, LEAST)
            }
        }

        fun isFree(row: Int) = taken.all { abs(it - (times[row] - times[0])) > duration / PLACES }
        val own = listOfNotNull(now).map { time -> (edge until n - edge).first { times[it] - times[0] > time } }
        val gains = gains((rows + own).distinct().filter(::isFree))
        // Where one is the best of those looked at, another may be nearer to a better one.
        val begun = ArrayList<Int>()
        for ((row, _) in gains.entries.sortedByDescending { it.value }) {
            if (begun.size < BEGUN && begun.none { abs(it - row) < stride }) begun += row
        }
        val refined = begun.map { row ->
            refined(row) { near -> gains(near.filter(::isFree)).maxByOrNull { it.value }?.key }
        }
        return gains(refined.distinct()).maxByOrNull { it.value }?.let { timeBefore(it.key) }
    }

    /**
     * The best places of two jumps, s after the first row, where [rest] is to be explained: of two that undo each other
     * passes contradict either by itself. Null where there is no room.
     */
    fun pair(rest: DoubleArray): List<Double>? {
        val explained = BlindJump.Rest(state.fit, rest)
        val all = known(rows)
        val jumps = rows.map(all::getValue)
        val shares = DoubleArray(rows.size) { jumps[it].product(explained) }
        val lengths = DoubleArray(rows.size) { jumps[it].length }
        val products = jumps.map { it.products(jumps) }
        val (first, second) = JumpPairs.best(rows, edge, shares, lengths) { i, j -> products[i][j] } ?: return null
        return moved(rest, listOf(timeBefore(first), timeBefore(second)))
    }

    /** Jumps at [taken], s after the first row, each moved to where it is best beside the others to explain [rest]. */
    fun moved(rest: DoubleArray, taken: List<Double>): List<Double> {
        val moved = taken.toMutableList()
        for (k in moved.indices) moved[k] = best(rest, moved - moved[k], moved[k]) ?: moved[k]
        return moved
    }

    /** [row], moved to where it is the best of those near it, as [best] tells of rows that ascend. */
    private fun refined(row: Int, best: (List<Int>) -> Int?): Int {
        var now = row
        var reach = stride
        while (reach > 0) {
            val step = maxOf(reach / FINER, 1)
            val near = (maxOf(now - reach, edge)..minOf(now + reach, n - edge - 1)) step step
            now = best((near + now).distinct().sorted()) ?: now
            reach = if (step > 1) step else 0
        }
        return now
    }

    private fun timeBefore(row: Int) = (times[row] + times[row - 1]) / 2 - times[0]

    private val found = HashMap<Int, BlindJump>()

    /** Jumps at [rows], which ascend; each is found once. */
    @Synchronized
    private fun known(rows: List<Int>): Map<Int, BlindJump> {
        val new = rows.filter { it !in found }
        if (new.isNotEmpty()) state.fit.jumps(new).forEachIndexed { k, jump -> found[new[k]] = jump }
        return rows.associateWith(found::getValue)
    }

    /** What is unlike water of a jump at [time], s after the first row. */
    fun column(time: Double): DoubleArray =
        state.fit.unlike(DoubleArray(n) { if (times[it] - times[0] > time) 1.0 else 0.0 })

    companion object {
        private const val PLACES = 48
        private const val STRIKING = 40
        private const val LOOKED = 24

        /** Places about which a better one is looked for. */
        private const val BEGUN = 4
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
