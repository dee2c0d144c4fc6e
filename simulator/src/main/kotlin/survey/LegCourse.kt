package stillwater.survey

/**
 * When the boat was in which bin of a leg: the times at which that changed, to the last bit of a time.
 *
 * Between two points of the track the boat goes straight on. The legs' comparison asks for a hundred lags, so that
 * where the boat was is computed once here and not for every reading and lag.
 *
 * @param track the track. Not modified.
 * @param leg the leg.
 * @param bins number of bins.
 * @param bin the bin of a place between point `i` of the track and the next at a time, s: never back and forth between
 *   two points. Below 0 and from [bins] on are no bins.
 */
internal class LegCourse(
    private val track: Track,
    private val leg: Leg,
    private val bins: Int,
    private val bin: (Int, Double) -> Int,
) {
    private var size = 0

    /** From when on the boat was in another bin, s, ascending; then when the leg is over. */
    private var since = DoubleArray(FIRST)

    /** The bin before each of [since]; [bins] stands for none. */
    private var before = IntArray(FIRST)
    private var last = NOWHERE

    init {
        before[0] = bins
        for (point in leg.first until leg.last) {
            val from = track.times[point]
            // A time at which the boat was at a point belongs to the way there.
            val begin = if (point == leg.first) from else Math.nextUp(from)
            val end = track.times[point + 1]
            if (begin <= end) follow(point, begin, end)
        }
        since[size] = Math.nextUp(track.times[leg.last])
    }

    /** Adds the changes between [point] and the next. */
    private fun follow(point: Int, begin: Double, end: Double) {
        note(begin, bin(point, begin))
        val target = bin(point, end)
        var from = begin
        while (last != target) {
            var low = from
            var high = end
            while (true) {
                val middle = low + (high - low) / 2
                if (middle <= low || middle >= high) break
                if (bin(point, middle) == last) low = middle else high = middle
            }
            from = high
            note(from, bin(point, from))
        }
    }

    private fun note(seconds: Double, bin: Int) {
        if (bin == last) return
        last = bin
        since[size++] = seconds
        if (size == since.size) {
            since = since.copyOf(2 * size)
            before = before.copyOf(2 * size)
        }
        before[size] = if (bin in 0 until bins) bin else bins
    }

    /**
     * Adds each reading to the sum of the bin in which the boat was [lag] s before it, and counts it there.
     *
     * @param sums sum of the readings in each bin, and last of those in none. Modified.
     * @param counts as many, their numbers. Modified.
     */
    fun add(lag: Double, sums: DoubleArray, counts: IntArray) {
        // Asked for once: the first compiler, that of the launcher, asks each time.
        val times = track.times
        val values = track.values
        val readings = times.size
        val begin = times[leg.first]
        var i = leg.first
        while (i > 0 && times[i - 1] - lag >= begin) i--
        for (stretch in 0..size) {
            val until = since[stretch]
            val bin = before[stretch]
            val from = i
            var sum = sums[bin]
            while (i < readings) {
                if (times[i] - lag >= until) break
                sum += values[i]
                i++
            }
            sums[bin] = sum
            counts[bin] += i - from
        }
    }

    private companion object {
        const val FIRST = 128
        const val NOWHERE = Int.MIN_VALUE
    }
}
