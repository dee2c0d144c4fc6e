package stillwater.mission

import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonNull
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import stillwater.field.FieldMap
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position

/**
 * A mission's map as text for other programs: every cell as CSV, the measured ones as GeoJSON (RFC 7946).
 *
 * A cell without a reading has no value and the range of the water for bounds. Not-a-number and infinity are an empty
 * field and null. Neither closes what it writes to.
 *
 * @param spec the mission. @param map what is believed; read while writing.
 */
public class CellsText(private val spec: MissionSpec, private val map: FieldMap) {
    private val frame = LocalFrame(LatLon(spec.origin.latitude, spec.origin.longitude))
    private val quantity = spec.probe.quantity.name.lowercase().replace('_', '-')

    /**
     * Writes a header with the units in its names, and a line for each cell, row by row from the south-west. The unit
     * of value, lower and upper is the mission's and stands in a column of its own; empty where it has none.
     */
    public fun csv(out: Appendable) {
        out.append("column,row,x_m,y_m,lat_deg,lon_deg,value,lower,upper,visits,readings,conflicts,quantity,unit\n")
        for (cell in 0 until map.grid.size) {
            val center = map.grid.center(cell)
            val place = frame.toLatLon(center)
            val numbers = listOf(center.x, center.y, place.latitudeDeg, place.longitudeDeg) +
                listOf(value(cell), map.lower(cell), map.upper(cell))
            out.append("${cell % map.grid.columns},${cell / map.grid.columns},")
            out.append(numbers.joinToString(",") { if (it.isFinite()) it.toString() else "" })
            out.append(",${map.visits(cell)},${map.readings(cell)},${map.conflicts(cell)}")
            out.append(",$quantity,${spec.probe.quantity.unit}\n")
        }
    }

    /** Writes a feature collection with a polygon for each cell that was measured. */
    public fun geoJson(out: Appendable) {
        out.append("{\"type\":\"FeatureCollection\",\"features\":[")
        var written = 0
        for (cell in 0 until map.grid.size) {
            if (map.readings(cell) == 0) continue
            out.append(if (written++ == 0) "\n" else ",\n").append(feature(cell).toString())
        }
        out.append("\n]}\n")
    }

    private fun value(cell: Int) = if (map.readings(cell) > 0) map.value(cell) else Double.NaN

    private fun feature(cell: Int): JsonElement {
        val corners = map.grid.corners(cell)
        // Counter-clockwise already; closed as the standard wants it.
        val ring = JsonArray((corners + corners.first()).map(::coordinates))
        val properties = mapOf(
            "mission" to JsonPrimitive(spec.name),
            "quantity" to JsonPrimitive(quantity),
            "unit" to JsonPrimitive(spec.probe.quantity.unit),
            "column" to JsonPrimitive(cell % map.grid.columns),
            "row" to JsonPrimitive(cell / map.grid.columns),
            "value" to number(map.value(cell)),
            "lower" to number(map.lower(cell)),
            "upper" to number(map.upper(cell)),
            "visits" to JsonPrimitive(map.visits(cell)),
            "readings" to JsonPrimitive(map.readings(cell)),
            "conflicts" to JsonPrimitive(map.conflicts(cell)),
        )
        return JsonObject(
            mapOf(
                "type" to JsonPrimitive("Feature"),
                "geometry" to JsonObject(
                    mapOf("type" to JsonPrimitive("Polygon"), "coordinates" to JsonArray(listOf(ring))),
                ),
                "properties" to JsonObject(properties),
            ),
        )
    }

    private fun coordinates(at: Position): JsonElement {
        val place = frame.toLatLon(at)
        return JsonArray(listOf(place.longitudeDeg, place.latitudeDeg).map { JsonPrimitive(rounded(it)) })
    }

    private fun number(value: Double) = if (value.isFinite()) JsonPrimitive(value) else JsonNull

    /** To 1e-8 degrees, about a millimetre. */
    private fun rounded(degrees: Double) = Math.round(degrees * UNITS) / UNITS

    private companion object {
        const val UNITS = 1e8
    }
}
