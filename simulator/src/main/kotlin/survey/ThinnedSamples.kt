package stillwater.survey

/**
 * An even sample of a series of unknown length in bounded memory: every value at first, then every second, fourth, ...
 *
 * Whenever [CAPACITY] rows are full, every other one goes and the stride doubles, so the sample is the same in every
 * run. Confined to one thread.
 *
 * @param width numbers in a row.
 */
internal class ThinnedSamples(private val width: Int) {
    private var rows = DoubleArray(FIRST_ROWS * width)
    private var offered = 0L

    /** Number of rows kept. */
    var size = 0
        private set

    /** One in so many rows is kept. */
    var stride = 1L
        private set

    /** Whether the row that comes next is to be kept; a caller that sees true must [put] it. */
    fun wantsNext(): Boolean = offered++ % stride == 0L

    /** Makes room for one more row and returns its index; fill it with [set]. */
    fun put(): Int {
        if (size == CAPACITY) thin()
        if ((size + 1) * width > rows.size) rows = rows.copyOf(2 * rows.size)
        return size++
    }

    operator fun get(row: Int, column: Int): Double = rows[row * width + column]

    operator fun set(row: Int, column: Int, value: Double) {
        rows[row * width + column] = value
    }

    /** A copy of one column, in order. */
    fun column(column: Int): DoubleArray = DoubleArray(size) { get(it, column) }

    private fun thin() {
        for (row in 0 until CAPACITY / 2) rows.copyInto(rows, row * width, 2 * row * width, (2 * row + 1) * width)
        size = CAPACITY / 2
        stride *= 2
    }

    companion object {
        /** The largest number of rows kept. */
        const val CAPACITY = 1 shl 18

        private const val FIRST_ROWS = 1 shl 10
    }
}

/** Offers one number to a sample of width 1. */
internal fun ThinnedSamples.offer(value: Double) {
    if (wantsNext()) {
        val row = put()
        set(row, 0, value)
    }
}
