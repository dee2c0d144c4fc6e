package stillwater.benchmark

import stillwater.model.Position
import stillwater.plot.Drawing
import stillwater.plot.MapLine
import stillwater.plot.WaterMap
import stillwater.run.ExperimentResult
import stillwater.run.PlannerKind
import stillwater.run.Preset
import stillwater.run.Voyage

/** Draws where boats went in the plane in the first environment, upon the water and over the planner's first tree. */
object VoyageFigures {
    /** Names of the figures' files, without ending, that any run may write. */
    val names: List<String> = listOf(Preset.UNIFORM, Preset.GAUSSIAN).flatMap { field ->
        listOf("voyage-$field") + PlannerKind.entries.map { "voyage-$field-${it.label}" }
    }

    /** One figure a field and planner, of the most boats and the first filter, by name; none without a voyage. */
    fun of(result: ExperimentResult): List<Pair<String, Drawing>> {
        val planners = result.voyages.map { it.planner }.distinct()
        return result.settings.fields.keys.flatMap { field ->
            planners.mapNotNull { planner ->
                val name = "voyage-$field" + if (planners.size > 1) "-${planner.label}" else ""
                result.voyages.filter { it.field == field && it.planner == planner }
                    .maxByOrNull { it.tracks.size }?.let { name to drawing(result, it) }
            }
        }
    }

    private fun drawing(result: ExperimentResult, voyage: Voyage): Drawing {
        val outlines = result.settings.area?.outlines ?: listOf(gridOutline(result))
        return WaterMap(
            title = "Where the boats went, ${voyage.planner.label}, field ${voyage.field}",
            subtitle = "First environment, ${result.settings.moves} moves" +
                if (voyage.tree.isEmpty()) "" else "; thin: the first boat's first tree",
            outlines = outlines.mapIndexed { index, ring -> line(if (index == 0) "shore" else "keep-out", ring) },
            tracks = voyage.tracks.mapIndexed { index, track -> line("boat ${index + 1}", track) },
            legs = voyage.tree.map { (from, to) -> line("tree", listOf(from, to)) },
        )
    }

    private fun gridOutline(result: ExperimentResult): List<Position> {
        val grid = result.settings.grid
        return listOf(
            grid.corners(0)[0],
            grid.corners(grid.columns - 1)[1],
            grid.corners(grid.size - 1)[2],
            grid.corners(grid.size - grid.columns)[3],
        )
    }

    private fun line(name: String, places: List<Position>) =
        MapLine(name, DoubleArray(places.size) { places[it].x }, DoubleArray(places.size) { places[it].y })
}
