package stillwater.app.screen

import android.os.Handler
import android.os.Looper
import java.util.concurrent.Executor
import java.util.concurrent.Executors

/** Where everything is done that takes time or touches the disk; answers come on the main thread. */
internal object Background {
    /** One thread: what is asked first is done first. A test's runs at once. */
    @Volatile var executor: Executor = Executors.newSingleThreadExecutor { Thread(it, "background") }

    private val main = Handler(Looper.getMainLooper())

    /** Does [work], and hands what it gives to [then] on the main thread. */
    fun <T> run(work: () -> T, then: (T) -> Unit) {
        executor.execute {
            val done = work()
            main.post { then(done) }
        }
    }
}
