package stillwater.diagnose.track

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.median
import stillwater.diagnose.response.ReferenceGaps
import kotlin.math.abs
import kotlin.math.floor
import kotlin.math.hypot
import kotlin.math.sqrt

/**
 * Where a track comes close to a place where it has been before, once for each time it does, whether it crosses its old
 * way or not.
 *
 * How far the truth at two places may differ is told by how steep it is along the track: times the fixes' jitter and
 * what lies between the two across the way. Jitter is the fixes' own roughness (second differences, of which it makes
 * the root of six times), a tenth of a step at least because the way between rows is not straight.
 *
 * Jitter is another at each row, but how steep the truth is across the way is not: along a leg that is gone over again
 * to one side all meetings have the same error, as far as that slope reaches ([SlopeAcross]).
 */
internal class Meetings(private val series: MeasuredSeries, private val truth: DoubleArray, private val apart: Double) {
    /**
     * A place passed twice: [later] s apart, [higher] the second time, sensor units, with an error of [error] in water
     * that stays the same; the truth rose [faster] along the track then, sensor units/s. The second time was [aside].
     */
    class Meeting(
        val first: Double,
        val later: Double,
        val higher: Double,
        val error: Double,
        val faster: Double,
        val aside: Aside,
    )

    /** What lies across the way: [east] and [north], m, of where the track was first, at [x] and [y], m. */
    class Aside(val x: Double, val y: Double, val east: Double, val north: Double)

    private val n = series.size
    private val step = median(DoubleArray(maxOf(n - 1, 0)) { way(it, it + 1) })
    private val slope = SlopeAcross(truth, step)
    private val jitter: Double
    private val noise: Double

    init {
        val rough = DoubleArray(maxOf(2 * (n - 2), 0)) { k ->
            val i = k / 2 + 1
            val column = if (k % 2 == 0) series.x else series.y
            abs(column[i - 1] - 2 * column[i] + column[i + 1])
        }
        jitter = maxOf(median(rough) / NORMAL / sqrt(SECOND), LEAST_JITTER * step)
        val unlike = ReferenceGaps.errors(series.times, truth, 1)
        noise = median(unlike)
    }

    private fun way(i: Int, j: Int) = hypot(series.x[j] - series.x[i], series.y[j] - series.y[i])

    /** Of how many independent pieces of the track it is known how steep the truth is. */
    val pieces: Int get() = slope.pieces

    /** All meetings, the earliest first visit first. */
    fun all(): List<Meeting> {
        if (!(step > 0)) return emptyList()
        val nearest = nearest()
        fun distance(j: Int) = if (j !in 0 until n || nearest[j] < 0) Double.MAX_VALUE else way(nearest[j], j)
        // Going along the old way is one meeting after the other, each with jitter of its own: some rows apart.
        // What stands still comes back to the same row again and again, whose one error is then in all of them.
        val found = ArrayList<Meeting>()
        val isMet = BooleanArray(n)
        var last = -ROWS_APART
        for (j in 0 until n) {
            if (nearest[j] < 0 || isMet[nearest[j]] || j - last < ROWS_APART) continue
            if (distance(j) > distance(j - 1) || distance(j) > distance(j + 1)) continue
            found += meeting(nearest[j], j)
            isMet[nearest[j]] = true
            last = j
        }
        return found.sortedBy { it.first }
    }

    /** For each row the nearest of those long before it, within a step; -1 where there is none. */
    private fun nearest(): IntArray {
        val nearest = IntArray(n) { -1 }
        val cells = HashMap<Pair<Long, Long>, ArrayList<Int>>()
        var looks = 0
        for (j in 0 until n) {
            val column = floor(series.x[j] / step).toLong()
            val row = floor(series.y[j] / step).toLong()
            var least = step
            for (cell in 0 until CELLS * CELLS) {
                val beside = column + cell / CELLS - 1 to row + cell % CELLS - 1
                for (i in cells[beside].orEmpty()) {
                    if (series.times[j] - series.times[i] < apart || looks++ > MOST_LOOKS) continue
                    if (way(i, j) < least) {
                        least = way(i, j)
                        nearest[j] = i
                    }
                }
            }
            cells.getOrPut(column to row) { ArrayList() } += j
        }
        return nearest
    }

    private fun meeting(i: Int, j: Int): Meeting {
        val from = maxOf(i - 1, 0)
        val to = minOf(i + 1, n - 1)
        val length = way(from, to)
        val dx = series.x[j] - series.x[i]
        val dy = series.y[j] - series.y[i]
        var along = 0.0
        if (length > 0) {
            along = (dx * (series.x[to] - series.x[from]) + dy * (series.y[to] - series.y[from])) / length
            along = along.coerceIn(-step, step)
        }
        val across = sqrt(maxOf(dx * dx + dy * dy - along * along, 0.0))
        val way = if (length > 0) along / length else 0.0
        val aside = Aside(
            series.x[i],
            series.y[i],
            dx - way * (series.x[to] - series.x[from]),
            dy - way * (series.y[to] - series.y[from]),
        )
        val there = truth[i] + if (length > 0) along * (truth[to] - truth[from]) / length else 0.0
        val place = slope.variance * (2 * jitter * jitter + across * across)
        return Meeting(
            series.times[i],
            series.times[j] - series.times[i],
            truth[j] - there,
            sqrt(place + 2 * noise * noise),
            series.rise(truth, j, j) - series.rise(truth, i, i),
            aside,
        )
    }

    /**
     * Variance of the sum of what is higher at each of [meetings], times its share of [shares], in water that stays the
     * same; sensor units squared where shares are plain numbers. It is no less than with errors that are independent.
     */
    fun variance(meetings: List<Meeting>, shares: DoubleArray): Double {
        val reach = square(slope.reach)
        var alone = 0.0
        var common = 0.0
        for (i in meetings.indices) {
            val a = meetings[i].aside
            alone += square(shares[i] * meetings[i].error)
            for (j in 0 until i) {
                val b = meetings[j].aside
                val both = a.east * b.east + a.north * b.north
                val apart = square(a.x - b.x) + square(a.y - b.y)
                if (apart < reach) common += 2 * shares[i] * shares[j] * both * slope.alike(sqrt(apart))
            }
        }
        return alone + maxOf(common, 0.0)
    }

    private fun square(number: Double) = number * number

    private companion object {
        const val NORMAL = 0.6745

        /** Variance of a second difference of independent numbers. */
        const val SECOND = 6.0
        const val LEAST_JITTER = 0.1
        const val ROWS_APART = 3
        const val CELLS = 3
        const val MOST_LOOKS = 4_000_000
    }
}
