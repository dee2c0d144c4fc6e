package stillwater.app.pose

import android.app.Application
import android.hardware.Sensor
import android.hardware.SensorManager
import android.location.Location
import android.location.LocationManager
import android.os.Handler
import android.os.Looper
import android.os.SystemClock
import org.junit.Before
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.annotation.Config
import org.robolectric.shadows.SensorEventBuilder
import org.robolectric.shadows.ShadowSensor
import java.time.Duration
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.sin
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

@RunWith(RobolectricTestRunner::class)
@Config(sdk = [26, 29, 34, 35])
class PhonePoseTest {
    private val context: Application = RuntimeEnvironment.getApplication()
    private val locations = shadowOf(context.getSystemService(LocationManager::class.java)!!)
    private val sensors = shadowOf(context.getSystemService(SensorManager::class.java)!!)
    private val rotation = ShadowSensor.newInstance(Sensor.TYPE_ROTATION_VECTOR)
    private val gyroscope = ShadowSensor.newInstance(Sensor.TYPE_GYROSCOPE)
    private val handler = Handler(Looper.getMainLooper())
    private lateinit var pose: PhonePose

    @Before
    fun listen() {
        shadowOf(context).grantPermissions(android.Manifest.permission.ACCESS_FINE_LOCATION)
        locations.setProviderEnabled(LocationManager.GPS_PROVIDER, true)
        sensors.addSensor(rotation)
        sensors.addSensor(gyroscope)
        pose = PhonePose(context).also { it.start(handler) }
    }

    @Test
    fun aFixKeepsItsAccuracyAndItsOwnTime() {
        assertNull(pose.fix)
        shadowOf(Looper.getMainLooper()).idleFor(Duration.ofSeconds(5))
        val taken = SystemClock.elapsedRealtimeNanos() - 300_000_000
        fix(45.5, elapsedNanos = taken, accuracy = 4.5f)
        val fix = assertNotNull(pose.fix)
        assertEquals(4.5f, fix.accuracyMetres)
        assertEquals(taken, fix.elapsedNanos, "the receiver's stamp, not when we were told")
        assertEquals(45.5, fix.place.latitudeDeg)
        assertNull(pose.problem)
    }

    @Test
    fun theReceiverIsAskedForAllItHas() {
        val listener = locations.getLocationUpdateListeners(LocationManager.GPS_PROVIDER)
        assertEquals(1, listener.size)
        val asked = locations.getLegacyLocationRequests(LocationManager.GPS_PROVIDER).single()
        assertEquals(0L to 0f, asked.intervalMillis to asked.minUpdateDistanceMeters, "as often as it can")
        pose.stop()
        assertTrue(locations.getLocationUpdateListeners(LocationManager.GPS_PROVIDER).isEmpty())
        assertTrue(sensors.listeners.isEmpty())
    }

    @Test
    fun aJumpIsFlaggedAndANewPlaceIsOnlyNewOnce() {
        for (latitude in listOf(45.5, 45.50001, 45.51, 45.50002, 45.50003)) fix(latitude)
        assertEquals(1L, pose.jumps, "there and back is one")
        assertEquals(5L, pose.fixes)
        for (latitude in listOf(45.6, 45.60001, 45.60002)) fix(latitude)
        assertEquals(3L, pose.jumps, "the second is where the phone is now")
        assertEquals(false, pose.fix?.isJump)
    }

    @Test
    fun whatIsNoPlaceOnEarthIsNotTaken() {
        fix(95.0)
        assertNull(pose.fix)
        assertEquals(0L, pose.fixes)
    }

    @Test
    fun theHeadingIsFromEastAndTheYawRateAboutTheUprightAxis() {
        // Flat, the top to magnetic west.
        turn(azimuth = -PI / 2)
        assertEquals(270f, assertNotNull(pose.heading).degrees, 0.5f)
        assertEquals(PI, assertNotNull(pose.heading).radians, 0.01)
        assertTrue(assertNotNull(pose.heading).yawRate.isNaN(), "no gyroscope has spoken")
        spin(0f, 0f, 0.2f)
        turn(azimuth = -PI / 2)
        assertEquals(0.2, assertNotNull(pose.heading).yawRate, 1e-6)
        // On its long edge, screen to the north: what was its x axis points up or down.
        val half = sin(PI / 4).toFloat()
        sensors.sendSensorEventToListeners(event(rotation, floatArrayOf(0f, half, 0f, half)))
        spin(0.3f, 0f, 0f)
        sensors.sendSensorEventToListeners(event(rotation, floatArrayOf(0f, half, 0f, half)))
        assertEquals(-0.3, assertNotNull(pose.heading).yawRate, 1e-6)
    }

    @Test
    fun theHeadingIsFromTrueNorthOnceThePlaceIsKnown() {
        // Quebec, where the needle points some 14 degrees west.
        fix(45.5)
        turn(azimuth = 0.0)
        assertEquals(346f, assertNotNull(pose.heading).degrees, 2f)
    }

    @Test
    fun whatStandsInTheWayIsTold() {
        locations.setProviderEnabled(LocationManager.GPS_PROVIDER, false)
        val off = PhonePose(context).also { it.start(handler) }
        assertEquals(PoseProblem.SWITCHED_OFF, off.problem)
        locations.setProviderEnabled(LocationManager.GPS_PROVIDER, true)
        shadowOf(Looper.getMainLooper()).idle()
        assertNull(off.problem)
        locations.removeProvider(LocationManager.GPS_PROVIDER)
        assertEquals(PoseProblem.NO_RECEIVER, PhonePose(context).also { it.start(handler) }.problem)
    }

    private fun fix(latitude: Double, elapsedNanos: Long = SystemClock.elapsedRealtimeNanos(), accuracy: Float = 3f) {
        val location =
            Location(LocationManager.GPS_PROVIDER).apply {
                this.latitude = latitude
                longitude = -73.6
                this.accuracy = accuracy
                // GeomagneticField takes the year from it.
                time = 1_750_000_000_000
                elapsedRealtimeNanos = elapsedNanos
            }
        locations.simulateLocation(location)
        shadowOf(Looper.getMainLooper()).idleFor(Duration.ofSeconds(1))
    }

    private fun turn(azimuth: Double) {
        val values = floatArrayOf(0f, 0f, sin(-azimuth / 2).toFloat(), cos(-azimuth / 2).toFloat())
        sensors.sendSensorEventToListeners(event(rotation, values))
    }

    private fun spin(x: Float, y: Float, z: Float) =
        sensors.sendSensorEventToListeners(event(gyroscope, floatArrayOf(x, y, z)))

    private fun event(sensor: Sensor, values: FloatArray) = SensorEventBuilder.newBuilder(sensor, values).build()
}
