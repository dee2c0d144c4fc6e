package stillwater.model

/**
 * A moment on one clock, the boat's.
 *
 * A value class of its own because mixing two clocks (the phone's, the board's, a sonde's) is the likely mistake:
 * two [BoatTime]s may be subtracted only when they come from the same [Clock] or log. A Unix stamp fits with a
 * resolution below 1 µs.
 *
 * @property seconds time since the clock's own zero, s. May be any finite number; NaN means "unknown".
 */
@JvmInline
public value class BoatTime(public val seconds: Double) : Comparable<BoatTime> {
    /** Time from [earlier] to this moment, s; negative when [earlier] is later. */
    public operator fun minus(earlier: BoatTime): Double = seconds - earlier.seconds

    /** The moment [seconds] s later. */
    public operator fun plus(seconds: Double): BoatTime = BoatTime(this.seconds + seconds)

    override fun compareTo(other: BoatTime): Int = seconds.compareTo(other.seconds)
}

/** Tells the boat's time. Core reads no wall clock: a real, simulated or replayed one comes in through constructors. */
public fun interface Clock {
    /** The present moment. Never goes back. */
    public fun now(): BoatTime
}
