package stillwater.report

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonNull
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.double
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class GeoJsonTest {
    private val clockwise = listOf(
        GeoCorner(-73.151234567891, 45.54),
        GeoCorner(-73.151234567891, 45.55),
        GeoCorner(-73.14, 45.55),
        GeoCorner(-73.14, 45.54),
    )

    private fun features(vararg polygons: GeoPolygon): List<JsonObject> =
        Json.parseToJsonElement(GeoJson.text(polygons.toList())).jsonObject.getValue("features").jsonArray.map {
            it.jsonObject
        }

    private fun ring(feature: JsonObject): List<Pair<Double, Double>> =
        feature.getValue("geometry").jsonObject.getValue("coordinates").jsonArray.single().jsonArray.map {
            it.jsonArray[0].jsonPrimitive.double to it.jsonArray[1].jsonPrimitive.double
        }

    @Test
    fun ringsAreClosedAndCounterClockwiseFromEitherDirection() {
        for (corners in listOf(clockwise, clockwise.reversed())) {
            val ring = ring(features(GeoPolygon(corners, emptyMap())).single())
            assertEquals(5, ring.size)
            assertEquals(ring.first(), ring.last())
            val area = ring.zipWithNext { a, b -> (b.first - a.first) * (b.second + a.second) }.sum()
            assertTrue(area < 0, "the area under a counter-clockwise ring is negative: $area")
        }
    }

    @Test
    fun longitudeComesFirstRoundedToEightDecimals() {
        val text = GeoJson.text(listOf(GeoPolygon(clockwise, emptyMap())))
        assertTrue("[-73.15123457,45.54]" in text, text)
    }

    @Test
    fun propertiesKeepTheirTypesAndNanIsNull() {
        val properties = mapOf(
            "value" to 8.25,
            "visits" to 3,
            "name" to "a \"b\"",
            "gap" to Double.NaN,
            "ok" to true,
            "none" to null,
        )
        val read = features(GeoPolygon(clockwise, properties)).single().getValue("properties").jsonObject
        assertEquals(
            listOf("8.25", "3", "a \"b\"", "null", "true", "null"),
            read.values.map {
                it.jsonPrimitive.content
            },
        )
        assertEquals(JsonNull, read["gap"])
        assertTrue(read.getValue("name").jsonPrimitive.isString)
    }

    @Test
    fun noPolygonsIsAnEmptyCollection() {
        assertEquals(0, features().size)
    }

    @Test
    fun impossibleCornersAreRefused() {
        assertFailsWith<IllegalArgumentException> { GeoCorner(181.0, 0.0) }
        assertFailsWith<IllegalArgumentException> { GeoCorner(0.0, Double.NaN) }
        assertFailsWith<IllegalArgumentException> { GeoPolygon(clockwise.take(2), emptyMap()) }
    }
}
