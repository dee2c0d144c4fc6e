package stillwater.hidden

import com.github.ajalt.clikt.core.parse
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.doubleOrNull
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import stillwater.cli.DiagnoseCommand
import java.nio.file.Files
import java.nio.file.Path

/**
 * What the finder answers about a log, read from its diagnosis.json.
 *
 * @property verdict its verdict. @property sets for each effect it sees, the causes it may be; a sure one is alone.
 * @property numbers of each candidate cause, by name. @property before held-out residuals of the base. @property after
 * the same of the extended model; NaN without one. @property timeConstant the interval of the base's, s; null without.
 */
internal class FinderAnswer(json: JsonObject) {
    val verdict: String = json.text("verdict")
    val sets: List<List<String>> =
        (json.getValue("causes") as JsonArray).map { listOf(it.jsonPrimitive.content) }
            .filter { it.single() !in setOf("none", "unexplained") } +
            (json.getValue("ambiguity") as JsonArray).map { set -> set.jsonArray.map { it.jsonPrimitive.content } }
    val numbers: Map<String, Map<String, Double>> = json.getValue("candidates").jsonArray.map { it.jsonObject }
        .groupBy { it.text("cause") }
        .mapValues { (_, candidates) ->
            // A cross-sensitivity is a candidate for each condition, which its number's name says.
            candidates.flatMap { it.getValue("parameters").jsonArray }.associate {
                it.jsonObject.text("name") to (it.jsonObject.getValue("value").jsonPrimitive.doubleOrNull ?: Double.NaN)
            }
        }
    val before: Double = json.number("baseline")
    val after: Double = json.number("extended")
    val timeConstant: ClosedFloatingPointRange<Double>? =
        (json.getValue("baseline") as? JsonObject)?.getValue("parameters")?.jsonArray?.map { it.jsonObject }
            ?.firstOrNull { it.text("name") == "time_constant_s" }?.let { found ->
                val (lower, upper) = listOf("lower", "upper").map { (found[it] as? JsonPrimitive)?.doubleOrNull }
                lower?.rangeTo(upper ?: Double.POSITIVE_INFINITY)
            }

    private fun JsonObject.text(key: String) = getValue(key).jsonPrimitive.content

    private fun JsonObject.number(key: String) =
        (getValue(key) as? JsonObject)?.getValue("heldOutRmse")?.jsonPrimitive?.doubleOrNull ?: Double.NaN
}

/** Calls `stillwater diagnose` on a log as a user would. */
internal object Finder {
    private val conditions = listOf(
        "speed=speed_mps",
        "temperature=temperature_c",
        "salinity=salinity",
        "heading=heading_rad",
    )

    /** The answer about [log], with the believed [sensor] where there is one; results go into [out]. */
    fun ask(log: Path, withReference: Boolean, out: Path, sensor: Path? = null): FinderAnswer {
        val arguments = listOf("$log", "--value", "value", "--out", "$out", "--numbers-only", "--quiet") +
            conditions.flatMap { listOf("--condition", it) } +
            (if (withReference) listOf("--reference", "reference") else emptyList()) +
            if (sensor != null) listOf("--sensor", "$sensor") else emptyList()
        DiagnoseCommand().parse(arguments)
        return FinderAnswer(Json.parseToJsonElement(Files.readString(out.resolve("diagnosis.json"))).jsonObject)
    }
}
