package stillwater.app

import android.os.StrictMode

/**
 * Says to Android's StrictMode that [what] comes now, which may wait for the disk or the link: not on the main thread.
 *
 * StrictMode itself sees databases and the app's folders; where tests run it sees nothing of Java's files and of sockets.
 */
internal fun mayWait(what: String): Unit = StrictMode.noteSlowCall(what)
