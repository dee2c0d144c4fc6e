package stillwater.diagnose.reference

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Revisits
import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.median
import stillwater.diagnose.track.Meetings
import kotlin.math.abs
import kotlin.math.floor
import kotlin.math.sqrt

/**
 * Whether the water itself changed while it was measured, from what the reference says where the track crosses itself.
 *
 * At a crossing the same place is seen twice: Δu = r Δt + e, with r the water's own rate of change and e what errors of
 * position and of the reference make. A reference that is late by ℓ shows the place as it was before: it is lower where
 * the truth rises, and passes that go opposite ways, as down and up a cast, differ in all of the water by ℓ times how
 * much faster the truth rose the second time. r and ℓ are fitted together by least squares; the error of r is that of
 * leaving out one of twenty groups of crossings at a time, so that nothing is assumed of e but that groups are
 * independent.
 *
 * Where the track crosses itself seldom, places that it comes close to again stand in ([Meetings]), each with an error
 * reckoned from jitter and slope. What lies across the way at neighbouring meetings makes one error, not many: with h the
 * share that each Δu has in r, the variance of r is Σ h h' C, with C that of all meetings' errors together. It grows where
 * the Δu spread more than that about r Δt, and is known no better than the slope is.
 *
 * The change is taken as even in time and the same everywhere. Cost: O(n) for a track that does not stay in one place.
 */
internal class ChangingWater(private val series: MeasuredSeries, private val truth: DoubleArray) {
    /**
     * A place passed twice: when first, how much later again, s, how much higher the truth was then, and how much
     * faster it rose along the track, sensor units/s.
     */
    private class Crossing(val first: Double, val later: Double, val higher: Double, val faster: Double)

    /** Sums of the squares and products of what [add] was told, for r and the lateness of the reference. */
    private class Sums {
        private var later = 0.0
        private var faster = 0.0
        private var both = 0.0
        private var higher = 0.0
        private var shifted = 0.0

        fun add(later: Double, faster: Double, higher: Double, weight: Double) {
            this.later += weight * later * later
            this.faster += weight * faster * faster
            both += weight * later * faster
            this.higher += weight * later * higher
            shifted += weight * faster * higher
        }

        // Where the truth rose as fast both times, or as much faster as it is later, lateness does not show apart.
        private val apart get() = later * faster - both * both
        private val isApart get() = apart > ALIKE * later * faster

        /** r, sensor units/s. */
        val rate: Double get() = if (isApart) (faster * higher - both * shifted) / apart else higher / later

        /** How late the readings' truth is, s. */
        val late: Double get() = if (isApart) (later * shifted - both * higher) / apart else 0.0

        /** What of one that is [higher] by a sensor unit, with such a [weight], goes into [rate]; 1/s. */
        fun share(later: Double, faster: Double, weight: Double): Double =
            if (isApart) weight * (this.faster * later - both * faster) / apart else weight * later / this.later
    }

    private val crossings = crossings().sortedBy { it.first }
    private val isCrossed = crossings.size >= FEWEST
    private val beside = if (isCrossed || !isMoving()) null else Meetings(series, truth, apart())
    private val meetings = beside?.all().orEmpty()
    private val isMet = meetings.size >= FEWEST_MEETINGS

    /** r, sensor units/s; NaN where the track does not cross itself often enough. */
    val rate: Double = if (isCrossed) {
        rate { true }
    } else if (isMet) {
        met().rate
    } else {
        Double.NaN
    }

    /** Standard error of [rate]. */
    val error: Double = if (isCrossed) {
        error()
    } else if (isMet) {
        metError()
    } else {
        Double.NaN
    }

    /** Probability of such a rate in water that does not change. */
    val pValue: Double = if (rate.isNaN()) 1.0 else Evidence.student(rate / maxOf(error, 1e-300), degrees())

    /** The crossings, in the order of the first visits. */
    fun revisits() = Revisits(
        if (isMet) meetings.map { it.later }.toDoubleArray() else crossings.map { it.later }.toDoubleArray(),
        if (isMet) meetings.map { it.higher }.toDoubleArray() else crossings.map { it.higher }.toDoubleArray(),
        rate,
    )

