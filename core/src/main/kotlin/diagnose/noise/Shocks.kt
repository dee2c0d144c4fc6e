package stillwater.diagnose.noise

/**
 * What is not known of a sensor's state: shocks before rows, of which less and less stays.
 *
 * @property variance of the shock before each row, over the noise's, length n. @property keep the part that stays from
 * the row before to each row, length n.
 */
internal class Shocks(val variance: DoubleArray, val keep: DoubleArray) {
    /** Whether row [i] is shaken by so much that it may be far off without being wrong. */
    fun isShaken(i: Int): Boolean = variance[i] > SHAKEN

    /** Whether row [i] or one beside it is shaken by what single readings may show, where how much that is was fitted. */
    fun isShakenNear(i: Int): Boolean = (maxOf(i - 1, 0)..minOf(i + 1, variance.size - 1)).any { variance[it] > FELT }

    private companion object {
        /** Shocks above this variance, in that of the noise, make a row doubtful. */
        const val SHAKEN = 0.25

        /** The same of a size that fits all rows together, and single ones to a factor. */
        const val FELT = 0.04
    }
}
