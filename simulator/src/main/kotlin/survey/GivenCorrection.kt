package stillwater.survey

import stillwater.estimate.CorrectedTrack
import stillwater.model.Grid
import stillwater.sensor.SensorSpec

/**
 * Readings as [sensor], a sensor that was given, must have seen the water.
 *
 * @property sensor what was undone. @property words the same in words.
 * @property track the water at each of the log's rows, in their order.
 * @property told rows of which the log says something: the last ones show, behind a dead time, water of before them alone.
 * @property cautions which rows are less certain than the others, one sentence each.
 */
class GivenCorrection(
    val sensor: SensorSpec,
    val words: String,
    internal val track: CorrectedTrack,
    internal val told: Int,
    val cautions: List<String> = emptyList(),
) {
    /** Rows of which the log says nothing. */
    val untold: Int get() = track.values.size - told

    /** The water at reading [row]. */
    internal fun at(row: Int): Double = track.values[row]
}

/**
 * How well the water in each cell is known from corrected readings: the mean of their 95 % intervals' ends. What is not known
 * of one row is not known of those beside it either, so that the mean of many is known no better than one.
 *
 * Holds for the water where the boat went through the cell. Confined to one thread.
 */
class CorrectedCells internal constructor(private val grid: Grid, private val correction: GivenCorrection) {
    private val lower = DoubleArray(grid.size)
    private val upper = DoubleArray(grid.size)
    private val counts = IntArray(grid.size)
    private var row = 0

    /** Takes the log's next row, at ([x], [y]), m; false where the log says nothing of the water there and then. */
    internal fun take(x: Double, y: Double): Boolean {
        val now = row++
        if (now >= correction.told) return false
        val cell = grid.cellAt(x, y)
        if (cell != Grid.OUTSIDE) {
            lower[cell] += correction.track.lower[now]
            upper[cell] += correction.track.upper[now]
            counts[cell]++
        }
        return true
    }

    /** Lower end of the interval of [cell], sensor units; NaN where the boat never was. */
    fun lower(cell: Int): Double = lower[cell] / counts[cell]

    /** Upper end of the interval of [cell], sensor units; NaN where the boat never was. */
    fun upper(cell: Int): Double = upper[cell] / counts[cell]
}
