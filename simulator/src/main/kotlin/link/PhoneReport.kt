package stillwater.link

import kotlinx.serialization.SerialName
import kotlinx.serialization.Serializable
import kotlinx.serialization.SerializationException
import kotlinx.serialization.json.Json
import stillwater.model.LatLon

/**
 * What the phone aboard a virtual boat knows at a moment: one line of the phone's channel.
 *
 * `{"tick":12,"t_s":1.2,"heading_rad":0.4,"yaw_rate_rad_s":0.01,"fix":{"t_s":1.0,"lat_deg":45.5,"lon_deg":-73.6}}`,
 * answered with `{"done":12}` when the step at that time has been taken: until then the boat's time stands still.
 *
 * @property tick counts from 1.
 * @property time on the boat's clock, s.
 * @property heading rad, counter-clockwise from east.
 * @property yawRate rad/s, counter-clockwise.
 * @property fix that came since the report before; null where none did.
 * @property sent bytes that the board has put on its wire since that was opened; null where nobody counts.
 */
@Serializable
data class PhoneReport(
    val tick: Long,
    @SerialName("t_s") val time: Double,
    @SerialName("heading_rad") val heading: Double,
    @SerialName("yaw_rate_rad_s") val yawRate: Double,
    val fix: Fix? = null,
    val sent: Long? = null,
) {
    init {
        require(tick > 0) { "tick ($tick) must be above 0" }
        require(time.isFinite() && time >= 0) { "t_s ($time) must be at least 0 and finite" }
    }

    /** A fix at [time], s on the boat's clock. */
    @Serializable
    data class Fix(
        @SerialName("t_s") val time: Double,
        @SerialName("lat_deg") val latitude: Double,
        @SerialName("lon_deg") val longitude: Double,
    ) {
        init {
            LatLon(latitude, longitude)
        }
    }

    /** The line, its end included. */
    fun line(): String = Json.encodeToString(serializer(), this) + "\n"

    companion object {
        /** The report that [line] is; null where it is none. */
        fun parse(line: String): PhoneReport? = try {
            Json.decodeFromString(serializer(), line)
        } catch (_: SerializationException) {
            null
        } catch (_: IllegalArgumentException) {
            null
        }

        /** The answer to the report number [tick], its end included. */
        fun done(tick: Long): String = "{\"done\":$tick}\n"

        /** The number that the answer [line] has; null where it is none. */
        fun answered(line: String): Long? =
            line.trim().removeSurrounding("{\"done\":", "}").takeIf { it != line.trim() }?.toLongOrNull()
    }
}
