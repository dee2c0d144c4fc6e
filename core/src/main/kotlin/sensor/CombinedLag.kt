package stillwater.sensor

import stillwater.model.Conditions
import kotlin.math.expm1
import kotlin.math.sqrt

/**
 * A lag with several changes of its time constant at once: with the speed, with the temperature, between rise and fall,
 * and a slow path beside it.
 *
 * s = (1 − w) s₁ + w s₂; τ(c) ṡ₁ = a (ψ − s₁) with a = 1/√ρ for a rise and √ρ for a fall, and R τ(c) ṡ₂ = ψ − s₂. For a
 * truth and conditions that are constant over the step the solution is exact. [AsymmetricLag], [ConditionedLag] and
 * [TwoPathLag] are its special cases.
 *
 * @property timeConstant τ under the conditions of a step.
 * @property risingOverFalling ρ, time constant of a rise over that of a fall, dimensionless, above 0 and finite.
 * @property slowOverFast R, dimensionless, at least 1 and finite.
 * @property slowShare w, dimensionless, within 0..1.
 * @param initial the state of both paths before the first step, sensor units, finite.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class CombinedLag(
    private val timeConstant: TimeConstant,
    public val risingOverFalling: Double,
    public val slowOverFast: Double,
    public val slowShare: Double,
    initial: Double,
) : SensorModel {
    init {
        require(risingOverFalling > 0 && risingOverFalling.isFinite()) {
            "risingOverFalling ($risingOverFalling) must be above 0 and finite"
        }
        require(slowOverFast >= 1 && slowOverFast.isFinite()) {
            "slowOverFast ($slowOverFast) must be at least 1 and finite"
        }
        require(slowShare in 0.0..1.0) { "slowShare ($slowShare) must be within 0..1" }
        require(initial.isFinite()) { "initial ($initial) must be finite" }
    }

    private val up = sqrt(risingOverFalling)
    private var fast = initial
    private var slow = initial

    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        if (input.isFinite() && dt > 0 && dt.isFinite()) {
            val steps = dt / timeConstant.under(conditions)
            fast = towards(fast, input, -expm1(-if (input > fast) steps / up else steps * up))
            slow = towards(slow, input, -expm1(-steps / slowOverFast))
        }
        return (1 - slowShare) * fast + slowShare * slow
    }
}
