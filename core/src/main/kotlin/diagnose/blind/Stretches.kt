package stillwater.diagnose.blind

import stillwater.diagnose.all

/**
 * What of each stretch of a log without a reference all others do not foretell, of [fit], in rows that follow each other:
 * made once for all that is asked of it.
 */
internal class Stretches(private val fit: BlindFit) {
    private val n = fit.design.noise.spread.size

    /** First rows of each stretch, and the number of all. */
    private val bounds = IntArray(COUNT + 1) { (it.toLong() * n / COUNT).toInt() }

    private val all = (0 until COUNT).toList()

    private val unforeseen = fit.design.loops.all(all) { fit.unforeseen(bounds[it], bounds[it + 1]) }

    /**
     * What [of] says of each stretch, of its first row, of the row after its last, and of what is [BlindFit.unforeseen], a
     * copy.
     */
    fun <T : Any> each(of: (Int, Int, Array<DoubleArray>) -> T): List<T> = fit.design.loops.all(all) { stretch ->
        val rows = unforeseen[stretch]
        of(bounds[stretch], bounds[stretch + 1], Array(rows.size) { rows[it].copyOf() })
    }

    companion object {
        /** How many there are. */
        const val COUNT = BlindEvidence.STRETCHES
    }
}
