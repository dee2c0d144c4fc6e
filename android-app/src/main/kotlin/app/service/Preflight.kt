package stillwater.app.service

import android.Manifest
import android.content.Context
import android.content.pm.PackageManager
import android.os.BatteryManager
import android.os.Build
import android.os.PowerManager
import stillwater.app.link.LinkHealth
import stillwater.app.link.LinkState

/** One line of the checklist before a start; all have to be [ready]. */
data class PreflightItem(val check: PreflightCheck, val ready: Boolean)

/** What is looked at before a start. */
enum class PreflightCheck {
    PERMISSIONS,
    LINK,
    FIX,
    PHONE_BATTERY,
    STORAGE,
    BATTERY_SAVER,
}

/** Looks at the phone. Touches the disk: not for the main thread. */
internal class Preflight(private val context: Context) {
    /** All checks, in their order. [fixAgeSeconds] and [accuracyMetres] are those of the newest fix, null without. */
    fun look(link: LinkHealth, fixAgeSeconds: Double?, accuracyMetres: Float?): List<PreflightItem> =
        PreflightCheck.entries.map { check ->
            val ready =
                when (check) {
                    PreflightCheck.PERMISSIONS -> missingPermissions(context).isEmpty()
                    PreflightCheck.LINK -> link.state == LinkState.CONNECTED
                    PreflightCheck.FIX ->
                        fixAgeSeconds != null && fixAgeSeconds <= OLDEST_FIX &&
                            accuracyMetres != null && accuracyMetres <= WORST_ACCURACY
                    PreflightCheck.PHONE_BATTERY -> batteryPercent() >= LEAST_BATTERY_PERCENT
                    PreflightCheck.STORAGE -> context.filesDir.usableSpace >= LEAST_STORAGE
                    PreflightCheck.BATTERY_SAVER -> isExempt()
                }
            PreflightItem(check, ready)
        }

    private fun batteryPercent(): Int =
        context.getSystemService(BatteryManager::class.java)?.getIntProperty(BatteryManager.BATTERY_PROPERTY_CAPACITY)
            ?: 0

    private fun isExempt(): Boolean =
        context.getSystemService(PowerManager::class.java)?.isIgnoringBatteryOptimizations(context.packageName) == true

    companion object {
        /** A receiver gives one fix a second; three missed ones are a gap. s. */
        private const val OLDEST_FIX = 3.0

        /** Wider than a lawnmower's lane on a pond, a fix is no use. m. */
        private const val WORST_ACCURACY = 10f

        /** Two hours with the screen on, by the rule of thumb of 15 % an hour. */
        private const val LEAST_BATTERY_PERCENT = 30

        /** Many times what a day's log takes, bytes. */
        private const val LEAST_STORAGE = 100L * 1024 * 1024

        /** What Android asks the person for, on this version of it. */
        fun neededPermissions(): List<String> =
            buildList {
                add(Manifest.permission.ACCESS_FINE_LOCATION)
                if (Build.VERSION.SDK_INT >= Build.VERSION_CODES.S) add(Manifest.permission.BLUETOOTH_CONNECT)
                if (Build.VERSION.SDK_INT >= Build.VERSION_CODES.TIRAMISU) add(Manifest.permission.POST_NOTIFICATIONS)
            }

        /** Those of [neededPermissions] that are not given. */
        fun missingPermissions(context: Context): List<String> =
            neededPermissions().filter { context.checkSelfPermission(it) != PackageManager.PERMISSION_GRANTED }
    }
}
