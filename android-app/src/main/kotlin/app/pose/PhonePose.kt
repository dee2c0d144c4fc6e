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
import stillwater.model.LatLon

/**
 * One position of the phone's receiver.
 *
 * @property accuracyMetres radius of 68 % confidence, m; null where the receiver did not say.
 * @property speed over ground, m/s; null where not given.
 * @property courseDeg over ground, compass degrees; null where not given.
 * @property elapsedNanos when it was, ns since the phone started; the receiver's own stamp, not when we were told.
 */
data class PhoneFix(
    val place: LatLon,
    val accuracyMetres: Float?,
    val speed: Float?,
    val courseDeg: Float?,
    val elapsedNanos: Long,
)

/** What is in the way of a fix. */
enum class PoseProblem {
    /** The phone has no receiver. */
    NO_RECEIVER,

    /** The permission is not given. */
    NOT_PERMITTED,

    /** It is switched off in the phone's settings. */
    SWITCHED_OFF,
}

/**
 * Where the phone is and which way it points: the platform's GPS at its best rate, and its rotation sensor, which joins
 * compass and gyro, for the heading at low speed.
 *
 * Listeners run on the handler's thread; [fix], [headingDeg] and [problem] may be read from any.
 */
internal class PhonePose(context: Context) {
    private val locations: LocationManager? = context.getSystemService(LocationManager::class.java)
    private val sensors: SensorManager? = context.getSystemService(SensorManager::class.java)

    /** The newest fix, null before the first. */
    @Volatile var fix: PhoneFix? = null
        private set

    /** Which way the phone's top points, degrees from true north, clockwise; null where no sensor says. */
    @Volatile var headingDeg: Float? = null
        private set

    /** Why there can be no fix, null where nothing is in the way. */
    @Volatile var problem: PoseProblem? = null
        private set

    @Volatile private var declinationDeg = 0f

    /** Begins to listen, on [handler]'s thread. */
    @SuppressLint("MissingPermission") // a refusal is the SecurityException below
    fun start(handler: Handler) {
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
        sensors?.getDefaultSensor(Sensor.TYPE_ROTATION_VECTOR)?.let {
            sensors.registerListener(turns, it, SensorManager.SENSOR_DELAY_GAME, handler)
        }
    }

    /** Listens no more. */
    fun stop() {
        locations?.removeUpdates(places)
        sensors?.unregisterListener(turns)
    }

    /** All four functions: before Android 11 the platform's interface has none of them itself. */
    private val places =
        object : LocationListener {
            override fun onLocationChanged(location: Location) {
                if (location.latitude !in LatLon.LATITUDES_DEG || location.longitude !in LatLon.LONGITUDES_DEG) return
                val height = if (location.hasAltitude()) location.altitude.toFloat() else 0f
                declinationDeg =
                    GeomagneticField(
                        location.latitude.toFloat(),
                        location.longitude.toFloat(),
                        height,
                        location.time,
                    ).declination
                fix =
                    PhoneFix(
                        LatLon(location.latitude, location.longitude),
                        location.accuracy.takeIf { location.hasAccuracy() },
                        location.speed.takeIf { location.hasSpeed() },
                        location.bearing.takeIf { location.hasBearing() },
                        location.elapsedRealtimeNanos,
                    )
            }

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

            override fun onSensorChanged(event: SensorEvent) {
                SensorManager.getRotationMatrixFromVector(rotation, event.values)
                SensorManager.getOrientation(rotation, angles)
                headingDeg = Math.toDegrees(angles[0].toDouble()).toFloat() + declinationDeg
            }

            override fun onAccuracyChanged(sensor: Sensor?, accuracy: Int) = Unit
        }

    companion object {
        /** Wider than a lawnmower's lane on a pond, a fix is no use. m. */
        const val WIDEST_FIX = 10f
        private const val ROTATION_SIZE = 9
        private const val ANGLES = 3
    }
}
