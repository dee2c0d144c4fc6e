package stillwater.sensor

import stillwater.model.Conditions

/**
 * A sensor that the water reaches on two ways, a fast and a slow one: a probe whose body warms behind its tip, a
 * membrane with a film on part of it.
 *
 * s = (1 − w) s₁ + w s₂ with s₁ and s₂ first-order lags of their own time constants.
 *
 * Source of the form: Morison et al. 1994, doi:10.1175/1520-0426(1994)011<1151:TCFTLE>2.0.CO;2, for the heat stored in
 * a conductivity cell.
 *
 * @param fast time constant of the fast path, s, above 0 and finite.
 * @param slow time constant of the slow path, s, at least [fast] and finite.
 * @property slowShare w, dimensionless, within 0..1.
 * @param initial the state of both paths before the first step, sensor units, finite.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class TwoPathLag(fast: Double, slow: Double, public val slowShare: Double, initial: Double) : SensorModel {
    init {
        require(slow >= fast) { "slow ($slow s) must be at least fast ($fast s)" }
        require(slowShare in 0.0..1.0) { "slowShare ($slowShare) must be within 0..1" }
    }

    private val fastPath = FirstOrderLag(fast, initial)
    private val slowPath = FirstOrderLag(slow, initial)

    override fun step(input: Double, dt: Double, conditions: Conditions): Double =
        (1 - slowShare) * fastPath.step(input, dt, conditions) + slowShare * slowPath.step(input, dt, conditions)
}
