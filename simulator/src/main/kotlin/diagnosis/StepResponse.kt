package stillwater.diagnosis

import stillwater.model.Conditions
import stillwater.plot.Series
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.random.Random

/**
 * What two sensors have yet to show of a step of the water: by their lags, paths and delays alone.
 *
 * @param base without the causes that were named. @param extended with them. @param conditions under which they are.
 */
internal class StepResponse(
    private val base: SensorSpec,
    private val extended: SensorSpec,
    private val conditions: Conditions,
) {
    /** Shares of the step over time, s, until both have settled; a lag is a straight line where these are logarithmic. */
    fun curves(): List<Series> {
        val coarse = listOf(base, extended).map { shown(it, COARSE, MOST) }
        // The last moment at which either is not yet there.
        val end = coarse.maxOf { column -> column.indexOfLast { abs(it - 1) > SETTLED } + 2 } * COARSE
        val step = end / POINTS
        return listOf("base" to base, "extended" to extended).map { (name, sensor) ->
            val shown = doubleArrayOf(0.0) + shown(sensor, step, POINTS)
            val left = DoubleArray(POINTS + 1) { at -> abs(1 - shown[at]).takeIf { it >= SETTLED } ?: Double.NaN }
            Series(name, DoubleArray(POINTS + 1) { it * step }, left)
        }
    }

    /** So many readings, one every [step] s. */
    private fun shown(sensor: SensorSpec, step: Double, count: Int): DoubleArray {
        val response = SensorSpec(sensor.name, sensor.stages.mapNotNull(::linear)).build(0.0, Random(0))
        response.step(0.0, step, conditions)
        return DoubleArray(count) { response.step(1.0, step, conditions) }
    }

    /** [stage] where it is a lag, path or delay, without a limit to its rate, which has no share of a step. */
    private fun linear(stage: SensorStage): SensorStage? = when (stage) {
        is SensorStage.LimitedLag -> SensorStage.Lag(stage.timeConstant)
        is SensorStage.Lag, is SensorStage.Asymmetric, is SensorStage.Delay, is SensorStage.TwoPath,
        is SensorStage.FlowLag, is SensorStage.TemperatureLag, is SensorStage.Combined,
        -> stage
        else -> null
    }

    private companion object {
        /** s, and the most of it that is looked at. */
        const val COARSE = 0.5
        const val MOST = 4000
        const val SETTLED = 0.001
        const val POINTS = 300
    }
}
