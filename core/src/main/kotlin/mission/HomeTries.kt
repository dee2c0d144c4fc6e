package stillwater.mission

/**
 * How often a boat that is held up on its way home tries another way, and for how long it rests when it has tried
 * enough: what holds it, as a current does, may turn.
 *
 * [MOST_WAYS] ways on end on which it came no nearer to home are enough, or [MOST_WAYS_AGAIN] after a rest. One on
 * which it got on before it was held up, and learned of something new that is in the way, led along it, as along a
 * wall: with it the count begins anew, up to [MOST_IN_ALL]. Each rest takes twice as long as the one before; after
 * [MOST_RESTS] it [isStranded]. Confined to one thread.
 *
 * @param nearer is as much nearer to home as counts, m.
 */
internal class HomeTries(private val nearer: Double) {
    private var onEnd = 0
    private var inAll = 0
    private var nearest = Double.POSITIVE_INFINITY
    private var rests = 0
    private var restsUntil = Double.NaN

    /** Whether no way home is tried any more; stays so. */
    var isStranded = false
        private set

    /** For how long the boat rests yet, [now] in s; 0 where it does not. */
    fun restsFor(now: Double): Double = if (now < restsUntil) restsUntil - now else 0.0

    /** The rests so far, [now] in s, for who goes on after a restart; null where there was none or will be no more. */
    fun rest(now: Double): HomeRest? = if (rests == 0 || isStranded) null else HomeRest(rests, restsFor(now))

    /** Goes on [now], s, after a restart before which it was as [before] says. */
    fun resume(before: HomeRest, now: Double) {
        rests = before.count.coerceIn(0, MOST_RESTS)
        restsUntil = now + before.seconds.coerceIn(0.0, REST * (1 shl MOST_RESTS))
    }

    /**
     * The boat, [left] m from home, is held up on a way home, [now] in s; [isAlong] tells whether it got on before and
     * learned what is in the way. Answers whether another way is to be tried now.
     */
    fun heldUp(now: Double, left: Double, isAlong: Boolean): Boolean {
        if (left < nearest - nearer) {
            onEnd = 0
            inAll = 0
        }
        nearest = minOf(nearest, left)
        onEnd = if (isAlong) 1 else onEnd + 1
        inAll++
        if (onEnd < (if (rests == 0) MOST_WAYS else MOST_WAYS_AGAIN) && inAll < MOST_IN_ALL) return true
        isStranded = rests == MOST_RESTS
        restsUntil = if (isStranded) Double.NaN else now + REST * (1 shl rests)
        rests++
        beginCount()
        return false
    }

    /** Ends a rest and forgets all ways and rests so far; a boat that is stranded stays so. */
    fun beginAnew() {
        restsUntil = Double.NaN
        rests = 0
        beginCount()
    }

    private fun beginCount() {
        onEnd = 0
        inAll = 0
        // It may have drifted off by then.
        nearest = Double.POSITIVE_INFINITY
    }

    private companion object {
        /** Ways on end; each takes about a minute. */
        const val MOST_WAYS = 10

        /** The same after a rest: what was in the way then may still be. */
        const val MOST_WAYS_AGAIN = 3

        /** An hour of trying: some thirty cells of a wall in whose cells the boat is held up twice each. */
        const val MOST_IN_ALL = 60

        /** The first rest, s. */
        const val REST = 600.0

        /** Of 10 minutes to 160, 5 hours and 10 minutes: three quarters of a tide or more turn within. */
        const val MOST_RESTS = 5
    }
}
