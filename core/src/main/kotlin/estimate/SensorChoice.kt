package stillwater.estimate

import stillwater.model.Interval
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Chooses the sensor model of a [SelfCalibratingEstimator] from the readings.
 *
 * The first-order lag is fitted always. The others are fitted where it leaves something to explain, as [isExplained] is
 * judged; the Bayesian information criterion decides. Source: core/docs/SelfCalibratingEstimator.md, section "Choosing".
 */
internal class SensorChoice(settings: SelfCalibratingSettings, private val tape: Recording) : ReadingPlayer {
    private val lag = LagFit(settings)
    private val responses = ResponseBankKind.entries.map { kind -> ResponseBankFit(settings).also { it.kind = kind } }
    private val slew = SlewFit(settings)
    private val kinds = listOf(
        SensorKind.FIRST_ORDER,
        SensorKind.ASYMMETRIC,
        SensorKind.DEAD_TIME,
        SensorKind.SECOND_ORDER,
        SensorKind.SLEW_LIMIT,
    )
    private val fits: List<SensorFit> = listOf<SensorFit>(lag) + responses + slew
    private val criteria = DoubleArray(fits.size)
    private val cells = EvenCells(tape)

    /** Logarithm of the odds against each model; NaN if not tried. */
    private val odds = DoubleArray(fits.size) { Double.NaN }.also { it[0] = 0.0 }

    /** What readings near borders count for. */
    val crossings: Crossings get() = tape.crossings

    /** The model that values rest on. */
    var active: SensorFit = lag
        private set

    /** Another that the readings leave possible, whose bounds count too. */
    var rival: SensorFit? = null
        private set

    /**
     * Whether the chosen model explains the readings: what it leaves is white, [areCellsEven] and [isWaterSteady]. Once
     * it is not white it takes innovations that clearly are to say that it is again: a freer model that fits what is not the sensor's
     * hovers about the limit.
     */
    var isExplained: Boolean = true
        private set
    private var isWhite = true
    private var lastSlot = LagBank.NONE
    private var unsettled = 0

    /** Whether the readings bear out that the water changes at borders only, or are too few to say; see [EvenCells]. */
    var areCellsEven: Boolean = true
        private set

    /** Whether that holds of all readings: false if it does of each visit only, because a cell's water changed. */
    var isWaterSteady: Boolean = true
        private set

    val timeConstant: Double get() = (active as? ResponseBankFit)?.let { exp(it.logTime) } ?: lag.timeConstant

    val relativeUncertainty: Double
        get() = (active as? ResponseBankFit)?.let { sqrt(it.logTimeVariance) } ?: lag.relativeUncertainty

    /** From now on the tape does not hold all. */
    fun follow() {
        lag.follow()
        // By index: this is called with every reading, and a list's iterator is an object.
        for (k in responses.indices) responses[k].follow()
    }

    override val filters: Int get() = MOST_FILTERS

    override fun enter(slot: Int, from: Double, until: Double) {
        settle()
        lastSlot = slot
        active.enter(slot, from, until)
        rival?.enter(slot, from, until)
    }

    override fun take(slot: Int, seconds: Double, value: Double) {
        if (slot != lastSlot || ++unsettled > LONGEST_UNSETTLED) settle()
        lastSlot = slot
        active.take(slot, seconds, value)
        rival?.take(slot, seconds, value)
    }

    /** Reads the parameters off all that was taken, and judges what they leave: before a visit, and before a fit. */
    fun settle() {
        unsettled = 0
        active.settle()
        rival?.settle()
        judge()
    }

    /**
     * Whether what [fit] leaves is white enough to say that it explains the readings: clearly so once what one left was
     * not. Where the lag's is not, all others are tried: else it may hover between the two limits, neither explaining
     * nor held against another.
     */
    private fun isWhite(fit: SensorFit) = if (isWhite) fit.isWhite else fit.isClearlyWhite

    private fun judge() {
        isWhite = isWhite(active)
        isExplained = isWhite && areCellsEven && isWaterSteady
    }

    override fun leave() {
        settle()
        lastSlot = LagBank.NONE
        active.leave()
        rival?.leave()
    }

    /** Begins where [other] is, with what it believes of the sensor but not of the cells; [decide] comes next. */
    fun becomeLike(other: SensorChoice) {
        lag.becomeLike(other.lag)
        for (k in responses.indices) responses[k].becomeLike(other.responses[k])
        slew.becomeLike(other.slew)
        other.odds.copyInto(odds)
        isExplained = other.isExplained
        isWhite = other.isWhite
        areCellsEven = other.areCellsEven
        isWaterSteady = other.isWaterSteady
    }

