package stillwater.app.service

import android.app.Notification
import android.app.NotificationChannel
import android.app.NotificationManager
import android.app.PendingIntent
import android.content.Context
import android.content.Intent
import stillwater.app.R
import stillwater.app.screen.MainActivity
import stillwater.app.screen.linkWords
import stillwater.app.screen.logWords
import stillwater.app.screen.missionWords
import stillwater.mission.MissionState

/** What stands in the notification shade while the service runs: the state, and a way to stop. */
internal class BoatNotification(private val context: Context) {
    /** Makes the channel; calling it again changes nothing. */
    fun makeChannel() {
        val name = context.getString(R.string.channel_boat)
        // Low: seen, and never heard.
        val channel = NotificationChannel(CHANNEL, name, NotificationManager.IMPORTANCE_LOW)
        context.getSystemService(NotificationManager::class.java)?.createNotificationChannel(channel)
    }

    /** The notification for [snapshot]. */
    fun of(snapshot: BoatSnapshot): Notification {
        val stop =
            PendingIntent.getService(context, 1, BoatService.stopIntent(context), PendingIntent.FLAG_IMMUTABLE)
        val text = context.linkWords(snapshot).orEmpty()
        val trouble =
            snapshot.mission?.log?.problem?.let { context.getString(R.string.notification_log, context.logWords(it)) }
        val blind = context.getString(R.string.notification_open).takeIf { snapshot.isWithoutPlace }
        return opening(title(snapshot))
            .setContentText(listOfNotNull(blind, text, trouble).joinToString(". "))
            .setOngoing(true)
            .setOnlyAlertOnce(true)
            .addAction(Notification.Action.Builder(null, context.getString(R.string.stop), stop).build())
            .build()
    }

    /** The notification that Android did not let the service run. */
    fun ofRefusal(): Notification =
        opening(context.getString(R.string.activity_refused))
            .setContentText(context.getString(R.string.notification_refused))
            .setAutoCancel(true)
            .build()

    /** One under [title] that opens the app. */
    private fun opening(title: String): Notification.Builder {
        val open =
            Intent(context, MainActivity::class.java).let {
                PendingIntent.getActivity(context, 0, it, PendingIntent.FLAG_IMMUTABLE)
            }
        return Notification
            .Builder(context, CHANNEL)
            .setSmallIcon(R.drawable.ic_boat)
            .setContentTitle(title)
            .setContentIntent(open)
            // On a locked phone, too: STOP is in it, and nothing that is nobody's business.
            .setVisibility(Notification.VISIBILITY_PUBLIC)
    }

    private fun title(snapshot: BoatSnapshot): String {
        val state = snapshot.mission?.state ?: MissionState.Idle
        return when {
            state != MissionState.Idle -> context.missionWords(state)
            snapshot.activity == BoatActivity.RECOVERED -> context.getString(R.string.activity_recovered)
            else -> context.getString(R.string.activity_standing_by)
        }
    }

    companion object {
        private const val CHANNEL = "boat"

        /** The service's notification; Android takes any number but 0. */
        const val ID = 1

        /** The one of a refusal: it stays when the service is gone. */
        const val REFUSED_ID = 2
    }
}
