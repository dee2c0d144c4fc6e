package stillwater.estimate

import stillwater.model.Interval
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Chooses the sensor model of a [SelfCalibratingEstimator] from the readings.
 *
 * The first-order lag is fitted always. The others are fitted where it leaves something to explain; the Bayesian
 * information criterion decides. Source: core/docs/SelfCalibratingEstimator.md, section "Choosing".
 */
internal class SensorChoice(private val settings: SelfCalibratingSettings) {
    private val lag = LagFit(settings)
    private val responses = ResponseKind.entries.map { kind -> ResponseFit(settings).also { it.kind = kind } }
    private val slew = SlewFit(settings)
    private val kinds = listOf(
        SensorKind.FIRST_ORDER,
        SensorKind.ASYMMETRIC,
        SensorKind.DEAD_TIME,
        SensorKind.SECOND_ORDER,
        SensorKind.SLEW_LIMIT,
    )
    private val fits: List<SensorFit> = listOf<SensorFit>(lag) + responses + slew
    private val criteria = DoubleArray(fits.size) { Double.NaN }

    /** The model that values rest on. */
    var active: SensorFit = lag
        private set

    /** Another that the readings leave possible, whose bounds count too. */
    var rival: SensorFit? = null
        private set

    val isExplained: Boolean get() = active.isWhite

    val timeConstant: Double get() = (active as? ResponseFit)?.let { exp(it.logTime) } ?: lag.timeConstant

    val relativeUncertainty: Double
        get() = (active as? ResponseFit)?.let { sqrt(it.logTimeVariance) } ?: lag.relativeUncertainty

    /** From now on the tape does not hold all. */
    fun follow() {
        lag.follow()
    }

    fun take(slot: Int, seconds: Double, value: Double) {
        active.take(slot, seconds, value)
        rival?.take(slot, seconds, value)
    }

    fun leave() {
        active.leave()
        rival?.leave()
    }

    /** Fits to [tape], and chooses. */
    fun decide(tape: ReadingTape) {
        criteria.fill(Double.NaN)
        active = lag
        rival = null
        lag.calibrate(tape)
        if (lag.freedom < SensorFit.FEWEST_TO_JUDGE) return
        val penalty = ln(lag.freedom)
        criteria[0] = lag.freedom * ln(lag.misfit) + penalty
        for (k in responses.indices) {
            val fit = responses[k]
            if (lag.isWhite && fit.glance(tape, lag) < WORTH_A_FIT) continue
            fit.startFirst = ln(lag.timeConstant)
            fit.calibrate(tape)
            criteria[k + 1] = lag.freedom * ln(fit.misfit) + 2 * penalty
        }
        if (!lag.isWhite) {
            slew.calibrate(tape)
            if (slew.moves) criteria[SLEW] = lag.freedom * ln(slew.misfit * lag.freedom / slew.freedom) + penalty
        }
        var best = 0
        for (k in fits.indices) if (criteria[k] < criteria[best]) best = k
        active = fits[best]
        var next = -1
        for (k in 1 until fits.size) {
            val isClose = k != best && criteria[k] - criteria[best] < 2 * POSSIBLE && fits[k].isWhite
            if (isClose && best > 0 && (next < 0 || criteria[k] < criteria[next])) next = k
        }
        if (next >= 0) rival = fits[next]
    }

    /** What is believed, in sensor units with [scale] of them to the scaled unit. */
    fun belief(scale: Double): SensorBelief {
        val best = fits.indexOf(active)
        val candidates = fits.indices.map { k ->
            val standing = when {
                k == best -> SensorStanding.CHOSEN
                criteria[k].isNaN() -> SensorStanding.NOT_TRIED
                criteria[k] - criteria[best] >= 2 * POSSIBLE || !fits[k].isWhite -> SensorStanding.EXCLUDED
                best == 0 -> SensorStanding.NOT_NEEDED
                else -> SensorStanding.POSSIBLE
            }
            val odds = if (k == best) 0.0 else (criteria[k] - criteria[best]) / 2
            SensorCandidate(kinds[k], standing, odds, if (standing == SensorStanding.NOT_TRIED) emptyList() else parameters(k, scale))
        }
        return SensorBelief(isExplained, candidates.sortedBy { it.standing })
    }

    private fun parameters(k: Int, scale: Double): List<SensorParameter> {
        val fit = fits[k]
        val quantile = quantile(fit.freedom)
        if (fit is LagFit) return listOf(time("time_constant_s", fit.timeConstant, quantile * fit.relativeUncertainty))
        if (fit is SlewFit) return listOf(rate(fit, scale, quantile))
        fit as ResponseFit
        val first = sqrt(fit.logTimeVariance) * quantile
        val second = sqrt(fit.secondVariance) * quantile
        return when (fit.kind) {
            ResponseKind.ASYMMETRIC -> listOf(1, -1).map { sign ->
                val variance = fit.firstVariance + sign * fit.covariance + fit.secondVariance / 4
                val value = exp(fit.first + sign * fit.second / 2)
                val name = if (sign > 0) "rising_time_constant_s" else "falling_time_constant_s"
                time(name, value, quantile * sqrt(maxOf(0.0, variance)))
            }
            ResponseKind.DEAD_TIME -> listOf(
                SensorParameter(
                    "dead_time_s",
                    fit.second,
                    Interval(maxOf(0.0, fit.second - second), fit.second + second),
                    "s",
                ),
                time("time_constant_s", exp(fit.logTime), first),
            )
            ResponseKind.SECOND_ORDER -> listOf(
                time("sum_of_time_constants_s", exp(fit.logTime), first),
                SensorParameter(
                    "share_of_the_shorter",
                    ResponseKind.shorter(fit.second),
                    Interval(
                        ResponseKind.shorter(maxOf(0.0, fit.second - second)),
                        ResponseKind.shorter(fit.second + second),
                    ),
                    "",
                ),
            )
        }
    }

    private fun rate(fit: SlewFit, scale: Double, quantile: Double): SensorParameter {
        val reach = exp(quantile * fit.relativeUncertainty)
        val rate = scale * fit.rate
        return SensorParameter("rate_per_s", rate, Interval(rate / reach, rate * reach), "sensor units/s")
    }

    private fun time(name: String, value: Double, reach: Double) =
        SensorParameter(name, value, Interval(value * exp(-reach), value * exp(reach)), "s")

    companion object {
        /** Gain in misfit over σ² that a look must promise before a model is fitted. */
        private const val WORTH_A_FIT = 9.0

        /** A model with smaller logarithm of the odds against it is still possible. */
        private const val POSSIBLE = 5.0
        private const val SLEW = 4

        /** 97.5 % quantile of the normal distribution. */
        private const val NORMAL = 1.959963984540054

        /** Student's 97.5 % quantile to first order in 1/ν: z + (z³ + z) / (4 ν). */
        fun quantile(freedom: Double): Double = NORMAL + NORMAL * (NORMAL * NORMAL + 1) / (4 * freedom)
    }
}
