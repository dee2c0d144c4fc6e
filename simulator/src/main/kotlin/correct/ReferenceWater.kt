package stillwater.correct

import stillwater.diagnosis.ReferenceSteps
import stillwater.estimate.LikelyResponse
import stillwater.estimate.ReferenceLearner
import stillwater.estimate.Response
import stillwater.estimate.ResponseKind
import stillwater.estimate.TrackCorrector
import stillwater.estimate.TrackSeries
import stillwater.estimate.UnusableReadings
import stillwater.survey.Wording
import stillwater.survey.Wording.Companion.duration
import kotlin.math.sqrt

/**
 * The water that a reference tells, where it has noise of its own, is coarsely rounded, or comes more rarely than the readings. A
 * sensor does not show noise that is not in the water: learned from such a reference it looks slower than it is, and rounder,
 * because that smooths. What the reference says of the water, given all of it, is the water's mean, from which a sensor is
 * learned without that error (regression calibration, Carroll et al. 2006, Measurement Error in Nonlinear Models, ch. 4).
 */
internal object ReferenceWater {
    /** Twice a log-likelihood by which the readings have to be likelier from what was smoothed. */
    private const val CLEARLY = 10.0
    private const val FEWEST = 60

    /** Of the deviation of the references: more is not known of the water between them where they say little of it. */
    private const val MOST_UNKNOWN = 0.2
    private const val TWO_SIDED = 1.96

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
        val middle = usable.middle(MOST)
        if (middle.size < FEWEST || middle.all { references[it] == references[middle[0]] }) return null
        val part = series.at(middle)
        val plain = DoubleArray(middle.size) { references[middle[it]] }
        if (ReferenceLearner.isHeld(part, plain)) return null
        val water = water(part, plain)
        val gain = 2 * (likeliest(part, water) - likeliest(part, plain))
        if (!(gain > CLEARLY)) return null
        val all = if (middle.size == known.size) {
            water
        } else {
            water(series.at(known), DoubleArray(known.size) { references[known[it]] })
        }
        return DoubleArray(series.size) { Double.NaN }.also { for (i in known.indices) it[known[i]] = all[i] }
    }

    /**
     * What [references], NaN where there is none, say of the water in the rows between them as well, where they come more
     * rarely than the readings of [series] and the water is no line between them; null where they do not, or where the
     * water between them is not known from them.
     */
    fun filled(series: TrackSeries, references: DoubleArray): DoubleArray? {
        val known = (0 until series.size).filter { references[it].isFinite() }
        if (known.size < FEWEST) return null
        val part = series.at(known)
        if (!ReferenceSteps.isSparse(part.medianStep, series.medianStep)) return null
        val plain = DoubleArray(known.size) { references[known[it]] }
        if (ReferenceLearner(part, plain).roughness() <= SensorLearning.MOST_ROUGHNESS) return null
        val shown = DoubleArray(series.size) { Double.NaN }
        for ((before, after) in known.zipWithNext()) {
            val isGap = series.times[after] - series.times[before] > part.gapLimit
            for (row in before..if (isGap) before else after - 1) shown[row] = references[before]
        }
        shown[known.last()] = references[known.last()]
        val rows = (0 until series.size).filter { shown[it].isFinite() }
        val isBetween = BooleanArray(rows.size) { references[rows[it]].isNaN() }
        val track = TrackCorrector(
            series.at(rows).withValues(DoubleArray(rows.size) { shown[rows[it]] }),
            unusable = UnusableReadings(isBetween, ByteArray(rows.size)),
        ).correct(AS_IT_IS)
        // What is between reaches to the reading that is not there on one side: to the other it is as wide as it is.
        val halves = rows.indices.map { minOf(track.upper[it] - track.values[it], track.values[it] - track.lower[it]) }
        val unknown = sqrt(halves.sumOf { it * it } / halves.size) / TWO_SIDED
        val mean = plain.average()
        val deviation = sqrt(plain.sumOf { (it - mean) * (it - mean) } / plain.size)
        if (!(unknown < MOST_UNKNOWN * deviation)) return null
        return DoubleArray(series.size) { Double.NaN }.also { for (i in rows.indices) it[rows[i]] = track.values[i] }
    }

    /** What is said of references of which the water between was [filled] in. */
    fun filledWords(series: TrackSeries, references: DoubleArray): String {
        val known = (0 until series.size).filter { references[it].isFinite() }
        val step = ReferenceSteps.usual(known.map(series.times::get))
        return "the reference has a row every ${duration(step)} only: the sensor was learned from the water between " +
            "them as the reference's own course tells it"
    }

    private fun water(series: TrackSeries, references: DoubleArray) =
        TrackCorrector(series.withValues(references)).correct(AS_IT_IS).values

    /**
     * Log-likelihood of the readings of [series] by the response to [references], [held] over each step or not, that explains
     * them best.
     */
    fun likeliest(series: TrackSeries, references: DoubleArray, held: Boolean = false): Double =
        ResponseKind.entries.maxOf {
            ReferenceLearner(series, references, held).candidate(it)?.score ?: Double.NEGATIVE_INFINITY
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
