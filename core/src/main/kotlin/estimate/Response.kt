package stillwater.estimate

import stillwater.sensor.SensorStage
import kotlin.math.ln

/**
 * One exponential lag of a [Response].
 *
 * @property rising time constant while the sensor rises, s, above 0 and finite.
 * @property falling time constant while it falls, s, above 0 and finite; the same as [rising] for a symmetric lag.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class ResponseLag(val rising: Double, val falling: Double = rising) {
    init {
        require(rising > 0 && rising.isFinite()) { "rising ($rising s) must be above 0 and finite" }
        require(falling > 0 && falling.isFinite()) { "falling ($falling s) must be above 0 and finite" }
    }

    /** The time constant, s, whose rate is the mean of both where the sensor rises with the probability [rises], 0..1. */
    internal fun between(rises: Double): Double = when (rises) {
        1.0 -> rising
        0.0 -> falling
        else -> 1 / (rises / rising + (1 - rises) / falling)
    }
}

/**
 * How a sensor follows the water in time: a dead time, lags in a row, or a limited rate. What estimators that work on
 * a whole track can undo.
 *
 * @property deadTime d, s, at least 0 and finite.
 * @property lags at most two, in the order in which they act.
 * @property slewRate largest rate of change, sensor units/s, above 0; infinite without a limit.
 * @property slowShare w, dimensionless, within 0..1: above 0 the two lags are not in a row but beside each other, and
 *   the sensor shows (1 − w) of the first and w of the second.
 * @property flowExponent p, dimensionless, within 0..2: the time constants are those at a reference speed v₀ of the boat,
 *   and (v / v₀)^−p as long at the speed v; 0 for lags that are always the same. Not beside a dead time or a limit.
 * @property isLimitWithin whether the limit is that of the lag's own rate, not that of what the lags show.
 * @throws IllegalArgumentException if a number is out of its range, or there are more than two lags.
 */
public data class Response(
    val deadTime: Double = 0.0,
    val lags: List<ResponseLag> = emptyList(),
    val slewRate: Double = Double.POSITIVE_INFINITY,
    val slowShare: Double = 0.0,
    val flowExponent: Double = 0.0,
    val isLimitWithin: Boolean = false,
) {
    init {
        require(deadTime >= 0 && deadTime.isFinite()) { "deadTime ($deadTime s) must be at least 0 and finite" }
        require(lags.size <= MOST_LAGS) { "lags (${lags.size}) must be at most $MOST_LAGS" }
        require(slowShare in 0.0..1.0) { "slowShare ($slowShare) must be within 0..1" }
        require(slowShare == 0.0 || lags.size == 2) { "slowShare ($slowShare) is of two lags, found ${lags.size}" }
        require(flowExponent in 0.0..MOST_EXPONENT) { "flowExponent ($flowExponent) must be within 0..$MOST_EXPONENT" }
        require(flowExponent == 0.0 || (deadTime == 0.0 && slewRate.isInfinite())) {
            "flowExponent ($flowExponent) is of lags alone, found a dead time or a limit"
        }
        require(slewRate > 0) { "slewRate ($slewRate sensor units/s) must be above 0" }
    }

    /** Mean delay, s: dead time and time constants added up, rising and falling at the mean. */
    public val meanDelay: Double
        get() {
            val delays = lags.map { (it.rising + it.falling) / 2 }
            if (slowShare > 0) return deadTime + (1 - slowShare) * delays[0] + slowShare * delays[1]
            return deadTime + delays.sum()
        }

    /** This response with [time], s, less delay: of the dead time first, then of the longest lag. */
    public fun sooner(time: Double): Response {
        val left = time - deadTime
        if (left <= 0) return copy(deadTime = deadTime - time)
        val longest = lags.maxByOrNull { it.rising + it.falling } ?: return copy(deadTime = 0.0)
        val factor = maxOf(1 - 2 * left / (longest.rising + longest.falling), SHORTEST_PART)
        val shorter = ResponseLag(longest.rising * factor, longest.falling * factor)
        return copy(deadTime = 0.0, lags = lags.map { if (it === longest) shorter else it })
    }

    /**
     * The response as the stages of a [stillwater.sensor.SensorSpec].
     *
     * @param referenceSpeed v₀ of [flowExponent], m/s; not used without one.
     */
    public fun stages(referenceSpeed: Double = Double.NaN): List<SensorStage> = buildList {
        if (flowExponent > 0) {
            add(SensorStage.FlowLag(lags.single().rising, referenceSpeed, flowExponent))
            return@buildList
        }
        if (deadTime > 0) add(SensorStage.Delay(deadTime))
        if (slowShare > 0) {
            val (fast, slow) = lags.map { (it.rising + it.falling) / 2 }
            add(SensorStage.TwoPath(fast, slow, slowShare))
            return@buildList
        }
        val own = lags.singleOrNull()?.takeIf { isLimitWithin && slewRate.isFinite() && it.rising == it.falling }
        if (own != null) {
            add(SensorStage.LimitedLag(own.rising, slewRate))
            return@buildList
        }
        for (lag in lags) {
            val isSymmetric = lag.rising == lag.falling
            add(if (isSymmetric) SensorStage.Lag(lag.rising) else SensorStage.Asymmetric(lag.rising, lag.falling))
        }
        if (slewRate.isFinite()) add(SensorStage.Slew(slewRate))
    }

    public companion object {
        /** Lags in a row that are undone together. */
        public const val MOST_LAGS: Int = 2

        /** Largest [flowExponent]. */
        public const val MOST_EXPONENT: Double = 2.0
        private const val SHORTEST_PART = 0.01
    }
}

