package stillwater.app.service

import android.app.Notification
import android.app.NotificationManager
import android.app.Service
import android.content.Context
import android.content.Intent
import android.content.SharedPreferences
import android.content.pm.ServiceInfo
import android.os.Build
import android.os.Handler
import android.os.HandlerThread
import android.os.IBinder
import android.os.Looper
import android.os.PowerManager
import android.os.SystemClock
import android.util.Log
import stillwater.app.AboveMinSdk
import stillwater.app.link.LinkChoice
import stillwater.app.link.LinkMaker
import stillwater.app.mayWait
import stillwater.app.mission.Disk
import stillwater.app.mission.FileOutput
import stillwater.app.mission.Keeper
import stillwater.app.mission.LogFolder
import stillwater.app.mission.LogOpener
import stillwater.app.mission.MissionControl
import stillwater.mission.Wish
import java.io.File

/**
 * Keeps boat and mission going while the app is out of sight: in the foreground, with the processor awake.
 *
 * Started by the screen with a link; ended by the stop action. When Android ends the process, it starts the service again
 * without an intent: the link that was held is taken up again, the mission is read back from its log, and nothing moves.
 * Everything that may wait runs on threads of the service's own; the main thread starts and asks.
 */
open class BoatService :
    Service(),
    BoatCommands {
    private lateinit var thread: HandlerThread
    private lateinit var handler: Handler
    private lateinit var diskThread: HandlerThread
    private lateinit var loop: BoatLoop
    private lateinit var notification: BoatNotification

    /** Whether Android took the service into the foreground without giving it the phone's position; main thread. */
    private var isWithoutPlace = false

    /** How often a window in sight has asked for the position; main thread. */
    private var asked = 0

    /** Whether a window shows what the service does; main thread. */
    private var isInSight = false

    /** When STOP last ended a mission, ms; on the boat thread. */
    private var endedAt = Long.MIN_VALUE / 2

    @Volatile private var wakeLock: PowerManager.WakeLock? = null

    override val snapshot: BoatSnapshot get() = loop.snapshot

    /** The thread of link, pose and mission. */
    internal val boatLooper: Looper get() = thread.looper

    /** The thread of files. */
    internal val diskLooper: Looper get() = diskThread.looper

    /** Readings that the demo's probe has sent, by its own count; null where there is no demo. */
    internal val demoReadings: Long? get() = loop.demoReadings

    /** The thread that looks after the boat's. */
    internal val watchdogLooper: Looper get() = loop.watchdogLooper

    /** Gives the screens of this process the service itself. */
    inner class Local : BoatBinder(this@BoatService) {
        val service: BoatService get() = this@BoatService
    }

    override fun onBind(intent: Intent?): IBinder {
        lookedAt()
        return Local()
    }

    override fun onRebind(intent: Intent?) = lookedAt()

    private fun lookedAt() {
        isInSight = true
        asked = 0
        askForPlace()
        onBoat { isLookedAt = true }
    }

    /** While a window is in sight Android does not refuse what it refused in the background, if perhaps not at once. */
    private fun askForPlace() {
        if (!isWithoutPlace || !isInSight) return
        try {
            // Up to Android 13 what counts is whether the last start came from an app in sight: this one does.
            if (BackgroundPlace.isKeptBackInSilence) startService(Intent(this, BoatService::class.java).setAction(SEEN))
            // Of those that do not refuse nobody hears whether the window was in sight already: once more, to be sure.
            val isSure = !BackgroundPlace.isKeptBackInSilence || asked++ > 0
            enter(snapshot, ServiceInfo.FOREGROUND_SERVICE_TYPE_LOCATION, isKeptBack = !isSure)
        } catch (error: IllegalStateException) {
            // All stays as it was.
            Log.w(TAG, "no position yet: $error")
        }
        onBoat { listenAfresh() }
        if (isWithoutPlace) Handler(Looper.getMainLooper()).postDelayed(::askForPlace, ASK_AGAIN_MILLIS)
    }

    override fun onUnbind(intent: Intent?): Boolean {
        isInSight = false
        onBoat { isLookedAt = false }
        return true
    }

    override fun onCreate() {
        super.onCreate()
        thread = HandlerThread("boat").apply { start() }
        handler = Handler(thread.looper)
        diskThread = HandlerThread("disk").apply { start() }
        notification = BoatNotification(this)
        notification.makeChannel()
        val missions =
            MissionControl(
                LogFolder({ logOf(this, "") }, logs),
                HandlerDisk(Handler(diskThread.looper), handler),
                KeptMission(this),
                System::currentTimeMillis,
            )
        loop = BoatLoop(this, handler, missions, ::notifyOfChange)
        handler.post { loop.start() }
    }

    override fun onStartCommand(intent: Intent?, flags: Int, startId: Int): Int {
        if (intent?.action == STOP) {
            stopBoat()
            // A link that stays, because a mission was under way, is taken up again after the process died.
            return START_STICKY
        }
        // Sent for what Android makes of where it comes from.
        if (intent?.action == SEEN) return START_STICKY
        // Android ends an app that does not say so within seconds, whatever comes after.
        loop.activity = if (intent == null) BoatActivity.RECOVERED else BoatActivity.STANDING_BY
        val asked = intent?.let(LinkChoice::of)
        val isKeptBack = intent == null && !isInSight && BackgroundPlace.isKeptBackInSilence
        if (!enterForeground(BoatSnapshot(loop.activity), asked is LinkChoice.Demo, isKeptBack)) return START_NOT_STICKY
        loop.refusal = null
        getSystemService(NotificationManager::class.java)?.cancel(BoatNotification.REFUSED_ID)
        handler.post { begin(asked) }
        return START_STICKY
    }

    override fun onDestroy() {
        handler.post {
            loop.leave()
            diskThread.quitSafely()
            thread.quitSafely()
        }
        wakeLock?.takeIf { it.isHeld }?.release()
        super.onDestroy()
    }

    override fun load(json: String) = onBoat { load(json) }

    override fun arm() = onBoat { begin(Wish.WAIT) }

    override fun start() = onBoat { begin(Wish.GO_ON) }

    override fun hold() = onBoat { command { tell(Wish.HOLD) } }

    override fun goHome() = onBoat { command { tell(Wish.RETURN) } }

    override fun stop() = onBoat { stop() }

    override fun goOnWith(name: String) = onBoat { goOnWith(name) }

    override fun newMission() = onBoat { command { clear() } }

    override fun lookForPast() =
        onBoat {
            command {
                lookForPast()
                null
            }
        }

    private fun onBoat(work: BoatLoop.() -> Unit) {
        handler.post { loop.work() }
    }

    /**
     * Whether the service may go on; [isDemo], which nobody trusts a boat to, does without the foreground.
     *
     * @param isKeptBack whether Android gives no positions though it does not say so.
     */
    private fun enterForeground(first: BoatSnapshot, isDemo: Boolean, isKeptBack: Boolean): Boolean =
        try {
            // From Android 14 on the position is refused to a service that Android itself starts again, after the
            // process died: the link and the log go on, and the position comes once a window is in sight.
            val error = enter(first, ServiceInfo.FOREGROUND_SERVICE_TYPE_LOCATION, isKeptBack)
            error == null || isDemo || enter(first, LINK_ONLY) == null || refused(error)
        } catch (error: IllegalStateException) {
            // From Android 12 on: started from where no foreground service may be started.
            refused(error)
        }

    /** Enters the foreground for the link and for [more]; answers what a missing permission has against it. */
    private fun enter(shown: BoatSnapshot, more: Int, isKeptBack: Boolean = false): SecurityException? =
        try {
            val isBlind = isKeptBack || more == LINK_ONLY
            foreground(notification.of(shown.copy(isWithoutPlace = isBlind)), more)
            isWithoutPlace = isBlind
            loop.isWithoutPlace = isBlind
            null
        } catch (error: SecurityException) {
            Log.w(TAG, "not in the foreground as $more: $error")
            error
        }

    /** What Android may refuse, and a test's service does: for the link, and for [more]. */
    internal open fun foreground(shown: Notification, more: Int) {
        if (Build.VERSION.SDK_INT >= Build.VERSION_CODES.Q) {
            typedForeground(shown, more)
        } else {
            startForeground(BoatNotification.ID, shown)
        }
    }

    @AboveMinSdk
    private fun typedForeground(shown: Notification, more: Int) =
        startForeground(BoatNotification.ID, shown, ServiceInfo.FOREGROUND_SERVICE_TYPE_CONNECTED_DEVICE or more)

    private fun refused(error: Exception): Boolean {
        loop.activity = BoatActivity.REFUSED
        loop.refusal = error.message ?: error.javaClass.simpleName
        // Nobody may be looking, and what is not in the foreground has no notification of its own.
        getSystemService(NotificationManager::class.java)?.notify(BoatNotification.REFUSED_ID, notification.ofRefusal())
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
        if (asked != null && loop.isOtherWorld(asked)) {
            // A board must not be armed by what a virtual one was, nor left alone on the water.
            loop.command { Answer(Answer.Reason.UNDER_WAY) }
            return
        }
        LinkChoice.keep(kept, choice)
        keepAwake()
        loop.hold(choice, links)
    }

    private fun keepAwake() {
        if (wakeLock != null) return
        val power = getSystemService(PowerManager::class.java) ?: return
        // Without a time limit: the mission has one, and stopping releases it.
        wakeLock = power.newWakeLock(PowerManager.PARTIAL_WAKE_LOCK, "stillwater:boat").apply { acquire() }
    }

    /** On the boat thread. */
    private fun notifyOfChange() {
        getSystemService(NotificationManager::class.java)?.notify(BoatNotification.ID, notification.of(snapshot))
    }

    /**
     * Motors off, then disarmed. A mission that was under way goes on being told so over the link, which stays; without
     * one the link closes once both had the time to go out, and the service ends.
     */
    private fun stopBoat() {
        handler.post {
            val now = SystemClock.uptimeMillis()
            if (loop.stop()) {
                endedAt = now
                return@post
            }
            // The second of two taps, or the same one from the notification: meant for the mission that is over.
            if (now - endedAt < SAME_STOP_MILLIS) return@post
            loop.activity = BoatActivity.IDLE
            loop.isGivingUp = true
            LinkChoice.keep(getSharedPreferences(KEPT, Context.MODE_PRIVATE), null)
            handler.postDelayed(letGo, LAST_WORDS_MILLIS)
        }
    }

    /** On the boat thread. A start that comes before it is not undone: it takes this away. */
    private val letGo: Runnable =
        Runnable {
            loop.letGo()
            wakeLock?.takeIf { it.isHeld }?.release()
            wakeLock = null
            stopForeground(STOP_FOREGROUND_REMOVE)
            stopSelf()
        }

    companion object {
        private const val TAG = "Stillwater"
        private const val LINK_ONLY = 0
        private const val ASK_AGAIN_MILLIS = 1_000L
        private const val STOP = "stillwater.app.STOP"
        private const val SEEN = "stillwater.app.SEEN"
        private const val KEPT = "held-link"
        private const val LOGS = "missions"

        /** Longer than two lines take at 115200 baud by far, and than a board waits for the next command. */
        private const val LAST_WORDS_MILLIS = 300L

        /** A board says within a second or so that it is disarmed; a hand in a glove presses twice. */
        private const val SAME_STOP_MILLIS = 2_000L

        /** How links are made. */
        @Volatile internal var links: LinkMaker = LinkMaker.REAL

        /** How logs are opened. */
        @Volatile internal var logs: LogOpener = LogOpener(::FileOutput)

        /** The file of the past mission [name]; may not be there any more. Touches the disk. */
        fun logOf(context: Context, name: String): File {
            mayWait("the app's folder")
            return File(File(context.filesDir, LOGS), name)
        }

        /** Starts the service with [choice], or hands a running one that link instead. */
        fun startIntent(context: Context, choice: LinkChoice): Intent =
            LinkChoice.put(Intent(context, BoatService::class.java), choice)

        /** Ends the mission that is under way; without one, what the service does. */
        fun stopIntent(context: Context): Intent = Intent(context, BoatService::class.java).setAction(STOP)
    }
}

/** Files are worked on where [disk] is, and what comes of it goes to [boat]. */
private class HandlerDisk(private val disk: Handler, private val boat: Handler) : Disk {
    override fun run(work: () -> Unit) {
        disk.post(work)
    }

    override fun answer(work: () -> Unit) {
        boat.post(work)
    }
}

/** On the boat thread; on the disk before anything moves, for what comes next may be the process's death. */
private class KeptMission(private val context: Context) : Keeper {
    private val kept: SharedPreferences
        get() {
            mayWait("preferences")
            return context.getSharedPreferences("kept-mission", Context.MODE_PRIVATE)
        }

    override var mission: String?
        get() = kept.getString(JSON, null)
        set(value) {
            kept.edit().putString(JSON, value).commit()
        }

    private companion object {
        const val JSON = "json"
    }
}
