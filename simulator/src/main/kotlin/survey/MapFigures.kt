package stillwater.survey

import stillwater.field.FieldMap
import stillwater.plot.CellMap
import stillwater.plot.Figure
import stillwater.plot.Histogram
import stillwater.plot.LinePlot
import stillwater.plot.MapCell
import stillwater.plot.Mark
import stillwater.plot.Series
import stillwater.plot.TrackMap
import stillwater.run.FilterKind
import stillwater.survey.Wording.Companion.digits
import kotlin.math.ceil
import kotlin.math.sqrt

/**
 * A figure with the name of its files and what it shows.
 *
 * @property name name of the files, without ending. @property figure the drawing. @property caption a sentence or two.
 */
class MapFigure(val name: String, val figure: Figure, val caption: String)

/**
 * Draws a [SurveyMap]: the track, each filter's estimate, the width of the bounds, and the legs' comparison.
 *
 * The filters' maps share one colour scale that holds every value shown, so that they can be held side by side. The
 * track's goes from the 1 % to the 99 % quantile of the readings, so that a few outliers do not wash it out, and says
 * how many points lie beyond.
 *
 * @param map what to draw.
 */
class MapFigures(private val map: SurveyMap) {
    private val wording = Wording(map)
    private val quantity = shortened(map.log.quantity)
    private val legend = shortened(wording.quantity)
    private val where = map.log.file.fileName.toString() +
        map.correction?.let { ", corrected (sensor: ${shortened(it.sensor.name)})" }.orEmpty()
    private val trackColours = (map.statistics.values[RARE]..map.statistics.values[1 - RARE])
        .takeIf { it.start < it.endInclusive }
    private val cellColours = map.maps.flatMap { (kind, field) ->
        field.shownCells(kind).map { field.measuredValue(kind, it) }.filter { it.isFinite() }
    }.let { shown -> shown.minOrNull()?.rangeTo(shown.max())?.takeIf { it.start < it.endInclusive } }

    /** What draws each figure, in the order in which a reader wants them. */
    fun draw(): List<() -> MapFigure> = buildList {
        add { track() }
        map.maps.forEach { (kind, field) -> add { estimate(kind, field) } }
        map.maps.forEach { (kind, field) -> if (kind.givesBounds || isCorrectedMean(kind)) add { width(kind, field) } }
        map.mismatch?.let { add { shift(it) } }
        if (map.statistics.speeds.count > 1) add { speed() }
    }

    private fun track(): MapFigure {
        if (map.log.oneDimensional) return transect()
        val every = ceil(map.track.size / MOST_POINTS.toDouble()).toInt().coerceAtLeast(1)
        val points = ArrayList<Int>()
        for (point in 0 until map.track.size step every) {
            val before = points.lastOrNull()
            // A point without position interrupts the line.
            if (before != null && map.gaps.between(map.track.times[before], map.track.times[point])) points += NOWHERE
            points += point
        }
        val drawing = TrackMap(
            title = "$quantity along the track",
            subtitle = where,
            east = points.doubles { map.track.xs.getOrElse(it) { Double.NaN } },
            north = points.doubles { map.track.ys.getOrElse(it) { Double.NaN } },
            value = points.doubles { map.track.values.getOrElse(it) { Double.NaN } },
            unit = legend,
            colours = trackColours,
        )
        val thinned = every * map.track.stride
        val which = if (thinned == 1L) "Every reading" else "One in $thinned readings"
        val caption =
            "$which where the boat was when it was taken; no line is drawn over gaps. The colours end at the " +
                "1 % and the 99 % quantile of the readings; values beyond have the colour of the nearer end."
        return MapFigure("track", drawing.draw(), caption)
    }

    /** Readings over the only coordinate there is, by the way the vehicle went: the gap between the two is the lag. */
    private fun transect(): MapFigure {
        val every = ceil(map.track.size / MOST_POINTS.toDouble()).toInt().coerceAtLeast(1)
        val points = (every until map.track.size step every).toList()
        val (up, down) = points.partition { map.track.xs[it] >= map.track.xs[it - every] }
        fun series(name: String, indices: List<Int>) = Series(
            name,
            indices.doubles { map.track.xs[it] },
            indices.doubles { map.track.values[it] },
            mark = Mark.POINTS,
        )
        val drawing = LinePlot(
            title = "$quantity along the transect",
            subtitle = where,
            series = listOf(series("${map.log.xName} rising", up), series("${map.log.xName} falling", down)),
            xLabel = map.log.xName,
            yLabel = legend,
        )
        return MapFigure("track", drawing.draw(), "Every reading over ${map.log.xName}, by the way of travel.")
    }

