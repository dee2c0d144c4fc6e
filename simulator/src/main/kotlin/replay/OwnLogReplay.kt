package stillwater.replay

import kotlinx.serialization.SerializationException
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.contentOrNull
import kotlinx.serialization.json.doubleOrNull
import stillwater.io.LogProblem
import stillwater.mission.LogStart
import stillwater.mission.Mission
import stillwater.mission.MissionLog
import stillwater.mission.MissionRecovery
import stillwater.mission.MissionSpec
import stillwater.mission.Wish
import stillwater.model.BoatTime
import stillwater.model.LatLon
import java.nio.file.Path

/**
 * Feeds what a mission's own log says came in (fixes, compass, the board's lines, a person's orders) through the
 * mission again.
 *
 * Every step is taken at the recorded time, so that the same program decides the same, bit for bit; another program, or
 * the same with another [MissionSpec], shows what it would have decided on the same way. Where the log was gone on with
 * after a crash, the mission is recovered from the lines before, as it was then.
 *
 * @param file the log. @param other the mission to replay in place of the log's; null for the log's own.
 */
internal class OwnLogReplay(private val file: Path, private val other: MissionSpec?) {
    private val lines = LinkedHashMap<String, Long>()
    private val notUnderstood = LinkedHashMap<String, Long>()
    private val log = ArrayList<String>()
    private val decisions = Decisions()
    private val soFar = ArrayList<String>()
    private val recorded = MissionRecovery()
    private var link = RecordedLink()
    private var mission: Mission? = null
    private var differing = 0L
    private var firstDifference = Double.NaN

    /** Replays it all. Throws [LogProblem] where the log has no mission. */
    fun run(): Replayed {
        file.toFile().bufferedReader(Charsets.UTF_8).useLines { all -> all.forEach(::take) }
        val last = mission ?: throw LogProblem(file, null, null, "a mission's log", "no mission that can be read")
        val isSameMap = recorded.recovered()?.let { isSame(last.map, it.estimator.map) } ?: false
        val compared = AsRecorded(differing, firstDifference, isSameMap).takeIf { other == null }
        return Replayed(last.spec, "own log", last, decisions, log, lines, notUnderstood, compared, emptyList())
    }

    private fun take(line: String) {
        if (line.isBlank()) return
        val json = content(line)
        when {
            json == null -> return notUnderstood.count("<ms> TAB I TAB {json}")
            "spec" in json -> begin(json)
            "mission" in json -> step(json)
            "reading" in json -> lines.count("readings")
            "sensor" in json -> lines.count("other sensors")
            "pass" in json -> lines.count("cells left without a reading")
            else -> notUnderstood.count("spec, mission, reading, sensor or pass")
        }
        soFar += line
        recorded.line(line)
    }

    private fun content(line: String): JsonObject? {
        val start = line.indexOf('\t', line.indexOf('\t') + 1)
        return try {
            if (start < 0) null else Json.parseToJsonElement(line.substring(start + 1)) as? JsonObject
        } catch (_: SerializationException) {
            null
        }
    }

    private fun begin(json: JsonObject) {
        lines.count("beginnings")
        val spec = other ?: try {
            MissionSpec.fromJson(json["spec"].toString())
        } catch (_: IllegalArgumentException) {
            return notUnderstood.count("a mission")
        }
        val date = (json["date"] as? JsonPrimitive)?.contentOrNull.orEmpty()
        val start = LogStart((json["time"] as? JsonPrimitive)?.doubleOrNull?.toLong() ?: 0, date)
        val before = soFar.takeIf { mission != null }?.let { past ->
            // The log's own readings are in what was recovered then; another mission goes on with its own.
            MissionRecovery().apply { (if (other == null) past else log).forEach(::line) }.recovered()
        }
        link = RecordedLink()
        mission = Mission(spec, link, MissionLog(log::add, start, spec), recovered = before)
    }

    private fun step(json: JsonObject) {
        lines.count("steps")
        val mission = mission ?: return notUnderstood.count("a mission before its steps")
        val record = json["mission"] as? JsonObject
        val time = (record?.get("t_s") as? JsonPrimitive)?.doubleOrNull ?: return notUnderstood.count("a step's t_s")
        (json["in"] as? JsonObject)?.let { feed(mission, it) }
        mission.step(BoatTime(time))
        decisions.note(mission, BoatTime(time))
        val drive = (record["drive"] as? JsonArray)?.map { (it as? JsonPrimitive)?.doubleOrNull }
        val isSame = (record["state"] as? JsonPrimitive)?.contentOrNull == mission.state.word &&
            drive == listOf(mission.drive.forward, mission.drive.turn)
        if (isSame) return
        if (differing++ == 0L) firstDifference = time
    }

    private fun feed(mission: Mission, came: JsonObject) {
        for (order in came.list("order")) order(mission, (order as? JsonPrimitive)?.contentOrNull)
        for (fix in came.list("fix")) {
            val (time, latitude, longitude) = numbers(fix) ?: continue
            val isPlace = latitude in LatLon.LATITUDES_DEG && longitude.isFinite()
            if (isPlace) mission.fix(BoatTime(time), LatLon(latitude, longitude)) else notUnderstood.count("a place")
        }
        for (compass in came.list("compass")) {
            val (time, heading, yawRate) = numbers(compass) ?: continue
            mission.compass(BoatTime(time), heading, yawRate)
        }
        for (line in came.list("heard")) (line as? JsonPrimitive)?.contentOrNull?.let(link::say)
    }

    private fun order(mission: Mission, word: String?) {
        when (word) {
            "start" -> mission.start()
            "stop" -> mission.stop()
            "log-lost" -> mission.logLost()
            else -> {
                val wish = Wish.entries.find { it.word == word }
                if (wish == null) notUnderstood.count("an order that is known") else mission.wish = wish
            }
        }
    }

    private fun JsonObject.list(key: String): List<JsonElement> = (get(key) as? JsonArray).orEmpty()

    /** Three numbers, NaN for null; null, and counted, where [json] is something else. */
    private fun numbers(json: JsonElement): List<Double>? {
        val all = (json as? JsonArray)?.map { (it as? JsonPrimitive)?.doubleOrNull ?: Double.NaN }
        val isPlace = all != null && all.size == TRIPLE
        if (!isPlace) notUnderstood.count("three numbers")
        return all.takeIf { isPlace }
    }

    private companion object {
        const val TRIPLE = 3
    }
}

/** One more under [key]. */
internal fun MutableMap<String, Long>.count(key: String) {
    merge(key, 1, Long::plus)
}
