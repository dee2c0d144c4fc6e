package stillwater.app.mission

import stillwater.field.FieldMap
import stillwater.mission.GivenUp
import stillwater.mission.MissionSpec
import stillwater.mission.MissionState
import stillwater.mission.Wish
import stillwater.model.Position

/**
 * The mission as of one moment; nothing in it changes once it is handed over. Positions in the mission's frame, m.
 *
 * @property spec what it is to do: name, area (`spec.area.corners()` is the fence), home, budget and its unit, probe.
 * @property state what it is about, with the reason where there is one.
 * @property wish what a person wants of it.
 * @property isRecovered whether it was read back from the log of a process that ended; it waits for a person.
 * @property isOver whether it is done and its log closed: only a new mission can follow.
 * @property map what is believed, cell by cell: estimate, bounds, readings.
 * @property position where the boat is believed to be; null where not known.
 * @property track where it was, oldest first, thinned out as it grows.
 * @property plan where it means to go, next first.
 * @property used of the budget, in its unit.
 * @property trace the last readings, oldest first.
 * @property counts what became of the readings.
 * @property log where it is written down; null before it was first armed.
 * @property probeSilence time since a boat under way has heard its probe, s, where that is longer than any probe that
 *   works is silent; null elsewhere.
 * @property givenUp where the boat did not get in.
 * @property restsFor time for which a boat that was held up on every way home rests before it tries again, s; 0 where
 *   it does not.
 * @param readAt when each cell was last read, s on the boat's clock; NaN where it never was. Retained, not modified.
 * @param now of the report, s on the same clock.
 */
class MissionReport(
    val spec: MissionSpec,
    val state: MissionState,
    val wish: Wish,
    val isRecovered: Boolean,
    val isOver: Boolean,
    val map: FieldMap,
    val position: Position?,
    val track: List<Position>,
    val plan: List<Position>,
    val used: Double,
    val trace: List<TracePoint>,
    val counts: ReadingCounts,
    val log: LogReport?,
    val probeSilence: Double?,
    val givenUp: GivenUp,
    val restsFor: Double,
    private val readAt: DoubleArray,
    private val now: Double,
) {
    /** Whether it was started and is not over. */
    val isUnderWay: Boolean get() = state != MissionState.Idle && !isOver

    /** What may be used of the budget, in its unit. */
    val budget: Double get() = spec.budget.metres ?: spec.budget.seconds ?: 0.0

    /** The same with [log], which has moved on. */
    internal fun withLog(log: LogReport): MissionReport =
        MissionReport(
            spec, state, wish, isRecovered, isOver, map, position, track, plan, used, trace, counts, log, probeSilence,
            givenUp, restsFor, readAt, now,
        )

    /** Time since the last reading in [cell], s; null where there was none, or none since the app was started. */
    fun ageOf(cell: Int): Double? = readAt[cell].takeIf { it.isFinite() }?.let { now - it }
}

/**
 * One reading, and what was believed after it where it was taken.
 *
 * @property seconds when it was sampled, s on the boat's clock.
 * @property reading the probe's own word, sensor units.
 * @property gradient its change, sensor units/s, over the last readings; null before there are enough.
 * @property cell of the map that it was taken in; null where that is in none.
 * @property corrected value believed in the cell, sensor units; null where the reading lay in no cell.
 * @property lower bound of it; null likewise.
 * @property upper bound of it; null likewise.
 */
data class TracePoint(
    val seconds: Double,
    val reading: Double,
    val gradient: Double?,
    val cell: Int?,
    val corrected: Double?,
    val lower: Double?,
    val upper: Double?,
)

/**
 * What became of the probe's readings since the mission was armed; [received] is the sum of the others.
 *
 * @property received by the mission.
 * @property taken into the map.
 * @property waiting for the next one to confirm a jump, or to differ.
 * @property outOfRange of what the water can have.
 * @property unconfirmed jumps that the next reading did not confirm.
 * @property stuck too many that were the same.
 * @property withoutPlace no number, or the boat's place was not known.
 * @property unreadable lines, or parts of them, that were not understood; not among [received].
 * @property atBorders of [taken], those so near to a cell's border that they told of the probe but of no cell.
 */
data class ReadingCounts(
    val received: Long = 0,
    val taken: Long = 0,
    val waiting: Long = 0,
    val outOfRange: Long = 0,
    val unconfirmed: Long = 0,
    val stuck: Long = 0,
    val withoutPlace: Long = 0,
    val unreadable: Long = 0,
    val atBorders: Long = 0,
)

/**
 * The file that the mission is written to.
 *
 * @property name of the file.
 * @property lines handed to the log.
 * @property written of [lines], those that are on the disk.
 * @property lost of [lines], those that never will be: the disk took nothing for too long.
 * @property isClosed whether it is complete.
 * @property problem why it can't be written; null while it can.
 */
data class LogReport(
    val name: String,
    val lines: Long = 0,
    val written: Long = 0,
    val lost: Long = 0,
    val isClosed: Boolean = false,
    val problem: LogProblem? = null,
)

/**
 * Why a log can't be written.
 *
 * @property words more of it, in the system's words; null where [reason] says it all.
 */
data class LogProblem(val reason: Reason, val words: String? = null) {
    /** What can stand against a log. */
    enum class Reason {
        /** The system did not write it; the words say why. */
        NOT_WRITTEN,

        /** Next to no room is left. */
        LITTLE_ROOM,

        /** The folder of the logs is not there and cannot be made. */
        NO_FOLDER,
    }
}

/**
 * A mission that was, as a list shows it; `BoatService.logOf` is its file.
 *
 * @property name of the log's file.
 * @property bytes it takes.
 * @property isComplete whether the mission was ended, rather than cut off.
 * @property epochMillis when it was last written, Unix time, ms.
 */
data class PastMission(val name: String, val bytes: Long, val isComplete: Boolean, val epochMillis: Long)
