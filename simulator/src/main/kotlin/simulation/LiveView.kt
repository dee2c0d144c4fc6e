package stillwater.simulation

import com.github.ajalt.mordant.animation.Animation
import com.github.ajalt.mordant.animation.animation
import com.github.ajalt.mordant.rendering.TextColors
import com.github.ajalt.mordant.rendering.Whitespace
import com.github.ajalt.mordant.terminal.Terminal
import com.github.ajalt.mordant.widgets.Text
import stillwater.model.Grid
import stillwater.report.SignificantDigits
import kotlin.math.roundToInt

/**
 * Shows a [MissionRun] in a terminal as it runs: the map of estimates with the boat, its plan and home, what the reading,
 * the bounds and the water were lately, the state, and what the link lost. Holds the run back to [speed].
 *
 * @param terminal that is watched by a person. @param speed virtual seconds a second.
 */
class LiveView(private val terminal: Terminal, private val run: MissionRun, private val speed: Double) {
    private val picture = LivePicture(run)
    private val animation: Animation<String> = terminal.animation { Text(it, whitespace = Whitespace.PRE) }
    private var startedAt = System.nanoTime()
    private var next = 0.0

    /** Draws where it is time to, and waits until it is time to go on. Call it after each step. */
    fun watch() {
        picture.listen()
        if (run.time.seconds < next) return
        next = run.time.seconds + speed / PICTURES
        animation.update(picture.draw(terminal.size.width, terminal.size.height))
        val due = startedAt + (run.time.seconds / speed * NANOS).toLong()
        val early = due - System.nanoTime()
        if (early > 0) Thread.sleep(early / NANOS_PER_MILLI, (early % NANOS_PER_MILLI).toInt())
    }

    /** Leaves the last picture standing. */
    fun end() {
        animation.update(picture.draw(terminal.size.width, terminal.size.height))
        animation.stop()
    }

    private companion object {
        /** A second. */
        const val PICTURES = 10
        const val NANOS = 1e9
        const val NANOS_PER_MILLI = 1_000_000L
    }
}

/**
 * What a [LiveView] shows, as text.
 *
 * @param run that is watched. Retained.
 */
internal class LivePicture(private val run: MissionRun) {
    private val three = SignificantDigits(3)
    private val trace = ArrayDeque<Moment>()
    private var traced = Double.NEGATIVE_INFINITY
    private val truths = DoubleArray(run.world.site.grid.size) { run.world.truthAtCentre(it) }

    private class Moment(val reading: Double, val truth: Double, val lower: Double, val upper: Double)

    /** Takes note of the moment for the trace, every [TRACE_PERIOD] s. */
    fun listen() {
        if (run.time.seconds < traced + TRACE_PERIOD) return
        traced = run.time.seconds
        val map = run.mission.map
        val cell = run.mission.position?.let { map.grid.cellAt(it) } ?: Grid.OUTSIDE
        val boat = run.world.boat.dynamics
        trace += Moment(
            run.readings.taken.lastOrNull()?.value ?: Double.NaN,
            run.world.field.truth(boat.x, boat.y, run.time),
            if (cell == Grid.OUTSIDE) Double.NaN else map.lower(cell),
            if (cell == Grid.OUTSIDE) Double.NaN else map.upper(cell),
        )
        while (trace.size > LONGEST_TRACE) trace.removeFirst()
    }

    /** The picture for a terminal of [width] by [height] characters; 0 of those where it does not say. */
    fun draw(width: Int, height: Int): String {
        val lines = ArrayList<String>()
        lines += heading()
        val room = maxOf(LEAST_ROWS, height - TRACE_ROWS - TEXT_ROWS)
        lines += map((width / 2).coerceIn(1, WIDEST), room)
        lines += trace(width - LABEL)
        lines += counters()
        return lines.joinToString("\n")
    }

    private fun heading(): String {
        val state = run.history.spans.lastOrNull()?.label ?: "idle"
        return "${run.spec.name}  ${SimulationSummary.clock(run.time.seconds)}  $state"
    }

