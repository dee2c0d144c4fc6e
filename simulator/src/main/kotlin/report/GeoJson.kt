package stillwater.report

import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonArrayBuilder
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonNull
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.addJsonArray
import kotlinx.serialization.json.buildJsonArray
import kotlinx.serialization.json.buildJsonObject
import kotlinx.serialization.json.put

/**
 * One corner of a [GeoPolygon].
 *
 * @property longitude WGS-84, degrees east. @property latitude WGS-84, degrees north.
 */
public data class GeoCorner(public val longitude: Double, public val latitude: Double) {
    init {
        require(longitude in -180.0..180.0) { "longitude ($longitude) must be -180 to 180 degrees" }
        require(latitude in -90.0..90.0) { "latitude ($latitude) must be -90 to 90 degrees" }
    }
}

/**
 * An area on the globe with what is known about it.
 *
 * @property corners the outline in either direction, at least 3, the first not repeated at the end.
 * @property properties name to value: text, number, truth value or null; NaN and infinite numbers become null.
 */
public class GeoPolygon(public val corners: List<GeoCorner>, public val properties: Map<String, Any?>) {
    init {
        require(corners.size >= 3) { "a polygon needs 3 or more corners, got ${corners.size}" }
    }
}

/**
 * Writes polygons as GeoJSON (RFC 7946): longitude first, rings closed and counter-clockwise, coordinates rounded to
 * 1e-8 degrees (about 1 mm), which is what the areas are known to at best.
 */
public object GeoJson {
    private const val UNITS = 1e8

    /** The text of a feature collection, one feature a line, in the order of [polygons]. */
    public fun text(polygons: Iterable<GeoPolygon>): String = buildString {
        append("{\"type\":\"FeatureCollection\",\"features\":[")
        polygons.forEachIndexed { index, polygon ->
            append(if (index == 0) "\n" else ",\n").append(feature(polygon))
        }
        append("\n]}\n")
    }

    private fun feature(polygon: GeoPolygon) = buildJsonObject {
        put("type", "Feature")
        put(
            "geometry",
            buildJsonObject {
                put("type", "Polygon")
                put("coordinates", buildJsonArray { addJsonArray { ring(polygon.corners) } })
            },
        )
        put("properties", buildJsonObject { polygon.properties.forEach { (name, value) -> put(name, element(value)) } })
    }

    private fun JsonArrayBuilder.ring(corners: List<GeoCorner>) {
        val outward = if (twiceArea(corners) < 0) listOf(corners.first()) + corners.drop(1).asReversed() else corners
        (outward + outward.first()).forEach { add(JsonArray(listOf(degrees(it.longitude), degrees(it.latitude)))) }
    }

    /** Twice the area in square degrees, positive if counter-clockwise (shoelace formula). */
    private fun twiceArea(corners: List<GeoCorner>): Double = corners.indices.sumOf { i ->
        val a = corners[i]
        val b = corners[(i + 1) % corners.size]
        // Relative to the first corner, or the digits of a small cell far from 0 degrees cancel.
        (a.longitude - corners[0].longitude) * (b.latitude - corners[0].latitude) -
            (b.longitude - corners[0].longitude) * (a.latitude - corners[0].latitude)
    }

    private fun degrees(value: Double) = JsonPrimitive(Math.round(value * UNITS) / UNITS)

    private fun element(value: Any?): JsonElement = when (value) {
        null -> JsonNull
        is Boolean -> JsonPrimitive(value)
        is Number -> if (value.toDouble().isFinite()) JsonPrimitive(value) else JsonNull
        else -> JsonPrimitive(value.toString())
    }
}
