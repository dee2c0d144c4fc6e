package stillwater.app.screen

import android.os.StrictMode
import java.util.concurrent.Executor

/** Whatever Android takes for waiting throws, where it happens. */
internal val STRICT: StrictMode.ThreadPolicy =
    StrictMode.ThreadPolicy.Builder()
        .detectDiskReads()
        .detectDiskWrites()
        .detectNetwork()
        .detectCustomSlowCalls()
        .penaltyDeath()
        .build()

/** Does everything on a thread of its own, and is done when the call returns; what is thrown there is thrown here. */
internal object AnotherThread : Executor {
    override fun execute(work: Runnable) {
        var thrown: Throwable? = null
        Thread(work, "background").apply {
            setUncaughtExceptionHandler { _, error -> thrown = error }
            start()
            join()
        }
        thrown?.let { throw AssertionError("in the background", it) }
    }
}
