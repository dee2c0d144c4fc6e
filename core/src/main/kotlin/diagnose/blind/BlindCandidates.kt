package stillwater.diagnose.blind

import stillwater.diagnose.Candidate
import stillwater.diagnose.Cause
import stillwater.diagnose.Estimate
import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.evidence.StillReadings
import stillwater.sensor.SensorStage

/**
 * What changes nothing in what the [first] model shows, which leaves [rest]: these wild readings, and water that changes on
 * top of it.
 */
internal fun BlindOutliers.beside(rest: Double, first: BlindRound): List<Candidate> {
    val chances = listOf(Cause.OUTLIERS to pValue, Cause.TIME_VARYING_FIELD to Evidence.pValue(first.changed, 1))
    return chances.map { (cause, p) ->
        val numbers = size()?.takeIf { cause == Cause.OUTLIERS }?.numbers.orEmpty()
        val adjusted = minOf(p * (first.causes.size + 1), 1.0)
        Candidate(cause, null, numbers, rest, Double.NaN, Double.NaN, p, adjusted, first.state.shown)
    }
}

/** This saturation that was tried with the ends of [range], at which readings stand [still]. */
internal fun Candidate.ended(range: SensorStage.Range, still: StillReadings): Candidate = with(
    parameters.filter { it.name == "time_constant_s" } +
        listOf("lower" to range.lower, "upper" to range.upper).mapNotNull { (name, end) ->
            end?.let { Estimate(name, "sensor units", it, null) }
        },
    predicted,
    still.atEnd,
    still.atEnd,
)
