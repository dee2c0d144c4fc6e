package stillwater.diagnose.track

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.median
import stillwater.estimate.TrackSeries
import kotlin.math.atan2
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin

/**
 * Where the boat was, from fixes that jitter: through the rows about each one goes a parabola of time, as wide as it
 * foretells the fixes left out best. Where the log has speed and heading, what fixes are off the way reckoned from
 * these is smoothed as well, and taken if it foretells them better.
 *
 * A fix that is repeated until the receiver has a new one says nothing of the rows that repeat it: the parabolas go
 * through the others alone.
 *
 * @property x metres east, length n. @property y metres north, length n. @property behind how far behind the fixes these
 *   places are, m. @property fixes how far fixes scatter about this and about narrower parabolas.
 */
internal class SmoothTrack private constructor(
    private val series: MeasuredSeries,
    val x: DoubleArray,
    val y: DoubleArray,
    val fixes: FixErrors,
    val behind: Double = 0.0,
    boat: SmoothTrack? = null,
) {
    /** Where the boat was. */
    private val boat = boat ?: this

    /**
     * The places of a probe on a rigid arm, [distance] m behind the boat, which points along its way: in turns the arm's end
     * leaves that. The course is that from the row before to the row behind; where the boat hardly moves, the last one.
     */
    fun onArm(distance: Double): SmoothTrack = boat.moved(distance)

    private fun moved(distance: Double): SmoothTrack {
        val n = series.size
        val times = series.times
        val least = LEAST_WAY * (1 until n).sumOf { hypot(x[it] - x[it - 1], y[it] - y[it - 1]) } / (n - 1)
        val east = x.copyOf()
        val north = y.copyOf()
        var course = Double.NaN
        fun put(i: Int) {
            east[i] -= distance * cos(course)
            north[i] -= distance * sin(course)
        }
        for (i in 0 until n) {
            val from = if (i > 0 && times[i] - times[i - 1] <= series.gap) i - 1 else i
            val to = if (i < n - 1 && times[i + 1] - times[i] <= series.gap) i + 1 else i
            val way = hypot(x[to] - x[from], y[to] - y[from])
            val isFirst = course.isNaN()
            if (way > least * (to - from)) course = atan2(y[to] - y[from], x[to] - x[from])
            if (course.isNaN()) continue
            if (isFirst) for (k in 0 until i) put(k)
            put(i)
        }
        return SmoothTrack(series, east, north, fixes, distance, this)
    }

    companion object {
        /** Share of the mean way between rows that tells no course. */
        private const val LEAST_WAY = 0.2
        private val REACHES = listOf(2, 3, 5, 8, 12)
        private val LONG_REACHES = listOf(5, 12, 25, 50, 100)

        /** Reaches that fixes, which are off together for long, never choose by themselves. */
        private const val WIDER = 25
        private val LONGEST = listOf(200, 400, 800)

        /** The smoothed way of [series]. */
        fun of(series: MeasuredSeries): SmoothTrack = Ways(series).run { track(best) }

        /**
         * Ways of [series] that follow its fixes less closely than these say by themselves: those that are off together for
         * long foretell each other, whatever the boat did.
         */
        fun wider(series: MeasuredSeries): List<SmoothTrack> = Ways(series).run { wider.map(::track) }
    }

    /** Ways through the fixes of [series]. */
    private class Ways(private val series: MeasuredSeries) {
        private val fresh = TrackSeries(series.times, series.x, series.y, series.values).withFreshPositions()
        private val known = RepeatedFixes.known(series)
        private val way = DeadReckoning.of(series, fresh.xs, fresh.ys)
        private val plain = REACHES.map(::through)
        private val ratio = plain[1].scatter / plain[0].scatter

        /** The way that foretells the fixes left out best. */
        val best: Parabolas = run {
            val least = plain.minBy { it.missed }
            val other = LONG_REACHES.mapNotNull(::offWay).minByOrNull { it.missed }
            if (other == null || other.missed > least.missed) least else other
        }

        /** Those wider than [best]; reckoned ones of any reach where that is not. */
        val wider: List<Parabolas> by lazy {
            val long = LONG_REACHES + LONGEST.filter { 2 * it < series.size }
            val reckoned = long.filter { best.reckoned == null || it > best.reach }
            (REACHES + WIDER).filter { it > best.reach }.map(::through) + reckoned.mapNotNull(::offWay)
        }

        private fun through(reach: Int) = Parabolas(series, fresh.xs, fresh.ys, known, reach)

        /** Through what fixes are off the way reckoned from speed and heading; null where the log has no such. */
        private fun offWay(reach: Int): Parabolas? {
            fun off(fixes: DoubleArray, reckoned: DoubleArray) = DoubleArray(series.size) { fixes[it] - reckoned[it] }
            return way?.let { Parabolas(series, off(fresh.xs, it.x), off(fresh.ys, it.y), known, reach, it) }
        }

        fun track(way: Parabolas): SmoothTrack {
            val from = way.reckoned
            // What fixes are off wide parabolas of the way itself is its turns as well.
            val near = if (from != null && way !== best) plain[0].scatter else null
            val errors = FixErrors(way.reach, way.scatter, ratio, way.period, near)
            if (from == null) return SmoothTrack(series, way.x, way.y, errors)
            val east = DoubleArray(series.size) { from.x[it] + way.x[it] }
            val north = DoubleArray(series.size) { from.y[it] + way.y[it] }
            return SmoothTrack(series, east, north, errors)
        }
    }

    /** Parabolas through [reach] rows either side of those whose fix is [known]; of what these are off a way [reckoned]. */
    private class Parabolas(
        private val series: MeasuredSeries,
        private val from: DoubleArray,
        private val north: DoubleArray,
        private val known: BooleanArray,
        val reach: Int,
        val reckoned: DeadReckoning? = null,
    ) {
        val x = from.copyOf()
        val y = north.copyOf()
        var missed = 0.0
        private val sums = DoubleArray(5)
        private val right = DoubleArray(3)

        init {
            for (i in x.indices) {
                val rows = rows(i)
                if (rows.count { known[it] } <= FEWEST) continue
                for ((column, out) in listOf(from to x, north to y)) {
                    if (known[i]) missed += (column[i] - middle(column, rows, i, true)).let { it * it }
                    out[i] = middle(column, rows, i, false)
                }
            }
        }

        private val fresh = known.indices.filter { known[it] }

        /** Standard deviation of a fix about these on either axis, m: the median distance is 1.18 of it. */
        val scatter: Double by lazy {
            median(DoubleArray(fresh.size) { fresh[it].let { i -> hypot(from[i] - x[i], north[i] - y[i]) } }) /
                RAYLEIGH_MEDIAN
        }

        /** From one new fix to the next, s. */
        val period: Double by lazy {
            median(DoubleArray(fresh.size - 1) { series.times[fresh[it + 1]] - series.times[fresh[it]] })
        }

        private fun rows(i: Int): IntRange {
            var a = i
            var b = i
            val times = series.times
            var left = reach
            while (a > 0 && left > 0 && times[a] - times[a - 1] <= series.gap) if (known[--a]) left--
            left = reach
            while (b < times.size - 1 && left > 0 && times[b + 1] - times[b] <= series.gap) if (known[++b]) left--
            return a..b
        }

        /** The parabola's value at row [i]; without that row's own where [isLeftOut]. */
        private fun middle(column: DoubleArray, rows: IntRange, i: Int, isLeftOut: Boolean): Double {
            sums.fill(0.0)
            right.fill(0.0)
            for (k in rows) {
                if (!known[k] || (isLeftOut && k == i)) continue
                val t = (series.times[k] - series.times[i]) / series.period
                var power = 1.0
                for (d in 0..4) {
                    sums[d] += power
                    if (d < 3) right[d] += power * (column[k] - column[i])
                    power *= t
                }
            }
            return column[i] + intercept()
        }

        /** First unknown of the three normal equations, by Cramer's rule. */
        private fun intercept(): Double {
            val (a, b, c) = sums
            val d = sums[3]
            val e = sums[4]
            val whole = a * (c * e - d * d) - b * (b * e - c * d) + c * (b * d - c * c)
            val top = right[0] * (c * e - d * d) - b * (right[1] * e - right[2] * d) +
                c * (right[1] * d - right[2] * c)
            return if (whole > 1e-12 * a * c * e) top / whole else right[0] / a
        }

        private companion object {
            const val FEWEST = 4
            const val RAYLEIGH_MEDIAN = 1.1774
        }
    }
}
