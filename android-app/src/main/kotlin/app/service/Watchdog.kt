package stillwater.app.service

import android.os.Handler
import android.os.HandlerThread
import android.os.Looper
import android.os.SystemClock
import stillwater.model.Actuation
import stillwater.wire.ByteLink
import stillwater.wire.Command
import stillwater.wire.PlatypusEncoder

/**
 * Rests the motors when the boat's thread hangs: a board whose adapter stays powered may keep its last command otherwise.
 *
 * On a thread of its own. [feed] comes from the boat's.
 */
internal class Watchdog {
    private val thread = HandlerThread("watchdog").apply { start() }
    private val handler = Handler(thread.looper)
    private val rest = PlatypusEncoder.encode(Command.Move(Actuation.Differential(0.0, 0.0)))

    @Volatile private var fedAt = 0L

    @Volatile private var guarded: ByteLink? = null

    /** The thread it looks on. */
    val looper: Looper get() = thread.looper

    /** The boat's thread is alive; [link] is the one over which motors were told to move, null where none were. */
    fun feed(link: ByteLink?) {
        fedAt = SystemClock.uptimeMillis()
        guarded = link
    }

    /** Begins to look. */
    fun start() {
        handler.postDelayed(look, LOOK_MILLIS)
    }

    /** Looks no more. */
    fun stop() {
        thread.quitSafely()
    }

    private val look: Runnable =
        object : Runnable {
            override fun run() {
                val link = guarded
                if (link != null && SystemClock.uptimeMillis() - fedAt >= PATIENCE_MILLIS) {
                    link.write(rest)
                }
                handler.postDelayed(this, LOOK_MILLIS)
            }
        }

    private companion object {
        /** With the time between two looks, the 500 ms that a board's own watchdog has. */
        const val PATIENCE_MILLIS = 400L
        const val LOOK_MILLIS = 100L
    }
}
