package stillwater.plot

import java.util.concurrent.atomic.AtomicInteger
import java.util.stream.IntStream

/**
 * Does [tasks] at once, on up to all cores: they are begun in their order, each as soon as a core is free, so that no
 * core waits while one is left. What one throws is thrown here.
 */
public fun atOnce(tasks: List<() -> Unit>) {
    val next = AtomicInteger()
    IntStream.range(0, minOf(tasks.size, Runtime.getRuntime().availableProcessors())).parallel().forEach {
        var task = next.getAndIncrement()
        while (task < tasks.size) {
            tasks[task]()
            task = next.getAndIncrement()
        }
    }
}
