package stillwater.app.service

import android.app.Notification
import android.app.NotificationManager
import android.app.Service
import android.content.Context
import android.content.Intent
import android.content.pm.ServiceInfo
import android.os.Binder
import android.os.Build
import android.os.Handler
import android.os.HandlerThread
import android.os.IBinder
import android.os.Looper
import android.os.PowerManager
import android.os.SystemClock
import android.util.Log
import stillwater.app.AboveMinSdk
import stillwater.app.link.BoardEars
import stillwater.app.link.BoardLink
import stillwater.app.link.LinkChoice
import stillwater.app.link.LinkHealth
import stillwater.app.link.LinkMaker
import stillwater.app.pose.PhonePose
import stillwater.model.Actuation
import stillwater.wire.Command
import stillwater.wire.PlatypusEncoder
import java.io.File

/**
 * Holds the link and the phone's position while the app is out of sight: in the foreground, with the processor awake.
 *
 * Started by the screen with a link; ended by the stop action alone. When Android ends the process, it starts the
 * service again without an intent: the link that was held is taken up again, and nothing moves. Everything that may
 * wait runs on a thread of the service's own; the main thread starts and asks.
 */
open class BoatService :
    Service(),
    BoatCommands {
    private lateinit var thread: HandlerThread
    private lateinit var handler: Handler
    private lateinit var pose: PhonePose
    private lateinit var preflight: Preflight
    private lateinit var notification: BoatNotification

    @Volatile private var wakeLock: PowerManager.WakeLock? = null
    private var link: BoardLink? = null
    private var ears = BoardEars()

    /** How many connections of [link] have begun with a board that was told to stand still. */
    private var disarmed = 0L

    @Volatile private var shown = BoatSnapshot()

    @Volatile private var activity = BoatActivity.IDLE

    @Volatile private var refusal: String? = null

    /** What the screens show; any thread. */
    val snapshot: BoatSnapshot get() = shown

    /** The thread that does everything which may wait. */
    internal val boatLooper: Looper get() = thread.looper

    /** Gives the screens of this process the service itself. */
    inner class Local : Binder() {
        val service: BoatService get() = this@BoatService
    }

    override fun onBind(intent: Intent?): IBinder = Local()

    override fun onCreate() {
        super.onCreate()
        thread = HandlerThread("boat").apply { start() }
        handler = Handler(thread.looper)
        pose = PhonePose(this)
        preflight = Preflight(this)
        notification = BoatNotification(this)
        notification.makeChannel()
        handler.post(refresh)
    }

    override fun onStartCommand(intent: Intent?, flags: Int, startId: Int): Int {
        if (intent?.action == STOP) {
            stopBoat()
            return START_NOT_STICKY
        }
        // Android ends an app that does not say so within seconds, whatever comes after.
        activity = if (intent == null) BoatActivity.RECOVERED else BoatActivity.STANDING_BY
        if (!enterForeground(BoatSnapshot(activity))) return START_NOT_STICKY
        refusal = null
        handler.post { begin(intent?.let(LinkChoice::of)) }
        return START_STICKY
    }

    override fun onDestroy() {
        handler.post {
            handler.removeCallbacks(refresh)
            link?.close()
            pose.stop()
            thread.quitSafely()
        }
        wakeLock?.takeIf { it.isHeld }?.release()
        super.onDestroy()
    }

    private fun enterForeground(first: BoatSnapshot): Boolean =
        try {
            foreground(notification.of(first))
            true
        } catch (error: IllegalStateException) {
            // From Android 12 on: started from where no foreground service may be started.
            refused(error)
        } catch (error: SecurityException) {
            // From Android 14 on: a permission that one of the types asks for is missing.
            refused(error)
        }

    /** What Android may refuse, and a test's service does. */
    internal open fun foreground(shown: Notification) {
        if (Build.VERSION.SDK_INT >= Build.VERSION_CODES.Q) {
            typedForeground(shown)
        } else {
            startForeground(BoatNotification.ID, shown)
        }
    }

    @AboveMinSdk
    private fun typedForeground(shown: Notification) {
        val types =
            ServiceInfo.FOREGROUND_SERVICE_TYPE_CONNECTED_DEVICE or ServiceInfo.FOREGROUND_SERVICE_TYPE_LOCATION
        startForeground(BoatNotification.ID, shown, types)
    }

    private fun refused(error: Exception): Boolean {
        Log.w("Stillwater", "not in the foreground: $error")
        activity = BoatActivity.REFUSED
        refusal = error.message ?: error.javaClass.simpleName
        stopSelf()
        return false
    }

    /** On the boat thread. [asked] is null where the service was started again without an intent. */
    private fun begin(asked: LinkChoice?) {
        handler.removeCallbacks(letGo)
        val kept = getSharedPreferences(KEPT, Context.MODE_PRIVATE)
        val choice = asked ?: LinkChoice.kept(kept)
        if (choice == null) {
            // Nothing was held when the process ended, so there is nothing to take up.
            stopBoat()
            return
        }
        LinkChoice.keep(kept, choice)
        keepAwake()
        link?.close()
        ears = BoardEars()
        disarmed = 0
        link = links.make(this, choice).also { it.open() }
        pose.stop()
        pose.start(handler)
        look()
    }

    override fun load(json: String) = Unit

    override fun arm() = Unit

    override fun start() = Unit

    override fun hold() = Unit

    override fun goHome() = Unit

    override fun stop() = Unit

    override fun newMission() = Unit

    override fun lookForPast() = Unit

    /** The file of the past mission [name]; may not be there any more. */
    fun logOf(name: String): File = File(File(filesDir, "missions"), name)

    private fun keepAwake() {
        if (wakeLock != null) return
        val power = getSystemService(PowerManager::class.java) ?: return
        // Without a time limit: the mission has one, and stopping releases it.
        wakeLock = power.newWakeLock(PowerManager.PARTIAL_WAKE_LOCK, "stillwater:boat").apply { acquire() }
    }

    private fun look() {
        link?.let(ears::listen)
        val health = link?.health ?: LinkHealth()
        // Whatever a board was told before this connection, by a process that died perhaps: it is over.
        if (health.connects != disarmed) link?.let(::standStill)
        disarmed = health.connects
        val fix = pose.fix
        val age = fix?.let { (SystemClock.elapsedRealtimeNanos() - it.elapsedNanos) * SECONDS_PER_NANO }
        val before = shown
        shown =
            BoatSnapshot(
                activity = activity,
                linkName = link?.name,
                link = health,
                board = ears.report,
                refusal = refusal,
                fix = fix,
                fixAgeSeconds = age,
                headingDeg = pose.headingDeg,
                preflight = preflight.look(BoatAtRest(link != null, health, fixAgeSeconds = age, accuracyMetres = fix?.accuracyMetres)),
            )
        if (link != null && (before.link.state != health.state || before.linkName != shown.linkName)) {
            getSystemService(NotificationManager::class.java)?.notify(BoatNotification.ID, notification.of(shown))
        }
    }

    private val refresh: Runnable =
        object : Runnable {
            override fun run() {
                look()
                handler.postDelayed(this, REFRESH_MILLIS)
            }
        }

    /** Motors off, then disarmed; the link closes once both had the time to go out. */
    private fun stopBoat() {
        handler.post {
            activity = BoatActivity.IDLE
            LinkChoice.keep(getSharedPreferences(KEPT, Context.MODE_PRIVATE), null)
            link?.let(::standStill)
            handler.postDelayed(letGo, LAST_WORDS_MILLIS)
        }
    }

    private fun standStill(link: BoardLink) {
        link.write(PlatypusEncoder.encode(Command.Move(Actuation.Differential(0.0, 0.0))))
        link.write(PlatypusEncoder.encode(Command.Disarm))
    }

    /** On the boat thread. A start that comes before it is not undone: it takes this away. */
    private val letGo: Runnable =
        Runnable {
            link?.close()
            link = null
            pose.stop()
            look()
            wakeLock?.takeIf { it.isHeld }?.release()
            wakeLock = null
            stopForeground(STOP_FOREGROUND_REMOVE)
            stopSelf()
        }

    companion object {
        private const val STOP = "stillwater.app.STOP"
        private const val KEPT = "held-link"
        private const val REFRESH_MILLIS = 500L

        /** Longer than two lines take at 115200 baud by far, and than a board waits for the next command. */
        private const val LAST_WORDS_MILLIS = 300L
        private const val SECONDS_PER_NANO = 1e-9

        /** How links are made. */
        @Volatile internal var links: LinkMaker = LinkMaker.REAL

        /** Starts the service with [choice], or hands a running one that link instead. */
        fun startIntent(context: Context, choice: LinkChoice): Intent =
            LinkChoice.put(Intent(context, BoatService::class.java), choice)

        /** Ends what the service does. */
        fun stopIntent(context: Context): Intent = Intent(context, BoatService::class.java).setAction(STOP)
    }
}
