package stillwater.io

import kotlinx.serialization.SerializationException
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.booleanOrNull
import kotlinx.serialization.json.contentOrNull
import kotlinx.serialization.json.doubleOrNull
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import stillwater.model.WaterArea
import java.io.IOException
import java.nio.charset.CharacterCodingException
import java.nio.file.NoSuchFileException
import java.nio.file.Path
import kotlin.io.path.readText

/** Coordinates of an area. */
enum class AreaUnits(val label: String) {
    /** Longitude and latitude, degrees, WGS-84: what GeoJSON prescribes. */
    DEGREES("degrees"),

    /** Metres east and north in the local frame, for simulated fields. */
    METRES("metres"),
}

/** An area that cannot be used. */
class AreaException(val expected: String, val found: String, cause: Throwable? = null) :
    RuntimeException("expected $expected, found $found", cause)

/**
 * Reads the water a boat may be on from GeoJSON (RFC 7946).
 *
 * The water is the only Polygon without the property `"keep-out": true`; its further rings are islands. Every Polygon, or
 * part of a MultiPolygon, with that property is a keep-out; its holes are not kept out of only where they are water
 * anyway, and so are refused. Degrees become metres in a [LocalFrame] at the middle of the shore's bounding box.
 */
object AreaFile {
    /**
     * The area in the file [path].
     *
     * @throws AreaException if there is no such file or it holds no such area.
     */
    fun read(path: Path, units: AreaUnits): WaterArea {
        val text = try {
            path.readText()
        } catch (missing: NoSuchFileException) {
            throw AreaException("a GeoJSON file", "no file $path", missing)
        } catch (wrong: CharacterCodingException) {
            throw AreaException("GeoJSON in UTF-8", "other bytes in $path", wrong)
        } catch (failed: IOException) {
            throw AreaException("a GeoJSON file that can be read", "$path (${failed.javaClass.simpleName})", failed)
        }
        return parse(text, path.toString(), units)
    }

    /** The area in the GeoJSON [text] of a file called [name]. */
    fun parse(text: String, name: String, units: AreaUnits): WaterArea {
        val root = try {
            Json.parseToJsonElement(text)
        } catch (wrong: SerializationException) {
            throw AreaException("GeoJSON", "$name: ${wrong.message.orEmpty().lineSequence().first()}", wrong)
        }
        val polygons = ArrayList<Polygon>()
        collect(root, isKeepOut = false, name, name, polygons)
        val water = polygons.filterNot { it.isKeepOut }
        if (water.size != 1) {
            throw AreaException("one Polygon of water without \"keep-out\": true", "${water.size} in $name")
        }
        val shore = water.single().rings.first()
        val place = placer(shore, units, name)
        val islands = water.single().rings.drop(1)
        val keepOuts = polygons.filter { it.isKeepOut }.map { polygon ->
            if (polygon.rings.size > 1) throw AreaException("keep-outs without holes", "one with a hole in $name")
            polygon.rings.single()
        }
        return try {
            WaterArea(shore.map(place), (islands + keepOuts).map { ring -> ring.map(place) })
        } catch (wrong: IllegalArgumentException) {
            throw AreaException("a shore and keep-outs that fit", "$name: ${wrong.message}", wrong)
        }
    }

    private class Polygon(val rings: List<List<Pair<Double, Double>>>, val isKeepOut: Boolean)

    private fun collect(
        element: JsonElement,
        isKeepOut: Boolean,
        where: String,
        name: String,
        into: MutableList<Polygon>,
    ) {
        val item = element as? JsonObject ?: throw AreaException("a GeoJSON object", "something else at $where")
        when (val type = (item["type"] as? JsonPrimitive)?.contentOrNull) {
            "FeatureCollection" -> list(item["features"], "features of $where").forEachIndexed { index, feature ->
                collect(feature, isKeepOut, "feature ${index + 1} of $name", name, into)
            }
            "Feature" -> {
                val geometry = item["geometry"] ?: throw AreaException("a geometry", "none in $where")
                val property = (item["properties"] as? JsonObject)?.get("keep-out") as? JsonPrimitive
                collect(geometry, property?.booleanOrNull == true, where, name, into)
            }
            "Polygon" -> into += Polygon(rings(item["coordinates"], where), isKeepOut)
            "MultiPolygon" -> for (polygon in list(item["coordinates"], "coordinates of $where")) {
                into += Polygon(rings(polygon, where), isKeepOut)
            }
            else -> throw AreaException("Polygon or MultiPolygon", "${type ?: "no type"} at $where")
        }
    }

    private fun rings(element: JsonElement?, where: String): List<List<Pair<Double, Double>>> {
        val rings = list(element, "coordinates of $where").mapIndexed { ring, corners ->
            list(corners, "ring ${ring + 1} of $where").mapIndexed { index, corner ->
                val numbers = (corner as? JsonArray)?.map {
                    (it as? JsonPrimitive)?.doubleOrNull ?: Double.NaN
                }.orEmpty()
                if (numbers.size < 2 || numbers.take(2).any { !it.isFinite() }) {
                    throw AreaException("two numbers", "$corner as corner ${index + 1} of ring ${ring + 1} of $where")
                }
                numbers[0] to numbers[1]
            }
        }
        if (rings.isEmpty() || rings.first().isEmpty()) throw AreaException("a ring of corners", "none in $where")
        return rings
    }

    private fun list(element: JsonElement?, what: String): JsonArray =
        element as? JsonArray
            ?: throw AreaException("a list as $what", if (element == null) "none" else "something else")

    /** How corners in [units] become places in the local frame. */
    private fun placer(
        shore: List<Pair<Double, Double>>,
        units: AreaUnits,
        name: String,
    ): (Pair<Double, Double>) -> Position {
        if (units == AreaUnits.METRES) return { (x, y) -> Position(x, y) }
        val latLon = { corner: Pair<Double, Double> ->
            val (longitude, latitude) = corner
            if (latitude !in LatLon.LATITUDES_DEG || longitude !in LatLon.LONGITUDES_DEG) {
                throw AreaException(
                    "longitude and latitude in degrees, or --area-units metres",
                    "the corner ($longitude, $latitude) in $name",
                )
            }
            LatLon(latitude, longitude)
        }
        val corners = shore.map(latLon)
        val origin = LatLon(
            (corners.minOf { it.latitudeDeg } + corners.maxOf { it.latitudeDeg }) / 2,
            (corners.minOf { it.longitudeDeg } + corners.maxOf { it.longitudeDeg }) / 2,
        )
        if (!LocalFrame.canStartAt(origin.latitudeDeg)) throw AreaException("water that is not a pole", name)
        val frame = LocalFrame(origin)
        return { corner -> frame.toLocal(latLon(corner)) }
    }
}
