package stillwater.replay

import stillwater.io.BoundedLines
import stillwater.io.LogContent
import stillwater.io.PlatypusEntry
import stillwater.io.PlatypusLine
import stillwater.io.PlatypusLog
import stillwater.io.PlatypusVersion
import stillwater.mission.AreaSpec
import stillwater.mission.BudgetSpec
import stillwater.mission.EstimatorName
import stillwater.mission.GridSpec
import stillwater.mission.MissionSpec
import stillwater.mission.OriginSpec
import stillwater.mission.PlaceSpec
import stillwater.mission.PlannerName
import stillwater.mission.ProbeSpec
import stillwater.mission.Quantity
import stillwater.model.Interval
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import kotlin.math.abs
import kotlin.math.ceil
import kotlin.math.floor
import kotlin.math.max

/**
 * A mission around a Platypus log that came without one: cells over where the boat was, the probe that the log has most
 * of, its range that of the readings and a tenth more.
 *
 * Told beforehand what only the whole log shows, it is for looking at a log, not for judging how a mission would have
 * gone.
 */
internal class MadeUpMission(private val content: LogContent, private val version: PlatypusVersion) {
    private class Readings(val port: Int) {
        val values = ArrayList<Double>()
    }

    private var origin: LatLon? = null
    private var placeholder: LatLon? = null
    private var frame: LocalFrame? = null
    private var east = Interval(0.0, 0.0)
    private var north = Interval(0.0, 0.0)
    private val probes = LinkedHashMap<Quantity, Readings>()

    /** The mission; [warnings] hears what had to be assumed. */
    fun spec(warnings: MutableList<String>): MissionSpec {
        val parser = PlatypusLine(version)
        BoundedLines(content.reader {}).use { lines -> for (line in lines) take(parser.parse(line)) }
        val zero = origin ?: placeholder ?: LatLon(0.0, 0.0)
        if (origin == null) warnings += "the log has no fix: its mission waits for one"
        val most = probes.entries.maxByOrNull { it.value.values.size }
        val quantity = most?.key ?: Quantity.DISSOLVED_OXYGEN
        val found = most?.value ?: Readings(-1)
        if (found.values.isEmpty()) warnings += "the log has no reading of a probe that a mission can have"
        return MissionSpec(
            name = "replay",
            origin = OriginSpec(zero.latitudeDeg, zero.longitudeDeg),
            area = area(),
            grid = grid(),
            probe = probe(quantity, found),
            estimator = EstimatorName.AVERAGING,
            planner = PlannerName.LAWNMOWER,
            budget = BudgetSpec(seconds = LONG),
            home = PlaceSpec(0.0, 0.0),
        )
    }

    private fun take(entry: PlatypusEntry) {
        if (entry is PlatypusEntry.Pose) pose(entry)
        if (entry !is PlatypusEntry.Sensor || entry.data.isEmpty() || entry.data.any { !it.isFinite() }) return
        when (entry.type) {
            "ATLAS_DO" -> add(Quantity.DISSOLVED_OXYGEN, entry, 0)
            "ATLAS_PH" -> add(Quantity.ACIDITY, entry, 0)
            "ES2" -> add(Quantity.TEMPERATURE, entry, 1)
            "HDS_DEPTH" -> add(Quantity.DEPTH, entry, 0)
            else -> Unit
        }
    }

    private fun add(quantity: Quantity, entry: PlatypusEntry.Sensor, field: Int) {
        val value = entry.data.getOrNull(field) ?: return
        val list = probes.getOrPut(quantity) { Readings(entry.channel) }
        if (list.port == entry.channel) list.values += value
    }

    private fun pose(pose: PlatypusEntry.Pose) {
        val place = PlatypusReplay.placeOf(pose) ?: return
        if (PlatypusLog.isPlaceholder(pose)) {
            placeholder = placeholder ?: place
            return
        }
        if (!LocalFrame.canStartAt(place.latitudeDeg)) return
        val frame = frame ?: LocalFrame(place).also {
            frame = it
            origin = place
        }
        val local = frame.toLocal(place)
        if (!(abs(local.x) < FARTHEST && abs(local.y) < FARTHEST)) return
        east = Interval(minOf(east.lower, local.x), maxOf(east.upper, local.x))
        north = Interval(minOf(north.lower, local.y), maxOf(north.upper, local.y))
    }

    private val cell get() = max(1.0, ceil(max(east.width, north.width) / MOST_CELLS))

    private fun grid(): GridSpec {
        val west = floor(east.lower / cell) * cell - cell
        val south = floor(north.lower / cell) * cell - cell
        return GridSpec(
            PlaceSpec(west, south),
            columns = ceil((east.upper - west) / cell).toInt() + 1,
            rows = ceil((north.upper - south) / cell).toInt() + 1,
            cell = cell,
        )
    }

    private fun area(): AreaSpec {
        val cells = grid().grid()
        val margin = MARGIN
        val corner = grid().southWest
        return AreaSpec(
            southWest = PlaceSpec(corner.x - margin, corner.y - margin),
            northEast = PlaceSpec(
                corner.x + cells.columns * cell + margin,
                corner.y + cells.rows * cell + margin,
            ),
        )
    }

    private fun probe(quantity: Quantity, found: Readings): ProbeSpec {
        val low = found.values.minOrNull() ?: 0.0
        val high = found.values.maxOrNull() ?: HIGHEST
        val more = max((high - low) / TENTH, SMALLEST)
        return ProbeSpec(
            quantity,
            port = found.port.takeIf { it in 0..PORTS },
            lowest = low - more,
            highest = high + more,
            largestJump = high - low + more,
        )
    }

    private companion object {
        const val MOST_CELLS = 20
        const val MARGIN = 30.0
        const val LONG = 864_000.0
        const val FARTHEST = 20_000.0
        const val HIGHEST = 20.0
        const val TENTH = 10
        const val SMALLEST = 0.1
        const val PORTS = 9
    }
}
