package stillwater.sensor

import stillwater.model.Conditions
import kotlin.math.expm1

/**
 * A sensor that follows a rise and a fall of the truth with different time constants, as membranes do that fill faster
 * than they empty.
 *
 * τ(ψ − s) ṡ = ψ − s with τ the one of rising where ψ > s, the one of falling where ψ < s. For a truth ψ that is
 * constant over the step the solution is exact whatever its length: s never passes ψ, so the side does not change.
 *
 * @property rising time constant while the truth is above the state, s, above 0 and finite.
 * @property falling time constant while the truth is below the state, s, above 0 and finite.
 * @param initial the sensor's state before the first step, sensor units, finite.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class AsymmetricLag(
    public val rising: Double,
    public val falling: Double,
    initial: Double,
) : SensorModel {
    init {
        require(rising > 0 && rising.isFinite()) { "rising ($rising s) must be above 0 and finite" }
        require(falling > 0 && falling.isFinite()) { "falling ($falling s) must be above 0 and finite" }
        require(initial.isFinite()) { "initial ($initial) must be finite" }
    }

    private var state = initial

    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        if (!input.isFinite() || !(dt > 0 && dt.isFinite())) return state
        state = towards(state, input, -expm1(-dt / if (input > state) rising else falling))
        return state
    }
}
