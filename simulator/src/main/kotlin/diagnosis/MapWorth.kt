package stillwater.diagnosis

import stillwater.estimate.IntervalFilterSettings
import stillwater.run.Experiment
import stillwater.run.FilterKind
import stillwater.run.LagFilterSettings
import stillwater.run.PlannerKind
import stillwater.run.Preset
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage

/**
 * What a better model of the sensor is worth for a map: the benchmark's Gaussian fields, sampled by the extended
 * sensor, mapped by the interval filter with the limits of the old and of the new model.
 *
 * @property before mean error of the map with the base model's limits, share of the field's range.
 * @property after the same with the extended model's. @property error standard error of their difference.
 * @property environments number of fields.
 */
class MapWorth(val before: Double, val after: Double, val error: Double, val environments: Int) {
    /** Whether the extended model makes the map worse for certain. */
    val isWorse: Boolean get() = after - before > CERTAIN * error

    companion object {
        private const val CERTAIN = 3.0
        private const val ENVIRONMENTS = 20
        private const val MOVES = 300
        private const val SLACK = 1.5

        /** Four standard deviations: one reading in 16 000 is farther off. */
        private const val NOISE_REACH = 4.0

        /**
         * The comparison of [base] and [extended]; the log's values go from [lowest] to [highest].
         *
         * @param threads environments that run at once, at least 1.
         */
        suspend fun of(
            base: SensorSpec,
            extended: SensorSpec,
            lowest: Double,
            highest: Double,
            threads: Int,
        ): MapWorth? {
            if (!(highest > lowest)) return null
            val truth = inUnits(extended, lowest, highest - lowest)
            val old = limits(inUnits(base, lowest, highest - lowest))
            val new = limits(truth)
            val curves = listOf(old, new).map { limit ->
                val settings = Preset.NOISY.settings()
                val run = settings.copy(
                    fields = settings.fields.filterKeys { it == Preset.GAUSSIAN },
                    filters = listOf(FilterKind.INTERVAL),
                    planners = listOf(PlannerKind.RANDOM_WALK),
                    sensor = truth,
                    lagFilters = LagFilterSettings(limit),
                    environments = ENVIRONMENTS,
                    moves = MOVES,
                    checkpoints = listOf(MOVES),
                )
                Experiment(run).run(threads).curves.single()
            }
            val difference = curves[0].excessOver(curves[1], MOVES)
            return MapWorth(
                curves[0].at(MOVES).mean,
                curves[1].at(MOVES).mean,
                difference.standardError,
                ENVIRONMENTS,
            )
        }

        /** What the interval filter may assume of [sensor]: the slowest of its responses, and what noise may add. */
        private fun limits(sensor: SensorSpec): IntervalFilterSettings {
            var longest = 0.0
            var error = 0.0
            for (stage in sensor.stages) {
                when (stage) {
                    is SensorStage.Lag -> longest += stage.timeConstant
                    is SensorStage.LimitedLag -> longest += stage.timeConstant
                    is SensorStage.Asymmetric -> longest += maxOf(stage.rising, stage.falling)
                    is SensorStage.TwoPath -> longest += stage.slow
                    is SensorStage.FlowLag -> longest += stage.timeConstant
                    is SensorStage.TemperatureLag -> longest += stage.timeConstant
                    is SensorStage.Combined ->
                        longest += stage.timeConstant * if (stage.slowShare > 0) stage.slowOverFast else 1.0
                    is SensorStage.Delay -> longest += stage.deadTime
                    is SensorStage.Noise -> error += NOISE_REACH * stage.standardDeviation
                    is SensorStage.Wander -> error += NOISE_REACH * stage.standardDeviation
                    is SensorStage.Quantum -> error += stage.step / 2
                    is SensorStage.Backlash -> error += stage.width / 2
                    else -> Unit
                }
            }
            return IntervalFilterSettings(maxOf(SLACK * longest, 1e-3), error)
        }

        /** [sensor] for a field whose 0 is [zero] of the log and whose 1 is [range] more. */
        private fun inUnits(sensor: SensorSpec, zero: Double, range: Double) = SensorSpec(
            sensor.name,
            sensor.stages.map { stage ->
                when (stage) {
                    is SensorStage.Slew -> stage.copy(rate = stage.rate / range)
                    is SensorStage.LimitedLag -> stage.copy(rate = stage.rate / range)
                    is SensorStage.Noise -> stage.copy(standardDeviation = stage.standardDeviation / range)
                    is SensorStage.Wander -> stage.copy(standardDeviation = stage.standardDeviation / range)
                    is SensorStage.Quantum -> stage.copy(step = stage.step / range)
                    is SensorStage.Calibration ->
                        stage.copy(offset = (stage.gain * zero + stage.offset - zero) / range)
                    is SensorStage.Cross -> stage.copy(coefficient = stage.coefficient / range)
                    is SensorStage.Drifting -> stage.copy(rate = stage.rate / range)
                    is SensorStage.Jumps -> stage.copy(offsets = stage.offsets.map { it / range })
                    is SensorStage.Backlash -> stage.copy(width = stage.width / range)
                    is SensorStage.Range ->
                        SensorStage.Range(
                            stage.lower?.let { (it - zero) / range },
                            stage.upper?.let {
                                (it - zero) /
                                    range
                            },
                        )
                    is SensorStage.Outlying -> stage.copy(size = stage.size / range)
                    else -> stage
                }
            },
        )
    }
}
