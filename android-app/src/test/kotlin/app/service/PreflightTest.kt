package stillwater.app.service

import android.app.Application
import android.os.BatteryManager
import android.os.PowerManager
import org.junit.Before
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.annotation.Config
import stillwater.app.link.LinkHealth
import stillwater.app.link.LinkState
import stillwater.app.pose.PoseProblem
import kotlin.test.assertEquals
import kotlin.test.assertNull

/** Each line of the checklist by itself, and what makes it red. */
@RunWith(RobolectricTestRunner::class)
@Config(sdk = [26, 29, 34, 35])
class PreflightTest {
    private val context: Application = RuntimeEnvironment.getApplication()
    private val battery = shadowOf(context.getSystemService(BatteryManager::class.java)!!)
    private val power = shadowOf(context.getSystemService(PowerManager::class.java)!!)

    @Before
    fun allIsWell() {
        Preflight.neededPermissions().forEach { shadowOf(context).grantPermissions(it) }
        battery.setIntProperty(BatteryManager.BATTERY_PROPERTY_CAPACITY, 30)
        power.setIgnoringBatteryOptimizations(context.packageName, true)
    }

    @Test
    fun aBoatThatIsReadyIsGreen() = assertEquals(emptyMap(), red(boat()))

    @Test
    fun theBoatsOwnLines() {
        val link = PreflightCheck.LINK
        assertEquals(mapOf(link to PreflightReason.NO_LINK), red(boat(hasLink = false)))
        assertEquals(mapOf(link to PreflightReason.NOT_CONNECTED), red(boat(state = LinkState.WAITING)))
        assertEquals(mapOf(link to PreflightReason.BOARD_SILENT), red(boat(silence = 4.0)))
        val charge = PreflightCheck.BOAT_BATTERY
        assertEquals(mapOf(charge to PreflightReason.NOT_REPORTED), red(boat(volts = null)))
        assertEquals(mapOf(charge to PreflightReason.LOW_CHARGE), red(boat(volts = 10.9)))
        val fix = PreflightCheck.FIX
        for ((problem, reason) in mapOf(
            PoseProblem.NO_RECEIVER to PreflightReason.NO_RECEIVER,
            PoseProblem.NOT_PERMITTED to PreflightReason.NOT_PERMITTED,
            PoseProblem.SWITCHED_OFF to PreflightReason.RECEIVER_OFF,
        )) {
            assertEquals(mapOf(fix to reason), red(boat(pose = problem)))
        }
        assertEquals(mapOf(fix to PreflightReason.NO_FIX), red(boat(age = null)))
        assertEquals(mapOf(fix to PreflightReason.FIX_OLD), red(boat(age = 3.5)))
        assertEquals(mapOf(fix to PreflightReason.FIX_WIDE), red(boat(accuracy = 11f)))
        assertEquals(mapOf(fix to PreflightReason.FIX_WIDE), red(boat(accuracy = null)))
        assertEquals(mapOf(fix to PreflightReason.NO_HEADING), red(boat(hasHeading = false)))
    }

    /** A boat whose board has no wire to its battery goes on the water where its mission says that none is measured. */
    @Test
    fun aBatteryThatIsNotReportedIsAcceptedByTheMissionAndSaidSo() {
        assertEquals(emptyMap(), red(boat(volts = null, lowest = 0.0)))
        assertEquals(PreflightNote.NOT_REPORTED, note(PreflightCheck.BOAT_BATTERY, boat(volts = null, lowest = 0.0)))
        assertEquals(PreflightNote.NOT_WATCHED, note(PreflightCheck.BOAT_BATTERY, boat(volts = 9.0, lowest = 0.0)))
        assertNull(note(PreflightCheck.BOAT_BATTERY, boat()))
        val unasked = boat(volts = null, lowest = null, hasMission = false)
        assertEquals(PreflightReason.NOT_REPORTED, red(unasked)[PreflightCheck.BOAT_BATTERY], "no mission yet")
    }

