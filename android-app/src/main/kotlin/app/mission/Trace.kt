package stillwater.app.mission

import stillwater.estimate.SlopeWindow
import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Position
import stillwater.model.Reading

/** The last readings and what was believed after each; a fixed number of them. Confined to one thread. */
internal class Trace {
    private val slope = SlopeWindow(SLOPE_READINGS)
    private val points = ArrayDeque<TracePoint>()

    /** Takes [reading], which [map] has taken. */
    fun take(reading: Reading, map: FieldMap) {
        slope.add(reading.time.seconds, reading.value)
        val cell = map.grid.cellAt(reading.position).takeIf { it != Grid.OUTSIDE }
        if (points.size == READINGS) points.removeFirst()
        points +=
            TracePoint(
                reading.time.seconds,
                reading.value,
                if (slope.full) slope.slope() else null,
                cell,
                cell?.let(map::value),
                cell?.let(map::lower),
                cell?.let(map::upper),
            )
    }

    /** As of now, oldest first. */
    fun points(): List<TracePoint> = points.toList()

    private companion object {
        /** As the report's planner looks at. */
        const val SLOPE_READINGS = 5

        /** Half an hour of a probe that speaks every 3 s. */
        const val READINGS = 600
    }
}

/** Where the boat was: a fixed number of places, farther apart the longer the way. Confined to one thread. */
internal class Track {
    private var places = ArrayList<Position>()
    private var spacing = FIRST_SPACING

    /** The boat is at [place]; kept where it is far enough from the last. */
    fun add(place: Position) {
        if (places.isNotEmpty() && places.last().distanceTo(place) < spacing) return
        places.add(place)
        if (places.size < MOST) return
        places = places.filterIndexedTo(ArrayList(MOST)) { index, _ -> index % 2 == 0 }
        spacing *= 2
    }

    /** As of now, oldest first. */
    fun places(): List<Position> = places.toList()

    private companion object {
        /** m. */
        const val FIRST_SPACING = 0.5
        const val MOST = 4000
    }
}
