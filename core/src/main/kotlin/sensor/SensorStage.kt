package stillwater.sensor

import kotlinx.serialization.SerialName
import kotlinx.serialization.Serializable
import stillwater.model.Conditions
import kotlin.random.Random

/**
 * One part of a sensor as data. The parts of a sensor act in the order in which they are listed.
 *
 * Each is checked when it is built or read: an impossible number throws IllegalArgumentException with the reason. A
 * second-order response is two lags in a row.
 */
@Serializable
public sealed interface SensorStage {
    /** A [SensorModel] of this stage that has settled at [initial], drawing what is random in it from [random]. */
    public fun build(initial: Double, random: Random): SensorModel

    /** What this stage shows of [truth] once it has settled and before time wears on it, sensor units. */
    public fun settled(truth: Double): Double = truth

    /** Names of the conditions that what it does depends on; of a lag those with which its time constant changes. */
    public val conditions: Set<String> get() = emptySet()

    /** [FirstOrderLag] with [timeConstant] τ, s. */
    @Serializable
    @SerialName("first-order-lag")
    public data class Lag(@SerialName("time_constant_s") val timeConstant: Double) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel = FirstOrderLag(timeConstant, initial)
    }

    /** [SlewLimit] at [rate], sensor units/s. */
    @Serializable
    @SerialName("slew-limit")
    public data class Slew(@SerialName("rate_per_s") val rate: Double) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel = SlewLimit(rate, initial)
    }

    /** [RateLimitedLag] with [timeConstant] τ, s, and at most [rate], sensor units/s. */
    @Serializable
    @SerialName("rate-limited-lag")
    public data class LimitedLag(
        @SerialName("time_constant_s") val timeConstant: Double,
        @SerialName("rate_per_s") val rate: Double,
    ) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel = RateLimitedLag(timeConstant, rate, initial)
    }

    /** [GaussianNoise] of [standardDeviation], sensor units. */
    @Serializable
    @SerialName("noise")
    public data class Noise(@SerialName("standard_deviation") val standardDeviation: Double) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel = GaussianNoise(standardDeviation, random)
    }

    /** [CorrelatedNoise] of [standardDeviation], sensor units, over [correlationTime], s. */
    @Serializable
    @SerialName("correlated-noise")
    public data class Wander(
        @SerialName("standard_deviation") val standardDeviation: Double,
        @SerialName("correlation_time_s") val correlationTime: Double,
    ) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel =
            CorrelatedNoise(standardDeviation, correlationTime, random)
    }

    /** [Quantisation] to multiples of [step], sensor units. */
    @Serializable
    @SerialName("quantisation")
    public data class Quantum(val step: Double) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel = Quantisation(step)
    }

    /** [AsymmetricLag] with the time constants [rising] and [falling], s. */
    @Serializable
    @SerialName("asymmetric-lag")
    public data class Asymmetric(
        @SerialName("rising_time_constant_s") val rising: Double,
        @SerialName("falling_time_constant_s") val falling: Double,
    ) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel = AsymmetricLag(rising, falling, initial)
    }

    /** [DeadTime] of [deadTime], s. */
    @Serializable
    @SerialName("dead-time")
    public data class Delay(@SerialName("dead_time_s") val deadTime: Double) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel = DeadTime(deadTime, initial)
    }

    /** [TwoPathLag] with the time constants [fast] and [slow], s, and [slowShare], dimensionless. */
    @Serializable
    @SerialName("two-path-lag")
    public data class TwoPath(
        @SerialName("fast_time_constant_s") val fast: Double,
        @SerialName("slow_time_constant_s") val slow: Double,
        @SerialName("slow_share") val slowShare: Double,
    ) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel = TwoPathLag(fast, slow, slowShare, initial)
    }

    /** [ConditionedLag] of [TimeConstant.ofFlow]: [timeConstant], s, at [referenceSpeed], m/s, with [exponent]. */
    @Serializable
    @SerialName("flow-dependent-lag")
    public data class FlowLag(
        @SerialName("time_constant_s") val timeConstant: Double,
        @SerialName("reference_speed_m_per_s") val referenceSpeed: Double,
        val exponent: Double,
    ) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel =
            ConditionedLag(TimeConstant.ofFlow(timeConstant, referenceSpeed, exponent), initial)

        override val conditions: Set<String> get() = ofChanges(exponent, 0.0)
    }

    /**
     * [ConditionedLag] of [TimeConstant.ofTemperature]: [timeConstant], s, at [referenceTemperature], °C, with [relativeChange],
     * 1/°C.
     */
    @Serializable
    @SerialName("temperature-dependent-lag")
    public data class TemperatureLag(
        @SerialName("time_constant_s") val timeConstant: Double,
        @SerialName("reference_temperature_deg_c") val referenceTemperature: Double,
        @SerialName("relative_change_per_deg_c") val relativeChange: Double,
    ) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel =
            ConditionedLag(TimeConstant.ofTemperature(timeConstant, referenceTemperature, relativeChange), initial)

        override val conditions: Set<String> get() = ofChanges(0.0, relativeChange)
    }

    /**
     * [CombinedLag]: [timeConstant], s, at [referenceSpeed], m/s, and [referenceTemperature], °C; how it changes with
     * speed ([exponent]) and temperature ([relativeChange], 1/°C), between rise and fall ([risingOverFalling]), and the
     * slow path beside it ([slowOverFast], [slowShare]). What is left out does nothing.
     */
    @Serializable
    @SerialName("combined-lag")
    public data class Combined(
        @SerialName("time_constant_s") val timeConstant: Double,
        @SerialName("reference_speed_m_per_s") val referenceSpeed: Double = 1.0,
        val exponent: Double = 0.0,
        @SerialName("reference_temperature_deg_c") val referenceTemperature: Double = 0.0,
        @SerialName("relative_change_per_deg_c") val relativeChange: Double = 0.0,
        @SerialName("rising_over_falling") val risingOverFalling: Double = 1.0,
        @SerialName("slow_over_fast") val slowOverFast: Double = 1.0,
        @SerialName("slow_share") val slowShare: Double = 0.0,
    ) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel {
            val flow = TimeConstant.ofFlow(timeConstant, referenceSpeed, exponent)
            val warmth = TimeConstant.ofTemperature(1.0, referenceTemperature, relativeChange)
            val both = TimeConstant { (flow.under(it) * warmth.under(it)).coerceIn(Double.MIN_VALUE, Double.MAX_VALUE) }
            return CombinedLag(both, risingOverFalling, slowOverFast, slowShare, initial)
        }

        override val conditions: Set<String> get() = ofChanges(exponent, relativeChange)
    }

    /** [GainOffset] with [gain], dimensionless, and [offset], sensor units. */
    @Serializable
    @SerialName("gain-offset")
    public data class Calibration(val gain: Double, val offset: Double) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel = GainOffset(gain, offset)

        override fun settled(truth: Double): Double = build(truth, Random(0)).step(truth, 0.0, Conditions.NONE)
    }

    /**
     * [CrossSensitivity] to [condition] about [reference] with [coefficient]; settles as where the condition is unknown.
     */
    @Serializable
    @SerialName("cross-sensitivity")
    public data class Cross(val condition: String, val reference: Double, val coefficient: Double) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel =
            CrossSensitivity(condition, reference, coefficient)

        override val conditions: Set<String> get() = if (coefficient == 0.0) emptySet() else setOf(condition)
    }

    /** [Drift] at [rate], sensor units/s. */
    @Serializable
    @SerialName("drift")
    public data class Drifting(@SerialName("rate_per_s") val rate: Double) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel = Drift(rate)
    }

    /** [OffsetSteps] to [offsets], sensor units, at [times], s. */
    @Serializable
    @SerialName("offset-steps")
    public data class Jumps(@SerialName("times_s") val times: List<Double>, val offsets: List<Double>) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel =
            OffsetSteps(times.toDoubleArray(), offsets.toDoubleArray())
    }

    /** [Play] of [width], sensor units. */
    @Serializable
    @SerialName("hysteresis")
    public data class Backlash(val width: Double) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel = Play(width, initial)
    }

    /** [Saturation] at [lower] and [upper], sensor units; null where it does not end. */
    @Serializable
    @SerialName("saturation")
    public data class Range(val lower: Double? = null, val upper: Double? = null) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel =
            Saturation(lower ?: Double.NEGATIVE_INFINITY, upper ?: Double.POSITIVE_INFINITY)

        override fun settled(truth: Double): Double = build(truth, Random(0)).step(truth, 0.0, Conditions.NONE)
    }

    /** [Outliers] with [probability], dimensionless, and [size], sensor units. */
    @Serializable
    @SerialName("outliers")
    public data class Outlying(val probability: Double, val size: Double) : SensorStage {
        init {
            build(0.0, Random(0))
        }

        override fun build(initial: Double, random: Random): SensorModel = Outliers(probability, size, random)
    }
}

/** What a lag depends on that changes with the speed by [exponent] and with the temperature by [relativeChange], 1/°C. */
private fun ofChanges(exponent: Double, relativeChange: Double): Set<String> = setOfNotNull(
    Conditions.SPEED.takeIf { exponent != 0.0 },
    Conditions.TEMPERATURE.takeIf { relativeChange != 0.0 },
)
