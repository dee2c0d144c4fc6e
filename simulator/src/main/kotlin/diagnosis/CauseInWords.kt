package stillwater.diagnosis

import stillwater.diagnose.Cause
import stillwater.model.Conditions
import stillwater.report.SignificantDigits
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import stillwater.sensor.TimeConstant
import kotlin.math.sqrt

/**
 * What a cause comes to in the sensor that was found, in the quantities that a user would measure: both time constants of an
 * asymmetric lag and not their ratio, the moment of a jump, the speed that a time constant is for.
 *
 * @param sensor the sensor with the causes that were named. @param unitAfter the readings' unit with a blank before it,
 *   or nothing.
 */
internal class CauseInWords(private val sensor: SensorSpec, private val unitAfter: String) {
    private val three = SignificantDigits(3)

    /** What [cause] comes to; null where its own numbers say it. */
    fun of(cause: Cause): String? = sensor.stages.firstNotNullOfOrNull { of(cause, it) }

    private fun of(cause: Cause, stage: SensorStage): String? = when (cause) {
        Cause.ASYMMETRIC_RESPONSE -> when (stage) {
            is SensorStage.Asymmetric -> ofDirection(stage.rising, stage.falling)
            is SensorStage.Combined -> sqrt(stage.risingOverFalling).let { up ->
                ofDirection(stage.timeConstant * up, stage.timeConstant / up)
            }
            else -> null
        }
        Cause.TWO_PATH_RESPONSE -> when (stage) {
            is SensorStage.TwoPath -> ofPaths(stage.fast, stage.slow)
            is SensorStage.Combined -> ofPaths(stage.timeConstant, stage.timeConstant * stage.slowOverFast)
            else -> null
        }
        Cause.FLOW_DEPENDENT_RESPONSE -> when (stage) {
            is SensorStage.FlowLag -> ofFlow(stage.timeConstant, stage.referenceSpeed, stage.exponent)
            is SensorStage.Combined -> ofFlow(stage.timeConstant, stage.referenceSpeed, stage.exponent)
            else -> null
        }
        Cause.TEMPERATURE_DEPENDENT_RESPONSE -> when (stage) {
            is SensorStage.TemperatureLag ->
                ofTemperature(stage.timeConstant, stage.referenceTemperature, stage.relativeChange)
            is SensorStage.Combined ->
                ofTemperature(stage.timeConstant, stage.referenceTemperature, stage.relativeChange)
            else -> null
        }
        Cause.OFFSET_STEPS -> (stage as? SensorStage.Jumps)?.let { jumps ->
            "at " + jumps.times.joinToString(" and ") { seconds(it) }
        }
        Cause.CROSS_SENSITIVITY -> (stage as? SensorStage.Cross)?.let { "of ${it.condition}" }
        Cause.QUANTISATION -> (stage as? SensorStage.Quantum)?.let { "steps of ${three.format(it.step)}$unitAfter" }
        else -> null
    }

    private fun ofDirection(rising: Double, falling: Double) = "rising ${seconds(rising)}, falling ${seconds(falling)}"

    private fun ofPaths(fast: Double, slow: Double) = "fast ${seconds(fast)}, slow ${seconds(slow)}"

    /** Which way it goes is what the signs of exponents and relative changes do not say by themselves. */
    private fun ofFlow(timeConstant: Double, speed: Double, exponent: Double): String {
        val twice = TimeConstant.ofFlow(timeConstant, speed, exponent)
            .under(Conditions(mapOf(Conditions.SPEED to 2 * speed)))
        return at(timeConstant, speed, "m/s") + ", ${seconds(twice)} at twice that"
    }

    private fun ofTemperature(timeConstant: Double, temperature: Double, relativeChange: Double): String {
        val warmer = TimeConstant.ofTemperature(timeConstant, temperature, relativeChange)
            .under(Conditions(mapOf(Conditions.TEMPERATURE to temperature + 1)))
        return at(timeConstant, temperature, "°C") + ", ${seconds(warmer)} at one degree more"
    }

    private fun at(timeConstant: Double, condition: Double, unit: String) =
        "${seconds(timeConstant)} at ${three.format(condition)} $unit"

    private fun seconds(time: Double) = "${three.format(time)} s"
}
