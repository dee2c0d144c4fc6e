package stillwater.mission

import stillwater.model.BoatTime

/**
 * Turns a board's counter of milliseconds into the boat's time.
 *
 * The counter has 32 bits and wraps after 49.7 days; a board that restarts begins at 0. A line cannot have been stamped after
 * it was heard, so the smallest delay seen is the best estimate of the offset; it is let grow by [drift], because two
 * crystals differ. A step back of the counter is a wrap where it is by nearly the whole range, else a reset.
 * Platypus lines carry no stamp; boards that do, and recorded logs, need this.
 *
 * Source: own; the least-delay rule is that of D. L. Mills (1991), "Internet time synchronization", doi:10.1109/26.103043.
 * Never throws on data. Confined to one thread.
 *
 * @property drift by which the two clocks may part, s per s, at least 0 and below 0.01.
 * @throws IllegalArgumentException if [drift] is out of its range.
 */
public class BoardClock(public val drift: Double = 1e-4) {
    init {
        require(drift >= 0 && drift < 0.01) { "drift ($drift) must be in [0, 0.01)" }
    }

    private var last = -1L
    private var turns = 0L
    private var offset = Double.NaN
    private var heardBefore = 0.0

    /** Times the board began anew. */
    public var resets: Int = 0
        private set

    /** Times the counter wrapped. */
    public var wraps: Int = 0
        private set

    /**
     * The boat's time at which the board stamped [millis], heard at [heard]: never after [heard].
     *
     * @return NaN seconds where [millis] is not in 0 until 2³² or [heard] is not finite.
     */
    public fun sampled(millis: Long, heard: BoatTime): BoatTime {
        if (millis !in 0 until RANGE || !heard.seconds.isFinite()) return BoatTime(Double.NaN)
        if (last >= 0 && millis < last) {
            if (last - millis > RANGE / 2) {
                wraps++
                turns++
            } else if (last - millis > JITTER) {
                resets++
                turns = 0
                offset = Double.NaN
            }
        }
        // A stamp from before a wrap that changed places with one after it.
        val isBeforeWrap = turns > 0 && millis - last > RANGE / 2
        if (!isBeforeWrap && (last < 0 || millis >= last || last - millis > JITTER)) last = millis
        val board = ((if (isBeforeWrap) turns - 1 else turns) * RANGE + millis) / MILLIS
        val delay = heard.seconds - board
        val grown = offset + drift * maxOf(0.0, heard.seconds - heardBefore)
        offset = if (offset.isNaN()) delay else minOf(delay, grown)
        heardBefore = heard.seconds
        // The sum may round up.
        return BoatTime(minOf(board + offset, heard.seconds))
    }

    private companion object {
        const val RANGE = 1L shl 32
        const val MILLIS = 1000.0

        /** Stamps may change places by so much, ms. */
        const val JITTER = 1000L
    }
}
