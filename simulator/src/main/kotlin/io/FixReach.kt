package stillwater.io

import stillwater.model.LatLon
import kotlin.math.IEEErem
import kotlin.math.abs
import kotlin.math.hypot

/**
 * Which fixes may belong to one survey: those within [LIMIT_METRES] of its first one.
 *
 * A flat frame is of no use farther out, and beyond a quarter of the globe places fold back onto near ones.
 */
internal object FixReach {
    const val LIMIT_METRES = 1e6
    const val EXPECTED = "a fix within 1000 km of the first"
    const val REASON = "fixes more than 1000 km from the first"

    // 1000 km of a meridian are 8.96 to 9.05 degrees.
    private const val LATITUDES = 9.1
    private const val POLAR_LATITUDE = 80.0

    /** Whether the fix ([latitude], [longitude]), ([x], [y]) in the frame of [origin], is near enough to it. */
    fun holds(origin: LatLon, latitude: Double, longitude: Double, x: Double, y: Double): Boolean {
        if (abs(latitude - origin.latitudeDeg) > LATITUDES) return false
        // Below 80 degrees, a quarter of a turn is too far in any case; above, nothing that is left folds.
        val apart = longitude - origin.longitudeDeg
        val turn = if (abs(apart) <= 180) apart else apart.IEEErem(360.0)
        if (abs(origin.latitudeDeg) < POLAR_LATITUDE && abs(turn) > 90) return false
        return hypot(x, y) <= LIMIT_METRES
    }
}
