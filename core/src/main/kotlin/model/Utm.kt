package stillwater.model

import kotlin.math.PI
import kotlin.math.asinh
import kotlin.math.atan
import kotlin.math.atan2
import kotlin.math.atanh
import kotlin.math.cos
import kotlin.math.cosh
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.math.sinh
import kotlin.math.sqrt
import kotlin.math.tan

/**
 * A place as boats of the Platypus family log it: Universal Transverse Mercator on WGS-84.
 *
 * Converts to and from [LatLon] by Krüger's series to the fourth order in the third flattening, good to 1 µm within
 * the zone.
 *
 * Source: C. F. F. Karney (2011), "Transverse Mercator with an accuracy of a few nanometers", doi:10.1007/s00190-011-
 * 0445-3, eq. (7) to (11), (35), (36). Differs: four orders instead of six.
 *
 * @property easting metres east, 500 000 on the zone's central meridian; within 0..1 000 000.
 * @property northing metres north of the equator, or of 10 000 km south of it in the south; within 0..10 000 000.
 * @property zone 1 to 60.
 * @property north whether the place lies on the northern half.
 * @throws IllegalArgumentException if one is out of its range.
 */
public data class Utm(val easting: Double, val northing: Double, val zone: Int, val north: Boolean) {
    init {
        require(zone in ZONES) { "UTM zone ($zone) must be in 1..60" }
        require(easting in 0.0..2 * FALSE_EASTING) { "UTM easting ($easting m) must be in 0..1000000" }
        require(northing in 0.0..FALSE_NORTHING) { "UTM northing ($northing m) must be in 0..10000000" }
    }

    /** The same place in degrees. */
    public fun toLatLon(): LatLon {
        val xi = (northing - if (north) 0.0 else FALSE_NORTHING) / (SCALE * RECTIFYING_RADIUS)
        val eta = (easting - FALSE_EASTING) / (SCALE * RECTIFYING_RADIUS)
        // eq. (11)
        var xiPrime = xi
        var etaPrime = eta
        for (j in BETA.indices) {
            val order = 2.0 * (j + 1)
            xiPrime -= BETA[j] * sin(order * xi) * cosh(order * eta)
            etaPrime -= BETA[j] * cos(order * xi) * sinh(order * eta)
        }
        // eq. (18), inverted for tau by Newton's method, eq. (19) to (21)
        val tauPrime = sin(xiPrime) / hypot(sinh(etaPrime), cos(xiPrime))
        var tau = tauPrime
        repeat(NEWTON_STEPS) {
            val residual = conformalTangent(tau)
            val slope = hypot(1.0, residual) * hypot(1.0, tau) * (1 - ECCENTRICITY * ECCENTRICITY) /
                (1 + (1 - ECCENTRICITY * ECCENTRICITY) * tau * tau)
            tau += (tauPrime - residual) / slope
        }
        val longitudeDeg = centralMeridianDeg(zone) + Math.toDegrees(atan2(sinh(etaPrime), cos(xiPrime)))
        // Beyond the date line the outer zones run past 180 degrees.
        return LatLon(Math.toDegrees(atan(tau)), Math.IEEEremainder(longitudeDeg, FULL_TURN_DEG))
    }

    public companion object {
        /** The zones that exist. */
        public val ZONES: IntRange = 1..60

        private const val SCALE = 0.9996
        private const val FALSE_EASTING = 500_000.0
        private const val FALSE_NORTHING = 10_000_000.0
        private const val NEWTON_STEPS = 5
        private const val N = LocalFrame.FLATTENING / (2 - LocalFrame.FLATTENING)
        private val ECCENTRICITY = sqrt(LocalFrame.ECCENTRICITY_SQUARED)

        // eq. (14)
        private const val RECTIFYING_RADIUS =
            LocalFrame.SEMI_MAJOR_AXIS / (1 + N) * (1 + N * N / 4 + N * N * N * N / 64)

        // eq. (35)
        private val ALPHA = doubleArrayOf(
            N * (1.0 / 2 + N * (-2.0 / 3 + N * (5.0 / 16 + N * 41 / 180))),
            N * N * (13.0 / 48 + N * (-3.0 / 5 + N * 557 / 1440)),
            N * N * N * (61.0 / 240 - N * 103 / 140),
            N * N * N * N * 49561 / 161280,
        )

        // eq. (36)
        private val BETA = doubleArrayOf(
            N * (1.0 / 2 + N * (-2.0 / 3 + N * (37.0 / 96 - N / 360))),
            N * N * (1.0 / 48 + N * (1.0 / 15 - N * 437 / 1440)),
            N * N * N * (17.0 / 480 - N * 37 / 840),
            N * N * N * N * 4397 / 161280,
        )

        /** [place] in the zone it lies in, or in [zone] where a neighbouring one is wanted. */
        public fun of(place: LatLon, zone: Int = zoneOf(place)): Utm {
            val tau = tan(Math.toRadians(place.latitudeDeg))
            val offsetDeg = Math.IEEEremainder(place.longitudeDeg - centralMeridianDeg(zone), FULL_TURN_DEG)
            val longitude = offsetDeg * PI / (FULL_TURN_DEG / 2)
            // eq. (7) to (10)
            val tauPrime = conformalTangent(tau)
            val xiPrime = atan2(tauPrime, cos(longitude))
            val etaPrime = asinh(sin(longitude) / hypot(tauPrime, cos(longitude)))
            var xi = xiPrime
            var eta = etaPrime
            for (j in ALPHA.indices) {
                val order = 2.0 * (j + 1)
                xi += ALPHA[j] * sin(order * xiPrime) * cosh(order * etaPrime)
                eta += ALPHA[j] * cos(order * xiPrime) * sinh(order * etaPrime)
            }
            val north = place.latitudeDeg >= 0
            return Utm(
                easting = FALSE_EASTING + SCALE * RECTIFYING_RADIUS * eta,
                northing = (if (north) 0.0 else FALSE_NORTHING) + SCALE * RECTIFYING_RADIUS * xi,
                zone = zone,
                north = north,
            )
        }

        /** The zone that holds [place], 6 degrees of longitude each; the exceptions of Norway are not made. */
        public fun zoneOf(place: LatLon): Int {
            val degreesFromDateLine = (place.longitudeDeg + 180).mod(FULL_TURN_DEG)
            return (degreesFromDateLine / ZONE_WIDTH_DEG).toInt() + 1
        }

        private const val FULL_TURN_DEG = 360.0
        private const val ZONE_WIDTH_DEG = 6

        private fun centralMeridianDeg(zone: Int): Double = ZONE_WIDTH_DEG * zone - 183.0

        /** eq. (7) to (9): tangent of the conformal latitude from that of the geographic one. */
        private fun conformalTangent(tau: Double): Double {
            val sigma = sinh(ECCENTRICITY * atanh(ECCENTRICITY * tau / hypot(1.0, tau)))
            return tau * hypot(1.0, sigma) - sigma * hypot(1.0, tau)
        }
    }
}
