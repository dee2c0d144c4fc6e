package stillwater.app.link

import android.app.Activity
import android.os.Bundle

/**
 * Android starts it when a known adapter is plugged in, and with that gives the permission to use it; it is gone before
 * anything is drawn. The link's next attempt finds the adapter by itself, so there is nothing to tell anybody.
 */
class UsbAttachedActivity : Activity() {
    override fun onCreate(savedInstanceState: Bundle?) {
        super.onCreate(savedInstanceState)
        finish()
    }
}
