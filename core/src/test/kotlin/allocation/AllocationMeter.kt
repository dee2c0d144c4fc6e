package stillwater.allocation

import com.sun.management.ThreadMXBean
import java.lang.management.ManagementFactory
import kotlin.test.assertEquals

/** One call under test; unlike a function type, it takes its number unboxed. */
internal fun interface Call {
    /** Call number [index]. */
    fun run(index: Int)
}

/**
 * Counts the bytes the calling thread allocates.
 *
 * The counter belongs to the thread, so that neither the compiler's nor the collector's work counts, and it is exact
 * on HotSpot: nothing of it depends on load or speed.
 */
internal object AllocationMeter {
    private val threads = ManagementFactory.getThreadMXBean() as ThreadMXBean

    /**
     * The fewest bytes that [CALLS] calls of [call] took in any of [ROUNDS] rounds.
     *
     * The fewest, because the JVM itself allocates a few hundred bytes for the thread now and then, when it links what
     * runs for the first time; what allocates on every call, or on one in a hundred, shows in every round. Few calls,
     * because code that has run often is compiled again without objects that are there in the source and that another
     * machine would allocate.
     */
    fun bytes(call: Call): Long {
        var fewest = Long.MAX_VALUE
        repeat(ROUNDS) {
            val before = threads.currentThreadAllocatedBytes
            for (i in 0 until CALLS) call.run(i)
            fewest = minOf(fewest, threads.currentThreadAllocatedBytes - before)
        }
        return fewest
    }

    /** Checks that [call] allocates nothing. */
    fun assertNone(what: String, call: Call) {
        assertEquals(0L, bytes(call), "bytes allocated by $CALLS calls of $what")
    }

    const val ROUNDS = 12
    const val CALLS = 500
}
