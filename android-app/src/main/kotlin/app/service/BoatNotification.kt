package stillwater.app.service

import android.app.Notification
import android.app.NotificationChannel
import android.app.NotificationManager
import android.app.PendingIntent
import android.content.Context
import android.content.Intent
import stillwater.app.R
import stillwater.app.screen.MainActivity
import stillwater.app.screen.words

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
        val open =
            Intent(context, MainActivity::class.java).let {
                PendingIntent.getActivity(context, 0, it, PendingIntent.FLAG_IMMUTABLE)
            }
        val stop =
            PendingIntent.getService(context, 1, BoatService.stopIntent(context), PendingIntent.FLAG_IMMUTABLE)
        val title =
            when (snapshot.activity) {
                BoatActivity.RECOVERED -> R.string.activity_recovered
                else -> R.string.activity_standing_by
            }
        val link = context.getString(snapshot.link.state.words())
        val text = context.getString(R.string.notification_link, snapshot.linkName.orEmpty(), link)
        return Notification
            .Builder(context, CHANNEL)
            .setSmallIcon(R.drawable.ic_boat)
            .setContentTitle(context.getString(title))
            .setContentText(text)
            .setContentIntent(open)
            .setOngoing(true)
            .setOnlyAlertOnce(true)
            .addAction(Notification.Action.Builder(null, context.getString(R.string.stop), stop).build())
            .build()
    }

    companion object {
        private const val CHANNEL = "boat"

        /** The service's notification; Android takes any number but 0. */
        const val ID = 1
    }
}
