package stillwater.correct

import stillwater.estimate.UndoableSensor
import stillwater.survey.Wording.Companion.digits

/**
 * Which rows of a [CorrectedLog] are less certain than the others, and why, in words.
 *
 * @param result what it is about. @param unitAfter the readings' unit with a blank before it, or nothing.
 */
internal class CorrectCautions(private val result: CorrectedLog, private val unitAfter: String) {
    /** One sentence each. */
    val lines: List<String>
        get() = result.bridged +
            listOfNotNull(outlying(), atEnd(1, "upper", "upward"), atEnd(-1, "lower", "downward"), play())

    private fun outlying(): String? {
        val outlying = result.track.outlying.count { it }
        if (outlying == 0) return null
        if (outlying == 1) {
            return "1 reading stands out from those around it as no water here does and is left out: its row is " +
                "foretold from the others, with an interval that reaches to the reading"
        }
        return "$outlying readings stand out from those around them as no water here does and are left out: their " +
            "rows are foretold from the others, with intervals that reach to the readings"
    }

    private fun atEnd(side: Int, end: String, open: String): String? {
        val ends = result.unusable.ends
        val rows = ends.indices.filter { ends[it].toInt() == side }
        if (rows.isEmpty()) return null
        val at = digits(result.series.values[rows.first()])
        val what = if (isEndGiven(side)) "are at the $end end" else "look like the $end end"
        return "${rows.size} of ${ends.size} readings $what of the sensor's range ($at$unitAfter): " +
            "they were not learned from, and of the water there they say one side only, so that the intervals are " +
            "wide $open there and as long after as the sensor remembers"
    }

    /** Whether the sensor was given with an end of its range on [side]; else it was looked for in the readings. */
    private fun isEndGiven(side: Int): Boolean {
        if (result.origin != SensorOrigin.GIVEN) return false
        val range = UndoableSensor.of(result.spec).range
        return (if (side > 0) range.endInclusive else range.start).isFinite()
    }

    private fun play(): String? {
        val play = UndoableSensor.of(result.spec).play
        if (play == 0.0) return null
        return "hysteresis in the sensor hides changes within ${digits(play)}$unitAfter: that cannot be undone, and " +
            "the intervals were widened by half of it either way"
    }
}
