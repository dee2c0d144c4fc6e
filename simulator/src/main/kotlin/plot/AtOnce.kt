package stillwater.plot

import java.util.concurrent.atomic.AtomicInteger
import java.util.stream.IntStream

/**
 * Does [tasks] at once, on up to all cores: they are begun in their order, each as soon as a core is free, so that no
 * core waits while one is left.
 *
 * What one throws is thrown here, once none is running any more; no other is begun then. Where several throw, it is
 * what the first of them in their order does, with the others' suppressed.
 */
public fun atOnce(tasks: List<() -> Unit>) {
    val next = AtomicInteger()
    val failures = arrayOfNulls<Throwable>(tasks.size)
    IntStream.range(0, minOf(tasks.size, Runtime.getRuntime().availableProcessors())).parallel().forEach {
        var task = next.getAndIncrement()
        while (task < tasks.size) {
            // Thrown in a stream, it would be thrown to the caller while others still run.
            runCatching(tasks[task]).onFailure {
                failures[task] = it
                next.set(tasks.size)
            }
            task = next.getAndIncrement()
        }
    }
    val thrown = failures.filterNotNull()
    val first = thrown.firstOrNull() ?: return
    thrown.filter { it !== first }.forEach(first::addSuppressed)
    throw first
}
