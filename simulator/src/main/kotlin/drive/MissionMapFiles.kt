package stillwater.drive

import stillwater.field.FieldMap
import stillwater.mission.MissionSpec
import stillwater.plot.CellMap
import stillwater.plot.MapCell
import stillwater.report.CsvTable
import stillwater.report.OutputDirectory
import stillwater.report.writeFigures
import stillwater.run.kind
import stillwater.run.withUnit
import stillwater.survey.isHalfKnown

/** Writes the map that a mission made: `cells.csv`, exact to the last bit, and the figure `map`. */
internal object MissionMapFiles {
    private val HEADER = listOf("cell", "x_m", "y_m", "value", "lower", "upper", "visits", "readings", "conflicts")

    /**
     * Writes [map] of [spec] into [directory]; the figure only where it [isDrawn]. Answers a warning where something is
     * missing.
     */
    fun write(directory: OutputDirectory, spec: MissionSpec, map: FieldMap, isDrawn: Boolean): List<String> {
        val grid = map.grid
        directory.stream("cells.csv") { out ->
            CsvTable(out, HEADER).use { table ->
                for (cell in 0 until grid.size) {
                    table.row(
                        cell,
                        grid.centerX(cell),
                        grid.centerY(cell),
                        map.value(cell),
                        map.lower(cell),
                        map.upper(cell),
                        map.visits(cell),
                        map.readings(cell),
                        map.conflicts(cell),
                    )
                }
            }
        }
        if (!isDrawn) return emptyList()
        val cells = (0 until grid.size).map { cell ->
            val value = if (map.readings(cell) > 0) map.value(cell) else Double.NaN
            val side = spec.grid.cell
            val isHalf = map.isHalfKnown(spec.estimator.kind, cell)
            MapCell.rectangle(grid.centerX(cell), grid.centerY(cell), side, side, grid.rotation, value, isHalf)
        }
        val known = (0 until grid.size).count { map.readings(it) > 0 }
        val quantity = spec.probe.quantity.withUnit
        val subtitle = "$known of ${grid.size} cells have readings"
        return directory.writeFigures(listOf("map" to CellMap(spec.name, subtitle, cells, quantity).draw()))
    }
}
