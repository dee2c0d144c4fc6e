package stillwater.app.service

import android.app.Application
import android.content.Intent
import android.hardware.GeomagneticField
import android.hardware.Sensor
import android.hardware.SensorManager
import android.location.Location
import android.location.LocationManager
import android.os.BatteryManager
import android.os.PowerManager
import android.os.SystemClock
import org.robolectric.Robolectric
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.android.controller.ServiceController
import org.robolectric.shadows.SensorEventBuilder
import org.robolectric.shadows.ShadowSensor
import stillwater.app.link.LinkChoice
import stillwater.app.link.LinkMaker
import stillwater.app.mission.FileOutput
import stillwater.app.mission.LogOpener
import stillwater.app.mission.MissionReport
import stillwater.mission.MissionSpec
import stillwater.mission.MissionState
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import stillwater.sensor.SensorSpec
import stillwater.virtual.BoardSpec
import stillwater.virtual.PlumeWater
import stillwater.virtual.VirtualBoat
import stillwater.virtual.VirtualBoatSpec
import java.time.Duration
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.sin

/**
 * The service on a desk, in virtual time: a virtual boat at the other end of [wire], its fixes and compass as the
 * phone's receiver and sensors, and a phone on which everything is in order.
 */
internal class ServiceDesk(val wire: DeskWire, spec: String = POND, seed: Long = 1) {
    private val context: Application = RuntimeEnvironment.getApplication()
    private val mission = MissionSpec.fromJson(spec)
    private val locations = shadowOf(context.getSystemService(LocationManager::class.java)!!)
    private val sensors = shadowOf(context.getSystemService(SensorManager::class.java)!!)
    private val rotation = ShadowSensor.newInstance(Sensor.TYPE_ROTATION_VECTOR)
    private val buffer = ByteArray(4096)
    private var steps = 0
    private lateinit var controller: ServiceController<BoatService>

    /** The boat. */
    val boat =
        VirtualBoat(
            VirtualBoatSpec(
                PROBE,
                board = ELECTRONICS,
                start = Position(mission.home.x, mission.home.y),
            ),
            PlumeWater(Position(25.0, 15.0)),
            LocalFrame(LatLon(mission.origin.latitude, mission.origin.longitude)),
            seed,
        )

    /** Everything the board has sent that got through, as text. */
    val said = StringBuilder()

    /** Everything the phone has sent that got through, as text. */
    val told = StringBuilder()

    init {
        for (permission in Preflight.neededPermissions()) shadowOf(context).grantPermissions(permission)
        locations.setProviderEnabled(LocationManager.GPS_PROVIDER, true)
        sensors.addSensor(rotation)
        shadowOf(context.getSystemService(BatteryManager::class.java)!!)
            .setIntProperty(BatteryManager.BATTERY_PROPERTY_CAPACITY, 80)
        shadowOf(context.getSystemService(PowerManager::class.java)!!)
            .setIgnoringBatteryOptimizations(context.packageName, true)
    }

    val service: BoatService get() = controller.get()
    val snapshot: BoatSnapshot get() = service.snapshot
    val report: MissionReport get() = checkNotNull(snapshot.mission)
    val state: MissionState get() = report.state

    /** A service as Android makes it, started with [intent], null after the process died. */
    fun start(
        intent: Intent? = BoatService.startIntent(context, BOARD),
        links: LinkMaker = LinkMaker { _, _ -> wire.link },
    ) {
        BoatService.links = links
        controller = Robolectric.buildService(BoatService::class.java).create()
        service.onStartCommand(intent, 0, 1)
        settle()
    }

    /** The service goes, and what it still had to do is done. */
    fun end() {
        val threads = listOf(service.boatLooper.thread, service.diskLooper.thread)
        controller.destroy()
        threads.forEach { it.join() }
        BoatService.links = LinkMaker.REAL
        BoatService.logs = LogOpener(::FileOutput)
    }

    /** What was asked for is done, and files are written. */
    fun settle() {
        repeat(2) {
            shadowOf(service.boatLooper).idle()
            shadowOf(service.diskLooper).idle()
        }
        shadowOf(service.boatLooper).idle()
    }

