package stillwater.simulation

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonNull
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.buildJsonObject
import kotlinx.serialization.json.put
import stillwater.mission.MissionSpec
import stillwater.model.Grid
import stillwater.model.Position
import kotlin.math.abs
import kotlin.math.pow
import kotlin.math.roundToLong

/**
 * A page that plays a [Film]: everything in it, no network and no other file.
 *
 * @param spec the mission. @param film what was recorded. @param caption one line under the title. @param unit of the
 *   quantity, with its name.
 */
class Animation(
    private val spec: MissionSpec,
    private val film: Film,
    private val caption: String,
    private val unit: String,
) {
    private val grid: Grid = spec.grid.grid()

    /** The page. */
    fun page(): String {
        val template = checkNotNull(Animation::class.java.getResource(TEMPLATE)) { "$TEMPLATE is not in the jar" }
        // No text of the mission can end the script that holds the data.
        val data = Json.encodeToString(JsonObject.serializer(), data()).replace("<", "\\u003c")
        return template.readText().replace("__DATA__", data)
    }

    private fun data() = buildJsonObject {
        val states = film.frames.map { it.state }.distinct()
        put("title", spec.name)
        put("caption", caption)
        put("unit", unit)
        put("budget", if (spec.budget.metres != null) "m" else "s")
        put("prior", numbers(listOf(spec.probe.lowest, spec.probe.highest), FINE))
        put("cells", JsonArray((0 until grid.size).map { cell -> numbers(grid.corners(cell).flat(), COARSE) }))
        put("truth", numbers(film.truths.asList(), FINE))
        put("water", JsonArray(spec.area.water().outlines.map { ring -> numbers(ring.flat(), COARSE) }))
        put("home", numbers(listOf(spec.home.x, spec.home.y), COARSE))
        put("states", JsonArray(states.map(::JsonPrimitive)))
        fun column(name: String, decimals: Int, of: (Frame) -> Double) =
            put(name, numbers(film.frames.map(of), decimals))
        column("t", 1) { it.time }
        column("x", COARSE) { it.x }
        column("y", COARSE) { it.y }
        column("heading", COARSE) { it.heading }
        column("bx", COARSE) { it.believedX }
        column("by", COARSE) { it.believedY }
        column("state", 0) { states.indexOf(it.state).toDouble() }
        column("reading", FINE) { it.reading }
        column("under", FINE) { it.truth }
        column("lower", FINE) { it.lower }
        column("upper", FINE) { it.upper }
        column("volts", COARSE) { it.volts }
        column("used", 1) { it.used }
        column("taken", 0) { it.taken.toDouble() }
        column("leftOut", 0) { it.leftOut.toDouble() }
        column("unreadable", 0) { it.unreadable.toDouble() }
        column("error", FINE) { it.error }
        put("plan", JsonArray(film.frames.map { numbers(it.plan.asList(), 1) }))
        put("changes", JsonArray(film.frames.map { numbers(it.changes.asList(), FINE) }))
    }

    private fun List<Position>.flat() = flatMap { listOf(it.x, it.y) }

    private fun numbers(values: List<Double>, decimals: Int) = JsonArray(values.map { number(it, decimals) })

    /** Rounded, whole numbers without a point; what is not finite is null. */
    private fun number(value: Double, decimals: Int): JsonElement {
        if (!(abs(value) < LARGEST)) return JsonNull
        val power = 10.0.pow(decimals)
        val scaled = (value * power).roundToLong()
        return if (scaled % power.toLong() == 0L) JsonPrimitive(scaled / power.toLong()) else JsonPrimitive(scaled / power)
    }

    private companion object {
        const val TEMPLATE = "/stillwater/simulation/player.html"
        const val COARSE = 2
        const val FINE = 4
        const val LARGEST = 1e9
    }
}
