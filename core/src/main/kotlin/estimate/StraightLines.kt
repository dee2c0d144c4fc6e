package stillwater.estimate

/**
 * The value at [time] on the straight lines through these, read at [times], which ascend and are as many; before the first that,
 * after the last that. There is one at least.
 */
internal fun DoubleArray.straight(times: DoubleArray, time: Double): Double {
    val found = times.binarySearch(time)
    if (found >= 0) return this[found]
    val after = -found - 1
    if (after == 0) return first()
    if (after == size) return last()
    val share = (time - times[after - 1]) / (times[after] - times[after - 1])
    return this[after - 1] + share * (this[after] - this[after - 1])
}