    /** What nobody has said is nobody's choice. */
    @Test
    fun aMissionThatSaysNothingOfTheBatteryIsRed() {
        for (volts in listOf(15.0, null)) {
            val unsaid = boat(volts = volts, lowest = null)
            assertEquals(mapOf(PreflightCheck.BOAT_BATTERY to PreflightReason.NOT_SAID), red(unsaid))
        }
    }

    /** Not red: some boards let their probes speak only once they are armed. */
    @Test
    fun aProbeThatWasNotHeardIsNoted() {
        assertEquals(emptyMap(), red(boat(hasProbe = false)))
        assertEquals(PreflightNote.PROBE_SILENT, note(PreflightCheck.PROBE, boat(hasProbe = false)))
        assertNull(note(PreflightCheck.PROBE, boat()))
    }

    @Test
    fun aMissionOfAnotherWaterIsRedAndOneNearByIsNoted() {
        val place = PreflightCheck.PLACE
        assertEquals(mapOf(place to PreflightReason.OTHER_WATER), red(boat(metres = 1_001.0)))
        assertEquals(mapOf(place to PreflightReason.NO_FIX), red(boat(metres = null)))
        assertEquals(emptyMap(), red(boat(metres = 1_000.0)))
        assertEquals(PreflightNote.ON_THE_WAY, note(place, boat(metres = 0.5)))
        assertNull(note(place, boat()))
        assertEquals(emptyMap(), red(boat(metres = null, hasMission = false)))
    }

    @Test
    fun thePhonesOwnLines() {
        shadowOf(context).denyPermissions(android.Manifest.permission.ACCESS_FINE_LOCATION)
        battery.setIntProperty(BatteryManager.BATTERY_PROPERTY_CAPACITY, 29)
        power.setIgnoringBatteryOptimizations(context.packageName, false)
        val expected =
            mapOf(
                PreflightCheck.PERMISSIONS to PreflightReason.NOT_PERMITTED,
                PreflightCheck.PHONE_BATTERY to PreflightReason.LOW_CHARGE,
                PreflightCheck.BATTERY_SAVER to PreflightReason.NOT_EXEMPT,
            )
        assertEquals(expected, red(boat()))
        assertEquals(
            mapOf(PreflightCheck.PHONE_BATTERY to PreflightReason.LOW_CHARGE),
            red(boat(isVirtual = true)),
            "the demo needs no permission, and nothing is lost when Android ends it",
        )
        battery.setIntProperty(BatteryManager.BATTERY_PROPERTY_CAPACITY, Int.MIN_VALUE)
        assertEquals(PreflightReason.UNKNOWN_CHARGE, red(boat())[PreflightCheck.PHONE_BATTERY])
    }

    private fun red(boat: BoatAtRest): Map<PreflightCheck, PreflightReason?> {
        val items = Preflight(context).look(boat)
        assertEquals(PreflightCheck.entries.toList(), items.map { it.check })
        assertEquals(items.map { !it.ready }, items.map { it.reason != null })
        return items.filter { !it.ready }.associate { it.check to it.reason }
    }

    private fun note(check: PreflightCheck, boat: BoatAtRest): PreflightNote? =
        Preflight(context).look(boat).single { it.check == check }.note

    private fun boat(
        hasLink: Boolean = true,
        state: LinkState = LinkState.CONNECTED,
        silence: Double = 0.1,
        volts: Double? = 15.0,
        pose: PoseProblem? = null,
        age: Double? = 1.0,
        accuracy: Float? = 5f,
        hasHeading: Boolean = true,
        isVirtual: Boolean = false,
        lowest: Double? = 11.0,
        metres: Double? = 0.0,
        hasMission: Boolean = true,
        hasProbe: Boolean = true,
    ) = BoatAtRest(
        hasLink = hasLink,
        link = LinkHealth(state),
        boardSilence = silence,
        volts = volts,
        lowestVolts = lowest,
        pose = pose,
        fixAgeSeconds = age,
        accuracyMetres = accuracy,
        hasHeading = hasHeading,
        isVirtual = isVirtual,
        hasMission = hasMission,
        hasProbe = hasProbe,
        metresToArea = metres,
    )
}