/**
 * The responses among which a log may decide.
 *
 * @property label name in files and on the terminal.
 * @property parameters names of the parameters, units in them, in the order of [response].
 */
public enum class ResponseKind(public val label: String, public val parameters: List<String>) {
    /** Follows at once. */
    NONE("none", emptyList()),

    /** One exponential lag. */
    FIRST_ORDER("first-order-lag", listOf("time_constant_s")),

    /** A pure delay. */
    DEAD_TIME("dead-time", listOf("dead_time_s")),

    /** Two equal lags in a row. */
    SECOND_ORDER("second-order-lag", listOf("time_constant_s")),

    /** Two lags in a row that are not equal. Which of them acts first does not show. */
    TWO_LAGS("two-lags-in-a-row", listOf("shorter_time_constant_s", "longer_time_constant_s")),

    /** A delay, then a lag. */
    DEAD_TIME_AND_LAG("dead-time-and-lag", listOf("dead_time_s", "time_constant_s")),

    /** A lag with one time constant up and another down. */
    ASYMMETRIC("asymmetric-lag", listOf("rising_time_constant_s", "falling_time_constant_s")),

    /** Two lags beside each other: most follows soon, and a share only slowly. */
    TWO_PATH("two-path-lag", listOf("fast_time_constant_s", "slow_time_constant_s", "slow_share")),

    /** A delay, then two lags beside each other. */
    DEAD_TIME_AND_TWO_PATH(
        "dead-time-and-two-path-lag",
        listOf("dead_time_s", "fast_time_constant_s", "slow_time_constant_s", "slow_share"),
    ),

    /** One exponential lag, the longer the slower the boat; its time constant at the reference speed. */
    FLOW("flow-dependent-lag", listOf("time_constant_s", "exponent")),

    /** Follows at once, but no faster than a rate. */
    SLEW("slew-limit", listOf("rate_per_s")),
    ;

    /**
     * The response with [parameters], all above 0, in the order of the property of that name; a share above
     * [LARGEST_SHARE] is taken as that. Not modified.
     */
    public fun response(vararg parameters: Double): Response {
        require(parameters.size == this.parameters.size) {
            "$label has ${this.parameters.size} parameters, found ${parameters.size}"
        }
        return when (this) {
            NONE -> Response()
            FIRST_ORDER -> Response(lags = listOf(ResponseLag(parameters[0])))
            DEAD_TIME -> Response(deadTime = parameters[0])
            SECOND_ORDER -> Response(lags = List(2) { ResponseLag(parameters[0]) })
            TWO_LAGS -> Response(lags = parameters.map { ResponseLag(it) })
            DEAD_TIME_AND_LAG -> Response(parameters[0], listOf(ResponseLag(parameters[1])))
            ASYMMETRIC -> Response(lags = listOf(ResponseLag(parameters[0], parameters[1])))
            TWO_PATH -> beside(0.0, parameters)
            DEAD_TIME_AND_TWO_PATH -> beside(parameters[0], parameters.copyOfRange(1, parameters.size))
            FLOW -> {
                val exponent = minOf(parameters[1], Response.MOST_EXPONENT)
                Response(lags = listOf(ResponseLag(parameters[0])), flowExponent = exponent)
            }
            SLEW -> Response(slewRate = parameters[0])
        }
    }

