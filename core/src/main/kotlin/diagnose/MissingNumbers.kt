package stillwater.diagnose

import stillwater.diagnose.algebra.Lagrange

/**
 * A log in which readings and truths are missing here and there, row by row: what can be kept of it.
 *
 * A row with a truth says what the sensor has seen, also without a reading. Where a truth is missing between two that are
 * near, a cubic through those beside it guesses it, so that a sensor that was stepped row by row has seen as many; what it
 * showed in such a row is left out.
 */
internal class MissingNumbers(private val times: DoubleArray, values: DoubleArray, private val reference: DoubleArray) {
    private val known = times.indices.filter { reference[it].isFinite() }
    private val truth = reference.copyOf()

    /** The rows that are kept, in order. */
    val rows: IntArray

    init {
        val steps = DoubleArray(maxOf(times.size - 1, 0)) { times[it + 1] - times[it] }
        val longest = NEAR * median(steps)
        val kept = BooleanArray(times.size) { reference[it].isFinite() }
        for (k in 1 until known.size) {
            if (times[known[k]] - times[known[k - 1]] > longest) continue
            for (row in known[k - 1] + 1 until known[k]) {
                truth[row] = guess(row, k)
                kept[row] = true
            }
        }
        rows = times.indices.filter { kept[it] }.toIntArray()
    }

    /** The truth in [rows], as it was given or guessed. */
    val guessed = DoubleArray(rows.size) { truth[rows[it]] }

    /** Of [rows], those whose truth was guessed. */
    val isGuessed = BooleanArray(rows.size) { !reference[rows[it]].isFinite() }

    /** Of [rows], those with a reading and a truth. */
    val isRead = BooleanArray(rows.size) { values[rows[it]].isFinite() && !isGuessed[it] }

    /** The truth of [row], which lies before the [k]-th known one: within what those beside it reach over. */
    private fun guess(row: Int, k: Int): Double {
        val beside = (maxOf(k - 2, 0)..minOf(k + 1, known.size - 1)).map { known[it] }.toIntArray()
        val lowest = beside.minOf { reference[it] }
        val highest = beside.maxOf { reference[it] }
        val beyond = BEYOND * (highest - lowest)
        return Lagrange.through(times, reference, beside, times[row]).coerceIn(lowest - beyond, highest + beyond)
    }

    private companion object {
        /** Usual steps between two known truths over which those between are guessed. */
        const val NEAR = 3.5

        /** Of what the truths beside a guess reach over, by which it may be beyond them. */
        const val BEYOND = 0.25
    }
}
