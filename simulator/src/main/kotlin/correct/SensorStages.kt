package stillwater.correct

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.doubleOrNull
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import stillwater.sensor.SensorSpec
import stillwater.survey.Wording.Companion.digits

/** A sensor's stages in words, as in sensor.json. */
internal object SensorStages {
    /** Name of a rate limit's parameter, which is no time. */
    const val RATE = "rate_per_s"
    private const val REFERENCE_SPEED = "reference_speed_m_per_s"

    /** The stages of [spec] with their numbers, in the order in which they act; empty where there are none. */
    fun words(spec: SensorSpec): String {
        val stages = Json.parseToJsonElement(spec.toJson()).jsonObject.getValue("stages").jsonArray
        return stages.map { it.jsonObject }.joinToString(", then ") { stage ->
            val numbers = stage.filterKeys { it != "type" }.map { (name, value) ->
                val number = (value as? JsonPrimitive)?.doubleOrNull
                "${parameter(name)} ${number?.let { digits(it, 3) } ?: value}"
            }
            "${stage.getValue("type").jsonPrimitive.content}: ${numbers.joinToString(", ")}"
        }
    }

    /** The parameter [name] of a file in words, with its unit. */
    fun parameter(name: String): String = when (name) {
        RATE -> "rate per s"
        REFERENCE_SPEED -> "reference speed in m/s"
        else -> name.removeSuffix("_s").replace('_', ' ') + if (name.endsWith("_s")) " in s" else ""
    }
}
