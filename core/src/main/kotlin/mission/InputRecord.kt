package stillwater.mission

import kotlinx.serialization.json.JsonPrimitive
import stillwater.model.BoatTime
import stillwater.model.LatLon

/**
 * What came in between two steps, as the log writes it down: with it a replay hands the same to the same mission again.
 *
 * JSON:
 * `{"order":["start"],"phone":[percent],"fix":[[t_s,lat_deg,lon_deg]],"compass":[[t_s,heading_rad,yaw_rate_rad_s]],
 * "heard":["line"]}`, each only where something came. An order is `start`, `stop`, `log-lost` or the word of a [Wish].
 * `heard` has the board's lines whole, whether they could be read or not, one byte a character. Confined to one thread.
 */
internal class InputRecord {
    private val orders = StringBuilder()
    private val charges = StringBuilder()
    private val fixes = StringBuilder()
    private val compasses = StringBuilder()
    private val lines = StringBuilder()

    fun order(word: String) = add(orders, "\"$word\"")

    fun phone(percent: Double) = add(charges, number(percent))

    fun fix(time: BoatTime, place: LatLon) =
        add(fixes, "[${number(time.seconds)},${place.latitudeDeg},${place.longitudeDeg}]")

    fun compass(time: BoatTime, heading: Double, yawRate: Double) =
        add(compasses, "[${number(time.seconds)},${number(heading)},${number(yawRate)}]")

    fun heard(bytes: ByteArray, start: Int, end: Int) =
        add(lines, JsonPrimitive(String(bytes, start, end - start, Charsets.ISO_8859_1)).toString())

    /** All that came in, as a member of a JSON object; empty where nothing did. What was taken is forgotten. */
    fun take(): String {
        val parts =
            listOf("order" to orders, "phone" to charges, "fix" to fixes, "compass" to compasses, "heard" to lines)
        val text = parts.filter { it.second.isNotEmpty() }.joinToString(",") { (name, list) -> "\"$name\":[$list]" }
        parts.forEach { it.second.setLength(0) }
        return if (text.isEmpty()) "" else ",\"in\":{$text}"
    }

    private fun add(list: StringBuilder, item: String) {
        if (list.isNotEmpty()) list.append(',')
        list.append(item)
    }

    private fun number(value: Double) = if (value.isFinite()) value.toString() else "null"
}
