package stillwater.estimate

import kotlin.math.ln

/**
 * Finds single wild readings, which a lag undone would make much wilder: readings without which the rest is so much
 * more likely that a fault, seen once in [USUAL] readings and then anywhere in their range, is the better explanation.
 * Water that changes at a front is confirmed by the readings after it, and stays.
 *
 * @param stretch the readings; those found are marked in it. @param likelihood logarithm of the density of the readings
 * that are not marked.
 */
internal class OutlierSearch(private val stretch: Stretch, private val likelihood: () -> Double) {
    /** Marks the outliers among the readings of which [surprises] has more than water usually gives. */
    fun mark(surprises: DoubleArray) {
        val wild = stretch.values.indices.filter {
            !stretch.silent[it] && !stretch.outlying[it] && surprises[it] > WILD
        }
            .sortedByDescending { surprises[it] }.take(MOST)
        if (wild.isEmpty()) return
        val range = stretch.values.max() - stretch.values.min()
        val fault = -ln(USUAL * range)
        var with = likelihood()
        for (reading in wild) {
            stretch.outlying[reading] = true
            val without = likelihood() + fault
            if (without > with) with = without else stretch.outlying[reading] = false
        }
    }

    private companion object {
        /** Squared deviations; a normal reading in a billion. */
        const val WILD = 36.0
        const val MOST = 12
        const val USUAL = 1000.0
    }
}
