package stillwater.diagnose.blind

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.median
import stillwater.diagnose.three
import stillwater.diagnose.track.FixErrors
import stillwater.diagnose.track.SmoothTrack
import kotlin.math.abs
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * What fixes that scatter about the boat's way do to a log without a reference: water told at the wrong places, so that
 * readings seem wrong by as much as what the sensor shows is steep there. An error that wanders is followed in part, so
 * that it is larger than it scatters: see [FixErrors].
 */
internal class FixScatter(private val series: MeasuredSeries, track: SmoothTrack, resolution: Double) {
    private val n = series.size

    private val scatter = track.fixes.scatter
    private val isCourseWide = track.fixes.isWide

    /** What errors of fixes may be left in the track. */
    val errors: List<FixErrors.Likely> = track.fixes.likely

    /** What readings scatter by themselves, sensor units: third differences hold 20 times its square, and no water. */
    private val own: Double = run {
        val v = series.values
        val third = DoubleArray(maxOf(n - 3, 1)) { i ->
            if (i + 3 < n) abs(v[i + 3] - 3 * v[i + 2] + 3 * v[i + 1] - v[i]) else 0.0
        }
        maxOf(NORMAL_MEDIAN * median(third) / sqrt(THIRD), resolution / sqrt(ROUNDING))
    }

    /** The largest deviation that errors of fixes may have in the course, m; 0 where fixes do not scatter. */
    private val most = sqrt(errors.maxOfOrNull { it.variance } ?: 0.0)

    /** What of the scatter may be left in the course, m: a wide one follows less of the errors than they scatter about it. */
    private val left = minOf(scatter, most)

    /** Root mean square of how steep what the sensor of [state] shows is along the way, sensor units/m. */
    private fun steepness(state: BlindState) = sqrt(squares(state.modes.steepness(state.shown)) / n)

    /** Whether fixes may be off by enough for readings to show it in [state]. */
    fun isWide(state: BlindState): Boolean = most * steepness(state) > SOME * own

    /** What errors of places are in what the sensor of [state] shows, sensor units; 0 where its noise has none. */
    private fun shift(state: BlindState): Double {
        val places = state.fit.design.noise.places ?: return 0.0
        return sqrt(places.variance * state.variance) * steepness(state)
    }

    /**
     * Whether fixes are so far off in [state] that what is left says nothing of the response: the water along the fixes has
     * quick changes that the boat did not see, and a response that shows less of these looks likelier than the true one. A wide
     * course has none.
     */
    fun areFar(state: BlindState): Boolean = !isCourseWide && shift(state) > FAR * own

    /** In words, where it is more than what readings scatter by themselves, and a part of what is left; null where not. */
    fun words(state: BlindState): String? {
        val places = state.fit.design.noise.places ?: return scattered(state)
        val course = sqrt(places.variance * state.variance)
        val likely = errors.minBy { abs(ln(it.time / places.time)) }
        val fixes = likely.fixes * course / sqrt(likely.variance)
        val by = "${metres(fixes)} for ${three(likely.fixTime)} s"
        val more = if (areFar(state)) " Of a response of another shape such a log says little." else ""
        return "The fixes are off by some $by at a time, and the course through them by ${metres(course)}, which in " +
            "water as steep as here is ${said(shift(state))}: the answer allows for that.$more"
    }

    private fun scattered(state: BlindState): String? {
        val error = left * steepness(state)
        if (!(error > maxOf(own, PART * sqrt(state.variance)))) return null
        val more = if (left < scatter) ", and up to ${metres(left)} of that may be left in it" else ""
        return "The fixes scatter by ${metres(scatter)} about the boat's way$more, which in water as steep as here " +
            "is ${said(error)}: a small effect, or a response of another shape, may come of that alone."
    }

    private fun metres(way: Double) = "${three(way)} ${series.placeUnit}"

    private fun said(error: Double) = "${three(error)} sensor units" +
        if (own > 0) ", ${three(error / own)} times what readings scatter by themselves" else ""

    private companion object {
        /** Of what readings scatter by themselves. */
        const val SOME = 0.5

        /** The same: see core/docs/Diagnosis.md, (11e). */
        const val FAR = 3.0

        /** Of the deviation of what is left. */
        const val PART = 0.4
        const val NORMAL_MEDIAN = 1.4826

        /** 1 + 3² + 3² + 1. */
        const val THIRD = 20.0

        /** Of a step squared, the variance of rounding to it. */
        const val ROUNDING = 12.0
    }
}
