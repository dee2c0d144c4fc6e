package stillwater.diagnose.evidence

import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.baseNumbers

/**
 * This fit to [rows] of what [scales] have without [gone], begun from a lag of [tau] s, with [steps]; noise wanders within
 * [longest] s. A given number that is among [gone] is given again.
 */
internal fun ModelFit.without(
    gone: List<Trial>,
    tau: Double,
    scales: Scales,
    steps: Steps,
    rows: BooleanArray,
    longest: Double,
): ModelFit {
    val keys = gone.map { it.term.key }
    val given = gone.flatMap { it.term.cause.baseNumbers }
    val fewer = ResponseModel(scales.series, model.terms.filter { it.key !in keys }, steps, scales)
    val start = fewer.carried(model, numbers)
    start[ResponseModel.TIME_CONSTANT] = tau
    val open = BooleanArray(start.size) { it < ResponseModel.BASE && free[it] && it !in given }
    for (term in fewer.terms) {
        for (k in 0 until fewer.width(term)) open[fewer.slot(term) + k] = free[model.slot(term) + k]
    }
    val guess = CorrelatedNoise(scales.series.times, noise.share, noise.time, rows, scales.shocks)
    return Fitting.fit(fewer, start, open, rows, longest, guess = guess)
}

/** Which of these may be gone: all together, and each alone. */
internal fun List<Trial>.allOrEach(): List<List<Trial>> = (listOf(this) + map { listOf(it) }).distinct()
