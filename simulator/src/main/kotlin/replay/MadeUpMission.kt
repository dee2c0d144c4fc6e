package stillwater.replay

import stillwater.io.BoundedLines
import stillwater.io.LogContent
import stillwater.io.LogProblem
import stillwater.io.PlatypusEntry
import stillwater.io.PlatypusLine
import stillwater.io.PlatypusLog
import stillwater.io.PlatypusVersion
import stillwater.io.SensorChoice
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
import stillwater.report.counted
import stillwater.run.withUnit
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
 *
 * @param wanted sensor whose readings are to be mapped; null for that with the most.
 */
internal class MadeUpMission(
    private val content: LogContent,
    private val version: PlatypusVersion,
    private val wanted: SensorChoice? = null,
) {
    private class Readings(val sensor: SensorChoice, val quantity: Quantity) {
        val values = ArrayList<Double>()
    }

    private var origin: LatLon? = null
    private var placeholder: LatLon? = null
    private var frame: LocalFrame? = null
    private var east = Interval(0.0, 0.0)
    private var north = Interval(0.0, 0.0)
    private val probes = LinkedHashMap<SensorChoice, Readings>()

    /** What the map is of, so that nobody need guess; null before [spec] and where there is nothing. */
    var probe: String? = null
        private set

    /** The mission; [warnings] hears what had to be assumed. */
    fun spec(warnings: MutableList<String>): MissionSpec {
        val parser = PlatypusLine(version)
        BoundedLines(content.reader {}).use { lines -> for (line in lines) take(parser.parse(line)) }
        val zero = origin ?: placeholder ?: LatLon(0.0, 0.0)
        if (origin == null) warnings += "the log has no fix: its mission waits for one"
        val found = if (wanted == null) likeliest() else named(wanted)
        if (found == null) warnings += "the log has no reading of a probe that a mission can have"
        probe = found?.let(::told)
        return MissionSpec(
            name = "replay",
            origin = OriginSpec(zero.latitudeDeg, zero.longitudeDeg),
            area = area(),
            grid = grid(),
            probe = if (found == null) probe(Quantity.DISSOLVED_OXYGEN, null) else probe(found.quantity, found),
            estimator = EstimatorName.AVERAGING,
            planner = PlannerName.LAWNMOWER,
            budget = BudgetSpec(seconds = LONG),
            home = PlaceSpec(0.0, 0.0),
        )
    }

    /** The probe with the most readings; of an ES2 the temperature. */
    private fun likeliest(): Readings? =
        probes.values.filter { it.quantity != Quantity.CONDUCTIVITY }.maxByOrNull { it.values.size }

    private fun named(choice: SensorChoice): Readings {
        val isLike = { sensor: SensorChoice -> sensor.type == choice.type && sensor.field == choice.field }
        return probes.values.firstOrNull { isLike(it.sensor) && choice.channel in setOf(null, it.sensor.channel) }
            ?: throw LogProblem(
                content.file,
                null,
                null,
                "readings of $choice, which --value names",
                if (probes.isEmpty()) "none of a probe that a mission can have" else "those of ${names(probes.values)}",
            )
    }

    private fun told(found: Readings): String {
        val others = probes.values - found
        val chosen = "${found.quantity.withUnit}, ${found.sensor} of the log with " +
            counted(found.values.size, "reading")
        return if (others.isEmpty()) chosen else "$chosen; --value takes ${names(others)} in its place"
    }

    private fun names(probes: Collection<Readings>) = probes.joinToString(", ") { "${it.sensor}" }

    private fun take(entry: PlatypusEntry) {
        if (entry is PlatypusEntry.Pose) pose(entry)
        if (entry !is PlatypusEntry.Sensor || entry.data.any { !it.isFinite() }) return
        for ((field, quantity) in QUANTITIES[entry.type].orEmpty().withIndex()) {
            val value = entry.data.getOrNull(field) ?: continue
            val sensor = SensorChoice(entry.type, entry.channel.takeIf { it >= 0 }, field)
            probes.getOrPut(sensor) { Readings(sensor, quantity) }.values += value
        }
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

    private fun probe(quantity: Quantity, found: Readings?): ProbeSpec {
        val low = found?.values?.min() ?: 0.0
        val high = found?.values?.max() ?: HIGHEST
        val more = max((high - low) / TENTH, SMALLEST)
        return ProbeSpec(
            quantity,
            port = found?.sensor?.channel?.takeIf { it in 0..PORTS },
            lowest = low - more,
            highest = high + more,
            largestJump = high - low + more,
        )
    }

    private companion object {
        /** What a probe's numbers are of, by its type in the log. */
        val QUANTITIES = mapOf(
            "ATLAS_DO" to listOf(Quantity.DISSOLVED_OXYGEN),
            "ATLAS_PH" to listOf(Quantity.ACIDITY),
            "ES2" to listOf(Quantity.CONDUCTIVITY, Quantity.TEMPERATURE),
            "HDS_DEPTH" to listOf(Quantity.DEPTH),
        )
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
