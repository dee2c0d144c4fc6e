package stillwater.benchmark

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonNull
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.add
import kotlinx.serialization.json.addJsonObject
import kotlinx.serialization.json.buildJsonObject
import kotlinx.serialization.json.put
import kotlinx.serialization.json.putJsonArray
import stillwater.run.ExperimentResult
import java.nio.file.Path

/** An [ExperimentResult] for machines; numbers unrounded, null where there is none. */
object BenchmarkJson {
    private val format = Json { prettyPrint = true }

    /** The JSON text about [result] and the [files] written. */
    fun text(result: ExperimentResult, files: List<Path>): String =
        format.encodeToString(JsonObject.serializer(), of(result, files))

    private fun of(result: ExperimentResult, files: List<Path>) = buildJsonObject {
        put("seed", result.settings.seed)
        put("environments", result.settings.environments)
        put("sensor", result.settings.sensor.name)
        putJsonArray("results") {
            for (curve in result.curves) {
                curve.checkpoints.zip(curve.summaries) { move, summary ->
                    addJsonObject {
                        put("field", curve.field)
                        put("filter", curve.filter.label)
                        put("planner", curve.planner.label)
                        put("boats", curve.boats)
                        put("move", move)
                        put("mean_abs_error", number(summary.mean))
                        put("standard_error", number(summary.standardError))
                        put("p10", number(summary.p10))
                        put("p90", number(summary.p90))
                        put("coverage", number(summary.bounds?.coverage ?: Double.NaN))
                        put("mean_width", number(summary.bounds?.meanWidth ?: Double.NaN))
                    }
                }
            }
        }
        putJsonArray("budgets") {
            for (row in BudgetTable.rows(result)) {
                addJsonObject {
                    BudgetTable.COLUMNS.zip(row) { name, cell ->
                        if (cell is Number) put(name, number(cell.toDouble())) else put(name, cell.toString())
                    }
                }
            }
        }
        putJsonArray("claims") {
            for (claim in ReportClaims(result).all()) {
                addJsonObject {
                    put("claim", claim.text)
                    put("verdict", claim.verdict.label)
                    put("detail", claim.detail)
                }
            }
        }
        putJsonArray("files") { files.forEach { add(it.toString()) } }
    }

    private fun number(value: Double): JsonElement = if (value.isFinite()) JsonPrimitive(value) else JsonNull
}
