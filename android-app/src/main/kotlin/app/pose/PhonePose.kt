package stillwater.app.pose

import android.annotation.SuppressLint
import android.content.Context
import android.hardware.GeomagneticField
import android.hardware.Sensor
import android.hardware.SensorEvent
import android.hardware.SensorEventListener
import android.hardware.SensorManager
import android.location.Location
import android.location.LocationListener
import android.location.LocationManager
import android.os.Bundle
import android.os.Handler
import android.os.SystemClock
import stillwater.control.FixCheck
import stillwater.control.PhoneTurn
import stillwater.model.LatLon

/**
 * One position of the phone's receiver.
 *
 * @property accuracyMetres radius of 68 % confidence, m; null where the receiver did not say.
 * @property speed over ground, m/s; null where not given.
 * @property courseDeg over ground, compass degrees; null where not given.
 * @property elapsedNanos when it was, ns since the phone started; the receiver's own stamp, not when we were told.
 * @property isJump whether it lies farther from the one before than a boat goes.
 */
data class PhoneFix(
    val place: LatLon,
    val accuracyMetres: Float?,
    val speed: Float?,
    val courseDeg: Float?,
    val elapsedNanos: Long,
    val isJump: Boolean = false,
)

/**
 * Where the phone is and which way it points: the platform's GPS at its best rate, and its rotation sensor, which joins
 * compass and gyro, for the heading at low speed. The phone's top points to the boat's bow.
 *
 * Listeners run on the handler's thread; what they found may be read from any.
 */
internal class PhonePose(context: Context) : Pose {
    private val locations: LocationManager? = context.getSystemService(LocationManager::class.java)
    private val sensors: SensorManager? = context.getSystemService(SensorManager::class.java)

    @Volatile override var fix: PhoneFix? = null
        private set

    @Volatile override var heading: PhoneHeading? = null
        private set

    @Volatile override var problem: PoseProblem? = null
        private set

    @Volatile override var fixes = 0L
        private set

    @Volatile override var jumps = 0L
        private set

    private val check = FixCheck()
    private var declinationDeg = 0.0
    private var yawRate = Double.NaN

    @SuppressLint("MissingPermission") // a refusal is the SecurityException below
    override fun start(handler: Handler) {
        val locations = this.locations
        if (locations == null || LocationManager.GPS_PROVIDER !in locations.allProviders) {
            problem = PoseProblem.NO_RECEIVER
        } else {
            try {
                locations.requestLocationUpdates(LocationManager.GPS_PROVIDER, 0L, 0f, places, handler.looper)
                val on = locations.isProviderEnabled(LocationManager.GPS_PROVIDER)
                problem = if (on) null else PoseProblem.SWITCHED_OFF
            } catch (_: SecurityException) {
                problem = PoseProblem.NOT_PERMITTED
            }
        }
        for (type in listOf(Sensor.TYPE_GYROSCOPE, Sensor.TYPE_ROTATION_VECTOR)) {
            val sensor = sensors?.getDefaultSensor(type) ?: continue
            sensors.registerListener(turns, sensor, SensorManager.SENSOR_DELAY_GAME, handler)
        }
    }

    override fun stop() {
        locations?.removeUpdates(places)
        sensors?.unregisterListener(turns)
    }

    private fun take(location: Location) {
        if (location.latitude !in LatLon.LATITUDES_DEG || location.longitude !in LatLon.LONGITUDES_DEG) return
        val height = if (location.hasAltitude()) location.altitude.toFloat() else 0f
        declinationDeg =
            GeomagneticField(location.latitude.toFloat(), location.longitude.toFloat(), height, location.time)
                .declination
                .toDouble()
        val place = LatLon(location.latitude, location.longitude)
        val accuracy = if (location.hasAccuracy()) location.accuracy.toDouble() else 0.0
        val jumped = check.isJump(location.elapsedRealtimeNanos * SECONDS_PER_NANO, place, accuracy)
        fixes++
        jumps = check.jumps
        fix =
            PhoneFix(
                place,
                location.accuracy.takeIf { location.hasAccuracy() },
                location.speed.takeIf { location.hasSpeed() },
                location.bearing.takeIf { location.hasBearing() },
                location.elapsedRealtimeNanos,
                jumped,
            )
    }

    /** All four functions: before Android 11 the platform's interface has none of them itself. */
    private val places =
        object : LocationListener {
            override fun onLocationChanged(location: Location) = take(location)

            @Deprecated("The platform calls it up to Android 9.")
            override fun onStatusChanged(provider: String?, status: Int, extras: Bundle?) = Unit

            override fun onProviderEnabled(provider: String) {
                problem = null
            }

            override fun onProviderDisabled(provider: String) {
                problem = PoseProblem.SWITCHED_OFF
            }
        }

    private val turns =
        object : SensorEventListener {
            private val rotation = FloatArray(ROTATION_SIZE)
            private val angles = FloatArray(ANGLES)
            private var knowsRotation = false

            override fun onSensorChanged(event: SensorEvent) {
                if (event.sensor?.type == Sensor.TYPE_GYROSCOPE) {
                    if (knowsRotation) yawRate = PhoneTurn.yawRate(rotation, event.values)
                    return
                }
                SensorManager.getRotationMatrixFromVector(rotation, event.values)
                knowsRotation = true
                SensorManager.getOrientation(rotation, angles)
                val compassDeg = Math.toDegrees(angles[0].toDouble()) + declinationDeg
                heading = PhoneHeading.ofCompass(compassDeg, yawRate, SystemClock.elapsedRealtimeNanos())
            }

            override fun onAccuracyChanged(sensor: Sensor?, accuracy: Int) = Unit
        }

    private companion object {
        const val ROTATION_SIZE = 9
        const val ANGLES = 3
        const val SECONDS_PER_NANO = 1e-9
    }
}
