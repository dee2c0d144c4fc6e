package stillwater.estimate

import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import stillwater.sensor.TimeConstant
import kotlin.math.abs
import kotlin.math.hypot
import kotlin.math.sqrt

/**
 * A sensor spec in the form in which a whole track can be corrected for it.
 *
 * A lag whose time constant τ(c) depends on conditions is a constant lag τ₀ in a time that runs τ₀ / τ(c) as fast:
 * τ ds/dt = ψ − s is τ₀ ds/dw = ψ − s for dw = τ₀ / τ dt. So such a track is corrected in that time.
 *
 * @property response how it follows. @property gain dimensionless, of all stages after the response.
 * @property needs names of the conditions without which it cannot be undone.
 * @property range between which readings are shown, sensor units; infinite where it has no end. Readings at an end say
 * one side only.
 * @property wander noise that wanders, sensor units of the readings before all gains; null for none.
 * @property noise standard deviation of its white noise, sensor units of the readings before all gains; 0 where none is
 *   stated. @property play width of the dead band within which the truth may move unseen, sensor units; 0 for none.
 */
public class UndoableSensor private constructor(
    public val response: Response,
    private val shown: List<SensorStage>,
    private val timeConstant: TimeConstant?,
    public val needs: Set<String>,
    public val range: ClosedFloatingPointRange<Double> = ENDLESS,
    public val play: Double = 0.0,
    public val wander: SensorStage.Wander? = null,
    public val noise: Double = 0.0,
) {
    public val gain: Double = gainOf(shown)

    /**
     * [series] as a sensor with the response alone would have read it, in the time in which that is constant.
     *
     * @param conditions columns by name, each as long as [series], NaN where unknown; those of [needs] are there. Not
     *   modified.
     */
    public fun calibrated(series: TrackSeries, conditions: Map<String, DoubleArray> = emptyMap()): TrackSeries {
        if (shown.isEmpty() && timeConstant == null) return series
        val values = series.values.copyOf()
        for (stage in shown.reversed()) {
            for (i in values.indices) values[i] = before(stage, values[i], series, i, conditions)
        }
        val scaled = series.withValues(values)
        return if (timeConstant == null) scaled else scaled.retimed(times(series, conditions))
    }

    private fun before(
        stage: SensorStage,
        value: Double,
        series: TrackSeries,
        i: Int,
        conditions: Map<String, DoubleArray>,
    ): Double {
        val age = series.times[i] - series.times[0]
        return when (stage) {
            is SensorStage.Calibration -> (value - stage.offset) / stage.gain
            is SensorStage.Drifting -> value - stage.rate * age
            is SensorStage.Jumps ->
                value - (stage.times.indexOfLast { it < age }.takeIf { it >= 0 }?.let { stage.offsets[it] } ?: 0.0)
            is SensorStage.Cross -> {
                val added = stage.coefficient * (conditions.getValue(stage.condition)[i] - stage.reference)
                // Where the condition is unknown the sensor shows nothing of it.
                if (added.isFinite()) value - added else value
            }
            else -> value
        }
    }

    private fun times(series: TrackSeries, conditions: Map<String, DoubleArray>): DoubleArray {
        val changing = timeConstant ?: return series.times
        val usual = changing.under(Conditions.NONE)
        val times = series.times.copyOf()
        for (i in 1 until times.size) {
            val now = Conditions(needs.associateWith { conditions.getValue(it)[i] })
            times[i] = times[i - 1] + (series.times[i] - series.times[i - 1]) * usual / changing.under(now)
        }
        return times
    }

    /** What is gathered while the stages are read in order. */
    private class Gathering {
        var response = Response()
        var changing: TimeConstant? = null
        val shown = ArrayList<SensorStage>()
        var range = ENDLESS
        var play = 0.0
        var wander: SensorStage.Wander? = null
        var noise = 0.0
        val needs = LinkedHashSet<String>()

        /** The gains so far, dimensionless. */
        val gain: Double get() = gainOf(shown)

        /** Several that wander are as one that has the variance of all, for as long as the longest. */
        fun wanders(stage: SensorStage.Wander) {
            if (stage.standardDeviation == 0.0) return
            val own = stage.copy(standardDeviation = stage.standardDeviation / abs(gain))
            wander = wander?.let {
                SensorStage.Wander(
                    hypot(it.standardDeviation, own.standardDeviation),
                    maxOf(it.correlationTime, own.correlationTime),
                )
            } ?: own
        }

        fun sounds(stage: SensorStage.Noise) {
            noise = hypot(noise, stage.standardDeviation / abs(gain))
        }

        fun follows(change: Response) {
            require(shown.isEmpty()) {
                "a stage that takes time after a gain, an offset or what else is added cannot be undone"
            }
            require(range == ENDLESS) {
                "a stage that takes time after a saturation cannot be undone: the readings do not show when it was " +
                    "at its end"
            }
            response = change
            // A lag smooths what noise comes before it.
            noise = 0.0
        }

        fun changes(timeConstant: TimeConstant, vararg conditions: String) {
            require(response == Response()) { WITH_OTHERS }
            changing = timeConstant
            needs += conditions
        }

        /** What is added to the readings once they end is added to the ends. */
        fun shows(stage: SensorStage) {
            shown += stage
            if (range == ENDLESS) return
            range = if (stage is SensorStage.Calibration) {
                val ends = listOf(range.start, range.endInclusive).map { stage.gain * it + stage.offset }
                ends.min()..ends.max()
            } else {
                // They move; those that readings show are found in the readings.
                ENDLESS
            }
        }

        fun ends(stage: SensorStage.Range) {
            val lower = stage.lower ?: Double.NEGATIVE_INFINITY
            val upper = stage.upper ?: Double.POSITIVE_INFINITY
            range = maxOf(lower, range.start)..minOf(upper, range.endInclusive)
        }

        fun combined(stage: SensorStage.Combined) {
            val isChanging = stage.exponent != 0.0 || stage.relativeChange != 0.0
            if (isChanging) {
                val flow = TimeConstant.ofFlow(stage.timeConstant, stage.referenceSpeed, stage.exponent)
                val warmth = TimeConstant.ofTemperature(1.0, stage.referenceTemperature, stage.relativeChange)
                val names = listOf(Conditions.SPEED, Conditions.TEMPERATURE)
                    .zip(listOf(stage.exponent, stage.relativeChange)).filter { it.second != 0.0 }.map { it.first }
                changes({ flow.under(it) * warmth.under(it) }, *names.toTypedArray())
            }
            val ratio = sqrt(stage.risingOverFalling)
            val fast = ResponseLag(stage.timeConstant * ratio, stage.timeConstant / ratio)
            beside(fast, stage.timeConstant * stage.slowOverFast, stage.slowShare)
        }

        fun beside(fast: ResponseLag, slow: Double, share: Double) {
            // Two lags without a share would be in a row.
            if (share == 0.0) return follows(response.copy(lags = response.lags + fast))
            require(response.lags.isEmpty()) { "two paths beside another lag cannot be undone" }
            follows(response.copy(lags = listOf(fast, ResponseLag(slow)), slowShare = share))
        }
    }

    public companion object {
        /** A range without ends. */
        public val ENDLESS: ClosedFloatingPointRange<Double> = Double.NEGATIVE_INFINITY..Double.POSITIVE_INFINITY

        private fun gainOf(stages: List<SensorStage>) =
            stages.filterIsInstance<SensorStage.Calibration>().fold(1.0) { product, stage -> product * stage.gain }

        private const val TWO_LIMITS = "two limits of the rate cannot be undone"
        private const val WITH_OTHERS =
            "a lag that changes with conditions cannot be undone beside a dead time or another lag"

        /**
         * [spec] as it can be undone: dead times, up to two lags or two paths, or one lag that changes with conditions,
         * and a slew limit, in the lag or behind it; then gains, offsets, steps of them, drifts and cross-sensitivities, with noise,
         * quantisation and outliers anywhere. Of a hysteresis and of the ends of a range what can be known is kept:
         * [play] and [range].
         *
         * @throws UnfitStage if [spec] has a stage that cannot be undone.
         */
        public fun of(spec: SensorSpec): UndoableSensor {
            val found = Gathering()
            spec.stages.forEachIndexed { index, stage ->
                try {
                    take(stage, found)
                    require(!isMixed(found)) { WITH_OTHERS }
                } catch (wrong: IllegalArgumentException) {
                    throw UnfitStage(index, wrong)
                }
            }
            val range = found.range
            return UndoableSensor(
                found.response,
                found.shown,
                found.changing,
                found.needs,
                range,
                found.play,
                found.wander,
                found.noise,
            )
        }

        /** Whether a lag that changes with conditions stands beside something else that takes time. */
        private fun isMixed(found: Gathering) = found.changing != null &&
            (found.response.deadTime > 0 || found.response.slewRate.isFinite() || !isAlone(found.response))

        private fun isAlone(response: Response) = response.lags.size == 1 || response.slowShare > 0

        private fun take(stage: SensorStage, found: Gathering) {
            val response = found.response
            fun lag(lag: ResponseLag) {
                require(response.slowShare == 0.0) { "two paths beside another lag cannot be undone" }
                found.follows(response.copy(lags = response.lags + lag))
            }
            when (stage) {
                // Outliers are found in the readings one by one.
                is SensorStage.Quantum, is SensorStage.Outlying -> Unit
                is SensorStage.Noise -> found.sounds(stage)
                is SensorStage.Wander -> found.wanders(stage)
                is SensorStage.Delay -> found.follows(response.copy(deadTime = response.deadTime + stage.deadTime))
                is SensorStage.Lag -> lag(ResponseLag(stage.timeConstant))
                is SensorStage.LimitedLag -> {
                    require(response.slewRate.isInfinite()) { TWO_LIMITS }
                    lag(ResponseLag(stage.timeConstant))
                    found.follows(found.response.copy(slewRate = stage.rate, isLimitWithin = true))
                }
                is SensorStage.Asymmetric -> lag(ResponseLag(stage.rising, stage.falling))
                is SensorStage.Slew -> {
                    require(response.slewRate.isInfinite()) { TWO_LIMITS }
                    found.follows(response.copy(slewRate = stage.rate))
                }
                is SensorStage.TwoPath -> found.beside(ResponseLag(stage.fast), stage.slow, stage.slowShare)
                is SensorStage.FlowLag -> {
                    val flow = TimeConstant.ofFlow(stage.timeConstant, stage.referenceSpeed, stage.exponent)
                    found.changes(flow, Conditions.SPEED)
                    lag(ResponseLag(stage.timeConstant))
                }
                is SensorStage.TemperatureLag -> {
                    val warmth = TimeConstant.ofTemperature(
                        stage.timeConstant,
                        stage.referenceTemperature,
                        stage.relativeChange,
                    )
                    found.changes(warmth, Conditions.TEMPERATURE)
                    lag(ResponseLag(stage.timeConstant))
                }
                is SensorStage.Combined -> found.combined(stage)
                is SensorStage.Calibration, is SensorStage.Drifting, is SensorStage.Jumps -> found.shows(stage)
                is SensorStage.Cross -> {
                    found.shows(stage)
                    found.needs += stage.condition
                }
                is SensorStage.Range -> found.ends(stage)
                is SensorStage.Backlash -> found.play += stage.width / abs(found.gain)
            }
        }
    }
}