    private fun beside(deadTime: Double, parameters: DoubleArray) = Response(
        deadTime,
        listOf(ResponseLag(parameters[0]), ResponseLag(parameters[1])),
        slowShare = minOf(parameters[2], LARGEST_SHARE),
    )

    /** Whether [other] is this one with a parameter at its limit, so that this one can do no worse on the same data. */
    public fun contains(other: ResponseKind): Boolean = when (this) {
        NONE -> false
        TWO_LAGS -> other == FIRST_ORDER || other == SECOND_ORDER || other == NONE
        DEAD_TIME_AND_LAG -> other == FIRST_ORDER || other == DEAD_TIME || other == NONE
        DEAD_TIME_AND_TWO_PATH -> other == TWO_PATH || DEAD_TIME_AND_LAG.contains(other) || other == DEAD_TIME_AND_LAG
        ASYMMETRIC, TWO_PATH, FLOW -> other == FIRST_ORDER || other == NONE
        else -> other == NONE
    }

    /** Whether parameter [index] is a time, s. */
    internal fun isTime(index: Int): Boolean = parameters[index].endsWith("_s") && this != SLEW

    /**
     * Whether [parameters], in the order of [response], are this kind's and not another one's: two paths need a slow
     * one that is slower and not nearly all.
     */
    internal fun isOwn(parameters: DoubleArray): Boolean {
        if (!hasTwoPaths) return true
        val (fast, slow, share) = parameters.takeLast(TWO_PATH.parameters.size)
        return slow > fast && share < LARGEST_SHARE
    }

    /**
     * What is thought likely before any reading, as the logarithm of a density of the parameters' logarithms [logs]. A
     * slow path of a small share is told apart only together with that share, so both get a wide normal one: slower by
     * [USUAL_RATIO], a share of [USUAL_SHARE], either a factor of e off. All else is left to the readings.
     */
    internal fun belief(logs: DoubleArray): Double {
        if (!hasTwoPaths) return 0.0
        val (fast, slow, share) = logs.takeLast(TWO_PATH.parameters.size)
        val ratio = slow - fast - ln(USUAL_RATIO)
        val part = share - ln(USUAL_SHARE)
        return -(ratio * ratio + part * part) / (2 * BELIEVED * BELIEVED)
    }

    /** Largest value of parameter [index] that [response] tells from larger ones, in its unit. */
    internal fun most(index: Int): Double = when (parameters[index]) {
        TWO_PATH.parameters.last() -> LARGEST_SHARE
        FLOW.parameters.last() -> Response.MOST_EXPONENT
        else -> Double.POSITIVE_INFINITY
    }

    /** Whether it has a slow path; its share is then the last parameter. */
    public val hasTwoPaths: Boolean get() = this == TWO_PATH || this == DEAD_TIME_AND_TWO_PATH

    /** Whether parameter [index] is the time of a slow path, whose length is limited by [belief] alone. */
    internal fun isSlow(index: Int): Boolean = parameters[index] == TWO_PATH.parameters[1]

    /** Whether something is believed of parameter [index] beforehand: of the slow path's time and share. */
    internal fun isBelieved(index: Int): Boolean = hasTwoPaths && (isSlow(index) || most(index).isFinite())

    public companion object {
        /** Standard deviation of what is believed beforehand of the logarithm of a slow path's ratio and share. */
        internal const val BELIEVED: Double = 1.0

        /** Largest share of a slow path, dimensionless: beyond it the fast one is not seen. */
        public const val LARGEST_SHARE: Double = 0.9

        private const val USUAL_RATIO = 8.0
        private const val USUAL_SHARE = 0.1
    }
}
