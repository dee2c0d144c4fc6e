package stillwater.model

import io.kotest.property.Arb
import io.kotest.property.PropTestConfig
import io.kotest.property.arbitrary.numericDouble
import io.kotest.property.checkAll
import kotlinx.coroutines.runBlocking
import net.sf.geographiclib.Geodesic
import org.junit.jupiter.api.Test
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class LocalFrameTest {
    private val config = PropTestConfig(seed = 20_131, iterations = 2_000)
    private val latitudes = Arb.numericDouble(-89.0, 89.0)
    private val longitudes = Arb.numericDouble(-180.0, 180.0)
    private val azimuths = Arb.numericDouble(-180.0, 180.0)
    private val distances = Arb.numericDouble(0.0, 5_000.0)

    @Test
    fun agreesWithGeodesicsToACentimetreOverFiveKilometres() = runBlocking<Unit> {
        checkAll(config, latitudes, longitudes, azimuths, distances) { latitude, longitude, azimuth, distance ->
            // GeographicLib is the oracle: the far end of the geodesic from the origin.
            val end = Geodesic.WGS84.Direct(latitude, longitude, azimuth, distance)
            val local = LocalFrame(LatLon(latitude, longitude)).toLocal(LatLon(end.lat2, end.lon2))
            val east = distance * sin(Math.toRadians(azimuth))
            val north = distance * cos(Math.toRadians(azimuth))
            val error = hypot(local.x - east, local.y - north)
            assertTrue(error < CENTIMETRE, "seed ${config.seed}: off by $error m at $latitude, $longitude")
        }
    }

    @Test
    fun comesBackToTheSamePlace() = runBlocking<Unit> {
        checkAll(config, latitudes, longitudes, azimuths, distances) { latitude, longitude, azimuth, distance ->
            val frame = LocalFrame(LatLon(latitude, longitude))
            val position = Position(
                distance * sin(Math.toRadians(azimuth)),
                distance * cos(Math.toRadians(azimuth)),
            )
            val back = frame.toLocal(frame.toLatLon(position))
            // Rounding of Earth-centred coordinates (6.4e6 m) is 1e-9 m; of degrees 4e-9 m.
            assertEquals(0.0, back.distanceTo(position), 1e-7, "seed ${config.seed}")
        }
    }

    @Test
    fun crossesTheDateLineWithoutAJump() {
        val frame = LocalFrame(LatLon(-16.9, 179.999))
        val beyond = frame.toLocal(LatLon(-16.9, -179.999))
        val distance = Geodesic.WGS84.Inverse(-16.9, 179.999, -16.9, -179.999).s12
        assertEquals(distance, beyond.x, CENTIMETRE)
        assertEquals(-179.999, frame.toLatLon(beyond).longitudeDeg, 1e-9)
    }

    @Test
    fun takesLongitudesEitherWay() {
        val frame = LocalFrame(LatLon(45.54, 286.85))
        val west = frame.toLocal(LatLon(45.55, -73.14))
        val east = frame.toLocal(LatLon(45.55, 286.86))
        assertEquals(0.0, west.distanceTo(east), 1e-7)
    }

    @Test
    fun givesTheSameWithAndWithoutAllocation() {
        val frame = LocalFrame(LatLon(44.0, -70.0))
        val into = DoubleArray(2)
        frame.toLocal(44.01, -70.02, into)
        assertEquals(frame.toLocal(LatLon(44.01, -70.02)), Position(into[0], into[1]))
    }

    @Test
    fun staysCloseToAPole() {
        val frame = LocalFrame(LatLon(89.99, 10.0))
        val far = frame.toLocal(LatLon(89.99, -170.0))
        // Over the pole: twice the 1.1 km to it, straight north.
        assertEquals(Geodesic.WGS84.Inverse(89.99, 10.0, 89.99, -170.0).s12, far.y, CENTIMETRE)
        assertTrue(abs(far.x) < CENTIMETRE)
    }

    @Test
    fun refusesAPoleAndPlacesBeyondTheEarth() {
        assertFailsWith<IllegalArgumentException> { LocalFrame(LatLon(90.0, 0.0)) }
        val frame = LocalFrame(LatLon(0.0, 0.0))
        assertFailsWith<IllegalArgumentException> { frame.toLatLon(Position(7e6, 0.0)) }
        assertFailsWith<IllegalArgumentException> { LatLon(90.1, 0.0) }
        assertFailsWith<IllegalArgumentException> { LatLon(0.0, Double.NaN) }
    }

    private companion object {
        const val CENTIMETRE = 0.01
    }
}
