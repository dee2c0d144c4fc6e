package stillwater.survey

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonNull
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonObjectBuilder
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.buildJsonArray
import kotlinx.serialization.json.buildJsonObject
import kotlinx.serialization.json.put
import kotlinx.serialization.json.putJsonObject
import stillwater.estimate.SensorBelief
import stillwater.report.putOrigin
import java.nio.file.Path

/** A [SurveyMap] for machines; numbers unrounded, null where there is none. */
object MapJson {
    private val format = Json { prettyPrint = true }

    /** The JSON text about [map], what is to be [warned][warnings] of, and the [files] written. */
    fun text(map: SurveyMap, warnings: List<String>, files: List<Path>): String =
        format.encodeToString(JsonObject.serializer(), of(map, warnings, files))

    private fun sensor(belief: SensorBelief) = buildJsonObject {
        put("explained", belief.isExplained)
        put("even_cells", belief.areCellsEven)
        put("steady_water", belief.isWaterSteady)
        putJsonObject("models") {
            for (candidate in belief.candidates) {
                putJsonObject(candidate.kind.label) {
                    put("standing", candidate.standing.name.lowercase().replace('_', '-'))
                    put("log_odds_against", number(candidate.evidence))
                    for (parameter in candidate.parameters) {
                        putJsonObject(parameter.name) {
                            put("value", number(parameter.value))
                            put("low", number(parameter.interval.lower))
                            put("high", number(parameter.interval.upper))
                        }
                    }
                }
            }
        }
    }

    private fun of(map: SurveyMap, warnings: List<String>, files: List<Path>) = buildJsonObject {
        put("log", map.log.file.toString())
        put("format", map.log.format)
        put("quantity", map.log.quantity)
        put("unit", map.unit)
        put("position_unit", Wording(map).length)
        put("warnings", buildJsonArray { warnings.forEach { add(JsonPrimitive(it)) } })
        put("readings", map.pass.readings)
        map.correction?.let {
            putJsonObject("corrected_for") {
                put("sensor", Json.parseToJsonElement(it.sensor.toJson()))
                put("readings_left_out", it.untold)
            }
        }
        putJsonObject("skipped") { map.pass.skipped.forEach { (reason, count) -> put(reason, count) } }
        statistics(map)
        grid(map)
        putOrigin(map.log.frame)
        putJsonObject("prior") {
            put("lower", map.prior.lower)
            put("upper", map.prior.upper)
            put("given", map.rangeGiven)
            put("widened_for_lag", map.isRangeWidened)
            put("readings_outside", map.outsideRange)
        }
        map.bounded?.let { put("epsilon_per_s", it.epsilon) }
        if (map.bounded != null) put("resolution_step_slope_per_s", map.stepSlope)
        map.calibration?.let { calibration ->
            putJsonObject("calibration") {
                put("from_s", calibration.stretch.from)
                put("to_s", calibration.stretch.to)
                put("slopes", calibration.slopes)
                put("found_per_s", number(calibration.found))
            }
        }
        map.interval?.let { put("interval_assumes", it.json()) }
        map.learned?.let { put("sensor", sensor(it.sensor())) }
        put("even_cells", map.areCellsEven)
        putJsonObject("filters") {
            map.maps.forEach { (kind, field) ->
                putJsonObject(kind.label) {
                    put("outside", field.outside)
                    put("rejected", field.rejected)
                    put("conflicts", (0 until field.grid.size).sumOf { field.conflicts(it).toLong() })
                    if (kind.givesBounds) cells(BoundCounts.of(field, kind))
                }
            }
        }
        legs(map)
        putJsonObject("cell_passes") {
            put("opposite_pairs", map.passes.opposite.pairs)
            put("opposite_mean_difference", number(map.passes.opposite.meanDifference))
            put("same_pairs", map.passes.same.pairs)
            put("same_mean_difference", number(map.passes.same.meanDifference))
        }
        put("files", buildJsonArray { files.forEach { add(JsonPrimitive(it.toString())) } })
    }

