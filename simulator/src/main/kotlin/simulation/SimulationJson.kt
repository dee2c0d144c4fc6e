package stillwater.simulation

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonObjectBuilder
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.addJsonObject
import kotlinx.serialization.json.buildJsonObject
import kotlinx.serialization.json.put
import kotlinx.serialization.json.putJsonArray
import kotlinx.serialization.json.putJsonObject
import stillwater.run.label

/** A [SimulationResult] for machines. */
internal object SimulationJson {
    private val FORMAT = Json { prettyPrint = true }

    /** The text of summary.json. */
    fun text(result: SimulationResult, warnings: List<String>): String =
        FORMAT.encodeToString(JsonObject.serializer(), json(result, warnings)) + "\n"

    private fun json(result: SimulationResult, warnings: List<String>) = buildJsonObject {
        val run = result.run
        put("mission", run.spec.name)
        put("estimator", run.spec.estimator.label)
        put("planner", run.spec.planner.label)
        put("seed", run.world.settings.seed)
        put("field", run.world.settings.water.label)
        put("sensor", run.world.sensor.name)
        put("over", result.isOver)
        put("end", run.history.spans.last().label)
        put("simulated_s", round(run.time.seconds))
        putJsonObject("map") {
            put("cells", result.map.grid.size)
            errors("error_at_centres", result.atCentres)
            errors("error_against_cell_means", result.againstMeans)
            errors("error_over_all_cells", result.overAllCells)
            errors("averages_error_against_cell_means", result.averagesError)
            holding("bounds_at_centres", result.boundsAtCentres)
            holding("bounds_around_cell_means", result.boundsAroundMeans)
        }
        putJsonObject("same_readings_in_process") {
            errors("error_at_centres", result.inProcessError)
            errors("mission_over_the_same_cells", result.comparedError)
            put("mission_over_in_process", finite(result.comparedError.mean / result.inProcessError.mean))
        }
        way(result)
        readings(result.readings, run.mission.unplaced)
        link(result)
        result.belief?.let { belief ->
            putJsonObject("sensor_learned") {
                put("explained", belief.isExplained)
                put("even_cells", belief.areCellsEven)
                put("steady_water", belief.isWaterSteady)
                put("response", belief.chosen.kind.label)
                belief.chosen.parameters.forEach { put(it.name, finite(it.value)) }
            }
        }
        put("states", states(run.history))
        putJsonArray("warnings") { warnings.forEach { add(JsonPrimitive(it)) } }
    }

    private fun JsonObjectBuilder.way(result: SimulationResult) {
        val run = result.run
        putJsonObject("way") {
            put("distance_m", run.track.distance)
            put("distance_under_way_m", run.track.distanceUnderWay)
            put("under_way_s", round(result.timeUnderWay))
            put("used", run.mission.used)
            put("used_in", if (run.spec.budget.metres != null) "m" else "s")
            put("cross_track_rms_m", finite(run.track.crossTrack))
            put("cross_track_largest_m", run.track.largestCrossTrack)
            put("place_error_rms_m", finite(run.track.poseError))
            put("energy_wh", run.world.battery.used)
            put("battery_v", run.world.battery.volts)
            put("waypoints_given_up", run.mission.givenUp)
            putJsonArray("cells_given_up") { run.mission.givenUpCells.forEach { add(JsonPrimitive(it)) } }
            putJsonArray("places_given_up_off_map") {
                for (place in run.mission.givenUpOffMap) {
                    addJsonObject {
                        put("x_m", place.x)
                        put("y_m", place.y)
                    }
                }
            }
        }
    }

    private fun JsonObjectBuilder.link(result: SimulationResult) {
        val mission = result.run.mission
        putJsonObject("link") {
            put("unreadable_lines", mission.board.unreadable)
            putJsonObject("by_kind") { result.unreadable.forEach { (kind, count) -> put(kind, count) } }
            put("commands_the_board_could_not_use", mission.board.refusals)
            put("writes_not_taken", mission.board.unsent)
        }
        putJsonObject("refused") {
            put("fixes", mission.refusedFixes)
            put("steps", mission.refusedSteps)
        }
    }

    private fun JsonObjectBuilder.readings(account: ReadingAccount, unplaced: Long) = putJsonObject("readings") {
        put("sent", account.sent)
        put("received", account.received)
        put("lost_on_the_link", account.lost)
        put("logged", account.logged)
        put("taken", account.taken)
        putJsonObject("refused") { account.refused.forEach { (reason, count) -> put(reason, count) } }
        put("waiting", account.waiting)
        put("in_cells", account.inCells)
        put("in_cells_but_at_borders", unplaced)
        put("off_the_map", account.outside)
        put("rejected_by_the_estimator", account.rejected)
        put("complete", account.isComplete)
    }

    private fun states(history: StateHistory) = JsonArray(
        history.spans.map { span ->
            buildJsonObject {
                put("state", span.state.word)
                span.reason?.let { put("why", it) }
                put("from_s", round(span.from))
                put("until_s", round(span.until))
            }
        },
    )

    private fun JsonObjectBuilder.errors(name: String, errors: MapErrors) = putJsonObject(name) {
        put("cells", errors.cells)
        put("mean_abs", finite(errors.mean))
        put("rms", finite(errors.rootMeanSquare))
        put("largest", finite(errors.largest))
    }

    private fun JsonObjectBuilder.holding(name: String, holding: BoundsHolding) = putJsonObject(name) {
        put("cells", holding.cells)
        put("hold", finite(holding.holding))
        put("mean_width", finite(holding.meanWidth))
    }

    private fun finite(value: Double): Double? = value.takeIf { it.isFinite() }

    /** Steps of a tenth of a second, without the dust of adding them. */
    private fun round(seconds: Double) = Math.round(seconds * STEPS) / STEPS

    private const val STEPS = 100.0
}
