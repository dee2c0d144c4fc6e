package stillwater.virtual

import stillwater.field.Field
import stillwater.model.BoatTime
import stillwater.model.Position
import kotlin.math.exp
import kotlin.math.hypot

/**
 * Water that is even but for a plume poor in oxygen, for a demo: v = b − d exp(−r / s), r the distance from [center].
 *
 * The same at all times, defined everywhere, and between [background] − [depth] and [background].
 *
 * @property center where the plume rises.
 * @property background far from it, mg/L.
 * @property depth by how much less there is at [center], mg/L.
 * @property scale distance within which the plume falls off by a factor e, m, above 0.
 * @throws IllegalArgumentException if a number is not finite or [scale] is not above 0.
 */
public class PlumeWater(
    public val center: Position,
    public val background: Double = 9.0,
    public val depth: Double = 4.0,
    public val scale: Double = 20.0,
) : Field {
    init {
        require(background.isFinite() && depth.isFinite()) { "background, depth ($background, $depth) must be finite" }
        require(scale > 0 && scale.isFinite()) { "scale ($scale m) must be above 0 and finite" }
    }

    override fun truth(x: Double, y: Double, time: BoatTime): Double =
        background - depth * exp(-hypot(x - center.x, y - center.y) / scale)
}
