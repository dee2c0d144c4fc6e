package stillwater.diagnose

import kotlin.math.abs
import kotlin.math.floor
import kotlin.math.sqrt

/**
 * Whether the water itself changed while it was measured, from what the reference says where the track crosses itself.
 *
 * At a crossing the same place is seen twice: Δu = r Δt + e, with r the water's own rate of change and e what errors of
 * position and of the reference make. r is Σ Δu Δt / Σ Δt²; its error is that of leaving out one of twenty groups of
 * crossings at a time, so that nothing is assumed of e but that groups are independent.
 *
 * Where the track crosses itself seldom, places that it comes close to again stand in ([Meetings]), each with an error
 * reckoned from jitter and slope; the error of r grows where the Δu spread more than that about r Δt.
 *
 * The change is taken as even in time and the same everywhere. Cost: O(n) for a track that does not stay in one place.
 */
internal class ChangingWater(private val series: MeasuredSeries, private val truth: DoubleArray) {
    /** A place passed twice: when first, how much later again, s, and how much higher the truth was then. */
    private class Crossing(val first: Double, val later: Double, val higher: Double)

    private val crossings = crossings().sortedBy { it.first }
    private val isCrossed = crossings.size >= FEWEST
    private val meetings = if (isCrossed || !isMoving()) emptyList() else Meetings(series, truth, apart()).all()
    private val isMet = meetings.size >= FEWEST_MEETINGS

    /** r, sensor units/s; NaN where the track does not cross itself often enough. */
    val rate: Double = if (isCrossed) {
        rate { true }
    } else if (isMet) {
        met()
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
    val pValue: Double =
        if (rate.isNaN()) 1.0 else Evidence.student(rate / maxOf(error, 1e-300), if (isCrossed) GROUPS - 1 else KNOWN)

    /** The crossings, in the order of the first visits. */
    fun revisits() = Revisits(
        if (isMet) meetings.map { it.later }.toDoubleArray() else crossings.map { it.later }.toDoubleArray(),
        if (isMet) meetings.map { it.higher }.toDoubleArray() else crossings.map { it.higher }.toDoubleArray(),
        rate,
    )

    private inline fun rate(counts: (Int) -> Boolean): Double {
        var over = 0.0
        var under = 0.0
        crossings.forEachIndexed { i, crossing ->
            if (counts(i)) {
                over += crossing.higher * crossing.later
                under += crossing.later * crossing.later
            }
        }
        return over / under
    }

    private fun error(): Double {
        val without = DoubleArray(GROUPS) { group -> rate { it * GROUPS / crossings.size != group } }
        val mean = without.average()
        return sqrt(without.sumOf { (it - mean) * (it - mean) } * (GROUPS - 1) / GROUPS)
    }

    /** r from the meetings, each weighed by its error. */
    private fun met(): Double = meetings.sumOf { it.higher * it.later / (it.error * it.error) } /
        meetings.sumOf { it.later * it.later / (it.error * it.error) }

    private fun metError(): Double {
        val r = met()
        val spread = meetings.sumOf { ((it.higher - r * it.later) / it.error).let { z -> z * z } } / (meetings.size - 1)
        return sqrt(maxOf(spread, 1.0) / meetings.sumOf { it.later * it.later / (it.error * it.error) })
    }

    private fun isMoving() = series.size >= FEWEST && median(series.speed) >= SLOWEST

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
        return Crossing(from, between(series.times, j, second) - from, higher)
    }

    private fun between(column: DoubleArray, i: Int, share: Double) = column[i] + share * (column[i + 1] - column[i])

    private companion object {
        const val GROUPS = 20
        const val FEWEST = 2 * GROUPS
        const val FEWEST_MEETINGS = 6

        /** Degrees of freedom where errors are reckoned, not seen: the jitter and the slope are not wholly known. */
        const val KNOWN = 30
        const val SLOWEST = 0.02
        const val LEAST_APART = 0.02
        const val LEAST_ROWS = 30
        const val MOST_LOOKS = 4_000_000
    }
}
