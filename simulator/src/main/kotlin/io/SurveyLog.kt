package stillwater.io

import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.LocalFrame
import stillwater.model.Position
import stillwater.model.Reading
import java.nio.file.Path

/** Takes the readings of a log one by one, in the order of their times. */
fun interface ReadingSink {
    /**
     * Takes one reading; see [stillwater.estimate.FieldEstimator.update] for the same parameters.
     *
     * @param time when the sample was taken, on the log's clock.
     * @param x metres east in the log's frame.
     * @param y metres north in the log's frame; 0 in a log of a straight transect.
     * @param value what the sensor said, sensor units.
     * @param conditions what else was logged in the same row.
     */
    fun take(time: BoatTime, x: Double, y: Double, value: Double, conditions: Conditions)
}

/**
 * What one pass over a log came to.
 *
 * @property readings readings handed on.
 * @property skipped rows or lines that gave none although they could have, by reason.
 * @property warnings what the user should know of those and of the positions, one sentence each, without a full stop.
 * @property jumps steps between positions that are too fast for a boat, of which [warnings] tells.
 */
data class LogPass(
    val readings: Long,
    val skipped: Map<String, Long>,
    val warnings: List<String> = emptyList(),
    val jumps: Long = 0,
)

/**
 * A log on disk that yields the readings of one sensor, as often as it is read, in constant memory.
 *
 * Readings come in strictly growing time and hold finite numbers only. Confined to one thread.
 */
interface SurveyLog {
    /** The file. */
    val file: Path

    /** What kind of log it turned out to be, for people. */
    val format: String

    /** Name of the column or sensor that gives the values. */
    val quantity: String

    /** Name of what x measures, where it is not metres east. */
    val xName: String

    /** Whether positions have only an x: a transect or a vertical profile. */
    val oneDimensional: Boolean

    /** Whether readings have places; else all are at 0, 0. */
    val hasPlaces: Boolean get() = true

    /** What positions are counted in: m, or the units of the only coordinate of a transect. */
    val lengthUnit: String get() = if (oneDimensional) "units of $xName" else "m"

    /** What speeds are counted in. */
    val speedUnit: String get() = if (oneDimensional) "$lengthUnit per s" else "m/s"

    /** Frame the positions are in; null before the first [read], and for logs without latitudes. */
    val frame: LocalFrame?

    /** The log as it stands in its file, where this takes it otherwise. */
    val asWritten: SurveyLog get() = this

    /**
     * Hands every reading to [sink].
     *
     * @param progress told now and then how many bytes of the file have been read.
     * @throws LogProblem at the first row that cannot be used, unless bad rows are to be skipped, and where the log
     *   as a whole is of no use.
     */
    fun read(progress: (Long) -> Unit = {}, sink: ReadingSink): LogPass

    companion object {
        /**
         * Opens the log [file], telling its format by its content.
         *
         * @throws LogProblem if there is no such log or [choice] does not fit it.
         */
        fun open(file: Path, choice: LogChoice = LogChoice()): SurveyLog {
            val content = LogContent.of(file)
            return when (val version = content.platypus) {
                null -> CsvOpening.open(content, choice)
                else -> PlatypusLog.open(content, version, choice)
            }
        }
    }
}

/** All readings of a log that fits into memory. */
fun SurveyLog.readings(): List<Reading> = buildList {
    read { time, x, y, value, conditions -> add(Reading(time, Position(x, y), value, conditions)) }
}
