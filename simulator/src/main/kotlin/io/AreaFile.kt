package stillwater.io

import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonNull
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.booleanOrNull
import kotlinx.serialization.json.contentOrNull
import kotlinx.serialization.json.doubleOrNull
import stillwater.model.JsonForm
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import stillwater.model.WaterArea
import java.nio.file.Path
import kotlin.math.IEEErem

/** Coordinates of an area. */
enum class AreaUnits(val label: String) {
    /** Longitude and latitude, degrees, WGS-84: what GeoJSON prescribes. */
    DEGREES("degrees"),

    /** Metres east and north in the local frame, for simulated fields. */
    METRES("metres"),
}

/**
 * Reads the water a boat may be on from GeoJSON (RFC 7946).
 *
 * The water is the only Polygon without the property `"keep-out": true`; its further rings are islands. Every Polygon, or
 * part of a MultiPolygon, with that property is a keep-out; its holes are not kept out of only where they are water
 * anyway, and so are refused. Degrees become metres in a [LocalFrame] at the middle of the shore's bounding box.
 */
object AreaFile {
    private val FILE = JsonFile("GeoJSON")

    /**
     * The area in the file [path].
     *
     * @throws JsonFileProblem if there is no such file or it holds no such area.
     */
    fun read(path: Path, units: AreaUnits): WaterArea = FILE.read(path) { AreaText(it, units).area() }

    /** The area in the GeoJSON [text] of a file called [name]; throws as [read] does. */
    fun parse(text: String, name: String, units: AreaUnits): WaterArea =
        FILE.parse(text, name) { AreaText(it, units).area() }
}

/** The area in a GeoJSON [text]; what is wrong with it is said as [stillwater.model.JsonProblem]. */
private class AreaText(private val text: String, private val units: AreaUnits) {
    /** A ring of [corners], which stands at [path]. */
    private class Ring(val corners: List<Pair<Double, Double>>, val path: String)

    private class Polygon(val rings: List<Ring>, val isKeepOut: Boolean)

    private val polygons = ArrayList<Polygon>()

    fun area(): WaterArea {
        collect(FORM.read(text), isKeepOut = false, ROOT)
        val water = polygons.filterNot { it.isKeepOut }
        if (water.size != 1) {
            fail(water.getOrNull(1)?.rings?.first()?.path ?: ROOT, WATER, "${water.size} of them")
        }
        val shore = water.single().rings.first()
        val islands = water.single().rings.drop(1)
        val keepOuts = polygons.filter { it.isKeepOut }.map { polygon ->
            polygon.rings.getOrNull(1)?.let { fail(it.path, "keep-outs without holes", "a hole") }
            polygon.rings.single()
        }
        val place = placer(shore)
        val rings = (listOf(shore) + islands + keepOuts).map { ring ->
            ring.corners.mapIndexed { index, corner -> place(corner, "${ring.path}[$index]") }
        }
        return try {
            WaterArea(rings.first(), rings.drop(1))
        } catch (wrong: IllegalArgumentException) {
            val words = wrong.message.orEmpty()
            val ring = KEEP_OUT.find(words)?.let { (islands + keepOuts)[it.groupValues[1].toInt() - 1] } ?: shore
            throw FORM.problem(text, ring.path, words)
        }
    }

    private fun collect(element: JsonElement, isKeepOut: Boolean, path: String) {
        val item = element as? JsonObject ?: fail(path, "a GeoJSON object", "something else")
        when (val type = (item["type"] as? JsonPrimitive)?.contentOrNull) {
            "FeatureCollection" -> list(item["features"], "$path.features").forEachIndexed { index, feature ->
                collect(feature, isKeepOut, "$path.features[$index]")
            }
            "Feature" -> {
                val geometry = item["geometry"] ?: fail(path, "the field geometry", "none")
                collect(geometry, keepOut(item["properties"] as? JsonObject, "$path.properties"), "$path.geometry")
            }
            "Polygon" -> polygons += Polygon(rings(item["coordinates"], "$path.coordinates"), isKeepOut)
            "MultiPolygon" ->
                list(item["coordinates"], "$path.coordinates").forEachIndexed { index, polygon ->
                    polygons += Polygon(rings(polygon, "$path.coordinates[$index]"), isKeepOut)
                }
            else -> fail("$path.type", "Polygon or MultiPolygon", type?.let { "'$it'" } ?: "no type")
        }
    }