    private fun JsonObjectBuilder.grid(map: SurveyMap) = putJsonObject("grid") {
        put("columns", map.grid.columns)
        put("rows", map.grid.rows)
        put("cell_width_m", map.grid.cellWidth)
        put("cell_height_m", map.grid.cellHeight)
        put("rotation_deg", Math.toDegrees(map.grid.rotation))
        put("cells_visited", map.passes.visitedCells)
        put("cells_revisited", map.passes.revisitedCells)
    }

    private fun JsonObjectBuilder.cells(counts: BoundCounts) = putJsonObject("visited_cells") {
        put(CellStatus.BOTH.label, counts.both)
        put(CellStatus.CROSSED.label, counts.crossed)
        put(CellStatus.ONE_SIDED.label, counts.oneSided)
        put(CellStatus.MEASURED.label, counts.measured)
        put(CellStatus.NONE.label, counts.none)
    }

    private fun JsonObjectBuilder.statistics(map: SurveyMap) = putJsonObject("statistics") {
        val statistics = map.statistics
        put("duration_s", statistics.duration)
        quantiles("step_s", statistics.steps)
        put("gaps", map.gaps.count)
        map.gaps.longest?.let { gap ->
            putJsonObject("longest_gap") {
                put("start_s", gap.start)
                put("seconds", gap.seconds)
                put("jump_m", gap.jump)
            }
        }
        put("gap_limit_s", number(statistics.gapLimit))
        put("longest_step_s", statistics.longestStep)
        put("repeated_fixes_share", statistics.repeatedFixes)
        put("fix_scatter_m", statistics.fixScatter)
        put("place_deviation_m", statistics.placeDeviation)
        put("repeated_values_share", statistics.repeatedValues)
        quantiles("speed_mps", statistics.speeds)
        put("way_m", statistics.distance)
        put("position_jumps", map.pass.jumps)
        put("lowest", statistics.lowest)
        put("highest", statistics.highest)
        put("median", statistics.values.median)
        put("resolution", number(statistics.resolution))
    }

    private fun JsonObjectBuilder.quantiles(name: String, quantiles: Quantiles) = putJsonObject(name) {
        put("p5", number(quantiles[0.05]))
        put("median", number(quantiles.median))
        put("p95", number(quantiles[0.95]))
        put("max", number(quantiles[1.0]))
    }

    private fun JsonObjectBuilder.legs(map: SurveyMap) = putJsonObject("legs") {
        put("found", map.legs.legs.size)
        val mismatch = map.mismatch ?: return@putJsonObject
        put("axis_deg", Math.toDegrees(map.legs.axis))
        put("compared", mismatch.scores.size)
        put("bin_width_m", mismatch.binWidth)
        estimate("opposite_mismatch", mismatch.opposite)
        estimate("same_direction_mismatch", mismatch.same)
        estimate("opposite_minus_same", mismatch.excess)
        put("compared_both_ways", mismatch.pairedLegs)
        mismatch.aside?.let {
            putJsonObject("aside") {
                put("distance_m", it.distance)
                put("difference", it.difference)
            }
        }
        put("verdict", mismatch.verdict.label)
        putJsonObject("best_shift") {
            put("earlier_by_s", mismatch.shift.seconds)
            put("low_s", mismatch.shift.low)
            put("high_s", mismatch.shift.high)
            put("at_end", mismatch.shift.isAtEnd)
            put("mismatch", mismatch.shift.mismatch)
            put("clear", mismatch.shift.isClear)
            put("with_reserve", mismatch.hasReserve)
        }
    }

    private fun JsonObjectBuilder.estimate(name: String, estimate: Estimate?) {
        if (estimate == null) return
        putJsonObject(name) {
            put("mean", estimate.mean)
            put("standard_error", number(estimate.standardError))
        }
    }

    private fun number(value: Double): JsonElement = if (value.isFinite()) JsonPrimitive(value) else JsonNull
}
