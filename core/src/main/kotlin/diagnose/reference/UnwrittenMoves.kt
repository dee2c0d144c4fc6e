package stillwater.diagnose.reference

import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.Estimate
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.ModelAssessment
import stillwater.diagnose.Verdict
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.evidence.TooLittle
import stillwater.diagnose.independentResiduals
import stillwater.diagnose.response.Resolution
import stillwater.diagnose.response.Scales
import stillwater.diagnose.three
import stillwater.estimate.ReferenceLearner
import stillwater.estimate.ResponseKind
import stillwater.estimate.TrackSeries
import stillwater.estimate.UnusableReadings
import stillwater.model.Interval
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.sqrt

/**
 * The answer to a log whose reference moves only where rows of it are missing. Which causes are at work is not to be told:
 * when it moved is not known. How the readings settle after each move shows the lag all the same.
 *
 * @param series has a reference. @param isGap before which rows some are missing. @param given the sensor that is taken as
 *   given; null for none.
 */
internal class UnwrittenMoves(
    private val series: MeasuredSeries,
    isGap: BooleanArray,
    private val given: SensorSpec?,
) {
    private val track = TrackSeries(series.times, series.x, series.y, series.values).withGaps(isGap)
    private val isRead = series.readRows()
    private val wild = UnusableReadings.of(track, Resolution.of(series.shown(series.values))).wild
    private val learner = ReferenceLearner(
        track,
        checkNotNull(series.reference),
        unusable = UnusableReadings(BooleanArray(track.size) { wild[it] || !isRead[it] }, ByteArray(track.size)),
    )

    /** The result, of which [why] says what cannot be told. */
    fun answer(why: String): DiagnosisResult {
        val range = learner.lagRange()
        val isShown = range.start > 0 && range.endInclusive < ReferenceLearner.MOST_FACTOR * range.start
        val lag = learner.candidate(ResponseKind.FIRST_ORDER).takeIf { isShown } ?: return TooLittle.answer(series, why)
        val (gain, offset) = learner.calibration(lag.response)
        val tau = lag.parameter(0)
        val reach = lag.interval(0).let { Interval(it.start, it.endInclusive) }
        val left = learner.residuals(lag.response)
        val spread = sqrt(squares(left) / maxOf(1, learner.count))
        val base = ModelAssessment(
            listOf(
                Estimate("time_constant_s", "s", tau, reach),
                Estimate("gain", "", gain, null),
                Estimate("offset", "sensor units", offset, null),
            ),
            spread,
            Double.NaN,
            Double.NaN,
            DoubleArray(series.size) { series.values[it] - left[it] },
            spread,
            0.0,
            0.0,
            DoubleArray(series.size) { if (spread > 0) left[it] / spread else 0.0 },
            independentResiduals(isRead),
        )
        val stages = listOf(SensorStage.Lag(tau), SensorStage.Calibration(gain, offset)) +
            listOf(SensorStage.Noise(spread)).filter { spread > 0 }
        return DiagnosisResult(
            Verdict.InsufficientData("$why. ${words(tau, reach)}"),
            emptyList(),
            base,
            null,
            SensorSpec("base", stages),
            null,
            null,
            emptyList(),
            wild.indices.filter { wild[it] && isRead[it] },
            emptyList(),
        )
    }

    private fun words(tau: Double, reach: Interval): String {
        val lag = "What does show is how the readings settle after the moves: a time constant of ${three(tau)} " +
            "[${three(reach.lower)}, ${three(reach.upper)}] s"
        val own = given?.stages?.filterIsInstance<SensorStage.Lag>()?.singleOrNull()?.timeConstant ?: return lag
        return lag + if (own in reach.lower..reach.upper) "" else ", and not the ${three(own)} s of the sensor given"
    }
}
