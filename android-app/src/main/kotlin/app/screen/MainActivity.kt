package stillwater.app.screen

import android.app.Activity
import android.content.ComponentName
import android.content.Context
import android.content.Intent
import android.content.ServiceConnection
import android.content.pm.PackageManager
import android.content.res.ColorStateList
import android.net.Uri
import android.os.Bundle
import android.os.Handler
import android.os.IBinder
import android.os.Looper
import android.provider.Settings
import android.view.View
import android.widget.Button
import android.widget.FrameLayout
import android.widget.LinearLayout
import stillwater.app.R
import stillwater.app.link.LinkChoice
import stillwater.app.service.BoatService
import stillwater.app.service.BoatSnapshot
import stillwater.app.service.Preflight

/**
 * The one window: a screen in the middle, the way to the others above it, STOP below it whatever the screen.
 *
 * It holds nothing that matters: it looks at the service twice a second while it is in sight, and may be turned, left
 * or swiped away at any time.
 */
class MainActivity : Activity() {
    private lateinit var map: MapView
    private lateinit var mapScreen: View
    private lateinit var link: LinkScreen
    private val tabs = mutableListOf<Pair<Button, View>>()
    private val main = Handler(Looper.getMainLooper())
    private var service: BoatService? = null
    private var refusedForGood = false

    private val connection =
        object : ServiceConnection {
            override fun onServiceConnected(name: ComponentName?, binder: IBinder?) {
                service = (binder as? BoatService.Local)?.service
                show()
            }

            override fun onServiceDisconnected(name: ComponentName?) {
                service = null
            }
        }

    override fun onCreate(savedInstanceState: Bundle?) {
        super.onCreate(savedInstanceState)
        map = MapView(this).apply { id = R.id.map }
        val words = line("").apply { id = R.id.map_words }
        val gap = resources.getDimensionPixelSize(R.dimen.gap)
        words.setPadding(gap, 0, gap, gap)
        map.onCell = { words.text = it }
        mapScreen =
            column().apply {
                below(map, weight = 1f)
                below(words)
            }
        link = LinkScreen(this, ::connect, ::allow, ::exempt)
        val screens = FrameLayout(this).apply { listOf(mapScreen, link).forEach(::addView) }
        val tabRow = LinearLayout(this)
        for ((tab, screen) in listOf(R.id.tab_map to mapScreen, R.id.tab_link to link)) {
            val name = getString(if (tab == R.id.tab_map) R.string.tab_map else R.string.tab_link)
            val button = largeButton(name) { open(screen) }.apply { id = tab }
            tabs += button to screen
            tabRow.addView(button, LinearLayout.LayoutParams(0, LinearLayout.LayoutParams.WRAP_CONTENT, 1f))
        }
        val all =
            column().apply {
                fitsSystemWindows = true
                below(tabRow)
                below(screens, weight = 1f)
                below(stopButton(::stop))
            }
        setContentView(all)
        open(if (savedInstanceState?.getBoolean(LINK_OPEN) == true) link else mapScreen)
    }

    override fun onSaveInstanceState(state: Bundle) {
        super.onSaveInstanceState(state)
        state.putBoolean(LINK_OPEN, link.visibility == View.VISIBLE)
    }

    override fun onStart() {
        super.onStart()
        bindService(Intent(this, BoatService::class.java), connection, Context.BIND_AUTO_CREATE)
        main.post(refresh)
    }

    override fun onStop() {
        main.removeCallbacks(refresh)
        unbindService(connection)
        service = null
        super.onStop()
    }

    override fun onRequestPermissionsResult(code: Int, permissions: Array<String>, results: IntArray) {
        super.onRequestPermissionsResult(code, permissions, results)
        // Refused, and Android would not even say why it is asked: it will not ask again.
        refusedForGood =
            permissions.indices.any {
                results[it] != PackageManager.PERMISSION_GRANTED &&
                    !shouldShowRequestPermissionRationale(permissions[it])
            }
        show()
    }

    private fun open(screen: View) {
        for ((tab, each) in tabs) {
            each.visibility = if (each === screen) View.VISIBLE else View.GONE
            tab.isSelected = each === screen
            val (ground, text) = if (tab.isSelected) R.color.text to R.color.ground else R.color.button to R.color.text
            tab.backgroundTintList = ColorStateList.valueOf(getColor(ground))
            tab.setTextColor(getColor(text))
        }
        if (screen === link) link.offer()
    }

    private fun connect(choice: LinkChoice) {
        startForegroundService(BoatService.startIntent(this, choice))
    }

    private fun stop() {
        // A service that is bound only is told the same way: it has nothing to end and says so.
        startService(BoatService.stopIntent(this))
    }

    private fun allow() {
        if (refusedForGood) {
            startActivity(Intent(Settings.ACTION_APPLICATION_DETAILS_SETTINGS, ownUri()))
        } else {
            requestPermissions(Preflight.missingPermissions(this).toTypedArray(), PERMISSIONS)
        }
    }

    private fun exempt() {
        startActivity(Intent(Settings.ACTION_REQUEST_IGNORE_BATTERY_OPTIMIZATIONS, ownUri()))
    }

    private fun ownUri(): Uri = Uri.fromParts("package", packageName, null)

    private val refresh: Runnable =
        object : Runnable {
            override fun run() {
                show()
                main.postDelayed(this, REFRESH_MILLIS)
            }
        }

    private fun show() {
        link.show(service?.snapshot ?: BoatSnapshot(), refusedForGood)
    }

    private fun column() = LinearLayout(this).apply { orientation = LinearLayout.VERTICAL }

    private companion object {
        const val PERMISSIONS = 1
        const val REFRESH_MILLIS = 500L
        const val LINK_OPEN = "link-open"
    }
}
