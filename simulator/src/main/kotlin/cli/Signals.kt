package stillwater.cli

import com.sun.jna.Library
import com.sun.jna.Native
import com.sun.jna.Pointer
import sun.misc.Signal
import sun.misc.SignalHandler
import kotlin.system.exitProcess

/**
 * Ctrl-C, a request to end and a terminal that was closed: until [attend] they end the program, from then on the first
 * of each lets it end in good order, and a second ends it at once.
 *
 * A signal that was ignored when the program began, as nohup has it, stays so. To be made before a serial port is
 * opened: the library for these has the system ignore some signals from then on, and a terminal that is closed would
 * leave a boat without anybody who can stop it.
 */
internal class Signals {
    private interface LibC : Library {
        fun signal(number: Int, handler: Pointer?): Pointer?
    }

    private val seen = HashSet<String>()
    private val mine = listOf("INT", "TERM", "HUP").filter(::handle)

    @Volatile
    private var stop: (() -> Unit)? = null

    /** The first signal calls [stop] from now on, from another thread. */
    fun attend(stop: () -> Unit) {
        this.stop = stop
        for (name in mine) {
            if (handle(name)) continue
            // Ignored by now, and not by whoever started the program.
            try {
                Native.load("c", LibC::class.java).signal(Signal(name).number, Pointer.NULL)
                handle(name)
            } catch (_: UnsatisfiedLinkError) {
                // No system that has such libraries.
            }
        }
    }

    /** Answers whether the signal is there and not ignored. */
    private fun handle(name: String): Boolean = try {
        Signal.handle(Signal(name)) { signal -> came(signal) } != SignalHandler.SIG_IGN
    } catch (_: IllegalArgumentException) {
        false
    }

    private fun came(signal: Signal) {
        val order = stop ?: exitProcess(SIGNALLED + signal.number)
        val isSecond = synchronized(seen) { !seen.add(signal.name) }
        if (isSecond) Runtime.getRuntime().halt(SIGNALLED + signal.number)
        order()
    }

    private companion object {
        /** What shells add to a signal's number. */
        const val SIGNALLED = 128
    }
}
