package stillwater.diagnose.response

import stillwater.diagnose.Loops
import stillwater.diagnose.algebra.Spline

/**
 * What a sensor whose parts are linear in the truth shows of many truths along one log, four of them at a time.
 *
 * Each part makes of a column a sum of two neighbouring rows, of the bends of the spline through it there and of its
 * own row before. These factors depend on the sensor and the log's times alone, so that they are found once.
 *
 * @param spline through the log's times. @param delay how late and where the truth is seen; null for at once.
 * @param path the lag. @param slow a second path and its share of the reading; null for none.
 * @param second a lag behind the first; null for none.
 */
internal class LinearResponse(
    private val spline: Spline,
    private val delay: NeighbourSums?,
    private val path: NeighbourSums,
    private val slow: Pair<NeighbourSums, Double>?,
    private val second: NeighbourSums?,
) {
    /** Working space of one thread. */
    private inner class Work {
        val bends by lazy(LazyThreadSafetyMode.NONE) { Array(AT_ONCE) { DoubleArray(spline.size) } }
        val late by lazy(LazyThreadSafetyMode.NONE) { Array(AT_ONCE) { DoubleArray(spline.size) } }
        val other by lazy(LazyThreadSafetyMode.NONE) { Array(AT_ONCE) { DoubleArray(spline.size) } }
        val spare by lazy(LazyThreadSafetyMode.NONE) { DoubleArray(spline.size) }
    }

    /** The bends of truths that are shown again and again, kept by those that found them; for any number of threads. */
    class Bends(truths: Int) {
        private val found = arrayOfNulls<Array<DoubleArray>>((truths + AT_ONCE - 1) / AT_ONCE)

        /** Those of the [group]-th four, as [find] finds them. */
        fun of(group: Int, find: () -> Array<DoubleArray>): Array<DoubleArray> =
            known(group) ?: find().also { keep(group, it) }

        @Synchronized
        private fun known(group: Int) = found[group]

        @Synchronized
        private fun keep(group: Int, bends: Array<DoubleArray>) {
            found[group] = bends
        }
    }

    /**
     * Writes what is shown of each of [truths], length n, into the first of [shown]. Whenever some are there, [then] is
     * told the first of them and the one behind the last, so that they are done with while they are in the cache.
     *
     * @param bends of these truths; null where they are not kept.
     */
    fun of(
        truths: Array<DoubleArray>,
        loops: Loops,
        shown: List<DoubleArray>,
        bends: Bends? = null,
        then: (Int, Int) -> Unit = { _, _ -> },
    ) {
        val groups = (truths.size + AT_ONCE - 1) / AT_ONCE
        loops.each(minOf(PARTS, groups)) { part ->
            val work = Work()
            for (group in part until groups step PARTS) {
                val from = group * AT_ONCE
                // Where columns are no multiple of four the last is done more than once, for nobody.
                val own = Array(AT_ONCE) { truths[minOf(from + it, truths.size - 1)] }
                val out = Array(AT_ONCE) { if (from + it < truths.size) shown[from + it] else work.spare }
                val bent = when {
                    !isBent(delay, path, slow?.first) -> work.bends
                    bends != null -> bends.of(group) { bent(own) }
                    else -> bent(own, work.bends)
                }
                show(own, bent, out, work)
                then(from, minOf(from + AT_ONCE, truths.size))
            }
        }
    }

    /** Shows [truths] with the [bends] of their splines. */
    private fun show(
        truths: Array<DoubleArray>,
        bends: Array<DoubleArray>,
        out: Array<DoubleArray>,
        work: Work,
    ) {
        var seen = truths
        var bent = bends
        if (delay != null) {
            delay.of(seen, bent, work.late)
            seen = work.late
            if (isBent(path, slow?.first)) bent = bent(seen, work.bends)
        }
        path.of(seen, bent, out)
        if (slow != null) {
            val (own, share) = slow
            own.of(seen, bent, work.other)
            for (k in 0 until AT_ONCE) mix(out[k], work.other[k], share)
        }
        if (second != null) {
            for (k in 0 until AT_ONCE) out[k].copyInto(work.late[k])
            if (isBent(second)) bent(work.late, work.bends)
            second.of(work.late, work.bends, out)
        }
    }

    private fun isBent(vararg users: NeighbourSums?) = users.any { it != null && it.isBent }

    /** The bends of the splines through [columns], in [out]. */
    private fun bent(
        columns: Array<DoubleArray>,
        out: Array<DoubleArray> = Array(AT_ONCE) { DoubleArray(spline.size) },
    ): Array<DoubleArray> = out.also { spline.bends(columns, it) }

    private fun mix(out: DoubleArray, other: DoubleArray, share: Double) {
        for (i in out.indices) out[i] += share * (other[i] - out[i])
    }

    companion object {
        /** Columns that are gone through together: each waits for its own row before. */
        const val AT_ONCE = 4

        /** Parts of the work that may be done at the same time. */
        private const val PARTS = 4
    }
}