    /** Water that somebody meant to keep out of must not become the water for a "yes". */
    private fun keepOut(properties: JsonObject?, path: String): Boolean {
        val property = properties?.get("keep-out") ?: return false
        val primitive = property as? JsonPrimitive
        if (primitive is JsonNull) return false
        return primitive?.takeIf { !it.isString }?.booleanOrNull
            ?: fail("$path.keep-out", "true or false without quotes", "$property")
    }

    private fun rings(element: JsonElement?, path: String): List<Ring> {
        val rings = list(element, path).mapIndexed { ring, corners ->
            val ringPath = "$path[$ring]"
            Ring(list(corners, ringPath).mapIndexed { index, corner -> corner(corner, "$ringPath[$index]") }, ringPath)
        }
        if (rings.isEmpty() || rings.first().corners.isEmpty()) fail(path, "a ring of corners", "none")
        return rings
    }

    private fun corner(corner: JsonElement, path: String): Pair<Double, Double> {
        val numbers = (corner as? JsonArray)?.map { number ->
            (number as? JsonPrimitive)?.takeIf { !it.isString }?.doubleOrNull ?: Double.NaN
        }.orEmpty()
        if (numbers.size < 2 || numbers.take(2).any { !it.isFinite() }) fail(path, "two numbers", "$corner")
        return numbers[0] to numbers[1]
    }

    private fun list(element: JsonElement?, path: String): JsonArray = element as? JsonArray
        ?: fail(path, "a list in brackets", if (element == null) "none" else "something else")

    /** How corners in [units] become places in the local frame; told where they stand. */
    private fun placer(shore: Ring): (Pair<Double, Double>, String) -> Position {
        if (units == AreaUnits.METRES) return { (x, y), _ -> Position(x, y) }
        val latLon = { corner: Pair<Double, Double>, path: String ->
            val (longitude, latitude) = corner
            if (latitude !in LatLon.LATITUDES_DEG || longitude !in LatLon.LONGITUDES_DEG) {
                fail(path, "longitude and latitude in degrees, or --area-units metres", "($longitude, $latitude)")
            }
            LatLon(latitude, longitude)
        }
        val corners = shore.corners.mapIndexed { index, corner -> latLon(corner, "${shore.path}[$index]") }
        // Counted on from the first corner: a shore may cross the meridian at which the numbers start again.
        val first = corners.first().longitudeDeg
        val longitudes = corners.map { first + (it.longitudeDeg - first).IEEErem(FULL_TURN) }
        val origin = LatLon(
            (corners.minOf { it.latitudeDeg } + corners.maxOf { it.latitudeDeg }) / 2,
            ((longitudes.min() + longitudes.max()) / 2).IEEErem(FULL_TURN),
        )
        if (!LocalFrame.canStartAt(origin.latitudeDeg)) fail(shore.path, "water that is not a pole", "a pole")
        val frame = LocalFrame(origin)
        return { corner, path -> frame.toLocal(latLon(corner, path)) }
    }

    private fun fail(path: String, expected: String, found: String): Nothing =
        throw FORM.problem(text, path, "expected $expected, found $found")

    private companion object {
        const val ROOT = "$"
        const val FULL_TURN = 360.0
        const val WATER = "one Polygon of water without \"keep-out\": true"
        val FORM = JsonForm(JsonElement.serializer(), "GeoJSON")
        val KEEP_OUT = Regex("""^keep-out (\d+)""")
    }
}
