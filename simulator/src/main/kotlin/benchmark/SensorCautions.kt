package stillwater.benchmark

import stillwater.model.Interval
import stillwater.run.ExperimentSettings
import stillwater.sensor.SensorStage
import stillwater.survey.Wording.Companion.digits
import stillwater.world.SimulatedConditions
import kotlin.math.abs

/** What of a sensor has no effect, or not the one meant, in a benchmark's fields. */
internal object SensorCautions {
    /** Of [settings]' sensor, one sentence each. */
    fun of(settings: ExperimentSettings): List<String> =
        listOfNotNull(SimulatedConditions.missing(settings.sensor), unfit(settings))

    /** That numbers of the sensor are those of another water, such as a log's; null where they may be the fields'. */
    private fun unfit(settings: ExperimentSettings): String? {
        var shown = settings.prior
        val unfit = settings.sensor.stages.mapNotNull { stage ->
            val words = Unfit(shown, settings).words(stage)
            if (stage is SensorStage.Calibration) {
                val ends = listOf(shown.lower, shown.upper).map(stage::settled)
                shown = Interval(ends.min(), ends.max())
            }
            words
        }
        if (unfit.isEmpty()) return null
        val range = "${digits(settings.prior.lower)} to ${digits(settings.prior.upper)}"
        return "the water of the fields is within $range, and numbers of the " +
            "sensor are not made for that: ${unfit.joinToString("; ")}. Nothing was scaled: numbers in sensor units " +
            "have to be the fields'"
    }

    /** Which numbers of a stage cannot be meant for readings within [shown]. */
    private class Unfit(private val shown: Interval, private val settings: ExperimentSettings) {
        fun words(stage: SensorStage): String? = when (stage) {
            is SensorStage.Range -> ends(stage)
            is SensorStage.Quantum -> much("steps of", stage.step, COARSE)
            is SensorStage.Noise -> much("noise of", stage.standardDeviation, WILD)
            is SensorStage.Wander -> much("noise of", stage.standardDeviation, WILD)
            is SensorStage.Backlash -> much("hysteresis of", stage.width, WILD)
            is SensorStage.Outlying -> much("outliers of", stage.size, BEYOND)
            is SensorStage.Calibration -> much("an offset of", stage.offset, BEYOND)
            is SensorStage.Jumps -> much("an offset of", stage.offsets.maxByOrNull { abs(it) } ?: 0.0, BEYOND)
            is SensorStage.Drifting -> much("in the time of a trial a drift of", stage.rate * time, BEYOND)
            is SensorStage.Slew -> rate(stage.rate)
            is SensorStage.LimitedLag -> rate(stage.rate)
            else -> null
        }

        /** Of a whole trial, s. */
        private val time get() = settings.moves.toDouble() * settings.samplesPerMove * settings.period

        /** That [size] is more than [most] of the range. */
        private fun much(name: String, size: Double, most: Double): String? {
            val share = abs(size) / shown.width
            if (!(share > most)) return null
            val isBeyond = share > BEYOND
            val times = if (isBeyond) "${digits(share, 2)} times the range" else "${digits(100 * share, 2)} % of it"
            return "$name ${digits(size)} would be $times"
        }

        private fun ends(range: SensorStage.Range): String? {
            val upper = range.upper ?: Double.POSITIVE_INFINITY
            val lower = range.lower ?: Double.NEGATIVE_INFINITY
            if (upper < shown.lower) return "above ${digits(upper)} it ends, and shows nothing of them"
            if (lower > shown.upper) return "below ${digits(lower)} it ends, and shows nothing of them"
            val beyond = listOf(lower, upper).filter { it.isFinite() && (it < shown.lower || it > shown.upper) }
            return when (beyond.size) {
                0 -> null
                1 -> "the end of its range at ${digits(beyond.single())} is outside and has no effect"
                else -> "the ends of its range at ${digits(lower)} and ${digits(upper)} are outside and have no effect"
            }
        }

        /** That a reading may pass over the whole range within a limit of [rate], sensor units/s. */
        private fun rate(rate: Double): String? {
            if (!(rate * settings.period > shown.width)) return null
            return "a rate of ${digits(rate)} a second is the whole range between two readings and limits nothing"
        }
    }

    /** Shares of the range: steps that leave hardly any water, sizes that hide most of it, and more than all of it. */
    private const val COARSE = 0.05
    private const val WILD = 0.5
    private const val BEYOND = 1.0
}
