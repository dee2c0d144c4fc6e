package stillwater.survey

import stillwater.field.FieldMap
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.plot.atOnce
import stillwater.plot.drawConcurrently
import stillwater.report.CsvTable
import stillwater.report.GeoCorner
import stillwater.report.GeoJson
import stillwater.report.GeoPolygon
import stillwater.report.OutputDirectory
import stillwater.report.writeFigures
import stillwater.run.FilterKind
import kotlin.math.abs

/**
 * Writes what a [SurveyMap] gives: cells.csv, cells.geojson, the figures and report.html.
 *
 * cells.csv has every cell of every filter, visited or not, with its status; where nothing was measured the value is
 * empty, and so are the bounds, as they are for filters without bounds; but the means of corrected readings have those of
 * [CorrectedCells]. The end of a one-sided cell that no evidence set is that of the range taken for the water.
 * cells.geojson has the visited cells only, and is left out for logs without latitudes, because RFC 7946 knows no other
 * coordinates.
 *
 * @param map what to write. @param summary the same in words. @param command the command as typed, for the report.
 */
class MapFiles(private val map: SurveyMap, private val summary: MapSummary, private val command: String) {
    /**
     * Writes all files into [directory], which the caller commits.
     *
     * @return warnings for the user, one line each.
     */
    fun write(directory: OutputDirectory): List<String> {
        directory.retire(MapFigures.NAMES.flatMap { listOf("$it.svg", "$it.png") } + "cells.geojson")
        var polygons: String? = null
        val figures = drawConcurrently(
            MapFigures(map).draw(),
            // Nothing else is written meanwhile: a directory is for one thread at a time.
            beside = listOf(
                { cells(directory) },
                { polygons = map.log.frame?.let { GeoJson.text(polygons(it)) } },
            ),
        ) { it.figure }
        polygons?.let { directory.write("cells.geojson", it) }
        var warnings = emptyList<String>()
        var report = ""
        atOnce(
            listOf(
                { warnings = directory.writeFigures(figures.map { it.name to it.figure }) },
                { report = MapReport(map, summary, figures, command).render() },
            ),
        )
        directory.write("report.html", report)
        return warnings
    }

    private fun cells(directory: OutputDirectory) = directory.stream("cells.csv") { out ->
        val table = CsvTable(out, COLUMNS)
        map.maps.forEach { (kind, field) -> rows(table, kind, field) }
        // Closing it writes what it has buffered.
        table.close()
    }

    private fun rows(table: CsvTable, kind: FilterKind, field: FieldMap) {
        val grid = field.grid
        for (cell in 0 until grid.size) {
            val center = grid.center(cell)
            val place = map.log.frame?.toLatLon(center)
            val status = field.status(kind, cell)
            val bounds = map.bounds(kind, cell)
            table.row(
                kind.label,
                cell % grid.columns,
                cell / grid.columns,
                center.x,
                center.y,
                place?.latitudeDeg,
                place?.longitudeDeg,
                field.measuredValue(kind, cell),
                bounds?.lower,
                bounds?.upper,
                field.visits(cell),
                field.readings(cell),
                field.conflicts(cell),
                status.label,
            )
        }
    }

    private fun polygons(frame: LocalFrame): List<GeoPolygon> = map.maps.flatMap { (kind, field) ->
        field.shownCells(kind).map { cell -> polygon(frame, kind, field, cell) }
    }

    private fun polygon(frame: LocalFrame, kind: FilterKind, field: FieldMap, cell: Int): GeoPolygon {
        val center = frame.toLatLon(field.grid.center(cell))
        val status = field.status(kind, cell)
        val bounds = map.bounds(kind, cell)
        val corners = field.grid.corners(cell).map { corner -> corner(frame.toLatLon(corner), center) }
        return GeoPolygon(
            corners,
            mapOf(
                "filter" to kind.label,
                "quantity" to map.log.quantity,
                "unit" to map.unit,
                "column" to cell % field.grid.columns,
                "row" to cell / field.grid.columns,
                "value" to field.measuredValue(kind, cell),
                "lower" to bounds?.lower,
                "upper" to bounds?.upper,
                "visits" to field.visits(cell),
                "readings" to field.readings(cell),
                "conflicts" to field.conflicts(cell),
                "status" to status.label,
            ),
        )
    }

    /** A cell on the date line is cut there, or its outline would go around the globe. */
    private fun corner(place: LatLon, center: LatLon): GeoCorner {
        val beyond = abs(place.longitudeDeg - center.longitudeDeg) > HALF_TURN
        val longitude = if (beyond) (if (center.longitudeDeg > 0) HALF_TURN else -HALF_TURN) else place.longitudeDeg
        return GeoCorner(longitude, place.latitudeDeg)
    }

    private companion object {
        const val HALF_TURN = 180.0
        val COLUMNS = listOf(
            "filter",
            "column",
            "row",
            "x_m",
            "y_m",
            "lat_deg",
            "lon_deg",
            "value",
            "lower",
            "upper",
            "visits",
            "readings",
            "conflicts",
            "status",
        )
    }
}
