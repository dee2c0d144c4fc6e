package stillwater.mission

import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.booleanOrNull
import kotlinx.serialization.json.contentOrNull
import kotlinx.serialization.json.doubleOrNull
import kotlinx.serialization.json.intOrNull
import stillwater.estimate.FieldEstimator
import stillwater.estimate.update
import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import stillwater.model.Reading
import stillwater.model.Utm

/**
 * What a log tells of a mission.
 *
 * @property spec the mission.
 * @property estimator with the map as it was.
 * @property used of the budget, in its unit.
 * @property lastTime latest time on the boat's clock that the log has, s.
 * @property lastValue value of the last reading taken, sensor units; NaN where there was none.
 * @property held reading that waits for its confirmation; null where none does.
 * @property same readings equal to the last, and one other among them at most, which wait for how they go on.
 * @property run equal readings on end, whatever became of them.
 * @property lastState one word for the state the mission was last in; "idle" where the log has no step.
 * @property readings that the map took.
 * @property unreadable lines that could not be read; a log that was cut has one.
 * @property givenUp where the boat did not get in.
 * @property rest of a boat that was held up on its ways home when the log ended; null where it was not.
 * @property boat what the boat was called when the log last began, or went on; null where the log does not say.
 * @property isVirtual whether the log is of a virtual boat; null where it does not say.
 */
public class RecoveredMission internal constructor(
    public val spec: MissionSpec,
    public val estimator: FieldEstimator,
    public val used: Double,
    public val lastTime: Double,
    public val lastValue: Double,
    public val held: Reading?,
    public val same: List<Reading>,
    public val run: Int,
    public val lastState: String,
    public val readings: Long,
    public val unreadable: Long,
    public val givenUp: GivenUp,
    public val rest: HomeRest?,
    public val boat: String?,
    public val isVirtual: Boolean?,
)

/** Hears what a log tells besides the map, in the log's order, and keeps of it what it likes. */
public interface RecoveryListener {
    /** [reading] was taken, and [map] is what was believed after it. Lives on: not to be kept, nor modified. */
    public fun took(reading: Reading, map: FieldMap)

    /** The boat was believed to be at [place], m, in the mission's frame; as in the log, exact to less than a millimetre. */
    public fun at(place: Position)
}

/**
 * Reads a [MissionLog] back: the same readings in the same order into a fresh estimator give the same map, bit for bit.
 *
 * A line that was cut, or is not of the log's form, is counted and passed over. What is not in the log is forgotten:
 * the plan, and whether the board was armed. Track and trace grow with the log, so they go to [listener] and are not
 * kept here. Confined to one thread.
 *
 * @param listener hears of readings and places; null where nobody asks. Retained.
 */
public class MissionRecovery(private val listener: RecoveryListener? = null) {
    private var spec: MissionSpec? = null
    private var estimator: FieldEstimator? = null
    private var used = 0.0
    private var lastTime = 0.0
    private var lastValue = Double.NaN
    private var held: Reading? = null
    private var same = emptyList<Reading>()
    private var run = 0
    private var lastState = MissionState.Idle.word
    private var readings = 0L
    private var unreadable = 0L
    private var frame: LocalFrame? = null
    private var givenUp = GivenUp()
    private var rest: HomeRest? = null
    private var boat: String? = null
    private var isVirtual: Boolean? = null

    /** Takes one line of the log. Never throws. */
    public fun line(line: String) {
        if (line.isBlank()) return
        val json = LogLine.content(line)
        if (json == null || !take(json)) unreadable++
    }

    /** What was recovered; null where the log has no mission. */
    public fun recovered(): RecoveredMission? {
        val spec = spec ?: return null
        val estimator = estimator ?: return null
        return RecoveredMission(
            spec,
            estimator,
            used,
            lastTime,
            lastValue,
            held,
            same,
            run,
            lastState,
            readings,
            unreadable,
            givenUp,
            rest,
            boat,
            isVirtual,
        )
    }

    private fun take(json: JsonObject): Boolean {
        json["spec"]?.let { return begin(it, json) }
        val known = estimator ?: return false
        json["pass"]?.let { return pass(known, it) }
        (json["reading"] as? JsonObject)?.let { return read(known, it) }
        (json["mission"] as? JsonObject)?.let { return step(it, json["pose"]) }
        return "sensor" in json
    }

