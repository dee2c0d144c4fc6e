package stillwater.model

import kotlin.math.hypot

/**
 * A place in the local frame.
 *
 * @property x metres east of the frame's origin.
 * @property y metres north of the frame's origin.
 */
public data class Position(val x: Double, val y: Double) {
    /** Straight-line distance to [other], m. */
    public fun distanceTo(other: Position): Double = hypot(other.x - x, other.y - y)

    /** This position moved by [dx] metres east and [dy] metres north. */
    public fun moved(dx: Double, dy: Double): Position = Position(x + dx, y + dy)
}