    /** North is up; each cell two characters wide. A grid larger than the room shows every n-th cell. */
    private fun map(columns: Int, rows: Int): List<String> {
        val grid = run.world.site.grid
        val every = maxOf(1, (grid.columns + columns - 1) / columns, (grid.rows + rows - 1) / rows)
        val boat = run.mission.position?.let { grid.cellAt(it) } ?: Grid.OUTSIDE
        val home = grid.cellAt(run.spec.home.x, run.spec.home.y)
        val plan = run.mission.waypoints().map { grid.cellAt(it) }.toSet()
        val low = truths.min()
        val span = (truths.max() - low).takeIf { it > 0 } ?: 1.0
        return (grid.rows - 1 downTo 0 step every).map { row ->
            (0 until grid.columns step every).joinToString("") { column ->
                val shown = block(grid, row, column, every)
                val mark = when {
                    boat in shown -> "@ "
                    home in shown -> "H "
                    shown.any { it in plan } -> "· "
                    else -> "  "
                }
                coloured(shown, mark, low, span)
            }
        }
    }

    private fun block(grid: Grid, row: Int, column: Int, every: Int): Set<Int> {
        val cells = HashSet<Int>()
        for (r in maxOf(0, row - every + 1)..row) {
            for (c in column until minOf(grid.columns, column + every)) cells += r * grid.columns + c
        }
        return cells
    }

    /** Dark blue is low, yellow is high; a cell whose bounds say nothing yet has dots on it. */
    private fun coloured(cells: Set<Int>, mark: String, low: Double, span: Double): String {
        val map = run.mission.map
        val known = cells.filter { map.readings(it) > 0 }
        if (known.isEmpty()) return mark
        val share = ((known.map { map.value(it) }.average() - low) / span).coerceIn(0.0, 1.0)
        val (red, green, blue) = SHADES[(share * (SHADES.size - 1)).roundToInt()]
        val isSure = known.any { map.upper(it) - map.lower(it) < map.prior.width * SURE }
        val text = if (mark.isBlank() && !isSure) "░░" else mark
        val paper = TextColors.rgb(red / FULL, green / FULL, blue / FULL)
        val ink = if (share > HALF) TextColors.black else TextColors.brightWhite
        return (ink on paper)(text)
    }

    /** The last minutes: `·` the water under the boat, `─` the bounds of its cell, `*` the reading. */
    private fun trace(columns: Int): List<String> {
        val shown = trace.takeLast(maxOf(1, columns))
        val low = truths.min()
        val high = truths.max().let { if (it > low) it else low + 1 }
        val canvas = Array(TRACE_ROWS) { CharArray(shown.size) { ' ' } }
        fun put(column: Int, value: Double, mark: Char) {
            if (value.isNaN()) return
            val row = ((high - value) / (high - low) * (TRACE_ROWS - 1)).roundToInt()
            if (row in 0 until TRACE_ROWS) canvas[row][column] = mark
        }
        shown.forEachIndexed { column, moment ->
            put(column, moment.lower, '─')
            put(column, moment.upper, '─')
            put(column, moment.truth, '·')
            put(column, moment.reading, '*')
        }
        return canvas.mapIndexed { row, characters ->
            val label = when (row) {
                0 -> three.format(high)
                TRACE_ROWS - 1 -> three.format(low)
                else -> ""
            }
            label.padStart(LABEL - 1) + " " + characters.concatToString()
        }
    }

    private fun counters(): List<String> {
        val mission = run.mission
        val error = MapErrors.of(mission.map) { truths[it] }
        val last = trace.lastOrNull()
        val reading = last?.let { "reading ${three.format(it.reading)}, water ${three.format(it.truth)}" }.orEmpty()
        return listOf(
            "* reading  · water  ─ bounds   $reading",
            "readings ${run.readings.taken.size} taken, ${mission.readings.leftOut} left out; " +
                "map error ${three.format(error.mean)} over ${error.cells} cells",
            "link ${mission.board.unreadable} bad lines, ${mission.board.refusals} refused commands; " +
                "battery ${three.format(mission.board.volts)} V; used ${mission.used.roundToInt()}",
        )
    }

    private companion object {
        const val TRACE_PERIOD = 2.0
        const val LONGEST_TRACE = 400
        const val TRACE_ROWS = 8
        const val TEXT_ROWS = 6
        const val LEAST_ROWS = 5
        const val WIDEST = 60
        const val LABEL = 7
        const val SURE = 0.999
        const val HALF = 0.5
        const val FULL = 255.0

        /** Viridis, of M. van der Walt and N. Smith (2015), at ten places. */
        val SHADES = listOf(
            Triple(68, 1, 84),
            Triple(72, 40, 120),
            Triple(62, 74, 137),
            Triple(49, 104, 142),
            Triple(38, 130, 142),
            Triple(31, 158, 137),
            Triple(53, 183, 121),
            Triple(109, 205, 89),
            Triple(180, 222, 44),
            Triple(253, 231, 37),
        )
    }
}
