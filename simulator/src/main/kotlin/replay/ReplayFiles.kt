package stillwater.replay

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonNull
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.buildJsonObject
import kotlinx.serialization.json.put
import kotlinx.serialization.json.putJsonObject
import stillwater.drive.MapCautions
import stillwater.drive.MissionMapFiles
import stillwater.drive.Resumption
import stillwater.mission.readingsTaken
import stillwater.report.CsvTable
import stillwater.report.OutputDirectory
import stillwater.report.counted
import stillwater.run.label
import stillwater.wire.Malformed
import java.util.Locale

/**
 * Writes what a replay came to: `cells.csv`, `decisions.csv`, `replay.json`, `mission.json`, `mission.txt` and the
 * figure.
 */
internal class ReplayFiles(private val replayed: Replayed) {
    /**
     * Writes them into [directory]; the figure only where it [isDrawn]. Answers a warning where something is missing.
     */
    fun write(directory: OutputDirectory, isDrawn: Boolean): List<String> {
        directory.stream("decisions.csv") { out ->
            CsvTable(out, listOf("time_s", "state", "why", "x_m", "y_m")).use { table ->
                for (it in replayed.decisions.changes) {
                    table.row(it.time, it.state, it.why.ifEmpty { null }, it.position?.x, it.position?.y)
                }
            }
        }
        directory.write("replay.json", json())
        directory.write("mission.json", PRETTY.encodeToString(JsonObject.serializer(), specJson()) + "\n")
        directory.stream("mission.txt") { replayed.log.copyTo(it) }
        return MissionMapFiles.write(directory, replayed.spec, replayed.map, isDrawn)
    }

    /** What a person should know of the replay and its map, one sentence each. */
    val warnings: List<String> get() = replayed.warnings + MapCautions.of(replayed.mission)

    /** The summary for machines. */
    fun json(): String {
        val json = buildJsonObject {
            put("format", replayed.format)
            put("mission", replayed.spec.name)
            put("quantity", replayed.spec.probe.quantity.label)
            put("unit", replayed.spec.probe.quantity.unit)
            put("estimator", replayed.spec.estimator.label)
            put("ended", replayed.mission.state.word)
            put("why", Decisions.why(replayed.mission.state))
            put("steps", replayed.decisions.steps)
            put("steps_with_motors_running", replayed.decisions.driven)
            putJsonObject("seconds_in_state") { replayed.decisions.secondsIn.forEach { (name, s) -> put(name, s) } }
            putJsonObject("lines") { replayed.lines.counts.forEach { (name, count) -> put(name, count) } }
            putJsonObject("lines_not_understood") {
                replayed.notUnderstood.counts.forEach { (expected, count) -> put(expected, count) }
            }
            putJsonObject("first_line_not_understood") {
                replayed.notUnderstood.first.forEach { (expected, line) -> put(expected, line) }
            }
            putJsonObject("board_lines_not_understood") { malformed().forEach { (name, count) -> put(name, count) } }
            val gate = replayed.mission.readings
            putJsonObject("readings") {
                put("taken", replayed.mission.readingsTaken)
                put("taken_before_it_was_taken_up_again", replayed.mission.readingsBefore)
                put("taken_but_at_borders", replayed.mission.unplaced)
                put("out_of_range", gate.outOfRange)
                put("alone", gate.lone)
                put("stuck", gate.stuck)
                put("waiting", gate.waiting)
                put("without_value_or_place", gate.withoutValueOrPlace)
            }
            put("fixes_refused", replayed.mission.refusedFixes)
            val compared = replayed.asRecorded
            put("steps_otherwise_than_recorded", compared?.let { JsonPrimitive(it.differingSteps) } ?: JsonNull)
            put("same_map_as_recorded", compared?.let { JsonPrimitive(it.isSameMap) } ?: JsonNull)
            put("warnings", JsonArray(warnings.map(::JsonPrimitive)))
        }
        return PRETTY.encodeToString(JsonObject.serializer(), json) + "\n"
    }

    /** The summary for people, line by line. */
    fun lines(): List<String> {
        val decisions = replayed.decisions
        val gate = replayed.mission.readings
        val first = replayed.notUnderstood.first
        val unread = replayed.notUnderstood.counts.map { (name, count) ->
            "$count (expected $name; ${if (count == 1L) "" else "the first "}at line ${first[name]})"
        } +
            malformed().map { (name, count) -> "$count of the board ($name)" }
        val why = Decisions.why(replayed.mission.state)
        val steps = counted(decisions.steps, "step")
        val changes = counted(decisions.changes.size, "change")
        val fixes = counted(replayed.mission.refusedFixes, "fix", "fixes")
        return listOfNotNull(
            "${replayed.format}, $steps; at its end ${replayed.mission.state.word} $why".trimEnd(),
            "probe: " + replayed.probe,
            "lines: " + replayed.lines.counts.entries.joinToString(", ") { "${it.value} ${kind(it.key, it.value)}" },
            "not understood: " + if (unread.isEmpty()) "none" else unread.joinToString(", "),
            "states: " +
                decisions.secondsIn.entries.joinToString(", ") { "%s %.1f s".format(Locale.ROOT, it.key, it.value) } +
                "; $changes, motors running in ${counted(decisions.driven, "step")}",
            "readings: ${replayed.mission.readingsTaken} taken${Resumption.of(
                replayed.mission,
            )}, ${gate.outOfRange} out of range, ${gate.lone} alone, " +
                "${gate.stuck} stuck, ${gate.waiting} waiting, " +
                "${gate.withoutValueOrPlace} without a place; $fixes refused",
            replayed.asRecorded?.let(::compared),
        )
    }

    private fun compared(same: AsRecorded): String {
        val differing = counted(same.differingSteps, "step")
        val steps = if (same.differingSteps == 0L) {
            "every step as recorded"
        } else {
            "$differing otherwise than recorded, the first at ${same.firstDifference} s"
        }
        return "$steps; the map is ${if (same.isSameMap) "" else "not "}that of the recorded readings, bit for bit"
    }

    /** The kinds are plurals, and keys in the JSON. */
    private fun kind(words: String, count: Long) = if (count == 1L) SINGULAR[words] ?: words else words

    private fun malformed() = Malformed.entries.associate { kind ->
        kind.name.lowercase().replace('_', '-') to replayed.mission.board.malformed(kind)
    }.filterValues { it > 0 }

    private fun specJson() = Json.parseToJsonElement(replayed.spec.toJson()) as JsonObject

    private companion object {
        val PRETTY = Json { prettyPrint = true }
        val SINGULAR = mapOf(
            "beginnings" to "beginning",
            "steps" to "step",
            "readings" to "reading",
            "other sensors" to "other sensor",
            "poses" to "pose",
            "cells left without a reading" to "cell left without a reading",
            "poses before the first fix" to "pose before the first fix",
            "poses said again" to "pose said again",
        )
    }
}
