package stillwater.diagnose

import java.util.Locale
import kotlin.math.exp

/**
 * What a reference can have, and no sensor: it is late, by its clock or by a lag of its own, or it shows more than the
 * water at the sensor, for noise that neighbouring rows share or for water that it sees elsewhere.
 *
 * @param base the model without causes. @param tried how many causes are tried in all.
 */
internal class ReferenceFaults(
    private val search: CauseSearch,
    private val base: ModelFit,
    baseHeldOut: HeldOutScore,
    private val used: BooleanArray,
    private val tried: Int,
    private val level: Double,
) {
    private val series = base.model.series
    private val late = search.attempt(base, baseHeldOut, Term(Cause.DEAD_TIME, isEitherWay = true), base)

    /** How the reference differs if that explains as much as causes do that are worth [explained]; null if not. */
    fun words(explained: Double): String? {
        val ahead = -late.fit.numbers[late.fit.model.slot(late.term)]
        val isLate = ahead > 0 && late.pValue * tried < level && late.foretells &&
            late.fit.score - late.cost >= explained
        return when {
            isLate ->
                "the readings are ahead of the reference by %.2g s: its clock is behind, or it has a lag of its own"
                    .format(Locale.ROOT, ahead)
            explained > base.score && smoothest() >= explained ->
                "the readings follow a smoother course than the reference's: it is noisy, or sees other water than " +
                    "the sensor"
            else -> null
        }
    }

    /** Twice the log-likelihood with the reference smoothed as much as serves best, less what that gains by chance. */
    private fun smoothest(): Double = WIDTHS.maxOf { width ->
        val smooth = series.withQuieter(smoothed(width * series.period))
        val scales = Scales(smooth, base.model.scales.unknown, base.model.scales.shocks)
        val model = ResponseModel(smooth, base.model.terms, base.model.held, scales)
        Fitting.fit(model, base.numbers, base.free, used, search.longest, guess = base.noise).score
    } - CHANCE

    /** The reference under a normal window of standard deviation [width], s; not across gaps. */
    private fun smoothed(width: Double): DoubleArray {
        val reference = requireNotNull(series.reference) { "faults of a reference need one" }
        val times = series.times
        val gap = GAP * series.period
        return DoubleArray(times.size) { i ->
            var weights = 1.0
            var sum = reference[i]
            for (way in intArrayOf(-1, 1)) {
                var k = i + way
                while (k in times.indices && !isBeyond(times, k, way, gap) &&
                    (times[k] - times[i]) * way < REACH * width
                ) {
                    val off = (times[k] - times[i]) / width
                    val weight = exp(-off * off / 2)
                    weights += weight
                    sum += weight * reference[k]
                    k += way
                }
            }
            sum / weights
        }
    }

    private fun isBeyond(times: DoubleArray, k: Int, way: Int, gap: Double) = (times[k] - times[k - way]) * way > gap

    private companion object {
        /** Of the windows, in rows. */
        val WIDTHS = listOf(0.7, 1.5, 3.0, 6.0)
        const val REACH = 3.0
        const val GAP = 3.0

        /** Twice the log-likelihood that one number and the choice among the windows gain by chance. */
        const val CHANCE = 4.0
    }
}
