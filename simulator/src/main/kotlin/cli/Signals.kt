package stillwater.cli

import sun.misc.Signal

/**
 * Lets a long command end in good order on Ctrl-C: the first calls [stop], from another thread; a second ends the
 * program at once.
 */
internal fun onInterrupt(stop: () -> Unit) {
    for (name in listOf("INT", "TERM", "HUP")) {
        try {
            var isSecond = false
            Signal.handle(Signal(name)) { signal ->
                if (isSecond) Runtime.getRuntime().halt(SIGNALLED + signal.number)
                isSecond = true
                stop()
            }
        } catch (_: IllegalArgumentException) {
            // This system has no such signal.
        }
    }
}

/** What shells add to a signal's number. */
private const val SIGNALLED = 128
