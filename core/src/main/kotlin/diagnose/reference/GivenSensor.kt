package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Term
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln

/** A sensor that is taken as given, as terms and numbers of a model. [spec] is one that [requireKnown] takes. */
internal class GivenSensor(spec: SensorSpec, private val scales: Scales) {
    private val calibrations = spec.stages.filterIsInstance<SensorStage.Calibration>()
    private val found = LinkedHashMap<Term, DoubleArray>()
    private var timeConstant = Double.NaN
    private var second = Double.NaN
    private var deadTime = 0.0
    private var drift = 0.0
    private var passed = 0
    private var gain = 1.0
    private var offset = 0.0

    init {
        spec.stages.forEach(::take)
        if (!second.isNaN()) put(Cause.SECOND_ORDER_RESPONSE, second)
        if (deadTime != 0.0) put(Cause.DEAD_TIME, deadTime)
        if (drift != 0.0) put(Cause.DRIFT, drift)
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
                if (timeConstant.isNaN()) timeConstant = stage.timeConstant else second = stage.timeConstant
            is SensorStage.LimitedLag -> {
                first(stage.timeConstant)
                found[Term(Cause.SLEW_LIMIT, isWithin = true)] = doubleArrayOf(stage.rate * abs(gainLeft()))
            }
            is SensorStage.Asymmetric -> {
                first(exp((ln(stage.rising) + ln(stage.falling)) / 2))
                put(Cause.ASYMMETRIC_RESPONSE, ln(stage.rising / stage.falling))
            }
            is SensorStage.TwoPath -> {
                first(stage.fast)
                put(Cause.TWO_PATH_RESPONSE, stage.slow / stage.fast, stage.slowShare)
            }
            is SensorStage.FlowLag -> {
                first(stage.timeConstant * atSpeed(stage.referenceSpeed, stage.exponent))
                put(Cause.FLOW_DEPENDENT_RESPONSE, stage.exponent)
            }
            is SensorStage.TemperatureLag -> {
                first(stage.timeConstant * atWarmth(stage.referenceTemperature, stage.relativeChange))
                put(Cause.TEMPERATURE_DEPENDENT_RESPONSE, stage.relativeChange)
            }
            is SensorStage.Combined -> combined(stage)
            is SensorStage.Delay -> deadTime += stage.deadTime
            is SensorStage.Slew -> put(Cause.SLEW_LIMIT, stage.rate * abs(gainLeft()))
            is SensorStage.Backlash -> {
                val term = Term(Cause.HYSTERESIS, isFirst = timeConstant.isNaN())
                found[term] = doubleArrayOf(stage.width * abs(gainLeft()))
            }
            is SensorStage.Range -> range(stage)
            is SensorStage.Drifting -> drift += stage.rate * gainLeft()
            is SensorStage.Jumps -> jumps(stage)
            is SensorStage.Cross -> cross(stage)
            is SensorStage.Calibration -> {
                offset = stage.gain * offset + stage.offset
                gain *= stage.gain
                passed++
            }
            is SensorStage.Noise, is SensorStage.Wander, is SensorStage.Quantum, is SensorStage.Outlying -> Unit
        }
    }

    /** The gain of all stages that are still to come: the model has what is before them behind them. */
    private fun gainLeft() = left().fold(1.0) { product, next -> product * next.gain }

    private fun left() = calibrations.drop(passed)

    /** The lag that may depend on conditions has [tau], s; one before it is then the second. */
    private fun first(tau: Double) {
        second = timeConstant
        timeConstant = tau
    }

    private fun range(stage: SensorStage.Range) {
        fun shown(limit: Double) = left().fold(limit) { value, next -> next.gain * value + next.offset }
        val lower = stage.lower?.let(::shown)
        val upper = stage.upper?.let(::shown)
        val (low, high) = if (gainLeft() < 0) upper to lower else lower to upper
        put(Cause.SATURATION, low ?: -ResponseModel.FAR_END, high ?: ResponseModel.FAR_END)
    }

    private fun combined(stage: SensorStage.Combined) {
        val factor = atSpeed(stage.referenceSpeed, stage.exponent) *
            atWarmth(stage.referenceTemperature, stage.relativeChange)
        first(stage.timeConstant * factor)
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
        val left = gainLeft()
        val changes = stage.offsets.mapIndexed { i, o -> left * (o - if (i == 0) 0.0 else stage.offsets[i - 1]) }
        put(Cause.OFFSET_STEPS, *changes.toDoubleArray(), times = stage.times)
    }

    private fun cross(stage: SensorStage.Cross) {
        val middle = scales.middles.getValue(stage.condition)
        offset += stage.coefficient * (middle - stage.reference)
        put(Cause.CROSS_SENSITIVITY, stage.coefficient * gainLeft(), condition = stage.condition)
    }

    companion object {
        /**
         * Refuses a sensor of which parts would be lost, or that takes more than the [conditions] of the log.
         *
         * @throws IllegalArgumentException if so; the message is for the user.
         */
        fun requireKnown(spec: SensorSpec, conditions: Set<String>) {
            val lags = spec.stages.filter(::isLag)
            require(lags.size <= 2 && lags.count { it !is SensorStage.Lag } <= 1) {
                "expected at most two lags, one of which does not change, in a sensor that is taken as given"
            }
            for (kind in SINGLE) require(spec.stages.count { kind.isInstance(it) } <= 1) { ONCE }
            require(spec.stages.count { it is SensorStage.Slew || it is SensorStage.LimitedLag } <= 1) { ONCE }
            val cross = spec.stages.filterIsInstance<SensorStage.Cross>().map { it.condition }
            require(cross.size == cross.toSet().size) { ONCE }
            val needed = if (spec.stages.any(::isWarmth)) cross + Conditions.TEMPERATURE else cross
            val missing = needed.toSet() - conditions
            require(missing.isEmpty()) { "it takes ${missing.joinToString(" and ") { "--condition $it=COLUMN" }}" }
        }

        private val SINGLE = listOf(
            SensorStage.Backlash::class,
            SensorStage.Range::class,
            SensorStage.Jumps::class,
        )
        private const val ONCE = "expected at most one slew limit, hysteresis, saturation, list of offset steps, and " +
            "cross-sensitivity to each condition in a sensor that is taken as given"

        private fun isLag(stage: SensorStage) = stage is SensorStage.Lag || stage is SensorStage.LimitedLag ||
            stage is SensorStage.Asymmetric || stage is SensorStage.TwoPath || stage is SensorStage.FlowLag ||
            stage is SensorStage.TemperatureLag || stage is SensorStage.Combined

        private fun isWarmth(stage: SensorStage) = stage is SensorStage.TemperatureLag ||
            (stage is SensorStage.Combined && stage.relativeChange != 0.0)
    }
}
