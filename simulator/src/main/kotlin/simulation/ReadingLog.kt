package stillwater.simulation

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.double
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import stillwater.mission.LogSink
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Position
import stillwater.model.Reading
import java.util.TreeMap

/**
 * Reads a mission's log as it is written: how many readings it has, what became of each, and those that the map took.
 *
 * Counts what stands in the log, independently of the mission's own counters, so that one can be held against the other.
 *
 * @param file takes every line on. Retained.
 */
class ReadingLog(private val file: LogSink) : LogSink {
    private val all = ArrayList<Reading>()
    private val verdicts = TreeMap<String, Long>()

    /** Lines. */
    var lines: Long = 0
        private set

    /** Cells that the boat left without a reading; the estimator is told so. */
    var passes: Long = 0
        private set

    /** Readings that were heard, whatever became of them. */
    val logged: Long get() = verdicts.values.sum()

    /** How often each verdict was given, by its name in the log. */
    val byVerdict: Map<String, Long> get() = verdicts

    /** Readings that the map took, in order. */
    val taken: List<Reading> get() = all

    override fun line(line: String) {
        lines++
        // What the board sent is escaped where the log has it, so that this is the log's own word.
        if ("\"reading\":{\"verdict\":" in line) read(Json.parseToJsonElement(line.substringAfterLast('\t')).jsonObject)
        if ("\t{\"pass\":[" in line) passes++
        file.line(line)
    }

    private fun read(json: JsonObject) {
        val reading = json.getValue("reading").jsonObject
        verdicts.merge(reading.getValue("verdict").jsonPrimitive.content, 1, Long::plus)
        for (element in reading.getValue("taken").jsonArray) {
            val numbers = element.jsonArray.map { it.jsonPrimitive.double }
            val known = Conditions(mapOf(Conditions.POSITION_DEVIATION to numbers[4]))
            all += Reading(BoatTime(numbers[0]), Position(numbers[1], numbers[2]), numbers[3], known)
        }
    }
}
