package stillwater.survey

import kotlin.math.hypot
import kotlin.math.sqrt

/**
 * A stretch of a log.
 *
 * @property from start, s after the first reading.
 * @property to end, s after the first reading, above [from].
 */
data class Stretch(val from: Double, val to: Double)

/**
 * What a log looks like: how often, how regular, how fast, how fine. Medians and quantiles of long logs rest on an
 * even sample of at most 2^18 steps; counts and extremes are exact.
 *
 * @property readings number of readings.
 * @property startTime time of the first reading on the log's clock, s.
 * @property duration time from first to last reading, s.
 * @property steps quantiles of the time between readings, s.
 * @property longestStep longest time between two readings, s.
 * @property speeds quantiles of the speed over ground, taken over stretches of 5 s or one step, m/s.
 * @property distance length of the track, from fixes at least 5 s or one step apart, m.
 * @property repeatedFixes share of readings at exactly the position of the one before, 0 to 1.
 * @property fixScatter how far a fix is off along either axis, as those beside it tell: standard deviation, m; what they share
 *   is not in it. 0 where there are too few.
 * @property repeatedValues share of readings with exactly the value of the one before, 0 to 1.
 * @property west smallest x, m. @property east largest x, m. @property south smallest y, m. @property north largest y, m.
 * @property lowest smallest value, sensor units. @property highest largest value, sensor units.
 * @property values quantiles of the values, sensor units.
 * @property resolution step in which values are rounded, sensor units; NaN where there is none.
 */
class SurveyStatistics internal constructor(
    val readings: Long,
    val startTime: Double,
    val duration: Double,
    val steps: Quantiles,
    val longestStep: Double,
    val speeds: Quantiles,
    val distance: Double,
    val repeatedFixes: Double,
    val fixScatter: Double,
    val repeatedValues: Double,
    val west: Double,
    val east: Double,
    val south: Double,
    val north: Double,
    val lowest: Double,
    val highest: Double,
    val values: Quantiles,
    val resolution: Double,
) {
    /**
     * How far a reading's place may be off along the way: what fixes scatter, and how far the boat goes while one is repeated,
     * as root mean square, m.
     */
    val placeDeviation: Double
        get() {
            val repeats = if (repeatedFixes < 1) repeatedFixes / (1 - repeatedFixes) else 0.0
            val behind = if (speeds.count > 0) repeats * steps.median * speeds.median / sqrt(THIRD) else 0.0
            return hypot(fixScatter, behind)
        }

    /** Time above which the silence between two readings is a gap: five median steps, s. */
    val gapLimit: Double get() = GAP_STEPS * steps.median

    private companion object {
        const val GAP_STEPS = 5

        /** Of the square of a length, the mean square of what is even from nothing to it, one part in so many. */
        const val THIRD = 3.0
    }
}
