package stillwater.estimate

import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage

/**
 * A sensor spec in the form in which a whole track can be corrected for it.
 *
 * @property response how it follows. @property gain dimensionless. @property offset sensor units; readings are gain ·
 * field
 *   + offset. @property drift sensor units/s from the first reading on.
 */
public class UndoableSensor private constructor(
    public val response: Response,
    public val gain: Double,
    public val offset: Double,
    public val drift: Double,
) {
    /** [series] as a sensor without gain, offset and drift would have read it. */
    public fun calibrated(series: TrackSeries): TrackSeries {
        if (gain == 1.0 && offset == 0.0 && drift == 0.0) return series
        val values = DoubleArray(series.size) {
            (series.values[it] - offset - drift * (series.times[it] - series.times[0])) / gain
        }
        return TrackSeries(series.times, series.xs, series.ys, values)
    }

    public companion object {
        /**
         * [spec] as it can be undone: dead times, up to two lags, a slew limit, then gains, offsets and drifts, with
         * noise and
         * quantisation anywhere.
         *
         * @throws IllegalArgumentException if [spec] has a stage that cannot be undone; the message names it.
         */
        public fun of(spec: SensorSpec): UndoableSensor {
            var response = Response()
            var gain = 1.0
            var offset = 0.0
            var drift = 0.0
            for (stage in spec.stages) {
                val isStatic = gain != 1.0 || offset != 0.0 || drift != 0.0
                fun with(change: Response) = change.also {
                    require(!isStatic) { "a stage that takes time after a gain, offset or drift cannot be undone" }
                }
                when (stage) {
                    is SensorStage.Noise, is SensorStage.Quantum -> Unit
                    is SensorStage.Delay ->
                        response =
                            with(response.copy(deadTime = response.deadTime + stage.deadTime))
                    is SensorStage.Lag -> response = with(response.and(ResponseLag(stage.timeConstant)))
                    is SensorStage.Asymmetric -> response = with(response.and(ResponseLag(stage.rising, stage.falling)))
                    is SensorStage.Slew -> response = with(response.copy(slewRate = stage.rate))
                    is SensorStage.Calibration -> {
                        require(stage.gain != 0.0) { "a gain of 0 cannot be undone" }
                        gain *= stage.gain
                        offset = offset * stage.gain + stage.offset
                        drift *= stage.gain
                    }
                    is SensorStage.Drifting -> drift += stage.rate
                    else -> throw IllegalArgumentException(
                        "stages dead-time, first-order-lag, asymmetric-lag, slew-limit, gain-offset, drift, noise " +
                            "and " +
                            "quantisation can be undone, ${stage::class.simpleName} cannot",
                    )
                }
            }
            return UndoableSensor(response, gain, offset, drift)
        }

        private fun Response.and(lag: ResponseLag) = copy(lags = lags + lag)
    }
}
