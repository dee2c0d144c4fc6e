package stillwater.correct

import stillwater.estimate.UndoableSensor
import stillwater.sensor.SensorStage
import stillwater.survey.LagShift
import stillwater.survey.Wording.Companion.digits
import stillwater.survey.Wording.Companion.duration
import stillwater.survey.Wording.Companion.percent

/**
 * Which rows of a [CorrectedLog] are less certain than the others, and why, in words.
 *
 * @param result what it is about. @param unitAfter the readings' unit with a blank before it, or nothing.
 */
internal class CorrectCautions(private val result: CorrectedLog, private val unitAfter: String) {
    /** Whether the sensor can be this log's, one sentence each. */
    val ofSensor: List<String> get() = listOfNotNull(slowest(), worse())

    /** That a given sensor was itself learned, and that nothing is said of how well; null for others. */
    val ofLearning: String?
        get() = if (result.origin == SensorOrigin.GIVEN && result.spec.name.startsWith(CorrectedLog.LEARNED)) {
            "the sensor given was learned from a log and is not known exactly: intervals know nothing of that; those " +
                "in the corrected.csv of `stillwater correct` do"
        } else {
            null
        }

    /** Whether undoing the response sets passes farther apart than they were. */
    val isWorse: Boolean get() = worse() != null

    /** One sentence each. */
    val lines: List<String>
        get() = result.bridged +
            listOfNotNull(outlying(), atEnd(1, "upper", "upward"), atEnd(-1, "lower", "downward"), play())

    /** What to say of a given sensor that is slower than the log is long; null for others. */
    private fun slowest(): String? {
        if (result.origin != SensorOrigin.GIVEN) return null
        val slowest = UndoableSensor.of(result.spec).response.lags.maxOfOrNull { maxOf(it.rising, it.falling) } ?: 0.0
        if (!(slowest > result.statistics.duration)) return null
        return "the sensor's time constant (${duration(slowest)}) is longer than the log " +
            "(${duration(result.statistics.duration)}): what it shows of the water is mostly from before it"
    }

    /** What to say where undoing the response sets passes farther apart than they were; null where it does not. */
    private fun worse(): String? {
        val before = result.before?.opposite?.mean ?: return null
        val found = result.after ?: return null
        val after = found.opposite.mean
        // Nothing was undone, or of nothing there is no share.
        if (result.origin == SensorOrigin.NOTHING || !(before > 0)) return null
        // The water itself differs from side to side, and more so when what the sensor smoothed is undone.
        if (result.before?.isAside == true) return null
        // Of few legs a little more is chance, as the line about them says.
        val much = if (found.scores.size < LagShift.FEWEST_LEGS) WORSE_OF_FEW else WORSE
        if (!(after > much * before)) return null
        val legs = "opposite legs differ by ${percent(after / before - 1)} more than as measured"
        return when (result.origin) {
            SensorOrigin.GIVEN -> "$legs: the sensor given is not this one's"
            else ->
                "$legs: none of the responses that were tried is this sensor's. Do not use the corrected values " +
                    "without another look; diagnose knows more kinds of response, and --sensor takes what it finds"
        }
    }

    private fun outlying(): String? {
        val outlying = result.track.outlying.count { it }
        if (outlying == 0) return null
        if (outlying == 1) {
            return "1 reading stands out from those around it as no water here does and is left out: its row is " +
                "foretold from the others, with an interval that reaches to the reading"
        }
        return "$outlying readings stand out from those around them as no water here does and are left out: their " +
            "rows are foretold from the others, with intervals that reach to the readings$hidden"
    }

    /** Of a sensor that is known to have outliers. */
    private val hidden: String
        get() = if (result.origin == SensorOrigin.GIVEN && result.spec.stages.any { it is SensorStage.Outlying }) {
            ". Smaller ones that do not stand out count as noise and widen all intervals"
        } else {
            ""
        }

    /** How many rows are less certain than the others, in a few words with a comma before them; empty where none are. */
    val inShort: String
        get() {
            val atEnd = result.track.clipped.count { it }
            val outlying = result.track.outlying.count { it }
            return listOfNotNull(
                ", $atEnd at an end of the sensor's range".takeIf { atEnd > 0 },
                ", $outlying left out as outliers".takeIf { outlying > 1 }
                    ?: ", 1 left out as an outlier".takeIf { outlying == 1 },
            ).joinToString("")
        }

    private fun atEnd(side: Int, end: String, open: String): String? {
        val ends = result.unusable.ends
        val rows = ends.indices.filter { ends[it].toInt() == side }
        if (rows.isEmpty()) return null
        // A reading may be beyond a given end by what noise there is behind it.
        val given = endGiven(side)
        val at = digits(given ?: result.series.values[rows.first()])
        val what = if (given != null) "are at the $end end" else "look like the $end end"
        return "${rows.size} of ${ends.size} readings $what of the sensor's range ($at$unitAfter): " +
            "they were not learned from, and of the water there they say one side only, so that the intervals are " +
            "wide $open there and as long after as the sensor remembers"
    }

    /**
     * The end on [side] of the range of the sensor that was given, sensor units; null without one, and where no reading comes
     * to it: another was then found in the readings.
     */
    private fun endGiven(side: Int): Double? {
        if (result.origin != SensorOrigin.GIVEN) return null
        val range = UndoableSensor.of(result.spec).range
        val end = if (side > 0) range.endInclusive else range.start
        val within = RangeEnds.beyondDoubt(result.spec).let { if (side > 0) it.endInclusive else it.start }
        val step = result.statistics.resolution.takeIf { it.isFinite() } ?: 0.0
        return end.takeIf { it.isFinite() && result.series.values.any { side * (it - within) >= -step / 2 } }
    }

    private fun play(): String? {
        val play = UndoableSensor.of(result.spec).play
        if (play == 0.0) return null
        return "hysteresis in the sensor hides changes within ${digits(play)}$unitAfter: that cannot be undone, and " +
            "the intervals were widened by half of it either way"
    }

    private companion object {
        /** Legs that differ by a few percent more may do so by chance. */
        const val WORSE = 1.1
        const val WORSE_OF_FEW = 2.0
    }
}