    private inline fun rate(counts: (Int) -> Boolean): Double {
        val sums = Sums()
        crossings.forEachIndexed { i, crossing ->
            if (counts(i)) sums.add(crossing.later, crossing.faster, crossing.higher, 1.0)
        }
        return sums.rate
    }

    private fun error(): Double {
        val without = DoubleArray(GROUPS) { group -> rate { it * GROUPS / crossings.size != group } }
        val mean = without.average()
        return sqrt(without.sumOf { (it - mean) * (it - mean) } * (GROUPS - 1) / GROUPS)
    }

    /** r from the meetings, each weighed by its error. */
    private fun met() = Sums().also { sums ->
        meetings.forEach { sums.add(it.later, it.faster, it.higher, 1 / (it.error * it.error)) }
    }

    private fun metError(): Double {
        val sums = met()
        val spread = meetings.sumOf {
            val off = (it.higher - sums.rate * it.later - sums.late * it.faster) / it.error
            off * off
        } / (meetings.size - 1)
        val shares = DoubleArray(meetings.size) { i ->
            meetings[i].let { sums.share(it.later, it.faster, 1 / (it.error * it.error)) }
        }
        return sqrt(maxOf(spread, 1.0) * checkNotNull(beside).variance(meetings, shares))
    }

    private fun degrees() = beside?.let { it.pieces.coerceIn(1, KNOWN) } ?: (GROUPS - 1)

    private fun isMoving() = series.size >= FEWEST && series.isMoving

    /** How much later a place must be passed again, s. */
    private fun apart() = maxOf(LEAST_APART * series.duration, LEAST_ROWS * series.period)

    private fun crossings(): List<Crossing> {
        val n = series.size
        val steps = DoubleArray(maxOf(n - 1, 0)) { i ->
            abs(series.x[i + 1] - series.x[i]) + abs(series.y[i + 1] - series.y[i])
        }
        val size = 2 * median(steps)
        if (!(size > 0) || !isMoving()) return emptyList()
        val cells = HashMap<Pair<Long, Long>, ArrayList<Int>>()
        fun cell(i: Int) = floor(series.x[i] / size).toLong() to floor(series.y[i] / size).toLong()
        val apart = apart()
        val found = ArrayList<Crossing>()
        var looks = 0
        for (j in 0 until n - 1) {
            val (column, row) = cell(j)
            for (dx in -1L..1L) {
                for (dy in -1L..1L) {
                    for (i in cells[column + dx to row + dy].orEmpty()) {
                        if (series.times[j] - series.times[i] < apart || looks++ > MOST_LOOKS) continue
                        crossing(i, j)?.let { found += it }
                    }
                }
            }
            cells.getOrPut(column to row) { ArrayList() } += j
        }
        return found
    }

    /** Where the steps after rows [i] and [j] cross, if they do. */
    private fun crossing(i: Int, j: Int): Crossing? {
        val ax = series.x[i + 1] - series.x[i]
        val ay = series.y[i + 1] - series.y[i]
        val bx = series.x[j + 1] - series.x[j]
        val by = series.y[j + 1] - series.y[j]
        val across = ax * by - ay * bx
        if (across == 0.0) return null
        val dx = series.x[j] - series.x[i]
        val dy = series.y[j] - series.y[i]
        val first = (dx * by - dy * bx) / across
        val second = (dx * ay - dy * ax) / across
        if (first !in 0.0..1.0 || second !in 0.0..1.0) return null
        val from = between(series.times, i, first)
        val higher = between(truth, j, second) - between(truth, i, first)
        val faster = series.rise(truth, j, j + 1) - series.rise(truth, i, i + 1)
        return Crossing(from, between(series.times, j, second) - from, higher, faster)
    }

    private fun between(column: DoubleArray, i: Int, share: Double) = column[i] + share * (column[i + 1] - column[i])

    private companion object {
        const val GROUPS = 20
        const val FEWEST = 2 * GROUPS
        const val FEWEST_MEETINGS = 3

        /** Degrees of freedom at most where errors are reckoned, not seen: jitter and slope are not wholly known. */
        const val KNOWN = 30
        const val LEAST_APART = 0.02
        const val LEAST_ROWS = 30

        /** Of the product of two squared columns: less than this is left of one beside the other. */
        const val ALIKE = 1e-6
        const val MOST_LOOKS = 4_000_000
    }
}
