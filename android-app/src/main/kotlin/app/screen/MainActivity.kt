package stillwater.app.screen

import android.app.Activity
import android.content.ActivityNotFoundException
import android.content.ComponentName
import android.content.Context
import android.content.Intent
import android.content.ServiceConnection
import android.content.pm.PackageManager
import android.net.Uri
import android.os.Bundle
import android.os.Handler
import android.os.IBinder
import android.os.Looper
import android.provider.Settings
import stillwater.app.R
import stillwater.app.link.LinkChoice
import stillwater.app.service.BoatBinder
import stillwater.app.service.BoatCommands
import stillwater.app.service.BoatService
import stillwater.app.service.BoatSnapshot
import stillwater.app.service.Preflight
import stillwater.app.setup.AreaPen
import stillwater.app.setup.AreaScreen
import stillwater.app.setup.DraftDesk
import stillwater.app.setup.DraftFile
import stillwater.app.setup.PenTarget
import stillwater.app.setup.SetupScreen
import stillwater.mission.MissionDraft
import stillwater.mission.MissionSpec

/**
 * The one window: a screen in the middle, the way to the others and the boat's state above it, STOP below it whatever
 * the screen.
 *
 * It holds nothing that matters: it looks at the service twice a second while it is in sight, and may be turned, left
 * or swiped away at any time. What is being filled in is kept in its state and in a file.
 */
