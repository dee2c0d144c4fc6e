package stillwater.speed

import org.openjdk.jmh.annotations.Benchmark
import org.openjdk.jmh.annotations.BenchmarkMode
import org.openjdk.jmh.annotations.Fork
import org.openjdk.jmh.annotations.Measurement
import org.openjdk.jmh.annotations.Mode
import org.openjdk.jmh.annotations.OperationsPerInvocation
import org.openjdk.jmh.annotations.OutputTimeUnit
import org.openjdk.jmh.annotations.Param
import org.openjdk.jmh.annotations.Scope
import org.openjdk.jmh.annotations.State
import org.openjdk.jmh.annotations.Warmup
import stillwater.estimate.BayesianMap
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.plan.Lawnmower
import stillwater.plan.LawnmowerPattern
import stillwater.sensor.SensorModel
import stillwater.world.GaussianMixtureField
import java.util.concurrent.TimeUnit
import kotlin.random.Random

/**
 * A move of a boat with a Bayesian map: ten readings in a cell, and the map asked for once, as a planner does.
 *
 * The mean over the first 400 moves of a survey, the learning of the covariance included; `DecisionTimes` has the
 * longest of them.
 */
@State(Scope.Thread)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.MILLISECONDS)
@Fork(1)
@Warmup(iterations = 1, time = 1)
@Measurement(iterations = 2, time = 1)
open class BayesianBenchmark {
    /** Columns and rows. */
    @Param("10x10", "40x25", "100x100")
    var cells: String = ""

    @Benchmark
    @OperationsPerInvocation(MOVES)
    fun move(): Double {
        var sum = 0.0
        val survey = BayesianSurvey(grid())
        repeat(MOVES) { sum += survey.move() }
        return sum
    }

    private fun grid() = cells.split('x').map { it.toInt() }.let { (columns, rows) -> Grid.unit(columns, rows) }

    private companion object {
        const val MOVES = 400
    }
}

/** A boat that mows a smooth field and asks for its map after each move. */
internal class BayesianSurvey(private val grid: Grid) {
    private val field = GaussianMixtureField.draw(grid, Random(Survey.SEED))
    private val cells = Lawnmower.tour(grid, LawnmowerPattern.HAMILTONIAN_CYCLE)
    private val sensor: SensorModel = Survey.SENSOR.build(field.truth(0), Random(Survey.SEED + 1))
    private val map = BayesianMap(grid, Interval.UNIT)
    private var readings = 0

    /** Ten readings in the next cell, and what the map says of it. */
    fun move(): Double {
        val cell = cells[readings / Survey.SAMPLES % cells.size]
        repeat(Survey.SAMPLES) {
            val value = sensor.step(field.truth(cell), 1.0, Conditions.NONE)
            map.update(BoatTime(readings++.toDouble()), grid.centerX(cell), grid.centerY(cell), value)
        }
        return map.map.value(cell)
    }
}
