package stillwater.model

import kotlin.math.abs
import kotlin.math.atan2
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * A place on the WGS-84 ellipsoid.
 *
 * @property latitudeDeg degrees north, -90 to 90.
 * @property longitudeDeg degrees east, -180 to 360 (both customs of writing west occur in logs).
 * @throws IllegalArgumentException if one is out of its range or NaN.
 */
public data class LatLon(val latitudeDeg: Double, val longitudeDeg: Double) {
    init {
        require(latitudeDeg in LATITUDES_DEG) { "latitude ($latitudeDeg deg) must be in -90..90" }
        require(longitudeDeg in LONGITUDES_DEG) { "longitude ($longitudeDeg deg) must be in -180..360" }
    }

    public companion object {
        /** Latitudes that exist, degrees. */
        public val LATITUDES_DEG: ClosedFloatingPointRange<Double> = -90.0..90.0

        /** Longitudes that are accepted, degrees. */
        public val LONGITUDES_DEG: ClosedFloatingPointRange<Double> = -180.0..360.0
    }
}

/**
 * The flat frame the boat works in: metres east and north of [origin], on the plane tangent to the WGS-84 ellipsoid
 * there.
 *
 * A point of the ellipsoid is projected onto the tangent plane along the plane's normal, and back by intersecting
 * that normal with the ellipsoid, which is a quadratic: both ways are exact to rounding, whatever the distance. As a
 * map the plane shortens a geodesic of d metres by about d³ / (6 R²): 0.5 mm at 5 km, 0.5 m at 50 km. Heights are
 * taken as 0: a lake at 500 m altitude is drawn 8e-5 too small. Immutable.
 *
 * Source: NIMA TR8350.2 (2000), the WGS-84 ellipsoid; the rotation is the usual one from Earth-centred to east,
 * north, up.
 *
 * @property origin where x = y = 0; not at a pole.
 * @throws IllegalArgumentException if [origin] is within 1e-6 degrees of a pole, where east has no direction.
 */
public class LocalFrame(public val origin: LatLon) {
    private val originUp: DoubleArray
    private val originEarth: DoubleArray
    private val east: DoubleArray
    private val north: DoubleArray

    init {
        require(canStartAt(origin)) { "origin (${origin.latitudeDeg} deg) must not be at a pole" }
        val latitude = Math.toRadians(origin.latitudeDeg)
        val longitude = Math.toRadians(origin.longitudeDeg)
        east = doubleArrayOf(-sin(longitude), cos(longitude), 0.0)
        north = doubleArrayOf(-sin(latitude) * cos(longitude), -sin(latitude) * sin(longitude), cos(latitude))
        originUp = doubleArrayOf(cos(latitude) * cos(longitude), cos(latitude) * sin(longitude), sin(latitude))
        originEarth = earthCentred(origin)
    }

    /** Where [place] lies in this frame. Places beyond a quarter of the globe fold back and have no use here. */
    public fun toLocal(place: LatLon): Position {
        val local = DoubleArray(2)
        toLocal(place.latitudeDeg, place.longitudeDeg, local)
        return Position(local[0], local[1])
    }

    /**
     * [toLocal] for loops over millions of fixes: no allocation.
     *
     * @param latitudeDeg degrees north, -90 to 90; not checked.
     * @param longitudeDeg degrees east; not checked.
     * @param into where x and y, m, are written to, length 2 at least. Modified.
     */
    public fun toLocal(latitudeDeg: Double, longitudeDeg: Double, into: DoubleArray) {
        val latitude = Math.toRadians(latitudeDeg)
        val longitude = Math.toRadians(longitudeDeg)
        val sine = sin(latitude)
        val normal = SEMI_MAJOR_AXIS / sqrt(1 - ECCENTRICITY_SQUARED * sine * sine)
        val radius = normal * cos(latitude)
        val a = radius * cos(longitude) - originEarth[0]
        val b = radius * sin(longitude) - originEarth[1]
        val c = normal * (1 - ECCENTRICITY_SQUARED) * sine - originEarth[2]
        into[0] = a * east[0] + b * east[1] + c * east[2]
        into[1] = a * north[0] + b * north[1] + c * north[2]
    }

    /**
     * The place on the ellipsoid that [toLocal] takes to [position], longitude within -180..180.
     *
     * @throws IllegalArgumentException if [position] is not finite or so far away (more than an Earth radius) that no
     *   point of the ellipsoid lies below it.
     */
    public fun toLatLon(position: Position): LatLon {
        val plane = DoubleArray(3) { originEarth[it] + position.x * east[it] + position.y * north[it] }
        // The point plane + u · up lies on x²/a² + y²/a² + z²/b² = 1: solve A u² + 2 B u + C = 0 for the root near 0.
        val quadratic = scaledDot(originUp, originUp)
        val linear = scaledDot(plane, originUp)
        val constant = scaledDot(plane, plane) - 1
        val discriminant = linear * linear - quadratic * constant
        require(discriminant >= 0) { "position ($position) must lie within an Earth radius of the frame's origin" }
        val up = -constant / (linear + sqrt(discriminant))
        for (axis in 0..2) plane[axis] += up * originUp[axis]
        // On the ellipsoid itself tan(latitude) = z / (p (1 - e²)).
        val latitude = atan2(plane[2], hypot(plane[0], plane[1]) * (1 - ECCENTRICITY_SQUARED))
        return LatLon(Math.toDegrees(latitude), Math.toDegrees(atan2(plane[1], plane[0])))
    }

    private fun earthCentred(place: LatLon): DoubleArray {
        val latitude = Math.toRadians(place.latitudeDeg)
        val longitude = Math.toRadians(place.longitudeDeg)
        val normal = SEMI_MAJOR_AXIS / sqrt(1 - ECCENTRICITY_SQUARED * sin(latitude) * sin(latitude))
        return doubleArrayOf(
            normal * cos(latitude) * cos(longitude),
            normal * cos(latitude) * sin(longitude),
            normal * (1 - ECCENTRICITY_SQUARED) * sin(latitude),
        )
    }

    private fun scaledDot(a: DoubleArray, b: DoubleArray) =
        (a[0] * b[0] + a[1] * b[1]) / (SEMI_MAJOR_AXIS * SEMI_MAJOR_AXIS) +
            a[2] * b[2] / (SEMI_MINOR_AXIS * SEMI_MINOR_AXIS)

    public companion object {
        internal const val SEMI_MAJOR_AXIS: Double = 6_378_137.0
        internal const val FLATTENING: Double = 1 / 298.257223563
        internal const val SEMI_MINOR_AXIS: Double = SEMI_MAJOR_AXIS * (1 - FLATTENING)
        internal const val ECCENTRICITY_SQUARED: Double = FLATTENING * (2 - FLATTENING)
        private const val CLOSEST_TO_POLE_DEG = 1e-6

        /** Whether a frame may have [place] as its origin: at a pole east has no direction. */
        public fun canStartAt(place: LatLon): Boolean = abs(place.latitudeDeg) <= 90 - CLOSEST_TO_POLE_DEG
    }
}
