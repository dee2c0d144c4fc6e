package stillwater.correct

import stillwater.estimate.CorrectedTrack
import stillwater.estimate.LikelyResponse
import stillwater.estimate.Response
import stillwater.estimate.ResponseKind
import stillwater.estimate.TrackSeries

/**
 * What intervals have to hold where a log holds no evidence on its sensor: that it is quick is then an assumption like any
 * other, and intervals for a sensor without lag held 1 to 16 % of the rows of slow ones.
 *
 * @property longest lag that is held, s: [USUAL], or a quarter of the log where that is less, as where lags are looked for.
 */
internal class UnknownLag private constructor(val longest: Double) {
    /** Each of which a first-order lag may be, s; what lies between two lies between what they give. */
    val responses: List<LikelyResponse> = generateSequence(longest) { it / APART }.take(LAGS).map {
        LikelyResponse(listOf<Response>(ResponseKind.FIRST_ORDER.response(it)), 1.0)
    }.toList()

    /** [track], for a sensor without lag, with intervals that hold what [corrected] makes of each of the lags as well. */
    fun held(track: CorrectedTrack, corrected: (List<LikelyResponse>) -> CorrectedTrack): CorrectedTrack =
        responses.fold(track) { wide, lag -> wide.holding(corrected(listOf(lag))) }

    companion object {
        /** Most probes of water settle within so many seconds, oxygen optodes among them; s. */
        const val USUAL = 30.0
        private const val LAGS = 3
        private const val APART = 3.0
        private const val QUARTER = 4

        /**
         * What is to be held of [series] if the sensor is as [learned]; null where something was learned or given, where a
         * reference says how far intervals reach ([isMeasured]), and of readings that never change.
         */
        fun of(series: TrackSeries, learned: Learned, isMeasured: Boolean): UnknownLag? {
            if (learned.origin != SensorOrigin.NOTHING || isMeasured || isFlat(series.values)) return null
            return UnknownLag(minOf(USUAL, (series.times.last() - series.times.first()) / QUARTER))
        }
    }
}
