package stillwater.diagnose.response

import stillwater.diagnose.Cause
import stillwater.diagnose.Estimate
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt

/**
 * A fitted model as a sensor that the simulator runs.
 *
 * @param spikes single readings that are far off; null for none. @param isRounded whether readings are rounded although
 *   the model says nothing of it. @param leftOut what of the model is no property of the sensor. @param range of which
 *   the model says nothing; null for none. @param hasWander whether noise of the fit that wanders is the sensor's: without a
 *   reference it may be the water's.
 */
internal class ExtendedSensor(
    private val fit: ModelFit,
    private val spikes: SpikeSize?,
    private val isRounded: Boolean = false,
    private val leftOut: Set<Cause> = emptySet(),
    private val range: SensorStage.Range? = null,
    private val hasWander: Boolean = false,
) {
    private val model = fit.model
    private val numbers = fit.numbers
    private val tau = maxOf(numbers[ResponseModel.TIME_CONSTANT], model.series.period / 50)
    private val gain = numbers[ResponseModel.GAIN].let { if (it == 0.0) 1e-9 else it }

    /** What the sensor's form cannot hold, one sentence each. */
    val losses = ArrayList<String>()

    /** The sensor, called [name]. */
    fun spec(name: String): SensorSpec = SensorSpec(name, response() + shown())

    private fun value(cause: Cause, k: Int = 0): Double? =
        model.terms.firstOrNull { it.cause == cause && cause !in leftOut }?.let { numbers[model.slot(it) + k] }

    private fun response(): List<SensorStage> = buildList {
        value(Cause.POSITION_OFFSET)?.let { behind ->
            val delay = behind / model.scales.ordinarySpeed
            losses += "An offset of place belongs to the platform: " + if (delay > 0) {
                "the sensor file holds it as the delay at the usual speed."
            } else {
                "no sensor shows the water ahead of it, so that the sensor file is without it."
            }
            if (delay > 0) add(SensorStage.Delay(delay))
        }
        value(Cause.DEAD_TIME)?.let { add(SensorStage.Delay(it)) }
        val band = value(Cause.HYSTERESIS)?.let { SensorStage.Backlash(it / abs(gain)) }
        val isFirst = model.terms.any { it.isFirst }
        if (band != null && isFirst) add(band)
        val lag = lag()
        add(lag)
        value(Cause.SECOND_ORDER_RESPONSE)?.let { add(SensorStage.Lag(it)) }
        limit()?.takeIf { lag !is SensorStage.LimitedLag }?.let {
            add(SensorStage.Slew(it))
            if (model.terms.any { term -> term.isWithin }) losses += BEHIND
        }
        if (band != null && !isFirst) add(band)
    }

    /** The largest rate of what the sensor shows before its gain, sensor units/s; null where there is no such limit. */
    private fun limit() = value(Cause.SLEW_LIMIT)?.let { it / abs(gain) }

    private fun lag(): SensorStage {
        val asymmetry = value(Cause.ASYMMETRIC_RESPONSE)
        val flow = value(Cause.FLOW_DEPENDENT_RESPONSE)
        val warmth = value(Cause.TEMPERATURE_DEPENDENT_RESPONSE)
        // The model takes no path that is slower than a part of the log.
        val ratio = value(Cause.TWO_PATH_RESPONSE)?.let { model.slowRatio(numbers) }
        val share = value(Cause.TWO_PATH_RESPONSE, 1) ?: 0.0
        return when {
            listOfNotNull(asymmetry, flow, warmth, ratio).size > 1 -> SensorStage.Combined(
                tau,
                model.scales.ordinarySpeed,
                flow ?: 0.0,
                model.scales.ordinaryTemperature.takeIf { it.isFinite() } ?: 0.0,
                warmth ?: 0.0,
                exp(asymmetry ?: 0.0),
                ratio ?: 1.0,
                share,
            )
            ratio != null -> SensorStage.TwoPath(tau, tau * ratio, share)
            asymmetry != null -> SensorStage.Asymmetric(tau * exp(asymmetry / 2), tau * exp(-asymmetry / 2))
            flow != null -> SensorStage.FlowLag(tau, model.scales.ordinarySpeed, flow)
            warmth != null -> SensorStage.TemperatureLag(tau, model.scales.ordinaryTemperature, warmth)
            else -> limit()?.takeIf { model.terms.any { it.isWithin } }?.let { SensorStage.LimitedLag(tau, it) }
                ?: SensorStage.Lag(tau)
        }
    }

    /** Noise of which [rounding], sensor units², comes of digits. */
    private fun noise(rounding: Double): List<SensorStage> {
        val known = value(Cause.QUANTISATION)
        val share = if (hasWander && known == null) fit.noise.share else 0.0
        val white = known ?: sqrt(maxOf((1 - share) * fit.variance - rounding, 0.0))
        val wander = sqrt(share * fit.variance)
        return listOf(SensorStage.Noise(white)).filter { white > 0 } +
            listOf(SensorStage.Wander(wander, fit.noise.time)).filter { wander > 0 }
    }

    private fun shown(): List<SensorStage> = buildList {
        val offset = numbers[ResponseModel.OFFSET]
        if (gain != 1.0 || offset != 0.0) add(SensorStage.Calibration(gain, offset))
        for (term in model.terms) {
            val at = model.slot(term)
            when (term.cause) {
                Cause.CROSS_SENSITIVITY -> {
                    val name = term.condition.orEmpty()
                    add(SensorStage.Cross(name, model.scales.middles.getValue(name), numbers[at]))
                }
                Cause.DRIFT -> add(SensorStage.Drifting(numbers[at]))
                Cause.OFFSET_STEPS -> {
                    var sum = 0.0
                    add(
                        SensorStage.Jumps(
                            term.times,
                            term.times.indices.map { k ->
                                sum += numbers[at + k]
                                sum
                            },
                        ),
                    )
                }
                else -> Unit
            }
        }
        value(Cause.SATURATION)?.let { lower ->
            val upper = value(Cause.SATURATION, 1) ?: Double.POSITIVE_INFINITY
            val none = ResponseModel.NO_END
            if (lower < upper) add(SensorStage.Range(lower.takeIf { it > -none }, upper.takeIf { it < none }))
        }
        range?.let(::add)
        val resolution = model.scales.resolution
        val isCoarse = (isRounded || value(Cause.QUANTISATION) != null) && resolution > 0
        // What rounding adds to the noise it adds once more in the simulation.
        val rounding = if (isCoarse) resolution * resolution / 12 else 0.0
        addAll(noise(rounding))
        spikes?.let { add(SensorStage.Outlying(it.probability, it.size)) }
        if (isCoarse) add(SensorStage.Quantum(resolution))
    }
}

/** What is lost of a limit to the rate of a lag that changes. */
private const val BEHIND =
    "The limit is that of the lag's own rate; of a lag that changes the sensor file has it behind the lag."

/** How often and how far single readings are off: [probability] of each, dimensionless; [size], sensor units. */
internal data class SpikeSize(val probability: Double, val size: Double) {
    /** Both, for an answer. */
    val numbers: List<Estimate>
        get() = listOf(
            Estimate("probability", "", probability, null),
            Estimate("size", "sensor units", size, null),
        )

    companion object {
        /** From [spikes] among [residuals]; those too small to be seen are reckoned with. */
        fun of(spikes: List<Int>, residuals: DoubleArray, spread: Double): SpikeSize? {
            if (spikes.isEmpty()) return null
            val size = spikes.maxOf { abs(residuals[it]) } * (spikes.size + 1) / spikes.size
            val seen = (1 - 5.5 * spread / size).coerceIn(0.1, 1.0)
            return SpikeSize((spikes.size / seen / residuals.size).coerceIn(0.0, 1.0), size)
        }
    }
}
