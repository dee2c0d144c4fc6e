package stillwater.estimate

/** How often a truth turns: without a turn nothing shows of how a sensor follows it the other way. */
internal object Turns {
    /** Of all that it goes over, by which it must go back. */
    private const val BACK = 0.1

    /** How often [truth] turns, from up to down or from down to up. */
    fun of(truth: DoubleArray): Int {
        val back = BACK * (truth.max() - truth.min())
        var turns = 0
        var direction = 0
        var highest = truth[0]
        var lowest = truth[0]
        for (value in truth) {
            highest = maxOf(highest, value)
            lowest = minOf(lowest, value)
            if (direction >= 0 && highest - value > back) {
                turns += direction
                direction = -1
                lowest = value
            } else if (direction <= 0 && value - lowest > back) {
                turns -= direction
                direction = 1
                highest = value
            }
        }
        return turns
    }
}
