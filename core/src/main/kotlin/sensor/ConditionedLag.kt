package stillwater.sensor

import stillwater.model.Conditions
import kotlin.math.exp
import kotlin.math.expm1
import kotlin.math.ln

/** How a time constant depends on what else holds. */
public fun interface TimeConstant {
    /** τ under [conditions], s, above 0 and finite. */
    public fun under(conditions: Conditions): Double

    public companion object {
        /**
         * τ = τ₀ (v / v₀)^(−p): the boundary layer before a membrane thins with the speed of the water past it.
         *
         * Slower than v₀ / 100 counts as v₀ / 100, faster than 100 v₀ as that; an unknown speed as v₀.
         *
         * @param timeConstant τ₀, s, above 0 and finite.
         * @param referenceSpeed v₀, m/s, above 0 and finite.
         * @param exponent p, dimensionless, within −2..2; a laminar boundary layer gives 0.5.
         * @throws IllegalArgumentException if a number is out of its range.
         */
        public fun ofFlow(timeConstant: Double, referenceSpeed: Double, exponent: Double): TimeConstant {
            require(referenceSpeed > 0 && referenceSpeed.isFinite()) {
                "referenceSpeed ($referenceSpeed m/s) must be above 0 and finite"
            }
            require(exponent in -2.0..2.0) { "exponent ($exponent) must be within -2..2" }
            requireTimeConstant(timeConstant)
            return TimeConstant {
                val speed = it[Conditions.SPEED]
                val ratio = if (speed.isNaN()) 1.0 else (speed / referenceSpeed).coerceIn(0.01, 100.0)
                bounded(timeConstant, -exponent * ln(ratio))
            }
        }

        /**
         * τ = τ₀ exp(−k (T − T₀)): diffusion and reaction are faster in warm water.
         *
         * More than 100 °C from T₀ counts as 100 °C; an unknown temperature as T₀.
         *
         * @param timeConstant τ₀, s, above 0 and finite.
         * @param referenceTemperature T₀, °C, finite.
         * @param relativeChange k, 1/°C, within −0.5..0.5.
         * @throws IllegalArgumentException if a number is out of its range.
         */
        public fun ofTemperature(
            timeConstant: Double,
            referenceTemperature: Double,
            relativeChange: Double,
        ): TimeConstant {
            require(referenceTemperature.isFinite()) {
                "referenceTemperature ($referenceTemperature °C) must be finite"
            }
            require(relativeChange in -0.5..0.5) { "relativeChange ($relativeChange / °C) must be within -0.5..0.5" }
            requireTimeConstant(timeConstant)
            return TimeConstant {
                val distance = it[Conditions.TEMPERATURE] - referenceTemperature
                bounded(timeConstant, if (distance.isNaN()) 0.0 else -relativeChange * distance.coerceIn(-100.0, 100.0))
            }
        }

        private fun requireTimeConstant(timeConstant: Double) =
            require(timeConstant > 0 && timeConstant.isFinite()) {
                "timeConstant ($timeConstant s) must be above 0 and finite"
            }

        private fun bounded(timeConstant: Double, exponent: Double) =
            (timeConstant * exp(exponent)).coerceIn(Double.MIN_VALUE, Double.MAX_VALUE)
    }
}

/**
 * A first-order lag whose time constant depends on the conditions of each step: τ(c) ṡ = ψ − s, exact for a truth and
 * conditions that are constant over the step.
 *
 * @property timeConstant τ under the conditions of a step.
 * @param initial the sensor's state before the first step, sensor units, finite.
 * @throws IllegalArgumentException if [initial] is not finite.
 */
public class ConditionedLag(private val timeConstant: TimeConstant, initial: Double) : SensorModel {
    init {
        require(initial.isFinite()) { "initial ($initial) must be finite" }
    }

    private var state = initial

    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        if (!input.isFinite() || !(dt > 0 && dt.isFinite())) return state
        state = towards(state, input, -expm1(-dt / timeConstant.under(conditions)))
        return state
    }
}
