package stillwater.io

import stillwater.estimate.FixSmoother
import stillwater.estimate.LoggedFixes
import stillwater.model.LatLon
import stillwater.model.LocalFrame

/**
 * What a line of a mission's log says came in before its step.
 *
 * @property step time of the step on the mission's clock, s. @property fixes time on that clock, s, latitude and longitude
 * in degrees, each. @property compass time, s, and heading, rad, counter-clockwise from east, each.
 */
internal class MissionInputs(val step: Double, val fixes: List<List<Double>>, val compass: List<List<Double>>)

/**
 * Where readings of a mission's log were taken, from all the fixes and headings in it.
 *
 * The poses that it has besides are what the boat knew at the time: behind where it turned (0.2 to 0.3 s of its way), off by
 * what it was told to allow for. Confined to one thread.
 */
internal class MissionFixes {
    private class Row(val seconds: Double, val numbers: List<Double>)

    private val fixes = ArrayList<Row>()
    private val headings = ArrayList<Row>()
    private val readings = ArrayList<Double>()

    /** Takes the [inputs] of a line of the time [seconds]. */
    fun take(seconds: Double, inputs: MissionInputs) {
        fun keep(row: List<Double>, columns: Int, list: MutableList<Row>) {
            if (row.size < columns || row.any { !it.isFinite() }) return
            list += Row(seconds - inputs.step + row[0], row.drop(1))
        }
        for (fix in inputs.fixes) keep(fix, FIX_COLUMNS, fixes)
        for (heading in inputs.compass) keep(heading, COMPASS_COLUMNS, headings)
    }

    /** Takes the time, s, of the next reading. */
    fun reading(seconds: Double) {
        readings += seconds
    }

    /** The readings' places in [frame]; null where no fix was logged. */
    fun places(frame: LocalFrame): MissionPlaces? {
        val given = ordered(fixes)
        val places = given.mapNotNull { row ->
            val (latitude, longitude) = row.numbers
            val isOnGlobe = latitude in -90.0..90.0 && longitude in -180.0..180.0
            val local = if (isOnGlobe) frame.toLocal(LatLon(latitude, longitude)) else null
            local?.takeIf { FixReach.holds(frame.origin, latitude, longitude, it.x, it.y) }?.let { row.seconds to it }
        }
        if (places.isEmpty()) return null
        val compass = ordered(headings)
        val smoother = FixSmoother(
            LoggedFixes(
                places.map { it.first }.toDoubleArray(),
                places.map { it.second.x }.toDoubleArray(),
                places.map { it.second.y }.toDoubleArray(),
                compass.map { it.seconds }.toDoubleArray(),
                compass.map { it.numbers[0] }.toDoubleArray(),
            ),
        )
        val times = readings.toDoubleArray()
        val (x, y) = smoother.at(times)
        return MissionPlaces(times, x, y, given.size, given.size - places.size + smoother.refused)
    }

    /** [rows] by their times, without those that say again what was said. */
    private fun ordered(rows: List<Row>): List<Row> {
        val kept = ArrayList<Row>()
        for (row in rows.sortedBy { it.seconds }) {
            if (kept.isEmpty() || row.seconds - kept.last().seconds >= SAME) kept += row
        }
        return kept
    }

    private companion object {
        const val FIX_COLUMNS = 3
        const val COMPASS_COLUMNS = 2

        /** Of times nearer than this one is another's rounding, s. */
        const val SAME = 0.02
    }
}

/**
 * Where readings were taken.
 *
 * @property times of the readings, s. @property x metres east, NaN where fixes do not say. @property y metres north.
 * @property fixes that there were. @property refused fixes left out of these.
 */
internal class MissionPlaces(
    val times: DoubleArray,
    val x: DoubleArray,
    val y: DoubleArray,
    val fixes: Int,
    val refused: Int,
) {
    /** What to say of the fixes that were left out; null where there are none. */
    val note: String?
        get() = if (refused == 0) null else "$refused of $fixes fixes: too far off the others, left out"
}