    /** Fits to the first [size] on the tape, and chooses. */
    suspend fun decide(size: Int) {
        tape.begin(size)
        // What was far behind a model that explained the readings is not tried again.
        if (!isExplained) odds.fill(Double.NaN)
        active = lag
        rival = null
        lag.calibrate(tape)
        areCellsEven = true
        isWaterSteady = true
        if (lag.freedom < SensorFit.FEWEST_TO_JUDGE) return judge()
        val penalty = ln(lag.freedom)
        criteria.fill(Double.NaN)
        criteria[0] = lag.freedom * ln(lag.misfit) + penalty
        for (k in 1 until fits.size) {
            if (odds[k] > HOPELESS) continue
            criteria[k] = criterion(fits[k], penalty)
        }
        var best = 0
        // A freer model that does not explain the readings either fits what is not the sensor's.
        for (k in fits.indices) if (criteria[k] < criteria[best] && fits[k].isWhite) best = k
        active = fits[best]
        for (k in fits.indices) if (!(odds[k] > HOPELESS)) odds[k] = (criteria[k] - criteria[best]) / 2
        var next = -1
        if (best > 0) {
            for (k in fits.indices) if (k != best && isPossible(k) && (next < 0 || odds[k] < odds[next])) next = k
        }
        if (next >= 0) rival = fits[next]
        // Where borders are heeded, what the sensor looks like without tells even cells; see [SensorLearner].
        val areBorneOut = crossings.areHeeded || cells.areBorneOut(active)
        areCellsEven = areBorneOut || cells.areBorneOutByEachVisit(active)
        isWaterSteady = areBorneOut || !areCellsEven
        judge()
    }

    /** Takes what came since [decide] began. */
    suspend fun catchUp() = tape.playOn(this)

    private suspend fun criterion(fit: SensorFit, penalty: Double): Double {
        if (fit is ResponseBankFit) {
            if (isWhite(lag) && fit.glance(tape, lag) < WORTH_A_FIT) return Double.NaN
            fit.startFrom(lag.timeConstant)
        } else if (isWhite(lag)) {
            return Double.NaN
        }
        fit.calibrate(tape)
        if (fit is SlewFit && !fit.moves) return Double.NaN
        // The same number of readings for all: a truth never reached is not fitted.
        if (fit is ResponseBankFit) return lag.freedom * ln(fit.comparableMisfit(tape)) + 2 * penalty
        val left = fit.misfit * if (fit is SlewFit) lag.freedom / fit.freedom else 1.0
        return lag.freedom * ln(left) + penalty
    }

    private fun isPossible(k: Int) = odds[k] < POSSIBLE && fits[k].isWhite

    /** What is believed, in sensor units with [scale] of them to the scaled unit. */
    fun belief(scale: Double): SensorBelief {
        val best = fits.indexOf(active)
        val candidates = fits.indices.map { k ->
            val standing = when {
                k == best -> SensorStanding.CHOSEN
                odds[k].isNaN() -> SensorStanding.NOT_TRIED
                !isExplained -> SensorStanding.POSSIBLE
                best == 0 && odds[k] < POSSIBLE -> SensorStanding.NOT_NEEDED
                isPossible(k) -> SensorStanding.POSSIBLE
                else -> SensorStanding.EXCLUDED
            }
            val numbers = if (standing == SensorStanding.NOT_TRIED) emptyList() else parameters(k, scale)
            SensorCandidate(kinds[k], standing, odds[k], numbers)
        }
        return SensorBelief(isExplained, areCellsEven, isWaterSteady, candidates.sortedBy { it.standing })
    }

    private fun parameters(k: Int, scale: Double): List<SensorParameter> {
        val fit = fits[k]
        val quantile = quantile(fit.freedom)
        if (fit is LagFit) return listOf(time("time_constant_s", fit.timeConstant, quantile * fit.relativeUncertainty))
        if (fit is SlewFit) return listOf(rate(fit, scale, quantile))
        fit as ResponseBankFit
        val first = sqrt(fit.logTimeVariance) * quantile
        val second = sqrt(fit.secondVariance) * quantile
        return when (fit.kind) {
            ResponseBankKind.ASYMMETRIC -> listOf(1, -1).map { sign ->
                val variance = fit.firstVariance + sign * fit.covariance + fit.secondVariance / 4
                val value = exp(fit.first + sign * fit.second / 2)
                val name = if (sign > 0) "rising_time_constant_s" else "falling_time_constant_s"
                time(name, value, quantile * sqrt(maxOf(0.0, variance)))
            }
            ResponseBankKind.DEAD_TIME -> listOf(
                SensorParameter(
                    "dead_time_s",
                    fit.second,
                    Interval(maxOf(0.0, fit.second - second), fit.second + second),
                    "s",
                ),
                time("time_constant_s", exp(fit.logTime), first),
            )
            ResponseBankKind.SECOND_ORDER -> listOf(
                time("sum_of_time_constants_s", exp(fit.logTime), first),
                SensorParameter(
                    "share_of_the_shorter",
                    ResponseBankKind.shorter(fit.second),
                    Interval(
                        ResponseBankKind.shorter(maxOf(0.0, fit.second - second)),
                        ResponseBankKind.shorter(fit.second + second),
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
        private const val HOPELESS = 50.0

        /** Readings in one cell after which the parameters are settled and the model is judged at the latest. */
        private const val LONGEST_UNSETTLED = 16

        /** Filters of two models of two parameters, an asymmetric one among them. */
        private const val MOST_FILTERS = 21

        /** 97.5 % quantile of the normal distribution. */
        private const val NORMAL = 1.959963984540054

        /** Student's 97.5 % quantile to first order in 1/ν: z + (z³ + z) / (4 ν). */
        fun quantile(freedom: Double): Double = NORMAL + NORMAL * (NORMAL * NORMAL + 1) / (4 * freedom)
    }
}
