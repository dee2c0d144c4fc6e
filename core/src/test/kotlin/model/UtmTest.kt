package stillwater.model

import org.junit.jupiter.api.Test
import kotlin.math.abs
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class UtmTest {
    private class Case(
        val latitude: Double,
        val longitude: Double,
        val zone: Int,
        val north: Boolean,
        val easting: Double,
        val northing: Double,
    )

    // pyproj 3.7.2 (PROJ 9.5.1): Transformer.from_crs(4326, 32600 + zone or 32700 + zone), rounded to 0.1 mm.
    private val cases = listOf(
        Case(45.5437202, -73.1535721, 18, true, 644143.3805, 5045011.8333),
        Case(44.4448326, -69.6008356, 19, true, 452189.8849, 4921456.8853),
        Case(40.0, -80.4, 17, true, 551215.9844, 4427929.5961),
        Case(-33.8568, 151.2153, 56, false, 334900.5697, 6252288.7529),
        Case(0.0, 0.0, 31, true, 166021.4431, 0.0),
        Case(-54.8019, -68.303, 19, false, 544805.0975, 3927029.8847),
        Case(71.2906, -156.7886, 4, true, 579155.0643, 7911254.8684),
        Case(83.5, -30.0, 26, true, 462101.3367, 9273261.9089),
        Case(-16.9, 179.95, 60, false, 814289.784, 8129153.8586),
        Case(65.8, -179.95, 1, true, 365101.4897, 7300786.2928),
        Case(1.3, 103.9, 48, true, 377621.2741, 143715.962),
        Case(12.5, 0.0, 31, true, 173901.0018, 1383692.7006),
    )

    @Test
    fun agreesWithProjToItsLastDigit() {
        for (case in cases) {
            val utm = Utm.of(LatLon(case.latitude, case.longitude))
            assertEquals(case.zone, utm.zone, "${case.latitude}, ${case.longitude}")
            assertEquals(case.north, utm.north)
            assertEquals(case.easting, utm.easting, ROUNDING)
            assertEquals(case.northing, utm.northing, ROUNDING)
            val place = Utm(case.easting, case.northing, case.zone, case.north).toLatLon()
            // 1e-9 degrees are 0.1 mm.
            assertEquals(case.latitude, place.latitudeDeg, 2e-9)
            assertEquals(0.0, Math.IEEEremainder(case.longitude - place.longitudeDeg, 360.0), 1e-8)
        }
    }

    @Test
    fun comesBackToTheSamePlaceAllOverTheGlobe() {
        val random = Random(SEED)
        repeat(2_000) {
            val place = LatLon(random.nextDouble(-80.0, 84.0), random.nextDouble(-180.0, 180.0))
            val back = Utm.of(place).toLatLon()
            val apart = abs(place.latitudeDeg - back.latitudeDeg) +
                abs(Math.IEEEremainder(place.longitudeDeg - back.longitudeDeg, 360.0))
            assertTrue(apart < 1e-9, "seed $SEED: $place came back as $back")
        }
    }

    @Test
    fun staysOnTheGlobeBeyondTheDateLine() {
        // The outer zones' eastings run over the date line; logs near Fiji hold such places.
        val east = Utm(833_000.0, 8_129_000.0, 60, false).toLatLon()
        assertTrue(east.longitudeDeg in -180.0..-179.0, "$east")
        val west = Utm(160_000.0, 8_129_000.0, 1, false).toLatLon()
        assertTrue(west.longitudeDeg in 179.0..180.0, "$west")
    }

    @Test
    fun refusesWhatNoZoneHolds() {
        assertFailsWith<IllegalArgumentException> { Utm(500_000.0, 0.0, 0, true) }
        assertFailsWith<IllegalArgumentException> { Utm(500_000.0, 0.0, 61, true) }
        assertFailsWith<IllegalArgumentException> { Utm(-1.0, 0.0, 1, true) }
        assertFailsWith<IllegalArgumentException> { Utm(500_000.0, 10_000_001.0, 1, true) }
        assertFailsWith<IllegalArgumentException> { Utm(Double.NaN, 0.0, 1, true) }
    }

    private companion object {
        const val SEED = 7

        /** Half of the oracle's last digit, and rounding, m. */
        const val ROUNDING = 6e-5
    }
}
