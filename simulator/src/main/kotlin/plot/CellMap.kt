package stillwater.plot

import org.jetbrains.letsPlot.geom.geomPolygon
import org.jetbrains.letsPlot.intern.layer.geom.PolygonMapping
import org.jetbrains.letsPlot.letsPlot
import org.jetbrains.letsPlot.sampling.samplingNone
import kotlin.math.cos
import kotlin.math.sin

/**
 * One cell of a map: an outline in a local frame (x east, y north) and a value.
 *
 * @param east the corners' x, m, in order around the cell, at least 3. Retained, not modified.
 * @param north the corners' y, m, as many. Retained, not modified.
 * @property value in the map's unit; NaN means that nothing is known here.
 * @property isHalfKnown whether the value is known from one side only; such a cell is drawn small, on grey.
 */
public class MapCell(
    internal val east: DoubleArray,
    internal val north: DoubleArray,
    public val value: Double,
    internal val isHalfKnown: Boolean = false,
) {
    init {
        require(east.size >= 3 && east.size == north.size) {
            "a cell needs 3 or more corners with east and north each, got ${east.size} and ${north.size}"
        }
        require(east.all(Double::isFinite) && north.all(Double::isFinite)) { "a cell's corners must be finite" }
    }

    /** The corners' places in [side], half as far from the middle of the cell. */
    internal fun inner(side: DoubleArray): DoubleArray {
        val middle = side.average()
        return DoubleArray(side.size) { (side[it] + middle) / 2 }
    }

    public companion object {
        /**
         * A rectangular cell.
         *
         * @param centreEast x of the centre, m. @param centreNorth y of the centre, m.
         * @param width side along the cell's own x axis, m. @param height side along its y axis, m.
         * @param rotation angle of the cell's x axis from east, counter-clockwise, rad.
         */
        public fun rectangle(
            centreEast: Double,
            centreNorth: Double,
            width: Double,
            height: Double,
            rotation: Double,
            value: Double,
            isHalfKnown: Boolean = false,
        ): MapCell {
            val across = doubleArrayOf(-width / 2, width / 2, width / 2, -width / 2)
            val along = doubleArrayOf(-height / 2, -height / 2, height / 2, height / 2)
            val c = cos(rotation)
            val s = sin(rotation)
            return MapCell(
                DoubleArray(across.size) { centreEast + c * across[it] - s * along[it] },
                DoubleArray(across.size) { centreNorth + s * across[it] + c * along[it] },
                value,
                isHalfKnown,
            )
        }
    }
}

/**
 * A map of cells coloured by value, true to scale: one metre is as long on either axis.
 *
 * @param cells the cells in any order; those with a NaN value are drawn grey and explained in the subtitle.
 * @param unit what the colours mean, such as `Oxygen (mg/L)`.
 * @param colours the values at the ends of the colour scale; by default those of the cells. Values beyond take the
 *   colour of the nearer end, and the subtitle says how many there are.
 * @param isDifference whether the values are differences, whose sign is what matters: blue below zero, red above.
 */
public class CellMap(
    private val title: String,
    private val subtitle: String = "",
    private val cells: List<MapCell>,
    private val unit: String,
    private val colours: ClosedFloatingPointRange<Double>? = null,
    private val isDifference: Boolean = false,
) : Drawing {
    override fun draw(): Figure {
        if (cells.isEmpty()) return Sheet(title, subtitle, MapFrame.WIDTH, MapFrame.EMPTY_HEIGHT).empty("no cells")
        val frame = MapFrame.around(cells.map { it.east }, cells.map { it.north }, MARGIN)
        val (known, unknown) = cells.partition { !it.value.isNaN() }
        val half = known.filter { it.isHalfKnown }
        val note = if (unknown.isEmpty()) "" else "grey: no value (${unknown.size} of ${cells.size} cells)"
        val small = if (half.isEmpty()) "" else "small: one bound only (${half.size} of ${cells.size})"
        var beyond = ""
        var plot = letsPlot() + frame.axes()
        // The library draws no scale for nothing but missing values, so the cells without one are a layer of their own.
        if (unknown.isNotEmpty() || half.isNotEmpty()) {
            plot += geomPolygon(
                outlines(unknown + half),
                size = OUTLINE,
                fill = Palette.ABSENT,
                color = Palette.ABSENT,
                sampling = samplingNone,
            ) { outline() }
        }
        if (known.isNotEmpty()) {
            val shown = known.map { it.value }
            val scale = if (isDifference) ColourScale.ofDifferences(shown) else ColourScale.of(shown, colours)
            beyond = scale.note(shown, "cells")
            val values = known.flatMap { cell -> List(cell.east.size) { scale.place(cell.value) } }
            plot += geomPolygon(shapes(known) + ("value" to values), size = OUTLINE, sampling = samplingNone) {
                outline()
                fill = "value"
                color = "value"
            }
            plot += scale.fill(unit, frame.isFlat) + scale.colour(unit, flat = null)
        }
        val below = listOf(subtitle, note, small, beyond).filter { it.isNotEmpty() }.joinToString("; ")
        return frame.sheet(title, below).figure(plot, frame.legend())
    }

    private fun outlines(shown: List<MapCell>): Map<String, List<Any?>> = mapOf(
        "east" to shown.flatMap { it.east.asList() },
        "north" to shown.flatMap { it.north.asList() },
        "cell" to shown.flatMapIndexed { index, cell -> List(cell.east.size) { index } },
    )

    /** As [outlines], those that are known from one side only drawn small. */
    private fun shapes(shown: List<MapCell>) = outlines(
        shown.map {
            if (it.isHalfKnown) MapCell(it.inner(it.east), it.inner(it.north), it.value) else it
        },
    )

    private fun PolygonMapping.outline() {
        x = "east"
        y = "north"
        group = "cell"
    }

    private companion object {
        const val MARGIN = 0.03

        /** An outline in the cell's own colour closes the hairlines between neighbours. */
        const val OUTLINE = 0.25
    }
}
