package stillwater.simulation

import stillwater.model.Grid
import kotlin.math.abs
import kotlin.math.ceil

/**
 * One moment of a run as the animation shows it.
 *
 * @property time s. @property x true place, m east. @property y m north. @property heading rad, counter-clockwise from east.
 * @property believedX where the mission takes the boat to be, m east; NaN where it does not know. @property believedY m north.
 * @property state its label, as in [StateSpan]. @property plan waypoints ahead, x and y in turn, m.
 * @property reading last that the map took, sensor units; NaN before. @property truth the water under the boat.
 * @property lower bound of the cell that the boat is in, NaN off the map. @property upper bound.
 * @property volts of the battery, V. @property used of the budget. @property taken readings. @property leftOut readings.
 * @property unreadable lines. @property error mean absolute, over cells with readings; NaN without any.
 * @property changes cells whose belief changed since the frame before: index, value, lower, upper, readings in turn.
 */
class Frame(
    val time: Double,
    val x: Double,
    val y: Double,
    val heading: Double,
    val believedX: Double,
    val believedY: Double,
    val state: String,
    val plan: DoubleArray,
    val reading: Double,
    val truth: Double,
    val lower: Double,
    val upper: Double,
    val volts: Double,
    val used: Double,
    val taken: Int,
    val leftOut: Long,
    val unreadable: Long,
    val error: Double,
    val changes: DoubleArray,
)

/**
 * Records a [MissionRun] for the animation and for the trace, some [FRAMES] frames of it.
 *
 * @param run to record. Retained.
 * @param expected time that it will take, s; twice the time gives twice the frames.
 */
class Film(private val run: MissionRun, expected: Double) {
    private val period = maxOf(SHORTEST, ceil(expected / FRAMES / SHORTEST) * SHORTEST)
    private val all = ArrayList<Frame>()
    private val cells = run.world.site.grid.size
    private val shown = DoubleArray(CHANGE * cells) { Double.NaN }
    private val mapEvery = ceil(cells.toDouble() * FRAMES / MOST_CELLS).toInt().coerceAtLeast(1)
    private var next = 0.0

    /** What the cells truly have at their centres, sensor units, indexed as the grid. */
    val truths = DoubleArray(cells) { run.world.truthAtCentre(it) }

    /** All of them. */
    val frames: List<Frame> get() = all

    /** Looks whether a frame is due. Call it after each step. */
    fun watch() {
        val time = run.time.seconds
        if (time < next) return
        next += period
        shoot(isMapDue = all.size % mapEvery == 0)
    }

    /** Records the end, the map as it is. */
    fun end() {
        if (all.lastOrNull()?.time != run.time.seconds) shoot(isMapDue = true)
    }

    private fun shoot(isMapDue: Boolean) {
        val mission = run.mission
        val map = mission.map
        val boat = run.world.boat.dynamics
        val place = mission.position
        val cell = place?.let { map.grid.cellAt(it) } ?: Grid.OUTSIDE
        val plan = mission.waypoints()
        all += Frame(
            time = run.time.seconds,
            x = boat.x,
            y = boat.y,
            heading = boat.heading,
            believedX = place?.x ?: Double.NaN,
            believedY = place?.y ?: Double.NaN,
            state = run.history.spans.last().label,
            plan = DoubleArray(2 * plan.size) { if (it % 2 == 0) plan[it / 2].x else plan[it / 2].y },
            reading = run.readings.taken.lastOrNull()?.value ?: Double.NaN,
            truth = run.world.field.truth(boat.x, boat.y, run.time),
            lower = if (cell == Grid.OUTSIDE) Double.NaN else map.lower(cell),
            upper = if (cell == Grid.OUTSIDE) Double.NaN else map.upper(cell),
            volts = mission.board.volts,
            used = mission.used,
            taken = run.readings.taken.size,
            leftOut = mission.readings.leftOut,
            unreadable = mission.board.unreadable,
            error = MapErrors.of(map) { truths[it] }.mean,
            changes = if (isMapDue) changes() else DoubleArray(0),
        )
    }

    private fun changes(): DoubleArray {
        val map = run.mission.map
        val least = map.prior.width / SHADES
        val changed = ArrayList<Double>()
        for (cell in 0 until cells) {
            val now = doubleArrayOf(map.value(cell), map.lower(cell), map.upper(cell), map.readings(cell).toDouble())
            val at = CHANGE * cell
            val isSame = now[3] > 0 == shown[at + 3] > 0 && (0 until 3).all { abs(now[it] - shown[at + it]) < least }
            if (isSame) continue
            now.copyInto(shown, at)
            changed += cell.toDouble()
            changed.addAll(now.asList())
        }
        return changed.toDoubleArray()
    }

    private companion object {
        const val FRAMES = 900.0

        /** Shortest time between two frames, s. */
        const val SHORTEST = 0.5

        /** Cells that all frames together may change. */
        const val MOST_CELLS = 400_000

        /** A smaller change of belief than this part of the range is not seen. */
        const val SHADES = 1000

        /** Numbers kept of a cell. */
        const val CHANGE = 4
    }
}
