package stillwater.estimate

import kotlin.math.hypot

/**
 * A track thinned by taking means of [thinning] even steps in a row.
 *
 * @property times s, length n. @property xs m, length n. @property ys m, length n.
 * @property first index of the first node of the stretch without gaps that a node is in, length n.
 */
internal class TrackNodes(private val even: PhaseCorrection, val thinning: Int) {
    private val starts: IntArray = run {
        val found = ArrayList<Int>()
        var i = 0
        while (i + thinning <= even.size) {
            if (even.first[i + thinning - 1] == even.first[i]) {
                found += i
                i += thinning
            } else {
                i++
            }
        }
        found.toIntArray()
    }
    val times: DoubleArray = DoubleArray(starts.size).also { means(even.times, it) }
    val xs: DoubleArray = DoubleArray(starts.size).also { means(even.xs, it) }
    val ys: DoubleArray = DoubleArray(starts.size).also { means(even.ys, it) }
    val first: IntArray = IntArray(starts.size).also { first ->
        for (i in 1 until first.size) {
            first[i] = if (even.first[starts[i]] == even.first[starts[i - 1]]) first[i - 1] else i
        }
    }
    private val last: IntArray = IntArray(starts.size).also { last ->
        for (i in last.indices.reversed()) last[i] = if (i + 1 < size && first[i + 1] == first[i]) last[i + 1] else i
    }
    val size: Int get() = times.size

    /** Whether [run], nodes of one stretch, is within [time], s, of a gap. */
    fun isNearGap(run: IntRange, time: Double): Boolean {
        val begin = first[run.first]
        val end = last[run.last]
        return (begin > 0 && times[run.first] - times[begin] < time) ||
            (end < size - 1 && times[end] - times[run.last] < time)
    }

    /** Time between nodes, s. */
    val step: Double = even.step * thinning

    fun distance(a: Int, b: Int): Double = hypot(xs[a] - xs[b], ys[a] - ys[b])

    /** Means of the even series [of], taken [later] steps later, by node, into [out], length [size]. Modified. */
    fun means(of: DoubleArray, out: DoubleArray, later: Int = 0) {
        for (node in out.indices) {
            var sum = 0.0
            for (i in starts[node] + later until starts[node] + later + thinning) {
                sum += of[i.coerceIn(0, of.size - 1)]
            }
            out[node] = sum / thinning
        }
    }
}
