package stillwater.replay

import stillwater.field.FieldMap
import stillwater.mission.Mission
import stillwater.mission.MissionSpec
import stillwater.run.withUnit

/**
 * What a replay came to.
 *
 * @property spec the mission that was replayed. @property format of the log, for people.
 * @property mission after its last step. @property decisions it took.
 * @property log its own log.
 * @property lines of the recorded log, by what they hold. @property notUnderstood lines, by what was expected of them.
 * @property asRecorded how the replay compares with what the log says was decided; null where the log does not say.
 * @property warnings what a person should know of it. @param probe what the map is of, where more is to be said of it
 *   than its quantity.
 */
internal class Replayed(
    val spec: MissionSpec,
    val format: String,
    val mission: Mission,
    val decisions: Decisions,
    val log: LineSpool,
    val lines: LineCounts,
    val notUnderstood: LineCounts,
    val asRecorded: AsRecorded?,
    val warnings: List<String>,
    probe: String? = null,
) {
    /** What the map is of, for people. */
    val probe: String = probe ?: spec.probe.quantity.withUnit

    /** The map that the replay made. */
    val map: FieldMap get() = mission.map
}

/**
 * A replay held against its own log.
 *
 * @property differingSteps steps whose state or drive the log has otherwise. @property firstDifference time of the
 *   first, s; NaN where there is none. @property isSameMap whether the map is that of the recorded readings, bit for
 *   bit.
 */
internal data class AsRecorded(val differingSteps: Long, val firstDifference: Double, val isSameMap: Boolean)

/** Whether two maps are the same, bit for bit. */
internal fun isSame(one: FieldMap, other: FieldMap): Boolean = one.grid == other.grid &&
    (0 until one.grid.size).all { cell ->
        one.value(cell).toRawBits() == other.value(cell).toRawBits() &&
            one.lower(cell).toRawBits() == other.lower(cell).toRawBits() &&
            one.upper(cell).toRawBits() == other.upper(cell).toRawBits() &&
            one.visits(cell) == other.visits(cell) &&
            one.readings(cell) == other.readings(cell)
    }