internal class MainActivity :
    Activity(),
    ScreenHost {
    private lateinit var frame: WindowFrame
    private lateinit var documents: Documents
    private lateinit var drafts: DraftFile
    override lateinit var desk: DraftDesk
        private set
    private val screens = mutableMapOf<ScreenName, Screen>()
    private val trail = ArrayList<ScreenName>()
    private val main = Handler(Looper.getMainLooper())
    override var boat: BoatCommands? = null
        private set
    override var isRefusedForGood = false
        private set
    private var pen = AreaPen()

    private val connection =
        object : ServiceConnection {
            override fun onServiceConnected(name: ComponentName?, binder: IBinder?) {
                boat = (binder as? BoatBinder)?.boat
                show()
            }

            override fun onServiceDisconnected(name: ComponentName?) {
                boat = null
            }
        }

    override fun onCreate(savedInstanceState: Bundle?) {
        super.onCreate(savedInstanceState)
        drafts = DraftFile(this)
        val kept = savedInstanceState?.getString(DRAFT)
        desk = DraftDesk(kept?.let(MissionDraft::fromJson) ?: MissionDraft())
        if (kept == null) drafts.read { old -> desk.change { if (it == MissionDraft()) old else it } }
        desk.onChange = ::draftChanged
        documents = Documents(this, desk, ::tell)
        frame = WindowFrame(this, onMenu = ::toggleMenu, onStop = ::stop)
        setContentView(frame.view)
        restore(savedInstanceState)
        present()
    }

    private fun restore(state: Bundle?) {
        isRefusedForGood = state?.getBoolean(REFUSED) == true
        state?.getIntArray(PEN)?.let { pen = AreaPen(PenTarget.entries[it[0]], it[1]) }
        documents.restore(state)
        val names = state?.getStringArrayList(TRAIL).orEmpty()
        trail += names.mapNotNull { name -> ScreenName.entries.find { it.name == name } }
        if (trail.isEmpty()) trail += ScreenName.MAP
        // All of them, so that each finds its own state again.
        trail.forEach(::screen)
    }

    override fun onSaveInstanceState(state: Bundle) {
        super.onSaveInstanceState(state)
        state.putStringArrayList(TRAIL, ArrayList(trail.map { it.name }))
        state.putBoolean(REFUSED, isRefusedForGood)
        state.putIntArray(PEN, intArrayOf(pen.target.ordinal, pen.ring))
        documents.save(state)
        val json = desk.draft.toJson()
        // Android takes a megabyte for all apps' states together; a longer draft is in the file.
        if (json.length < MOST_STATE) state.putString(DRAFT, json)
    }

    override fun onStart() {
        super.onStart()
        bindService(Intent(this, BoatService::class.java), connection, Context.BIND_AUTO_CREATE)
        // A boat may have been paired in Android's settings meanwhile.
        if (trail.last() == ScreenName.LINK) screens[ScreenName.LINK]?.opened()
        main.post(refresh)
    }

    override fun onStop() {
        main.removeCallbacks(refresh)
        unbindService(connection)
        boat = null
        drafts.write(desk.draft)
        super.onStop()
    }

    override fun onDestroy() {
        desk.onChange = {}
        super.onDestroy()
    }

    @Deprecated("The call that replaces it is Android 13's.")
    @Suppress("DEPRECATION")
    override fun onBackPressed() {
        if (trail.size > 1) back() else super.onBackPressed()
    }

    override fun onRequestPermissionsResult(code: Int, permissions: Array<String>, results: IntArray) {
        super.onRequestPermissionsResult(code, permissions, results)
        // Refused, and Android would not even say why it is asked: it will not ask again.
        isRefusedForGood =
            permissions.indices.any {
                results[it] != PackageManager.PERMISSION_GRANTED &&
                    !shouldShowRequestPermissionRationale(permissions[it])
            }
        show()
    }

    @Deprecated("The call that replaces it is androidx's.")
    public override fun onActivityResult(code: Int, result: Int, data: Intent?) {
        val purpose = DocumentPurpose.entries.getOrNull(code) ?: return
        documents.chosen(purpose, data?.data?.takeIf { result == RESULT_OK })
    }

    override fun open(name: ScreenName) {
        // The menu is a fork, not a place to go back to; and a screen is on the way back once.
        trail.remove(ScreenName.MENU)
        trail.remove(name)
        trail += name
        present()
    }

    override fun back() {
        if (trail.size > 1) trail.removeAt(trail.lastIndex)
        present()
    }

    private fun toggleMenu() = if (trail.last() == ScreenName.MENU) back() else open(ScreenName.MENU)

    private fun present() {
        val now = screen(trail.last())
        frame.present(getString(trail.last().title), now.view)
        now.opened()
        show()
    }

    private fun screen(name: ScreenName): Screen =
        screens.getOrPut(name) {
            when (name) {
                ScreenName.MAP -> MapScreen(this)
                ScreenName.TRACE -> TraceScreen(this)
                ScreenName.START -> StartScreen(this, this)
                ScreenName.MISSION -> SetupScreen(this, this, ::use)
                ScreenName.AREA -> AreaScreen(this, this, pen) { pen = it }
                ScreenName.LINK -> LinkScreen(this, this)
                ScreenName.PAST -> PastScreen(this, this, documents)
                ScreenName.MENU -> MenuScreen(this, ::open)
            }.also { frame.add(it.view) }
        }

    private fun draftChanged() {
        (screens[ScreenName.MISSION] as? SetupScreen)?.refresh()
        if (trail.last() == ScreenName.AREA) screens[ScreenName.AREA]?.opened()
    }

    private fun tell(words: String, purpose: DocumentPurpose) {
        when (purpose) {
            DocumentPurpose.MISSION, DocumentPurpose.PROBE, DocumentPurpose.SAVED_MISSION ->
                (screens[ScreenName.MISSION] as? SetupScreen)?.say(words)
            DocumentPurpose.LOG, DocumentPurpose.CSV, DocumentPurpose.GEOJSON ->
                (screens[ScreenName.PAST] as? PastScreen)?.say(words)
        }
    }

    private fun use(spec: MissionSpec) {
        boat?.load(spec.toJson())
        open(ScreenName.START)
    }

    override fun connect(choice: LinkChoice) {
        // Not as a foreground service from here: Android ends the app where one that was started so is then refused the
        // foreground, as without its permissions from Android 14 on. While the window is in sight it need not be.
        startService(BoatService.startIntent(this, choice))
    }

    private fun stop() {
        // A service that is bound only is told the same way: it has nothing to end and says so.
        startService(BoatService.stopIntent(this))
    }

    override fun allow() {
        if (isRefusedForGood) {
            leave(Intent(Settings.ACTION_APPLICATION_DETAILS_SETTINGS, ownUri()))
        } else {
            // Given a moment ago: Android does not take a request for nothing.
            val asked = Preflight.permissionsToAsk(this)
            if (asked.isNotEmpty()) requestPermissions(asked.toTypedArray(), PERMISSIONS)
        }
    }

    override fun exempt() = leave(Intent(Settings.ACTION_REQUEST_IGNORE_BATTERY_OPTIMIZATIONS, ownUri()))

    override fun leave(intent: Intent) {
        try {
            startActivity(intent)
        } catch (_: ActivityNotFoundException) {
            frame.tell(getString(R.string.no_such_screen))
        }
    }

    @Suppress("DEPRECATION") // the call that replaces it is androidx's
    override fun choose(intent: Intent, purpose: DocumentPurpose) {
        try {
            startActivityForResult(intent, purpose.ordinal)
        } catch (_: ActivityNotFoundException) {
            tell(getString(R.string.no_documents), purpose)
        }
    }

    private fun ownUri(): Uri = Uri.fromParts("package", packageName, null)

    private val refresh: Runnable =
        object : Runnable {
            override fun run() {
                show()
                main.postDelayed(this, REFRESH_MILLIS)
            }
        }

    private fun show() = show(boat?.snapshot ?: BoatSnapshot())

    /** Shows [snapshot] until the next look at the service. */
    internal fun show(snapshot: BoatSnapshot) {
        frame.show(snapshot)
        screens[trail.last()]?.show(snapshot)
    }

    private companion object {
        /** Beyond every purpose of a document. */
        const val PERMISSIONS = 100
        const val REFRESH_MILLIS = 500L
        const val MOST_STATE = 100_000
        const val TRAIL = "trail"
        const val PEN = "pen"
        const val REFUSED = "refused-for-good"
        const val DRAFT = "draft"
    }
}
