package stillwater.io

/**
 * The boat's last few poses, and where it was between them.
 *
 * A reading at time t between poses at t0 and t1 is placed at p0 + (p1 − p0)(t − t0)/(t1 − t0), if both are at most
 * [maxAge] away from it; with only one that near, at that one. Holds [CAPACITY] poses. Confined to one thread.
 *
 * @property maxAge longest time between a reading and a pose it is placed by, s, above 0.
 */
internal class PoseTrack(private val maxAge: Double) {
    private val times = DoubleArray(CAPACITY)
    private val xs = DoubleArray(CAPACITY)
    private val ys = DoubleArray(CAPACITY)
    private var count = 0

    /** Metres east of the place last found by [find]. */
    var x = Double.NaN
        private set

    /** Metres north of the place last found by [find]. */
    var y = Double.NaN
        private set

    /** Time of the latest pose, s; minus infinity before the first. */
    val latest: Double get() = if (count == 0) Double.NEGATIVE_INFINITY else times[count - 1]

    /** Adds the pose at [seconds]; one that comes a little late (threads) is sorted in. */
    fun add(seconds: Double, x: Double, y: Double) {
        if (count == CAPACITY) {
            times.copyInto(times, 0, 1)
            xs.copyInto(xs, 0, 1)
            ys.copyInto(ys, 0, 1)
            count--
        }
        var place = count++
        while (place > 0 && times[place - 1] > seconds) {
            times[place] = times[place - 1]
            xs[place] = xs[place - 1]
            ys[place] = ys[place - 1]
            place--
        }
        times[place] = seconds
        xs[place] = x
        ys[place] = y
    }

    /** Finds where the boat was at [seconds], into [x] and [y]; false where no pose is near enough. */
    fun find(seconds: Double): Boolean {
        var after = count
        while (after > 0 && times[after - 1] >= seconds) after--
        val before = after - 1
        val hasAfter = after < count && times[after] - seconds <= maxAge
        val hasBefore = before >= 0 && seconds - times[before] <= maxAge
        if (!hasAfter && !hasBefore) return false
        val from = if (hasBefore) before else after
        val to = if (hasAfter) after else before
        val span = times[to] - times[from]
        val share = if (span > 0) (seconds - times[from]) / span else 0.0
        x = xs[from] + (xs[to] - xs[from]) * share
        y = ys[from] + (ys[to] - ys[from]) * share
        return true
    }

    private companion object {
        const val CAPACITY = 256
    }
}