    private fun estimate(kind: FilterKind, field: FieldMap): MapFigure {
        val title = "$quantity, ${kind.label} filter"
        val caption = when (kind) {
            FilterKind.BOUNDED ->
                "Midpoint of the bounds in each visited cell with both. Where one was set only, the cell is drawn " +
                    (if (map.log.oneDimensional) "apart" else "small") + ": its other end is that of the range taken " +
                    "for the water, so that its value says as much of the range as of the water. Where they crossed " +
                    "it is the middle between two bounds that contradict each other, and the water need not be " +
                    "there. Of ${counts(field)}."
            FilterKind.AVERAGING ->
                if (map.correction == null) {
                    "Mean of the readings in each visited cell."
                } else {
                    "Mean of the corrected readings in each visited cell."
                }
            FilterKind.EXPONENTIAL -> "Exponential average of the readings in each visited cell."
            FilterKind.INTERVAL ->
                "Midpoint of the bounds that hold for every sensor no slower than was said, in each visited cell."
            FilterKind.SELF_CALIBRATING ->
                "The water's value in each visited cell at the time constant that explains all readings best."
            FilterKind.BOUNDED_EXTENDED ->
                "The water's value in each visited cell by the readings there and their slopes, within the bounds."
            FilterKind.BAYESIAN ->
                "The water's most likely value: in visited cells from their own readings and their neighbours', in " +
                    "others from those around, where these narrow it to half of the range taken for the water."
        }
        val value: (Int) -> Double = { field.measuredValue(kind, it) }
        val counts = BoundCounts.of(field, kind)
        val below = if (counts.crossed == 0) where else "$where; crossed: ${counts.crossed} of ${counts.visited} cells"
        val figure = if (!map.log.oneDimensional) {
            val shown = cells(field, field.shownCells(kind), value) { field.isHalfKnown(kind, it) }
            CellMap(title, below, shown, legend, cellColours).draw()
        } else if (kind == FilterKind.BOUNDED) {
            boundedProfile(title, below, field, value)
        } else {
            profile(title, below, field, value, legend)
        }
        return MapFigure("estimate-${kind.label}", figure, caption)
    }

    /** Whether the filter [kind] has intervals by how well corrected readings are known. */
    private fun isCorrectedMean(kind: FilterKind) = kind == FilterKind.AVERAGING && map.correction != null

    private fun width(kind: FilterKind, field: FieldMap): MapFigure {
        val what = if (kind.areBoundsCredible || isCorrectedMean(kind)) "95 % intervals" else "bounds"
        val title = "$quantity, width of the $what" + if (kind == FilterKind.BOUNDED) "" else ", ${kind.label} filter"
        val width: (Int) -> Double = { cell ->
            map.bounds(kind, cell)?.let { it.upper - it.lower }?.takeIf { it >= 0 } ?: Double.NaN
        }
        val crossed = BoundCounts.of(field, kind).crossed
        val below = if (crossed == 0) where else "$where; crossed: $crossed, without width"
        val unit = "width of $legend"
        val figure = if (map.log.oneDimensional) {
            profile(title, below, field, width, unit)
        } else {
            CellMap(title, below, cells(field, field.shownCells(kind), width), unit).draw()
        }
        return MapFigure(widthName(kind), figure, widthCaption(kind, field))
    }

