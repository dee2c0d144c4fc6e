package stillwater.simulation

import stillwater.field.FieldMap
import stillwater.plot.CellMap
import stillwater.plot.Figure
import stillwater.plot.LinePlot
import stillwater.plot.MapCell
import stillwater.plot.MapLine
import stillwater.plot.Series
import stillwater.plot.WaterMap
import stillwater.run.kind
import stillwater.survey.isHalfKnown

/** A figure with its file's name and what stands under it. */
internal class SimulationFigure(val name: String, val figure: Figure, val caption: String)

/**
 * Draws a [SimulationResult].
 *
 * @param quantity with its unit.
 */
internal class SimulationFigures(private val result: SimulationResult, private val quantity: String) {
    private val run = result.run
    private val grid = run.world.site.grid

    /** All of them. */
    fun draw(): List<SimulationFigure> = listOf(estimate(), truth(), error(), track(), trace(), errorOverTime())

    private fun estimate() = SimulationFigure(
        "estimate",
        CellMap(
            "Estimate",
            "${result.atCentres.cells} of ${grid.size} cells have readings",
            cells({ result.map.isHalfKnown(run.spec.estimator.kind, it) }) {
                if (isKnown(result.map, it)) result.map.value(it) else Double.NaN
            },
            quantity,
            colours(),
        ).draw(),
        "What the mission believes at its end, in the colours of the water below.",
    )

    private fun truth() = SimulationFigure(
        "water",
        CellMap("Water", "at the cells' centres", cells { result.centre(it) }, quantity, colours()).draw(),
        "The simulated water. The mission knows nothing of it but the readings.",
    )

    private fun error() = SimulationFigure(
        "error",
        CellMap(
            "Estimate minus water",
            "at the cells' centres",
            cells { if (result.map.readings(it) > 0) result.map.value(it) - result.centre(it) else Double.NaN },
            quantity,
            isDifference = true,
        ).draw(),
        "Where the map is off, over the cells that have readings: blue where it is too low, red where it is too high.",
    )

    private fun track(): SimulationFigure {
        val outlines = run.spec.area.water().outlines.mapIndexed { ring, corners ->
            val closed = corners + corners.first()
            MapLine(
                if (ring == 0) "shore" else "keep-out $ring",
                DoubleArray(closed.size) { closed[it].x },
                DoubleArray(closed.size) { closed[it].y },
            )
        }
        val steps = (0 until run.track.size).filter { it % EVERY == 0 || it == run.track.size - 1 }
        val sailed = MapLine(
            "boat",
            DoubleArray(steps.size) { run.track.x(steps[it]) },
            DoubleArray(steps.size) { run.track.y(steps[it]) },
        )
        val figure = WaterMap("Where the boat was", "the outline is the fence", outlines, listOf(sailed)).draw()
        return SimulationFigure("track", figure, "The boat's true way, which the mission knows from its fixes only.")
    }

    private fun trace(): SimulationFigure {
        val frames = result.film.frames
        val minutes = DoubleArray(frames.size) { frames[it].time / MINUTE }
        fun column(of: (Frame) -> Double) = DoubleArray(frames.size) { of(frames[it]) }
        // Outside of the map there are no bounds, and crossed ones have no inside.
        val hasBounds = { frame: Frame -> frame.lower <= frame.upper }
        val figure = LinePlot(
            "Reading, bounds and water",
            "along the boat's way; the band is what the map allowed at that moment in the cell the boat was in",
            listOf(
                Series(
                    "bounds of the cell",
                    minutes,
                    // The band alone: its middle is the value only for some estimators.
                    column { Double.NaN },
                    column { if (hasBounds(it)) it.lower else Double.NaN },
                    column { if (hasBounds(it)) it.upper else Double.NaN },
                ),
                Series("reading", minutes, column { it.reading }),
                Series("water under the boat", minutes, column { it.truth }),
            ),
            "Time (min)",
            quantity,
        ).draw()
        return SimulationFigure("trace", figure, "A slow probe trails the water that it is in.")
    }

    private fun errorOverTime(): SimulationFigure {
        val frames = result.film.frames
        val figure = LinePlot(
            "Map error over time",
            "mean absolute error at the centres of the cells that have readings",
            listOf(
                Series(
                    "",
                    DoubleArray(frames.size) { frames[it].time / MINUTE },
                    DoubleArray(frames.size) { frames[it].error },
                ),
            ),
            "Time (min)",
            quantity,
        ).draw()
        return SimulationFigure("error-over-time", figure, "New cells come in with large errors and push it up.")
    }

    private fun isKnown(map: FieldMap, cell: Int) =
        map.readings(cell) > 0 || map.upper(cell) - map.lower(cell) < SURE * map.prior.width

    private fun colours(): ClosedFloatingPointRange<Double>? {
        val low = result.film.truths.min()
        val high = result.film.truths.max()
        return if (low < high) low..high else null
    }

    private fun cells(isHalf: (Int) -> Boolean = { false }, value: (Int) -> Double) = (0 until grid.size).map {
        MapCell.rectangle(
            grid.centerX(it),
            grid.centerY(it),
            grid.cellWidth,
            grid.cellHeight,
            grid.rotation,
            value(it),
            isHalf(it),
        )
    }

    companion object {
        /** Names of all figures there may be. */
        val NAMES = listOf("estimate", "water", "error", "track", "trace", "error-over-time")

        /** Steps between two points of the track: a second. */
        private const val EVERY = 10
        private const val MINUTE = 60.0

        /** A cell without readings is known where its bounds are narrower than this part of the prior's. */
        private const val SURE = 0.999
    }
}