    /** Asks [what] of the service, and lets a step pass. */
    fun ask(what: BoatService.() -> Unit) {
        service.what()
        step()
    }

    /** Lets a tenth of a second pass. */
    fun step() {
        boat.advance(STEP)
        wire.toPhone(fromBoard())
        boat.takeFix()?.let { fix(it.place) }
        turn(boat.heading())
        shadowOf(service.boatLooper).idleFor(Duration.ofMillis(MILLIS))
        val commands = wire.fromPhone()
        told.append(String(commands))
        boat.phone.write(commands)
        // Files are worked on by the real clock; here they are to keep up with the virtual one.
        if (++steps % STEPS_A_SECOND == 0) shadowOf(service.diskLooper).idle()
    }

    /** Lets [seconds] s pass, at least half a one; the snapshot then has all that was done before the last half. */
    fun pass(seconds: Double) {
        repeat((seconds / STEP).toInt() - LOOK_STEPS) { step() }
        settle()
        repeat(LOOK_STEPS) { step() }
    }

    /** Lets time pass until [ended] holds, for [seconds] s at most; answers whether it does. */
    fun until(seconds: Double, ended: (BoatSnapshot) -> Boolean): Boolean {
        repeat((seconds / STEP).toInt()) {
            step()
            if (ended(snapshot)) return true
        }
        return false
    }

    /** The receiver finds itself at [place]. */
    fun fix(place: LatLon, accuracy: Float = 3f) {
        val location =
            Location(LocationManager.GPS_PROVIDER).apply {
                latitude = place.latitudeDeg
                longitude = place.longitudeDeg
                this.accuracy = accuracy
                time = System.currentTimeMillis()
                elapsedRealtimeNanos = SystemClock.elapsedRealtimeNanos()
            }
        locations.simulateLocation(location)
    }

    /** The rotation sensor of a phone that lies flat with its top [heading] rad from east, counter-clockwise. */
    private fun turn(heading: Double) {
        val place = mission.origin
        val declination =
            GeomagneticField(place.latitude.toFloat(), place.longitude.toFloat(), 0f, System.currentTimeMillis())
                .declination
        // From magnetic north, clockwise, as the sensor has it.
        val azimuth = PI / 2 - heading - Math.toRadians(declination.toDouble())
        val values = floatArrayOf(0f, 0f, sin(-azimuth / 2).toFloat(), cos(-azimuth / 2).toFloat())
        sensors.sendSensorEventToListeners(SensorEventBuilder.newBuilder(rotation, values).build())
    }

    private fun fromBoard(): ByteArray {
        var all = ByteArray(0)
        while (true) {
            val count = boat.phone.read(buffer)
            if (count <= 0) break
            all += buffer.copyOf(count)
        }
        said.append(String(all))
        return all
    }

    companion object {
        private val ELECTRONICS =
            BoardSpec(watchdog = 0.5, arming = 2.0, oxygenPeriod = 1.0, batteryPeriod = 1.0)

        val BOARD = LinkChoice.Bluetooth("00:11:22:33:AA:BB", "Boat 3")

        /** Four by three cells of 10 m in a rectangle 15 m larger all round. */
        const val POND = """{"name":"pond","origin":{"lat_deg":45.5,"lon_deg":-73.6},
            "area":{"south_west":{"x_m":-20,"y_m":-20},"north_east":{"x_m":60,"y_m":50}},
            "grid":{"south_west":{"x_m":0,"y_m":0},"columns":4,"rows":3,"cell_m":10},
            "probe":{"quantity":"dissolved-oxygen","port":1,"lowest":0,"highest":15},
            "planner":"lawnmower","budget":{"seconds":200},"home":{"x_m":5,"y_m":5},
            "failsafe":{"lowest_volts":13.2}}"""

        private const val STEP = 0.1
        private const val MILLIS = 100L
        private const val STEPS_A_SECOND = 10
        private const val LOOK_STEPS = 5
        private val PROBE =
            SensorSpec.fromJson(
                """{"name":"probe","stages":[{"type":"first-order-lag","time_constant_s":6.0},""" +
                    """{"type":"noise","standard_deviation":0.02}]}""",
            )
    }
}
