package stillwater.plot

import kotlin.concurrent.thread

/**
 * Draws small figures for nobody on a core that is idle meanwhile, so that the plot library is loaded, and its busiest
 * code compiled, when the figures that count are drawn: those of a million rows then take a quarter less processor
 * time. Beside figures it would only be in their way: [close] it when they are to be drawn, and none is begun.
 */
public class Rehearsal : AutoCloseable {
    @Volatile
    private var isOver = false

    init {
        if (Runtime.getRuntime().availableProcessors() > 1) {
            thread(isDaemon = true, name = "rehearsal") { drawings().forEach { if (!isOver) it.draw().prepare() } }
        }
    }

    override fun close() {
        isOver = true
    }

    private fun drawings(): Sequence<Drawing> = sequenceOf(
        CellMap("", "", cells(), unit = ""),
        TrackMap("", "", ways { it % SIDE }, ways { it / SIDE }, ways { it % SIDE }, unit = ""),
        LinePlot("", "", listOf(Series("", ways { it }, ways { it % SIDE })), "", ""),
        Histogram("", "", ways { it }, LongArray(CELLS - 1) { 1L + it }, ""),
    )

    private fun cells() = List(CELLS) {
        MapCell.rectangle((it % SIDE).toDouble(), (it / SIDE).toDouble(), 1.0, 1.0, rotation = 0.0, value = it.toDouble())
    }

    private inline fun ways(of: (Int) -> Int) = DoubleArray(CELLS) { of(it).toDouble() }

    private companion object {
        const val SIDE = 20
        const val CELLS = SIDE * SIDE
    }
}
