package stillwater.app.service

import android.Manifest
import android.content.Context
import android.content.pm.PackageManager
import android.os.BatteryManager
import android.os.Build
import android.os.PowerManager
import stillwater.app.link.LinkHealth
import stillwater.app.link.LinkState
import stillwater.app.mayWait
import stillwater.app.pose.PoseProblem
import stillwater.control.FixCheck

/**
 * One line of the checklist before a start; all have to be [ready].
 *
 * @property reason what is not in order; null where [ready].
 * @property note what a person should know of a line that is in order all the same; null where nothing.
 * @property metres from the boat to the mission's water, where [reason] or [note] speaks of it; null elsewhere.
 */
data class PreflightItem(
    val check: PreflightCheck,
    val ready: Boolean,
    val reason: PreflightReason? = null,
    val note: PreflightNote? = null,
    val metres: Double? = null,
)

/** What is worth knowing of a line that is in order. */
enum class PreflightNote {
    /** The board says nothing of its battery, and the mission does not ask. */
    NOT_REPORTED,

    /** The board says how much charge there is, and the mission does not ask. */
    NOT_WATCHED,

    /** The probe of the mission has not been heard on this connection: it may speak later, or be another one. */
    PROBE_SILENT,

    /** The boat is not on the mission's water yet, but near: armed, it waits until it is. */
    ON_THE_WAY,
}

/** Why a line of the checklist is red. */
enum class PreflightReason {
    /** A permission is not given. */
    NOT_PERMITTED,

    /** No link was chosen. */
    NO_LINK,

    /** The link is not connected yet, or was lost. */
    NOT_CONNECTED,

    /** The board has not been heard of lately. */
    BOARD_SILENT,

    /** The phone has no receiver. */
    NO_RECEIVER,

    /** The receiver is switched off in the phone's settings. */
    RECEIVER_OFF,

    /** No fix yet. */
    NO_FIX,

    /** The last fix is too old. */
    FIX_OLD,

    /** The fix is too uncertain. */
    FIX_WIDE,

    /** No compass, or it does not speak. */
    NO_HEADING,

    /** The boat is so far from the mission's water that it must be another's. */
    OTHER_WATER,

    /** The board has not said how much charge there is, and the mission asks. */
    NOT_REPORTED,

    /** The mission does not say below which voltage the battery is low, nor that nobody is to watch it. */
    NOT_SAID,

    /** The phone does not say how much charge there is. */
    UNKNOWN_CHARGE,

    /** Too little charge. */
    LOW_CHARGE,

    /** Too little room for the log. */
    LITTLE_ROOM,

    /** Android may end the app to save the battery. */
    NOT_EXEMPT,
}

/** What is looked at before a start. */
enum class PreflightCheck {
    PERMISSIONS,
    LINK,
    PROBE,
    FIX,
    PLACE,
    BOAT_BATTERY,
    PHONE_BATTERY,
    STORAGE,
    BATTERY_SAVER,
}

/**
 * What is known of boat and pose when the phone is looked at.
 *
 * @property hasLink whether a link was chosen.
 * @property boardSilence time since the board was understood, s; infinite before.
 * @property volts of the boat's battery, V; null before the board said so.
 * @property lowestVolts that the mission goes on with, V; 0 where it does not ask; null where none is loaded that says.
 * @property pose what stands in the way of a fix; null where nothing does.
 * @property fixAgeSeconds of the newest fix, s; null without.
 * @property accuracyMetres of the newest fix, m; null without.
 * @property hasHeading whether the compass speaks.
 * @property isVirtual whether boat and pose are the demo's.
 * @property hasProbe whether the mission's probe was heard on this connection; true where no mission is loaded.
 * @property hasMission whether a mission is loaded.
 * @property metresToArea from the newest fix to the mission's water, m; 0 on it; null without a fix or a mission.
 */
internal class BoatAtRest(
    val hasLink: Boolean = false,
    val link: LinkHealth = LinkHealth(),
    val boardSilence: Double = Double.POSITIVE_INFINITY,
    val volts: Double? = null,
    val lowestVolts: Double? = null,
    val pose: PoseProblem? = null,
    val fixAgeSeconds: Double? = null,
    val accuracyMetres: Float? = null,
    val hasHeading: Boolean = false,
    val isVirtual: Boolean = false,
    val hasProbe: Boolean = true,
    val hasMission: Boolean = false,
    val metresToArea: Double? = null,
)

/** Looks at the phone. Touches the disk: not for the main thread. */
internal class Preflight(private val context: Context) {
    /** Charge of the phone, percent; null where it does not say. */
    val phoneBatteryPercent: Int?
        get() =
            context
                .getSystemService(BatteryManager::class.java)
                ?.getIntProperty(BatteryManager.BATTERY_PROPERTY_CAPACITY)
                ?.takeIf { it in 0..FULL_PERCENT }

    /** Room for a log, bytes. */
    val storage: Long
        get() {
            mayWait("the room on the disk")
            return context.filesDir.usableSpace
        }

