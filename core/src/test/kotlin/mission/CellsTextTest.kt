package stillwater.mission

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonNull
import kotlinx.serialization.json.double
import kotlinx.serialization.json.int
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import org.junit.jupiter.api.Test
import stillwater.field.FieldMap
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class CellsTextTest {
    private val spec = Desk.small()
    private val map = FieldMap(spec.grid.grid(), spec.probe.range).apply {
        setValue(1, 8.5)
        setBounds(1, 8.0, Double.POSITIVE_INFINITY)
        countReading(1)
        countVisit(1)
    }

    @Test
    fun everyCellIsALineAndWhatWasNotMeasuredHasNoValue() {
        val lines = buildString { CellsText(spec, map).csv(this) }.trimEnd().lines()
        assertEquals(map.grid.size + 1, lines.size)
        val columns = lines[0].split(',')
        assertTrue(lines.all { it.split(',').size == columns.size })
        val measured = columns.zip(lines[2].split(',')).toMap()
        assertEquals(listOf("1", "0", "8.5", "8.0", "", "1", "1"), measured.values(MEASURED))
        assertEquals(listOf("dissolved-oxygen", "mg/L"), measured.values(listOf("quantity", "unit")))
        assertEquals("", columns.zip(lines[1].split(',')).toMap()["value"])
        // The centre is where the grid has it, to the millimetre that a degree's digits leave.
        val place = LatLon(measured.getValue("lat_deg").toDouble(), measured.getValue("lon_deg").toDouble())
        val at = LocalFrame(LatLon(spec.origin.latitude, spec.origin.longitude)).toLocal(place)
        assertTrue(at.distanceTo(map.grid.center(1)) < 1e-3, "$at")
    }

    @Test
    fun theMeasuredCellsAreClosedPolygonsCounterClockwise() {
        val json = Json.parseToJsonElement(buildString { CellsText(spec, map).geoJson(this) }).jsonObject
        assertEquals("FeatureCollection", json.getValue("type").jsonPrimitive.content)
        val feature = json.getValue("features").jsonArray.single().jsonObject
        val properties = feature.getValue("properties").jsonObject
        assertEquals(8.5, properties.getValue("value").jsonPrimitive.double)
        assertEquals(JsonNull, properties.getValue("upper"))
        assertEquals(1, properties.getValue("column").jsonPrimitive.int)
        val ring = feature.getValue("geometry").jsonObject.getValue("coordinates").jsonArray.single().jsonArray
            .map { corner -> corner.jsonArray.map { it.jsonPrimitive.double } }
        assertEquals("mg/L", properties.getValue("unit").jsonPrimitive.content)
        assertEquals(5, ring.size)
        assertEquals(ring.first(), ring.last())
        val local = ring.map { (longitude, latitude) -> frame().toLocal(LatLon(latitude, longitude)) }
        // Rounded to 1e-8 degrees, so to a millimetre or so.
        local.zip(map.grid.corners(1)).forEach { (one, other) -> assertTrue(one.distanceTo(other) < 2e-3) }
        assertTrue(local.zipWithNext { a: Position, b: Position -> a.x * b.y - b.x * a.y }.sum() > 0)
    }

    @Test
    fun aMapWithoutReadingsIsACollectionOfNothing() {
        val empty = FieldMap(spec.grid.grid(), spec.probe.range)
        val json = Json.parseToJsonElement(buildString { CellsText(spec, empty).geoJson(this) }).jsonObject
        assertEquals(0, json.getValue("features").jsonArray.size)
    }

    private fun frame() = LocalFrame(LatLon(spec.origin.latitude, spec.origin.longitude))

    private fun Map<String, String>.values(names: List<String>) = names.map { getValue(it) }

    private companion object {
        val MEASURED = listOf("column", "row", "value", "lower", "upper", "visits", "readings")
    }
}
