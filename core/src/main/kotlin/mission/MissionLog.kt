package stillwater.mission

import kotlinx.serialization.json.JsonPrimitive
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Drive
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import stillwater.model.Reading
import stillwater.model.Utm
import stillwater.wire.Message
import kotlin.math.cos
import kotlin.math.sin

/** Takes the lines of a log, in order and without terminator. Whoever has the file flushes it every second at least. */
public fun interface LogSink {
    /** Takes [line]. */
    public fun line(line: String)
}

/**
 * When a log begins, on the wall clock.
 *
 * @property epochMillis Unix time, ms.
 * @property date the same for people; free text.
 * @property boat what the boat, or the link to it, is called; free text; null where nobody says.
 * @property isVirtual whether boat and water are virtual ones, so that nothing in the log was measured; null where
 *   nobody says.
 */
public data class LogStart(
    val epochMillis: Long,
    val date: String,
    val boat: String? = null,
    val isVirtual: Boolean? = null,
)

/**
 * What a mission records of one step.
 *
 * @property time of the step.
 * @property state the mission is in.
 * @property position believed, m; null where not known.
 * @property heading rad, counter-clockwise from east; NaN where not known.
 * @property drive that was let through.
 * @property used of the budget, in its unit.
 * @property leftOut readings that the map did without.
 * @property givenUp where the boat did not get in; null where that is as at the step before.
 * @property rest of a boat that was held up on its ways home; null where it was not.
 */
public data class StepRecord(
    val time: BoatTime,
    val state: MissionState,
    val position: Position?,
    val heading: Double,
    val drive: Drive,
    val used: Double,
    val leftOut: Long,
    val givenUp: GivenUp? = null,
    val rest: HomeRest? = null,
)

/**
 * Writes a mission down, line by line: a superset of the Platypus 4.2 log, `<ms>` tab `I` tab `{json}`.
 *
 * Besides `pose` and `sensor` as the boats' tools know them a line may have `mission` (a step, and in it the cells that
 * the boat did not get into, by number, and off the map by their middles in m, where they have changed, and of one held
 * up on its ways home how often it has rested and what is left of the rest, s), `in` (all that came in since the step
 * before, for a replay), `reading` (what the map took, exactly: time, x, y, value and the place's standard deviation)
 * or `pass` (a cell left without a reading); the first line has the whole mission, and, where that is known, which
 * `boat` it is of and whether that is a `virtual` one. Numbers are written so that they are read back to the last bit;
 * what is not finite is `null`. [MissionRecovery] reads it back.
 *
 * A mission that goes on after a restart appends to the same log; the new first line then says so to any reader.
 *
 * @param sink where lines go. Retained.
 * @param start when it begins.
 * @param spec the mission.
 */
public class MissionLog(private val sink: LogSink, start: LogStart, private val spec: MissionSpec) {
    private val header = start
    private val frame = LocalFrame(LatLon(spec.origin.latitude, spec.origin.longitude))
    private val zone = Utm.zoneOf(frame.origin)
    private val inputs = InputRecord()
    private var begun = Double.NaN
    private var lastMillis = -1L

    /** Keeps an order's [word] for the step's record. */
    internal fun order(word: String) = inputs.order(word)

    /** Keeps the phone's charge, [percent], for the step's record. */
    internal fun phone(percent: Double) = inputs.phone(percent)

    /** Keeps the phone's fix for the step's record. */
    internal fun fix(time: BoatTime, place: LatLon) = inputs.fix(time, place)

    /** Keeps the phone's heading for the step's record. */
    internal fun compass(time: BoatTime, heading: Double, yawRate: Double) = inputs.compass(time, heading, yawRate)

    /** Keeps a line that the board sent for the step's record. */
    internal fun heard(bytes: ByteArray, start: Int, end: Int) = inputs.heard(bytes, start, end)

