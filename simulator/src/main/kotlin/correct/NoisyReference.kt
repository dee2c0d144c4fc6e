package stillwater.correct

import stillwater.estimate.LikelyResponse
import stillwater.estimate.ReferenceLearner
import stillwater.estimate.Response
import stillwater.estimate.ResponseKind
import stillwater.estimate.TrackCorrector
import stillwater.estimate.TrackSeries
import stillwater.estimate.UnusableReadings
import stillwater.survey.Wording
import kotlin.math.sqrt

/**
 * A reference with noise of its own, or one that is coarsely rounded. A sensor does not show noise that is not in the water:
 * learned from such a reference it looks slower than it is, and rounder, because that smooths. What the reference says of
 * the water, given all of it, is the water's mean, from which a sensor is learned without that error (regression calibration,
 * Carroll et al. 2006, Measurement Error in Nonlinear Models, ch. 4).
 */
internal object NoisyReference {
    /** Twice a log-likelihood by which the readings have to be likelier from what was smoothed. */
    private const val CLEARLY = 10.0
    private const val FEWEST = 60

    /** Rows asked, in the middle of a log. */
    private const val MOST = 2000
    private val AS_IT_IS = listOf(LikelyResponse(listOf(Response()), 1.0))

    /**
     * What [references], NaN where there is none, say of the water, in the same rows; null where the readings of [series] are
     * as likely from the references as they are.
     */
    fun smoothed(series: TrackSeries, references: DoubleArray, unusable: UnusableReadings): DoubleArray? {
        val known = (0 until series.size).filter { references[it].isFinite() }
        val usable = known.filter(unusable::isUsable)
        val middle = usable.drop(maxOf(0, (usable.size - MOST) / 2)).take(MOST)
        if (middle.size < FEWEST || middle.all { references[it] == references[middle[0]] }) return null
        val part = series.at(middle)
        val plain = DoubleArray(middle.size) { references[middle[it]] }
        if (ReferenceLearner.isHeld(part, plain)) return null
        val water = water(part, plain)
        val gain = 2 * (score(part, water) - score(part, plain))
        if (!(gain > CLEARLY)) return null
        val all = if (middle.size == known.size) {
            water
        } else {
            water(series.at(known), DoubleArray(known.size) { references[known[it]] })
        }
        return DoubleArray(series.size) { Double.NaN }.also { for (i in known.indices) it[known[i]] = all[i] }
    }

    private fun water(series: TrackSeries, references: DoubleArray) =
        TrackCorrector(series.withValues(references)).correct(AS_IT_IS).values

    private fun score(series: TrackSeries, references: DoubleArray): Double = ResponseKind.entries.maxOf {
        ReferenceLearner(series, references).candidate(it)?.score ?: Double.NEGATIVE_INFINITY
    }

    /** What is said of references that were [smoothed] from what they were [before]. */
    fun words(before: DoubleArray, smoothed: DoubleArray): String {
        val known = before.indices.filter { before[it].isFinite() && smoothed[it].isFinite() }
        val off = sqrt(known.map { before[it] - smoothed[it] }.sumOf { it * it } / known.size)
        val scatter = Wording.digits(off, 2)
        return "the reference scatters by $scatter (root mean square) about the water that it shows: the sensor was " +
            "learned from that water"
    }
}
