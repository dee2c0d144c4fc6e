package stillwater.survey

/**
 * Where a boat was and what it read there, thinned to a size that fits into memory.
 *
 * @property times s, growing, length n. Not modified.
 * @property xs metres east, length n. Not modified.
 * @property ys metres north, length n. Not modified.
 * @property values sensor units, length n. Not modified.
 * @property stride one in so many readings of the log is here.
 */
class Track(
    val times: DoubleArray,
    val xs: DoubleArray,
    val ys: DoubleArray,
    val values: DoubleArray,
    val stride: Long = 1,
) {
    init {
        require(xs.size == times.size && ys.size == times.size && values.size == times.size) {
            "times, xs, ys and values (${times.size}, ${xs.size}, ${ys.size}, ${values.size}) must be as long"
        }
    }

    /** Number of points. */
    val size: Int get() = times.size
}
