package stillwater.estimate

/** Whether a truth goes up and down, without which nothing shows of how a sensor follows one of the two. */
internal object BothWays {
    /** Of all that it goes over, by which it must rise and fall. */
    private const val TURN = 0.1

    /** Whether the [truth] goes both ways in the rows that are [usable]. */
    fun areIn(truth: DoubleArray, usable: BooleanArray): Boolean {
        var highest = Double.NEGATIVE_INFINITY
        var lowest = Double.POSITIVE_INFINITY
        var fall = 0.0
        var rise = 0.0
        for (i in truth.indices) {
            if (!usable[i]) continue
            highest = maxOf(highest, truth[i])
            lowest = minOf(lowest, truth[i])
            fall = maxOf(fall, highest - truth[i])
            rise = maxOf(rise, truth[i] - lowest)
        }
        return minOf(fall, rise) > TURN * (highest - lowest)
    }
}
