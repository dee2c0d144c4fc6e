package stillwater.correct

import stillwater.estimate.UndoableSensor
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.sqrt

/**
 * The readings of a sensor that are within the ends of its range beyond doubt.
 *
 * What is noise behind an end scatters about it: half of the readings at an upper end lie below it, and are no less at the
 * end than the others.
 */
internal object RangeEnds {
    /** The range of [sensor] without what noise behind its ends may reach, sensor units; infinite where it has no end. */
    fun beyondDoubt(sensor: SensorSpec?): ClosedFloatingPointRange<Double> {
        val range = if (sensor == null) UndoableSensor.ENDLESS else UndoableSensor.of(sensor).range
        if (sensor == null || range == UndoableSensor.ENDLESS) return range
        val margin = DEVIATIONS * noiseBehind(sensor)
        val start = range.start + margin
        val end = range.endInclusive - margin
        // Of a range that is all noise nothing would be left to learn from.
        return if (start < end) start..end else range
    }

    /** Standard deviation of the noise that is added behind the last end, sensor units of the readings. */
    private fun noiseBehind(sensor: SensorSpec): Double {
        val last = sensor.stages.indexOfLast { it is SensorStage.Range }
        if (last < 0) return 0.0
        return sqrt(
            sensor.stages.drop(last + 1).fold(0.0) { variance, stage ->
                when (stage) {
                    is SensorStage.Noise -> variance + stage.standardDeviation * stage.standardDeviation
                    is SensorStage.Wander -> variance + stage.standardDeviation * stage.standardDeviation
                    is SensorStage.Calibration -> variance * stage.gain * stage.gain
                    else -> variance
                }
            },
        )
    }

    /** Of normal noise one reading in 700 at an end is farther within. */
    private const val DEVIATIONS = 3.0
}