    /** A log that was gone on with has the mission again; another mission's lines are not this one's. */
    private fun begin(json: JsonElement, header: JsonObject): Boolean {
        val found = try {
            MissionSpec.fromJson(json.toString())
        } catch (_: IllegalArgumentException) {
            return false
        }
        if (spec == null) {
            spec = found
            estimator = found.estimator.build(found.grid.grid(), found.probe)
            frame = LocalFrame(LatLon(found.origin.latitude, found.origin.longitude))
        }
        if (spec != found) return false
        boat = (header["boat"] as? JsonPrimitive)?.contentOrNull ?: boat
        isVirtual = (header["virtual"] as? JsonPrimitive)?.booleanOrNull ?: isVirtual
        return true
    }

    private fun pass(estimator: FieldEstimator, json: JsonElement): Boolean {
        val numbers = numbers(json, PASS_SIZE) ?: return false
        estimator.update(BoatTime(numbers[0]), numbers[1], numbers[2], Double.NaN)
        held = null
        same = emptyList()
        return true
    }

    private fun read(estimator: FieldEstimator, json: JsonObject): Boolean {
        val taken = (json["taken"] as? JsonArray)?.map { reading(it) ?: return false } ?: return false
        for (reading in taken) {
            estimator.update(reading)
            lastValue = reading.value
            lastTime = maxOf(lastTime, reading.time.seconds)
            readings++
        }
        // As the mission itself hands them on: what was kept back together is judged by the map after the last of them.
        listener?.let { taken.forEach { reading -> it.took(reading, estimator.map) } }
        held = json["held"]?.let { reading(it) }
        same = (json["same"] as? JsonArray)?.mapNotNull { reading(it) }.orEmpty()
        run = (json["run"] as? JsonPrimitive)?.intOrNull ?: (same.size + 1)
        // What waits is of the map's time, too, which after a restart is ahead of the steps'.
        for (waiting in same + listOfNotNull(held)) lastTime = maxOf(lastTime, waiting.time.seconds)
        return true
    }

    private fun step(json: JsonObject, pose: JsonElement?): Boolean {
        val time = (json["t_s"] as? JsonPrimitive)?.doubleOrNull ?: return false
        val spent = (json["used"] as? JsonPrimitive)?.doubleOrNull ?: return false
        lastTime = maxOf(lastTime, time)
        used = spent
        (json["given_up"] as? JsonArray)?.let { cells ->
            val off = (json["given_up_off_map"] as? JsonArray)?.mapNotNull { numbers(it, POINT_SIZE) }.orEmpty()
            givenUp = GivenUp(
                cells.mapNotNull { (it as? JsonPrimitive)?.intOrNull },
                off.map { Position(it[0], it[1]) },
            )
        }
        rest = json["rest"]?.let { numbers(it, REST_SIZE) }?.let { HomeRest(it[0].toInt(), it[1]) }
        lastState = (json["state"] as? JsonPrimitive)?.contentOrNull ?: return false
        return pose == null || listener == null || at(pose, listener)
    }

    private fun at(pose: JsonElement, listener: RecoveryListener): Boolean {
        val known = pose as? JsonObject ?: return false
        val numbers = known["p"]?.let { numbers(it, PLACE_SIZE) } ?: return false
        val zone = (known["zone"] as? JsonPrimitive)?.contentOrNull ?: return false
        val number = zone.takeWhile(Char::isDigit).toIntOrNull() ?: return false
        val place = try {
            Utm(numbers[0], numbers[1], number, zone.endsWith(NORTH)).toLatLon()
        } catch (_: IllegalArgumentException) {
            return false
        }
        frame?.let { listener.at(it.toLocal(place)) }
        return true
    }

    private fun reading(json: JsonElement): Reading? =
        // Older logs do not say how well the place was known.
        numbers(json, READING_SIZE, READING_SIZE + 1)?.let {
            val known = it.getOrNull(READING_SIZE)?.let { m -> Conditions(mapOf(Conditions.POSITION_DEVIATION to m)) }
            Reading(BoatTime(it[0]), Position(it[1], it[2]), it[3], known ?: Conditions.NONE)
        }

    private fun numbers(json: JsonElement, least: Int, most: Int = least): List<Double>? {
        val all = (json as? JsonArray)?.map { (it as? JsonPrimitive)?.doubleOrNull ?: return null }
        return all?.takeIf { it.size in least..most }
    }

    private companion object {
        const val PASS_SIZE = 3
        const val READING_SIZE = 4
        const val PLACE_SIZE = 3
        const val POINT_SIZE = 2
        const val REST_SIZE = 2
        const val NORTH = "North"
    }
}