    private fun widthCaption(kind: FilterKind, field: FieldMap): String = when {
        isCorrectedMean(kind) ->
            "How well the water where the boat went through each cell is known from the corrected readings there, " +
                "if the sensor given is the right one."
        kind.areBoundsCredible ->
            "Upper minus lower end of each cell's 95 % interval, cut to the range taken for the water, " +
                "${digits(map.prior.lower)} to ${digits(map.prior.upper)}; of a cell that may be anywhere in it none."
        else ->
            "Upper minus lower bound in each visited cell with a bound; where only one was set the other end is " +
                "that of " +
                "the range taken for the water, ${digits(
                    map.prior.lower,
                )} to ${digits(map.prior.upper)}. Cells without " +
                "a bound and those whose bounds crossed have no width." +
                if (kind == FilterKind.BOUNDED) " Of ${counts(field)}." else ""
    }

    private fun counts(field: FieldMap) = BoundCounts.of(field).run {
        "$visited visited cells $both have both bounds, in $crossed they crossed, $oneSided have one and $none none"
    }

    private fun profile(
        title: String,
        subtitle: String,
        field: FieldMap,
        value: (Int) -> Double,
        label: String,
    ): Figure {
        val series = series("", field, field.visitedCells(), value, Mark.LINE_AND_POINTS)
        return LinePlot(title, subtitle, listOf(series), map.log.xName, label).draw()
    }

    /** As [profile], of cells with bounds: each kind of cell has its colour, and a band where bounds have not crossed. */
    private fun boundedProfile(title: String, subtitle: String, field: FieldMap, value: (Int) -> Double): Figure {
        val cells = field.visitedCells().groupBy { field.status(FilterKind.BOUNDED, it) }
        fun some(name: String, status: CellStatus, mark: Mark): List<Series> {
            val members = cells[status] ?: return emptyList()
            val values = series(name, field, members, value, mark)
            return if (status == CellStatus.CROSSED) listOf(values) else listOf(values, bands(name, field, members))
        }
        val series = some("both bounds", CellStatus.BOTH, Mark.LINE_AND_POINTS) +
            some("one bound only", CellStatus.ONE_SIDED, Mark.POINTS) +
            some("crossed", CellStatus.CROSSED, Mark.POINTS)
        return LinePlot(title, subtitle, series, map.log.xName, legend).draw()
    }

    /** The values of [members]; other cells that the boat entered interrupt the line. */
    private fun series(name: String, field: FieldMap, members: List<Int>, value: (Int) -> Double, mark: Mark): Series {
        val cells = field.visitedCells()
        val own = members.toSet()
        return Series(
            name,
            cells.doubles { field.grid.centerX(it) },
            cells.doubles { if (it in own) value(it) else Double.NaN },
            mark = mark,
        )
    }

    /** The bounds of [members], each over the whole width of its cell. */
    private fun bands(name: String, field: FieldMap, members: List<Int>): Series {
        val half = field.grid.cellWidth / 2
        val nothing = DoubleArray(members.size * CORNERS) { Double.NaN }
        fun each(of: (Int, Int) -> Double) = DoubleArray(nothing.size) { of(members[it / CORNERS], it % CORNERS) }
        return Series(
            name,
            each { cell, corner -> field.grid.centerX(cell) + if (corner == 0) -half else half },
            nothing,
            each { cell, corner -> if (corner < 2) field.lower(cell) else Double.NaN },
            each { cell, corner -> if (corner < 2) field.upper(cell) else Double.NaN },
        )
    }

    /** The [shown] cells, merged into blocks where there are too many to draw. */
    private fun cells(
        field: FieldMap,
        shown: List<Int>,
        value: (Int) -> Double,
        isHalf: (Int) -> Boolean = { false },
    ): List<MapCell> {
        val grid = field.grid
        val side = ceil(sqrt(shown.size / MOST_CELLS.toDouble())).toInt().coerceAtLeast(1)
        val blocks = shown.groupBy { (it / grid.columns / side) to (it % grid.columns / side) }
        return blocks.map { (block, members) ->
            val (row, column) = block
            val first = grid.center(row * side * grid.columns + column * side)
            // From the first cell's centre to the block's, along the grid's axes.
            val along = (side - 1) / 2.0 * grid.cellWidth
            val across = (side - 1) / 2.0 * grid.cellHeight
            val c = kotlin.math.cos(grid.rotation)
            val s = kotlin.math.sin(grid.rotation)
            // A block with any cell that is wholly known shows those.
            val whole = members.filterNot(isHalf).map(value).filter { it.isFinite() }
            val known = whole.ifEmpty { members.map(value).filter { it.isFinite() } }
            MapCell.rectangle(
                centreEast = first.x + c * along - s * across,
                centreNorth = first.y + s * along + c * across,
                width = side * grid.cellWidth,
                height = side * grid.cellHeight,
                rotation = grid.rotation,
                value = if (known.isEmpty()) Double.NaN else known.average(),
                isHalfKnown = whole.isEmpty(),
            )
        }
    }

    private fun shift(mismatch: LegMismatch): MapFigure {
        val drawing = LinePlot(
            title = "$quantity: how far opposite legs disagree",
            subtitle = where,
            series = listOf(Series("", mismatch.shift.shifts, mismatch.shift.curve)),
            xLabel = "Readings taken so much earlier (s)",
            yLabel = "Mean difference of $legend",
        )
        val caption = "Mean absolute difference between a leg and its two opposite neighbours, if every reading is " +
            "put where the boat was so many seconds before. A minimum to the right of 0 is a lag."
        return MapFigure("leg-mismatch", drawing.draw(), caption)
    }

    private fun speed(): MapFigure {
        val speeds = map.statistics.speeds
        // Beyond the 99.9 % quantile lie jumps of the receiver; they are counted in the last bin.
        val most = speeds[NEARLY_ALL].coerceAtLeast(SLOWEST)
        val edges = DoubleArray(BINS + 1) { most * it / BINS }
        val drawing = Histogram(
            title = "Speed over ground",
            subtitle = where,
            edges = edges,
            counts = speeds.counts(edges),
            valueLabel = "Speed (${wording.speed})",
            countLabel = "Stretches of 5 s, or one step",
        )
        return MapFigure("speed", drawing.draw(), "Speeds above the axis are in the last bar.")
    }

    private inline fun List<Int>.doubles(of: (Int) -> Double) = DoubleArray(size) { of(this[it]) }

    internal companion object {
        /** Names of the figures' files, without ending, that any run may write. */
        val NAMES: List<String> =
            listOf("track", "leg-mismatch", "speed") +
                FilterKind.entries.flatMap { listOf("estimate-${it.label}", widthName(it)) }

        private fun widthName(kind: FilterKind) =
            if (kind == FilterKind.BOUNDED) "bounds-width" else "bounds-width-${kind.label}"

        /** [name] in as many characters as a figure has room for. */
        private fun shortened(name: String) =
            if (name.length <= LONGEST_NAME) name else name.take(LONGEST_NAME - 1) + "…"

        private const val LONGEST_NAME = 60

        private const val RARE = 0.01

        /** Places at which the band of a cell is given: where it begins, where it ends, and one without a band. */
        private const val CORNERS = 3
        private const val NOWHERE = -1
        private const val MOST_POINTS = 4000
        private const val MOST_CELLS = 20_000
        private const val NEARLY_ALL = 0.999
        private const val SLOWEST = 0.01
        private const val BINS = 40
    }
}
