package stillwater.diagnose

import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.exp
import kotlin.math.ln

/** A sensor that is taken as given, as terms and numbers of a model. */
internal class GivenSensor(spec: SensorSpec, private val scales: Scales) {
    private val found = LinkedHashMap<Term, DoubleArray>()
    private var timeConstant = Double.NaN
    private var gain = 1.0
    private var offset = 0.0

    init {
        spec.stages.forEach(::take)
    }

    /** What acts beside a first-order lag with gain and offset. */
    val terms: List<Term> get() = found.keys.toList()

    /** The numbers of [model], which has [terms]. */
    fun numbers(model: ResponseModel): DoubleArray {
        val numbers = DoubleArray(model.parameters.size)
        numbers[ResponseModel.TIME_CONSTANT] =
            if (timeConstant.isNaN()) model.parameters[ResponseModel.TIME_CONSTANT].lower else timeConstant
        numbers[ResponseModel.GAIN] = gain
        numbers[ResponseModel.OFFSET] = offset
        for ((term, values) in found) values.copyInto(numbers, model.slot(term))
        return numbers
    }

    private fun put(cause: Cause, vararg values: Double, condition: String? = null, times: List<Double> = emptyList()) {
        found[Term(cause, condition, times)] = values
    }

    private fun take(stage: SensorStage) {
        when (stage) {
            is SensorStage.Lag ->
                if (timeConstant.isNaN()) {
                    timeConstant = stage.timeConstant
                } else {
                    put(Cause.SECOND_ORDER_RESPONSE, stage.timeConstant)
                }
            is SensorStage.Asymmetric -> {
                timeConstant = exp((ln(stage.rising) + ln(stage.falling)) / 2)
                put(Cause.ASYMMETRIC_RESPONSE, ln(stage.rising / stage.falling))
            }
            is SensorStage.TwoPath -> {
                timeConstant = stage.fast
                put(Cause.TWO_PATH_RESPONSE, stage.slow / stage.fast, stage.slowShare)
            }
            is SensorStage.FlowLag -> {
                timeConstant = stage.timeConstant * atSpeed(stage.referenceSpeed, stage.exponent)
                put(Cause.FLOW_DEPENDENT_RESPONSE, stage.exponent)
            }
            is SensorStage.TemperatureLag -> {
                timeConstant = stage.timeConstant * atWarmth(stage.referenceTemperature, stage.relativeChange)
                put(Cause.TEMPERATURE_DEPENDENT_RESPONSE, stage.relativeChange)
            }
            is SensorStage.Combined -> combined(stage)
            is SensorStage.Delay -> put(Cause.DEAD_TIME, stage.deadTime)
            is SensorStage.Slew -> put(Cause.SLEW_LIMIT, stage.rate)
            is SensorStage.Backlash -> put(Cause.HYSTERESIS, stage.width)
            is SensorStage.Range -> put(Cause.SATURATION, stage.lower ?: -1e12, stage.upper ?: 1e12)
            is SensorStage.Drifting -> put(Cause.DRIFT, stage.rate)
            is SensorStage.Jumps -> jumps(stage)
            is SensorStage.Cross -> cross(stage)
            is SensorStage.Calibration -> {
                offset = stage.gain * offset + stage.offset
                gain *= stage.gain
            }
            is SensorStage.Noise, is SensorStage.Quantum, is SensorStage.Outlying -> Unit
        }
    }

    private fun combined(stage: SensorStage.Combined) {
        timeConstant = stage.timeConstant * atSpeed(stage.referenceSpeed, stage.exponent) *
            atWarmth(stage.referenceTemperature, stage.relativeChange)
        if (stage.exponent != 0.0) put(Cause.FLOW_DEPENDENT_RESPONSE, stage.exponent)
        if (stage.relativeChange != 0.0) put(Cause.TEMPERATURE_DEPENDENT_RESPONSE, stage.relativeChange)
        if (stage.risingOverFalling != 1.0) put(Cause.ASYMMETRIC_RESPONSE, ln(stage.risingOverFalling))
        if (stage.slowShare != 0.0) put(Cause.TWO_PATH_RESPONSE, stage.slowOverFast, stage.slowShare)
    }

    /** The time constant at this log's ordinary speed over that at [reference], m/s. */
    private fun atSpeed(reference: Double, exponent: Double) = exp(-exponent * ln(scales.ordinarySpeed / reference))

    /** The same at this log's ordinary temperature; 1 where the log has none. */
    private fun atWarmth(reference: Double, relativeChange: Double): Double {
        val warmer = scales.ordinaryTemperature - reference
        return if (warmer.isNaN()) 1.0 else exp(-relativeChange * warmer)
    }

    private fun jumps(stage: SensorStage.Jumps) {
        val changes = stage.offsets.mapIndexed { i, o -> o - if (i == 0) 0.0 else stage.offsets[i - 1] }
        put(Cause.OFFSET_STEPS, *changes.toDoubleArray(), times = stage.times)
    }

    private fun cross(stage: SensorStage.Cross) {
        val middle = scales.middles[stage.condition] ?: return
        offset += stage.coefficient * (middle - stage.reference)
        put(Cause.CROSS_SENSITIVITY, stage.coefficient, condition = stage.condition)
    }
}
