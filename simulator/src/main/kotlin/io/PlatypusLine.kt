package stillwater.io

import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.contentOrNull
import kotlinx.serialization.json.doubleOrNull
import kotlinx.serialization.json.intOrNull
import stillwater.mission.LogLine
import kotlin.math.abs
import kotlin.math.atan2

/**
 * Takes the lines of a Platypus log of one [version] apart.
 *
 * Only poses, sensors and starts are parsed; of other lines only the frame is looked at, because their content need
 * not even be well formed (`gain.values` can be a Java object's address).
 */
internal class PlatypusLine(private val version: PlatypusVersion) {
    /** Milliseconds on the log's counter in the line last given to [parse]; -1 where it has none. */
    var millis = -1L
        private set

    /** Time of day in the line last given to [parse], s; NaN in versions that have none. */
    var clock = Double.NaN
        private set

    /** The boat's time at the mission's step that the line last given to [parse] tells of, s; NaN where it tells of none. */
    var step = Double.NaN
        private set

    /** What [line] says; [millis], [clock] and [step] are set on the way. */
    fun parse(line: String): PlatypusEntry {
        step = Double.NaN
        val payload = if (version == PlatypusVersion.LEVEL_JSON) afterLevel(line) else afterClock(line)
        if (payload == null) return PlatypusEntry.Unreadable("a line '${SHAPES.getValue(version)}'")
        return if (version == PlatypusVersion.TEXT) parseText(payload) else parseJson(payload)
    }

    /** What came in before the step that [line] tells of; null where it tells of none, as in any log but a mission's. */
    fun inputs(line: String): MissionInputs? {
        val payload = if (version == PlatypusVersion.LEVEL_JSON && INPUTS in line) afterLevel(line) else null
        val json = payload?.let { LogLine.objectOrNull(it) } ?: return null
        val step = stepOf(json) ?: return null
        val inputs = json["in"] as? JsonObject ?: return null
        fun rows(key: String) = (inputs[key] as? JsonArray)?.mapNotNull { it.numbers() }.orEmpty()
        return MissionInputs(step, rows("fix"), rows("compass"))
    }

    private fun stepOf(json: JsonObject): Double? =
        ((json["mission"] as? JsonObject)?.get("t_s") as? JsonPrimitive)?.doubleOrNull?.takeIf { it.isFinite() }

    private fun afterLevel(line: String): String? {
        val tab = line.indexOf('\t')
        millis = if (tab > 0) line.substring(0, tab).toLongOrNull() ?: -1 else -1
        clock = Double.NaN
        val framed = millis >= 0 && line.length > tab + 2 && line[tab + 1] in "DIWEF" && line[tab + 2] == '\t'
        return if (framed) line.substring(tab + LEVEL_LENGTH).trim() else null
    }

    private fun afterClock(line: String): String? {
        val blank = line.indexOf(' ')
        val second = if (blank > 0) line.indexOf(' ', blank + 1) else -1
        millis = if (blank > 0) line.substring(0, blank).toLongOrNull() ?: -1 else -1
        if (millis < 0 || second < 0) return null
        // The fraction is a count of milliseconds without leading zeros: 19:24:29,71 is 29.071 s.
        val parts = line.substring(blank + 1, second).split(':', ',').map { it.toIntOrNull() ?: return null }
        if (parts.size != CLOCK_PARTS || parts[0] !in 0..23 || parts[1] !in 0..59 || parts[2] !in 0..60) return null
        clock = parts[0] * 3600.0 + parts[1] * 60.0 + parts[2] + parts[3] / 1000.0
        return line.substring(second + 1).trim()
    }

    private fun parseText(payload: String): PlatypusEntry {
        val colon = payload.indexOf(": ")
        val key = if (colon > 0) payload.substring(0, colon) else return PlatypusEntry.Unreadable("KEY: text")
        val text = payload.substring(colon + 2)
        return when {
            key == "POSE" -> POSE_TEXT.matchEntire(text.trim())?.groupValues?.let { found ->
                val yaw = DecimalText.parse(found[YAW])
                pose(DecimalText.parse(found[EASTING]), DecimalText.parse(found[NORTHING]), found[ZONE], yaw)
            } ?: PlatypusEntry.Unreadable("POSE: {E, N, alt, Q[roll,pitch,yaw]} @ zone")
            key == "ES2" -> numbers(text.trim().removePrefix("[").removePrefix("e,").removeSuffix("]"), ",")
                ?.takeIf { it.size == 2 && text.trim().endsWith("]") }
                ?.let { PlatypusEntry.Sensor("ES2", NO_CHANNEL, it) }
                ?: PlatypusEntry.Unreadable("ES2: [e, ec, temp]")
            key.startsWith("SENSOR") && key.drop(SENSOR_LENGTH).toIntOrNull() != null ->
                textSensor(key.drop(SENSOR_LENGTH).toInt(), text)
            else -> PlatypusEntry.Other
        }
    }

