package stillwater.app.screen

import android.content.Context
import android.graphics.Canvas
import stillwater.app.R
import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Position

/**
 * The live map: cells coloured by what is believed, the fainter the less certain; track, plan, fence, keep-outs, home
 * and boat; a cross where the boat did not get in.
 *
 * A cell that is tapped is outlined and told of: [onCell] gets its words. Drawn anew only when a scene comes or a
 * finger does. Confined to the main thread.
 */
internal class MapView(context: Context) : WaterView(context) {
    /** Takes what there is to say about the tapped cell, each time it changes. */
    var onCell: (String) -> Unit = {}

    /** What is drawn. */
    var scene: MapScene = MapScene()
        set(value) {
            field = value
            tapped = tapped?.takeIf { cell -> value.map?.let { cell < it.grid.size } == true }
            tapped?.let { cell -> value.map?.let { onCell(told(it, cell)) } }
            val said = described(value)
            if (contentDescription != said) contentDescription = said
            invalidate()
        }

    /** Whether a cell is outlined and told of. */
    val isTold: Boolean get() = tapped != null

    private var tapped: Int? = null
    private val legend = ColourLegend(this)

    init {
        contentDescription = described(scene)
    }

    override fun extent(): List<Position> = scene.extent

    override fun boat(): Position? = scene.boat

    override fun touched(position: Position, reach: Double) {
        tap(position)
    }

    override fun onDraw(canvas: Canvas) {
        val projection = projection() ?: return drawNothing(canvas, R.string.map_empty)
        val range = scene.map?.measuredRange()
        scene.map?.let { drawCells(canvas, projection, it, range) }
        drawGivenUp(canvas, projection)
        drawLine(canvas, projection, scene.fence, LineStyle(R.color.fence, FENCE_DP, isClosed = true))
        for (ring in scene.keepOuts) drawKeepOut(canvas, projection, ring)
        drawLine(canvas, projection, scene.track, LineStyle(R.color.track, TRACK_DP, hasHalo = true))
        val ahead = listOfNotNull(scene.boat) + scene.plan
        drawLine(canvas, projection, ahead, LineStyle(R.color.plan, PLAN_DP, isDashed = true))
        tapped?.let { cell -> scene.map?.let { drawOutline(canvas, projection, it.grid, cell) } }
        scene.home?.let { drawHome(canvas, projection.x(it), projection.y(it)) }
        scene.boat?.let { drawBoat(canvas, projection.x(it), projection.y(it), scene.headingDeg) }
        drawScale(canvas, projection)
        range?.let { legend.draw(canvas, it, scene.unit) }
    }

    /** What is known of the cell at [position]; null where there is none. */
    internal fun tap(position: Position): String? {
        val map = scene.map ?: return null
        val cell = map.grid.cellAt(position)
        if (cell == Grid.OUTSIDE) return null
        tapped = cell
        invalidate()
        return told(map, cell).also {
            announceForAccessibility(it)
            onCell(it)
        }
    }

    private fun told(map: FieldMap, cell: Int): String {
        val known = known(map, cell)
        return if (cell in scene.givenUp.cells) resources.getString(R.string.cell_given_up, known) else known
    }

    private fun known(map: FieldMap, cell: Int): String {
        val bounds = context.boundsWords(map.lower(cell), map.upper(cell), map.prior)
        if (map.readings(cell) == 0) {
            return resources.getString(R.string.cell_not_measured, bounds, scene.unit).trim()
        }
        val said =
            resources.getQuantityString(
                R.plurals.cell_measured,
                map.readings(cell),
                map.value(cell),
                scene.unit,
                bounds,
                map.readings(cell),
            )
        val age = scene.ageOf(cell) ?: return said
        return resources.getString(R.string.cell_aged, said, context.duration(age))
    }

    private fun described(scene: MapScene): String {
        val map = scene.map ?: return resources.getString(R.string.map_empty_said)
        val measured = (0 until map.grid.size).count { map.readings(it) > 0 }
        val said = resources.getString(R.string.map_said, measured, map.grid.size)
        val givenUp = context.givenUpWords(scene.givenUp) ?: return said
        return resources.getString(R.string.map_said_given_up, said, givenUp)
    }

    /** A cross in each cell that the boat did not get into, on the map and off it. */
    private fun drawGivenUp(canvas: Canvas, projection: MapProjection) {
        val grid = scene.map?.grid ?: return
        val places = scene.givenUp.run { cells.filter { it < grid.size }.map(grid::center) + offMap }
        val halfX = CROSS_SHARE * grid.cellWidth
        val halfY = CROSS_SHARE * grid.cellHeight
        // The halos first, or one arm's would cut the other.
        for (style in listOf(LineStyle(R.color.ground, CROSS_DP + HALO), LineStyle(R.color.fence, CROSS_DP))) {
            for (at in places) {
                for (rise in listOf(-halfY, halfY)) {
                    val ends = listOf(Position(at.x - halfX, at.y - rise), Position(at.x + halfX, at.y + rise))
                    drawLine(canvas, projection, ends, style)
                }
            }
        }
    }

    private fun drawCells(canvas: Canvas, projection: MapProjection, map: FieldMap, range: Interval?) {
        val reach = maxOf(map.grid.cellWidth, map.grid.cellHeight) * projection.scale
        stroke(R.color.line, HAIR_DP)
        for (cell in 0 until map.grid.size) {
            if (!isInSight(projection, map.grid, cell, reach)) continue
            trace(projection, map.grid.corners(cell), isClosed = true)
            if (map.isUnknown(cell)) {
                // Nothing is known of it: its outline alone.
                canvas.drawPath(path, line)
                continue
            }
            // One measured value alone sits in the middle.
            val share = range?.takeIf { it.width > 0 }?.let { (map.value(cell) - it.lower) / it.width } ?: MIDDLE
            fill.color = FieldColours.faded(FieldColours.of(share), map.certainty(cell))
            canvas.drawPath(path, fill)
        }
    }

    /** Whether any of [cell], whose corners are at most [reach] px from its centre, is in the view. */
    private fun isInSight(projection: MapProjection, grid: Grid, cell: Int, reach: Double): Boolean {
        val x = projection.x(grid.centerX(cell))
        val y = projection.y(grid.centerY(cell))
        return x > -reach && x < width + reach && y > -reach && y < height + reach
    }

    private fun drawKeepOut(canvas: Canvas, projection: MapProjection, ring: List<Position>) {
        trace(projection, ring, isClosed = true)
        fill.color = FieldColours.faded(context.getColor(R.color.fence), 0.0)
        canvas.drawPath(path, fill)
        drawLine(canvas, projection, ring, LineStyle(R.color.fence, FENCE_DP, isClosed = true, isDashed = true))
    }

    private fun drawOutline(canvas: Canvas, projection: MapProjection, grid: Grid, cell: Int) {
        trace(projection, grid.corners(cell), isClosed = true)
        stroke(R.color.ground, TAPPED_DP + TRACK_DP)
        canvas.drawPath(path, line)
        stroke(R.color.text, TAPPED_DP)
        canvas.drawPath(path, line)
    }

    private companion object {
        const val HAIR_DP = 0.5f
        const val TRACK_DP = 2f
        const val PLAN_DP = 3f
        const val FENCE_DP = 2.5f
        const val TAPPED_DP = 3f
        const val CROSS_DP = 2f
        const val HALO = 2f

        /** Of a cell's side, half a cross. */
        const val CROSS_SHARE = 0.3
        const val MIDDLE = 0.5
    }
}
