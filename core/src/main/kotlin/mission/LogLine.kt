package stillwater.mission

import kotlinx.serialization.SerializationException
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonObject
import stillwater.model.JsonForm

/** A line as [MissionLog] writes it: `<ms>` tab `<level>` tab `{json}`. */
public object LogLine {
    /** The object in [line]; null where there is none, or one that is nested deeper than any log's. Never throws. */
    public fun content(line: String): JsonObject? {
        val start = line.indexOf('\t', line.indexOf('\t') + 1)
        return if (start < 0) null else objectOrNull(line.substring(start + 1))
    }

    /** The object that [json] is; null where it is none, or one that is nested deeper than any log's. Never throws. */
    public fun objectOrNull(json: String): JsonObject? = try {
        // The parser descends by calling itself.
        if (JsonForm.isShallow(json)) Json.parseToJsonElement(json) as? JsonObject else null
    } catch (_: SerializationException) {
        null
    }
}
