package stillwater.drive

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import stillwater.mission.MissionSpec

/** In which keys two missions are not the same, in words. */
internal object MissionDifference {
    private const val MOST_NAMED = 3
    private const val UNSAID = "left out"

    /** What [found] has in place of what [wanted] has, the first keys of it; empty where they are the same. */
    fun words(wanted: MissionSpec, found: MissionSpec): String {
        val keys = ArrayList<String>()
        compare("", Json.parseToJsonElement(wanted.toJson()), Json.parseToJsonElement(found.toJson()), keys)
        val more = if (keys.size > MOST_NAMED) ", and ${keys.size - MOST_NAMED} more" else ""
        return keys.take(MOST_NAMED).joinToString() + more
    }

    private fun compare(path: String, wanted: JsonElement?, found: JsonElement?, into: MutableList<String>) {
        when {
            wanted == found -> Unit
            wanted is JsonObject && found is JsonObject ->
                for (key in wanted.keys + found.keys) {
                    compare(if (path.isEmpty()) key else "$path.$key", wanted[key], found[key], into)
                }
            isShort(wanted) && isShort(found) -> into += "$path is ${found ?: UNSAID}, not ${wanted ?: UNSAID}"
            else -> into += "$path is another"
        }
    }

    /** Whether [value] is a number or a word, or its key is left out for what holds without it. */
    private fun isShort(value: JsonElement?) = value == null || value is JsonPrimitive
}
