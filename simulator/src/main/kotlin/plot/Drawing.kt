package stillwater.plot

import java.util.concurrent.Callable
import java.util.concurrent.ExecutionException
import java.util.concurrent.Executors

/** Data that can be drawn as one [Figure]. Drawing is pure: it reads nothing but the data. */
public fun interface Drawing {
    /** Draws the data; never fails on values (NaN, infinite and missing ones are left out). */
    public fun draw(): Figure
}

/**
 * Draws several figures at once, on up to all cores, in the order given.
 *
 * @param png whether to make each figure's PNG too, so that a later [Figure.png] at the default scale costs nothing.
 * @throws FigureException as [Figure.png], if [png] is asked for.
 */
public fun List<Drawing>.drawAll(png: Boolean = false): List<Figure> {
    if (isEmpty()) return emptyList()
    val workers = Executors.newFixedThreadPool(minOf(size, Runtime.getRuntime().availableProcessors())) { task ->
        Thread(task, "figure").apply { isDaemon = true }
    }
    try {
        return workers.invokeAll(
            map {
                Callable { it.draw().also { figure -> if (png) figure.png() } }
            },
        ).map { it.get() }
    } catch (failed: ExecutionException) {
        throw failed.cause ?: failed
    } finally {
        workers.shutdownNow()
    }
}
