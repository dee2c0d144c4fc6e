package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.Loops
import stillwater.diagnose.all
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ReferenceLead
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Term
import stillwater.diagnose.response.UnknownTruth
import stillwater.diagnose.three
import stillwater.estimate.straight
import kotlin.math.abs

/**
 * A reference whose clock goes at another rate than the readings': they are ever later than it, or ever earlier. No cause of the
 * list, and much like a dead time of the mean of that, where sharp steps are in doubt by a row or two.
 *
 * @param rest what was chosen, without delays.
 */
internal class ClockDrift(private val rest: WithoutDelays, private val loops: Loops) {
    private val last = rest.last
    private val series = last.model.series
    private val times = series.times
    private val truth = requireNotNull(series.reference) { "a clock is a reference's" }
    private val middle = (times.first() + times.last()) / 2

    /** That one clock is fast, where that explains the log better than what was chosen; else null. */
    fun rival(): Rival? {
        if (series.isSparse || series.size < PARTS * FEWEST_ROWS) return null
        val delays = loops.all((0 until PARTS).toList(), ::delay)
        val rate = (delays.last() - delays.first()) / (series.duration * (PARTS - 1) / PARTS)
        val change = abs(rate) * series.duration
        val isSteady = delays.zipWithNext().all { (one, next) -> (next - one) * rate > 0 }
        if (!isSteady || change < LEAST_ROWS * series.period) return null
        val around = RATES.flatMap { part -> AROUND.map { part * rate to delays[PARTS / 2] + it * series.period } }
        val (best, fit) = loops.all(around) { it to with(it.first, it.second) }.maxBy { it.second.score }
        val half = best.first * series.duration / 2
        return rest.rival(fit, NUMBERS) {
            "the readings are ${late(best.second - half)} the reference at the beginning and " +
                "${late(best.second + half)} it at the end, as where one of two clocks is fast"
        }
    }

    private fun late(delay: Double) =
        if (delay < 0) "${three(-delay)} s ahead of" else "${three(delay)} s later than"

    /** How much later the readings of one of the parts are than the reference, s. */
    private fun delay(part: Int): Double {
        val term = Term(Cause.DEAD_TIME, isEitherWay = true)
        // What is in doubt of sharp steps would hide how late the readings are.
        val terms = last.model.terms.filter { it.cause !in ReferenceLead.ALIKE } + term
        val model = ResponseModel(series, terms, last.model.steps, Scales(series, last.model.scales.unknown))
        val used = last.noise.used
        val rows = BooleanArray(used.size) { used[it] && it * PARTS / used.size == part }
        val slot = model.slot(term)
        val parameter = model.parameters[slot]
        val free = BooleanArray(model.parameters.size) { it == slot || it == ResponseModel.TIME_CONSTANT }
        val known = last.model.slotOrNull(term)?.let { last.numbers[it] } ?: 0.0
        val noise = CorrelatedNoise(times, 0.0, 1.0, rows)
        return STARTS.map { start ->
            val numbers = model.carried(last.model, last.numbers)
            numbers[slot] = (known + start * series.period).coerceIn(parameter.lower, parameter.upper)
            Fitting.fit(model, numbers, free, rows, rest.longest, noise = noise)
        }.maxBy { it.score }.numbers[slot]
    }

    /** The model without delays where readings are [delay] s later than the reference in the middle of the log, and by [rate] more each second. */
    private fun with(rate: Double, delay: Double): ModelFit {
        val isSharp = last.model.scales.unknown?.isSharp == true
        val course = DoubleArray(times.size) { i ->
            val time = times[i] - delay - rate * (times[i] - middle)
            if (isSharp) truth[lastBefore(time + series.period / 2)] else truth.straight(times, time)
        }
        val log = series.withQuieter(course)
        // A step is where the reference has it to a row.
        val unknown = UnknownTruth.of(log).let { if (it.isSharp) it.toARow() else it }
        val steps = last.model.steps
        val (tau, gain) = last.numbers.let { it[ResponseModel.TIME_CONSTANT] to it[ResponseModel.GAIN] }
        val scales = Scales(log, unknown, unknown.shocks(tau, gain, last.spread, steps.isHeld))
        return rest.fit(scales, steps, rest.base.numbers[ResponseModel.TIME_CONSTANT])
    }

    /** The last row that is not after [time], or the first. When a sharp step came is as likely before the middle between two as after it. */
    private fun lastBefore(time: Double): Int = times.binarySearch(time).let { if (it >= 0) it else maxOf(-it - 2, 0) }

    private companion object {
        const val PARTS = 3
        const val FEWEST_ROWS = 60

        /** Rows by which the delay changes over the log at least. */
        const val LEAST_ROWS = 2.0

        /** Of the rate that the parts tell, and rows beside what the middle one does. */
        val RATES = listOf(0.7, 0.85, 1.0, 1.15, 1.3)
        val AROUND = listOf(-1.0, -0.5, 0.0, 0.5, 1.0)

        /** Rows beside the delay that is known, from which a part's is looked for. */
        val STARTS = listOf(-4.0, -1.5, 0.0, 1.5, 4.0)

        /** Twice the log-likelihood that two numbers, and the best of so many, gain by chance. */
        const val NUMBERS = 8.0
    }
}
