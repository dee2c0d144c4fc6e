package stillwater.sensor

import stillwater.model.Conditions

/**
 * A sensor that also shows something else: y = ψ + k (c − c₀) with c a condition, as an uncompensated probe shows
 * temperature or salinity. Where c is unknown nothing is added.
 *
 * @property condition name of c in [Conditions], not blank.
 * @property reference c₀, the condition's units, finite.
 * @property coefficient k, sensor units per unit of the condition, finite.
 * @throws IllegalArgumentException if a value is out of its range.
 */
public class CrossSensitivity(
    public val condition: String,
    public val reference: Double,
    public val coefficient: Double,
) : SensorModel {
    init {
        require(condition.isNotBlank()) { "condition ('$condition') must not be blank" }
        require(reference.isFinite()) { "reference ($reference) must be finite" }
        require(coefficient.isFinite()) { "coefficient ($coefficient) must be finite" }
    }

    override fun step(input: Double, dt: Double, conditions: Conditions): Double {
        val added = coefficient * (conditions[condition] - reference)
        return if (input.isFinite() && added.isFinite()) inRange(input + added) else input
    }
}