    /** All checks, in their order. */
    fun look(boat: BoatAtRest): List<PreflightItem> =
        PreflightCheck.entries.map { check ->
            val reason =
                when (check) {
                    PreflightCheck.PERMISSIONS ->
                        PreflightReason.NOT_PERMITTED
                            .takeIf { !boat.isVirtual && missingPermissions(context).isNotEmpty() }
                    PreflightCheck.LINK -> link(boat)
                    // Not every board lets its probes speak before it is armed: silence is told, and refuses nothing.
                    PreflightCheck.PROBE -> null
                    PreflightCheck.FIX -> fix(boat)
                    PreflightCheck.PLACE -> place(boat)
                    PreflightCheck.BOAT_BATTERY -> boatBattery(boat)
                    PreflightCheck.PHONE_BATTERY -> phoneBattery()
                    PreflightCheck.STORAGE -> PreflightReason.LITTLE_ROOM.takeIf { storage < LEAST_STORAGE }
                    PreflightCheck.BATTERY_SAVER -> PreflightReason.NOT_EXEMPT.takeIf { !isExempt() && !boat.isVirtual }
                }
            val note = if (reason == null) note(check, boat) else null
            val speaksOfPlace = reason == PreflightReason.OTHER_WATER || note == PreflightNote.ON_THE_WAY
            PreflightItem(check, reason == null, reason, note, boat.metresToArea.takeIf { speaksOfPlace })
        }

    private fun note(check: PreflightCheck, boat: BoatAtRest): PreflightNote? =
        when {
            check == PreflightCheck.PLACE && (boat.metresToArea ?: 0.0) > 0 -> PreflightNote.ON_THE_WAY
            check == PreflightCheck.PROBE && !boat.hasProbe -> PreflightNote.PROBE_SILENT
            check != PreflightCheck.BOAT_BATTERY || boat.lowestVolts != 0.0 -> null
            boat.volts == null -> PreflightNote.NOT_REPORTED
            else -> PreflightNote.NOT_WATCHED
        }

    private fun link(boat: BoatAtRest): PreflightReason? =
        when {
            !boat.hasLink -> PreflightReason.NO_LINK
            boat.link.state != LinkState.CONNECTED -> PreflightReason.NOT_CONNECTED
            boat.boardSilence > LONGEST_SILENCE -> PreflightReason.BOARD_SILENT
            else -> null
        }

    private fun fix(boat: BoatAtRest): PreflightReason? {
        val age = boat.fixAgeSeconds
        val accuracy = boat.accuracyMetres
        return when {
            boat.pose == PoseProblem.NO_RECEIVER -> PreflightReason.NO_RECEIVER
            boat.pose == PoseProblem.NOT_PERMITTED -> PreflightReason.NOT_PERMITTED
            boat.pose == PoseProblem.SWITCHED_OFF -> PreflightReason.RECEIVER_OFF
            age == null -> PreflightReason.NO_FIX
            age > OLDEST_FIX -> PreflightReason.FIX_OLD
            !FixCheck.isNarrow(accuracy?.toDouble()) -> PreflightReason.FIX_WIDE
            !boat.hasHeading -> PreflightReason.NO_HEADING
            else -> null
        }
    }

    private fun place(boat: BoatAtRest): PreflightReason? {
        val metres = boat.metresToArea
        return when {
            !boat.hasMission -> null
            metres == null -> PreflightReason.NO_FIX
            metres > FARTHEST_WATER -> PreflightReason.OTHER_WATER
            else -> null
        }
    }

    /** Core's policy has 0 V where no voltage is measured: a boat without the wire for it is not kept ashore. */
    private fun boatBattery(boat: BoatAtRest): PreflightReason? {
        val volts = boat.volts
        val lowest = boat.lowestVolts
        return when {
            lowest == 0.0 -> null
            boat.hasMission && lowest == null -> PreflightReason.NOT_SAID
            volts == null -> PreflightReason.NOT_REPORTED
            lowest != null && volts < lowest -> PreflightReason.LOW_CHARGE
            else -> null
        }
    }

    private fun phoneBattery(): PreflightReason? {
        val percent = phoneBatteryPercent ?: return PreflightReason.UNKNOWN_CHARGE
        return PreflightReason.LOW_CHARGE.takeIf { percent < LEAST_BATTERY_PERCENT }
    }

    private fun isExempt(): Boolean =
        context.getSystemService(PowerManager::class.java)?.isIgnoringBatteryOptimizations(context.packageName) == true

    companion object {
        /** A receiver gives one fix a second; three missed ones are a gap. s. */
        const val OLDEST_FIX = 3.0

        /** From a car park to the jetty it may be so far, m; a mission of last week's lake is farther. */
        const val FARTHEST_WATER = 1_000.0

        /** A board at rest answers a question a second; three lost answers are a silence. s. */
        private const val LONGEST_SILENCE = 3.5
        private const val FULL_PERCENT = 100

        /** Two hours with the screen on, by the rule of thumb of 15 % an hour. */
        private const val LEAST_BATTERY_PERCENT = 30

        /** A log takes 17 MB an hour (LongMissionTest): three times what the battery that is asked for lasts. Bytes. */
        private const val LEAST_STORAGE = 100L * 1024 * 1024

        /** What Android asks the person for, on this version of it. */
        fun neededPermissions(): List<String> =
            buildList {
                add(Manifest.permission.ACCESS_FINE_LOCATION)
                if (Build.VERSION.SDK_INT >= Build.VERSION_CODES.S) add(Manifest.permission.BLUETOOTH_CONNECT)
                if (Build.VERSION.SDK_INT >= Build.VERSION_CODES.TIRAMISU) add(Manifest.permission.POST_NOTIFICATIONS)
            }

        /**
         * What to ask for: what is missing, and the coarse place with the fine one, without which some releases of
         * Android 12 ignore the request.
         */
        fun permissionsToAsk(context: Context): List<String> {
            val missing = missingPermissions(context)
            val isPlace = Manifest.permission.ACCESS_FINE_LOCATION in missing
            return if (isPlace) missing + Manifest.permission.ACCESS_COARSE_LOCATION else missing
        }

        /** Those of [neededPermissions] that are not given. */
        fun missingPermissions(context: Context): List<String> =
            neededPermissions().filter { context.checkSelfPermission(it) != PackageManager.PERMISSION_GRANTED }
    }
}