    /** Writes the end of a step; the first writes the log's first line before it. */
    public fun step(record: StepRecord) {
        val pose = record.position?.let { pose(it, record.heading) }.orEmpty()
        val state = record.state
        val why = when (state) {
            is MissionState.Holding -> ""","why":"${state.danger.name.lowercase()}""""
            is MissionState.Returning -> ""","why":"${state.danger.name.lowercase()}""""
            is MissionState.Stopped -> ""","why":"${state.reason.name.lowercase()}""""
            is MissionState.Preflight -> state.missing?.let { ""","why":"${it.name.lowercase()}"""" }.orEmpty()
            else -> ""
        }
        val givenUp = record.givenUp?.let(::givenUp).orEmpty()
        val rest = record.rest?.let { ""","rest":[${it.count},${number(it.seconds)}]""" }.orEmpty()
        write(
            record.time,
            """$pose"mission":{"t_s":${number(record.time.seconds)},"state":"${state.word}"$why,""" +
                """"drive":[${number(record.drive.forward)},${number(record.drive.turn)}],""" +
                """"used":${number(record.used)},"left_out":${record.leftOut}$givenUp$rest}${inputs.take()}""",
        )
    }

    /** What is off the map is written only where there is any. */
    private fun givenUp(all: GivenUp): String {
        val off = all.offMap.joinToString(",") { "[${number(it.x)},${number(it.y)}]" }
        return ""","given_up":[${all.cells.joinToString(",")}]""" +
            if (off.isEmpty()) "" else ""","given_up_off_map":[$off]"""
    }

    /** Writes what a sensor said at [now], and of the probe what became of it. */
    public fun sensor(now: BoatTime, message: Message) {
        platypus(message)?.let { write(now, it) }
    }

    /**
     * Writes what the probe said at [now], the [verdict] on it, what the map took, what waits, and how many equal
     * readings there were on end.
     */
    public fun reading(
        now: BoatTime,
        message: Message,
        verdict: ReadingVerdict,
        taken: List<Reading>,
        held: Reading?,
        same: List<Reading> = emptyList(),
        run: Int = same.size + 1,
    ) {
        val sensor = platypus(message) ?: return
        val list = taken.joinToString(",") { exact(it) }
        val waits = held?.let { ""","held":${exact(it)}""" }.orEmpty()
        val equal = same.joinToString(",") { exact(it) }
        val equals = if (same.isEmpty()) "" else ""","same":[$equal]"""
        val word = verdict.name.lowercase().replace('_', '-')
        val count = if (run == same.size + 1) "" else ""","run":$run"""
        write(now, """$sensor,"reading":{"verdict":"$word","taken":[$list]$waits$equals$count}""")
    }

    /** Writes that a cell was left, without a reading in it, at [place] at [time]; [now] is when that was noticed. */
    public fun pass(now: BoatTime, time: BoatTime, place: Position) {
        write(now, """"pass":[${number(time.seconds)},${number(place.x)},${number(place.y)}]""")
    }

    private fun write(now: BoatTime, content: String) {
        if (begun.isNaN()) {
            begun = now.seconds
            val boat = header.boat?.let { """"boat":${JsonPrimitive(it)},""" }.orEmpty()
            val virtual = header.isVirtual?.let { """"virtual":$it,""" }.orEmpty()
            line(
                0,
                """"date":"${header.date.filter { it.isLetterOrDigit() || it in " -:.+" }}",""" +
                    """"time":${header.epochMillis},$boat$virtual"spec":${spec.toJson()}""",
            )
        }
        // Each line has a time of its own: readers take equal stamps of one sensor for one reading.
        val millis = maxOf(Math.round((now.seconds - begun) * MILLIS), lastMillis + 1)
        line(millis, content)
    }

    private fun line(millis: Long, content: String) {
        lastMillis = millis
        sink.line("$millis\tI\t{$content}")
    }

    private fun pose(at: Position, heading: Double): String {
        if (!(Math.abs(at.x) < FARTHEST && Math.abs(at.y) < FARTHEST)) return ""
        val utm = Utm.of(frame.toLatLon(at), zone)
        val half = if (heading.isFinite()) heading / 2 else 0.0
        // The boats write the yaw into index 2.
        return """"pose":{"p":[${utm.easting},${utm.northing},0.0],"q":[${cos(half)},0.0,${sin(half)},0.0],""" +
            """"zone":"$zone${if (utm.north) "North" else "South"}"},"""
    }

    /** [message] in the words of the boats' own logs; null where they have none. */
    private fun platypus(message: Message): String? = when (message) {
        is Message.Oxygen -> sensor(message.port, "ATLAS_DO", message.milligramsPerLitre)
        is Message.Acidity -> sensor(message.port, "ATLAS_PH", message.ph)
        is Message.Conductivity -> sensor(message.port, "ES2", message.microsiemensPerCm, message.celsius)
        is Message.Depth -> sensor(message.port, "HDS_DEPTH", message.metres)
        is Message.WaterTemperature -> sensor(message.port, "HDS_TEMP", message.celsius)
        is Message.Battery -> sensor(message.port, "BATTERY", message.volts)
        else -> null
    }

    private fun sensor(port: Int, type: String, vararg values: Double) =
        """"sensor":{"channel":$port,"type":"$type","data":[${values.joinToString(",") { number(it) }}]}"""

    private fun exact(reading: Reading) = reading.run {
        val deviation = conditions[Conditions.POSITION_DEVIATION]
        val known = if (deviation.isFinite()) ",$deviation" else ""
        "[${number(time.seconds)},${number(position.x)},${number(position.y)},${number(value)}$known]"
    }

    private fun number(value: Double) = if (value.isFinite()) value.toString() else "null"

    private companion object {
        const val MILLIS = 1000.0

        /** Beyond this a position is no place that a boat reached, m. */
        const val FARTHEST = 100_000.0
    }
}
