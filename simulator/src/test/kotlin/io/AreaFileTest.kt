package stillwater.io

import org.junit.jupiter.api.Test
import stillwater.model.Position
import stillwater.model.WaterArea
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** What is refused is tested where the user sees it, in BenchmarkBadInputTest. */
class AreaFileTest {
    private fun feature(rings: String, properties: String = "null") =
        """{"type": "Feature", "properties": $properties, "geometry": {"type": "Polygon", "coordinates": [$rings]}}"""

    @Test
    fun holesAreIslandsAndMarkedPolygonsAreKeptOutOf() {
        val lake =
            feature("[[0,0],[10,0],[10,10],[0,10],[0,0]], [[4,4],[4,6],[6,6],[6,4],[4,4]]", """{"name": "lake"}""")
        val zone = feature("[[8,8],[12,8],[12,12],[8,12],[8,8]]", """{"keep-out": true}""")
        val text = """{"type": "FeatureCollection", "features": [$zone, $lake]}"""
        val area = AreaFile.parse(text, "lake.geojson", AreaUnits.METRES)
        assertEquals(3, area.outlines.size)
        assertTrue(Position(1.0, 1.0) in area)
        assertFalse(Position(5.0, 5.0) in area, "the island")
        assertFalse(Position(9.0, 9.0) in area, "the zone")
    }

    @Test
    fun degreesBecomeMetresAboutTheMiddle() {
        // A hundredth of a degree about 45 N: 1111.3 m north (meridian radius 6 367 382 m there), 788.5 m east.
        val text = """{"type": "Polygon", "coordinates": [[[9.99,44.99],[10.01,44.99],[10.01,45.01],[9.99,45.01]]]}"""
        val area = AreaFile.parse(text, "square.geojson", AreaUnits.DEGREES)
        assertEquals(2 * 1111.3, area.north - area.south, 0.5, "half a metre for the radius as rounded here")
        assertEquals(2 * 788.5, area.east - area.west, 0.5, "at the southern shore, which is a little wider")
        assertEquals(0.0, (area.east + area.west) / 2, 1e-6, "symmetric about the origin")
    }

    @Test
    fun shoreAcrossTheDateLineIsNotMirrored() {
        // West shore at 179.99 E, east shore at 179.99 W, the corner in the south-east cut off.
        fun lake(east: String): WaterArea {
            val ring = "[[179.99,-17],[180,-17],[$east,-16.99],[$east,-16.98],[179.99,-16.98]]"
            return AreaFile.parse("""{"type": "Polygon", "coordinates": [$ring]}""", "l.geojson", AreaUnits.DEGREES)
        }
        val signed = lake("-179.99")
        val unsigned = lake("180.01")
        // Rounding of degrees, in metres.
        assertEquals(unsigned.east, signed.east, 1e-6)
        assertEquals(unsigned.west, signed.west, 1e-6)
        assertTrue(Position(-1000.0, -1000.0) in signed, "the south-western corner")
        assertFalse(Position(1000.0, -1000.0) in signed, "the corner that is cut off")
    }

    @Test
    fun aMultiPolygonOfKeepOutsIsSeveral() {
        val lake = feature("[[0,0],[10,0],[10,10],[0,10],[0,0]]")
        val zones = """{"type": "Feature", "properties": {"keep-out": true}, "geometry": {"type": "MultiPolygon",
            "coordinates": [[[[1,1],[2,1],[2,2],[1,2]]], [[[5,5],[6,5],[6,6],[5,6]]]]}}"""
        val text = """{"type": "FeatureCollection", "features": [$lake, $zones]}"""
        assertEquals(3, AreaFile.parse(text, "lake.geojson", AreaUnits.METRES).outlines.size)
    }

    @Test
    fun aKeepOutWithAHoleIsRefused() {
        val lake = feature("[[0,0],[10,0],[10,10],[0,10],[0,0]]")
        val zone = feature("[[1,1],[5,1],[5,5],[1,5]], [[2,2],[3,2],[3,3],[2,3]]", """{"keep-out": true}""")
        val text = """{"type": "FeatureCollection", "features": [$lake, $zone]}"""
        val refused = assertFailsWith<JsonFileProblem> { AreaFile.parse(text, "lake.geojson", AreaUnits.METRES) }
        val path = "features[1].geometry.coordinates[1]"
        assertEquals("lake.geojson:1:301: $path: expected keep-outs without holes, found a hole", refused.message)
    }

    @Test
    fun aKeepOutIsTrueOrFalse() {
        val ring = "[[0,0],[10,0],[10,10],[0,10],[0,0]]"
        for (none in listOf("{}", "null", """{"keep-out": null}""", """{"keep-out": false}""")) {
            assertEquals(1, AreaFile.parse(feature(ring, none), "lake.geojson", AreaUnits.METRES).outlines.size, none)
        }
        for (other in listOf("\"yes\"", "1", "\"true\"", "[true]")) {
            val text = feature(ring, """{"keep-out": $other}""")
            val refused = assertFailsWith<JsonFileProblem> { AreaFile.parse(text, "lake.geojson", AreaUnits.METRES) }
            val expected = "properties.keep-out: expected true or false without quotes, found $other"
            assertTrue(refused.message.orEmpty().endsWith(expected), refused.message)
        }
    }

    @Test
    fun theRingThatDoesNotFitIsPointedAt() {
        val shore = "[[0,0],[10,0],[10,10],[0,10]]"
        val text = "{\"type\": \"Polygon\", \"coordinates\": [\n$shore,\n [[20,0],[21,0],[21,1]]]}"
        val refused = assertFailsWith<JsonFileProblem> { AreaFile.parse(text, "lake.geojson", AreaUnits.METRES) }
        val expected = "keep-out 1, which starts at (20.0 m, 0.0 m), lies outside the shore"
        assertEquals("lake.geojson:3:2: coordinates[1]: $expected", refused.message)
    }
}