    private fun textSensor(channel: Int, text: String): PlatypusEntry {
        val json = LogLine.objectOrNull(text)
        val type = json?.text("type")
        val data = json?.text("data")?.let { numbers(it, " ") }
        return if (type != null && data != null) {
            PlatypusEntry.Sensor(type.uppercase(), channel, data)
        } else {
            PlatypusEntry.Unreadable("""SENSORn: {"data":"numbers","type":"name"}""")
        }
    }

    private fun parseJson(payload: String): PlatypusEntry {
        if (!payload.startsWith("{") || !payload.endsWith("}")) return PlatypusEntry.Unreadable("a JSON object")
        val wanted = payload.startsWith("{\"cmd\"").not() && payload.startsWith("{\"gain\"").not()
        if (!wanted) return PlatypusEntry.Other
        val json = LogLine.objectOrNull(payload) ?: return PlatypusEntry.Unreadable("a JSON object")
        step = stepOf(json) ?: Double.NaN
        return jsonPose(json["pose"]) ?: jsonSensor(json["sensor"]) ?: jsonStart(json) ?: PlatypusEntry.Other
    }

    private fun jsonPose(json: JsonElement?): PlatypusEntry? {
        if (json == null) return null
        val place = (json as? JsonObject)?.get("p")?.numbers()
        val zone = (json as? JsonObject)?.text("zone")
        return if (place != null && place.size >= 2 && zone != null) {
            // The boats write the yaw into index 2.
            val q = json["q"]?.numbers()
            val heading = if (q != null && q.size == QUATERNION) 2 * atan2(q[2], q[0]) else Double.NaN
            pose(place[0], place[1], zone, heading)
        } else {
            PlatypusEntry.Unreadable("""a pose {"p":[E,N,alt],"q":[...],"zone":"..."}""")
        }
    }

    private fun pose(easting: Double, northing: Double, zone: String, heading: Double): PlatypusEntry =
        if (easting.isFinite() && northing.isFinite()) {
            PlatypusEntry.Pose(easting, northing, zone, heading)
        } else {
            PlatypusEntry.Unreadable("finite easting and northing")
        }

    private fun jsonSensor(json: JsonElement?): PlatypusEntry? {
        if (json == null) return null
        val sensor = json as? JsonObject
        val type = sensor?.text("type")
        val data = sensor?.get("data")?.numbers()
        val channel = (sensor?.get("channel") as? JsonPrimitive)?.intOrNull ?: NO_CHANNEL
        return if (type != null && data != null) {
            PlatypusEntry.Sensor(type.uppercase(), channel, data)
        } else {
            PlatypusEntry.Unreadable("""a sensor {"channel":n,"type":"...","data":[numbers]}""")
        }
    }

    private fun jsonStart(json: JsonObject): PlatypusEntry? {
        if ("date" !in json) return null
        val epoch = (json["time"] as? JsonPrimitive)?.doubleOrNull?.takeIf { abs(it) <= LATEST_EPOCH }
        return epoch?.let { PlatypusEntry.Start(it) } ?: PlatypusEntry.Unreadable("a start with a time in ms")
    }

    private fun JsonObject.text(key: String) = (get(key) as? JsonPrimitive)?.contentOrNull

    /** The numbers of an array, NaN where it holds something else; null where it is no array. */
    private fun JsonElement.numbers(): List<Double>? = (this as? JsonArray)?.map { element ->
        (element as? JsonPrimitive)?.contentOrNull?.let { DecimalText.parse(it) } ?: Double.NaN
    }

    private fun numbers(text: String, separator: String): List<Double>? =
        text.split(separator).filter { it.isNotBlank() }.map { DecimalText.parse(it) }.takeIf { it.isNotEmpty() }

    companion object {
        /** Channel of a sensor whose lines name none. */
        const val NO_CHANNEL = -1

        /** Some 30 000 years, ms. */
        private const val LATEST_EPOCH = 1e15
        private const val INPUTS = "\"in\":{"
        private const val LEVEL_LENGTH = 3
        private const val QUATERNION = 4

        /** Groups of [POSE_TEXT]. */
        private const val EASTING = 1
        private const val NORTHING = 2
        private const val YAW = 3
        private const val ZONE = 4
        private const val CLOCK_PARTS = 4
        private const val SENSOR_LENGTH = 6
        private val POSE_TEXT = Regex("""\{([^,]+), ([^,]+), [^,]+, Q\[(?:[^],]*,)*([^],]*)]} @ (\S+)""")
        private val SHAPES = mapOf(
            PlatypusVersion.TEXT to "<ms> HH:MM:SS,m KEY: text",
            PlatypusVersion.CLOCK_JSON to "<ms> HH:MM:SS,m {json}",
            PlatypusVersion.LEVEL_JSON to "<ms> TAB <D, I, W, E or F> TAB {json}",
        )
    }
}
