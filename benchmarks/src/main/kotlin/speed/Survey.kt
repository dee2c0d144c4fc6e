package stillwater.speed

import stillwater.estimate.FieldEstimator
import stillwater.field.CellField
import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Plan
import stillwater.plan.RandomWalk
import stillwater.plan.StopCondition
import stillwater.run.FilterKind
import stillwater.run.Preset
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import stillwater.world.UniformField
import kotlin.random.Random

/**
 * Readings of a random walk, taken once so that a benchmark measures who reads them and nothing else.
 *
 * Ten a cell, one a second, through a lag of ten seconds with noise 0.002 and a resolution of 0.005; the same in every
 * run.
 *
 * @param grid cells of the field.
 * @param moves cells entered.
 */
internal class Survey(val grid: Grid, moves: Int) {
    val size: Int = moves * SAMPLES
    val xs = DoubleArray(size)
    val ys = DoubleArray(size)
    val values = DoubleArray(size)
    private val moveTimes = DoubleArray(SAMPLES)
    private val moveValues = DoubleArray(SAMPLES)

    init {
        val field: CellField = UniformField.draw(grid, Random(SEED))
        val walk = RandomWalk(Random(SEED + 1))
        val plan = Plan()
        val empty = FieldMap(grid, Interval.UNIT)
        var cell = grid.size / 2
        val sensor = SENSOR.build(field.truth(cell), Random(SEED + 2))
        for (move in 0 until moves) {
            walk.plan(empty, grid.center(cell), 0.0, StopCondition.NEVER, plan)
            cell = grid.cellAt(plan.x(0), plan.y(0))
            for (i in move * SAMPLES until (move + 1) * SAMPLES) {
                xs[i] = grid.centerX(cell)
                ys[i] = grid.centerY(cell)
                values[i] = sensor.step(field.truth(cell), 1.0, Conditions.NONE)
            }
        }
    }

    /** A new filter of the [label] for the survey, with the noisy preset's settings. */
    fun estimator(label: String): FieldEstimator =
        FilterKind.entries.first { it.label == label }
            .estimator(grid, Interval.UNIT, Preset.NOISY.settings().boundedFilter)

    /** Hands all readings to [estimator]. Its calls write to memory: fields would be read anew for each. */
    fun read(estimator: FieldEstimator) {
        val xs = xs
        val ys = ys
        val values = values
        for (i in 0 until size) estimator.update(BoatTime(i.toDouble()), xs[i], ys[i], values[i], Conditions.NONE)
    }

    /** The same, each cell's readings in one call; to copy them for it is in the time. */
    fun readMoves(estimator: FieldEstimator) {
        for (first in 0 until size step SAMPLES) {
            for (i in 0 until SAMPLES) {
                moveTimes[i] = (first + i).toDouble()
                moveValues[i] = values[first + i]
            }
            estimator.updateAll(moveTimes, xs[first], ys[first], moveValues, SAMPLES)
        }
    }

    /** Hands over reading by reading, and after each cell's readings asks for the map and has [look] at the boat's cell there. */
    inline fun read(estimator: FieldEstimator, look: (map: FieldMap, cell: Int) -> Unit) {
        for (i in 0 until size) {
            estimator.update(BoatTime(i.toDouble()), xs[i], ys[i], values[i], Conditions.NONE)
            if (i % SAMPLES == SAMPLES - 1) look(estimator.map, grid.cellAt(xs[i], ys[i]))
        }
    }

    internal companion object {
        const val SAMPLES = 10
        const val SEED = 20_261_121

        /** The noisy preset's sensor. */
        val SENSOR = SensorSpec(
            "noisy-lag",
            listOf(SensorStage.Lag(9.5), SensorStage.Noise(0.002), SensorStage.Quantum(0.005)),
        )
    }
}
