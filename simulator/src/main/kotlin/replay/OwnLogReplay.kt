package stillwater.replay

import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.booleanOrNull
import kotlinx.serialization.json.contentOrNull
import kotlinx.serialization.json.doubleOrNull
import stillwater.control.Mixing
import stillwater.io.BoundedLines
import stillwater.io.LogContent
import stillwater.io.LogProblem
import stillwater.mission.LogLine
import stillwater.mission.LogStart
import stillwater.mission.Mission
import stillwater.mission.MissionLog
import stillwater.mission.MissionRecovery
import stillwater.mission.MissionSpec
import stillwater.mission.RecoveredMission
import stillwater.mission.Wish
import stillwater.model.BoatTime
import stillwater.model.JsonProblem
import stillwater.model.LatLon

/**
 * Feeds what a mission's own log says came in (fixes, compass, the board's lines, a person's orders) through the
 * mission again.
 *
 * Every step is taken at the recorded time, so that the same program decides the same, bit for bit; another program, or
 * the same with another [MissionSpec], shows what it would have decided on the same way and with the same boat: where
 * the log or the other mission says that its thruster swivels, it does. Where the log was gone on with after a crash,
 * the mission is recovered from the lines before, as it was then.
 *
 * @param content the log. @param other the mission to replay in place of the log's; null for the log's own.
 * @param log takes the replay's own. Retained, not closed.
 */
internal class OwnLogReplay(
    private val content: LogContent,
    private val other: MissionSpec?,
    private val log: LineSpool,
) {
    private val lines = LineCounts()
    private val notUnderstood = LineCounts()
    private val decisions = Decisions()
    private var number = 0L
    private val recorded = MissionRecovery()
    private var link = RecordedLink()
    private var mission: Mission? = null
    private var differing = 0L
    private var firstDifference = Double.NaN
    private var lastTime = Double.NEGATIVE_INFINITY
    private var refused: String? = null
    private var refusedLine: Long? = null

    /** Replays it all. Throws [LogProblem] where the log has no mission. */
    fun run(): Replayed {
        BoundedLines(content.reader {}).use { all ->
            for (line in all) {
                number++
                if (line.isNotBlank()) take(line)
            }
        }
        val last = mission ?: throw LogProblem(
            content.file,
            refusedLine,
            null,
            "a mission's log",
            "no mission that can be read" + (refused?.let { " ($it)" } ?: ""),
        )
        val isSameMap = recorded.recovered()?.let { isSame(last.map, it.estimator.map) } ?: false
        val compared = AsRecorded(differing, firstDifference, isSameMap).takeIf { other == null }
        val warnings = listOfNotNull(OTHERWISE.takeIf { compared != null && !(differing == 0L && isSameMap) })
        return Replayed(last.spec, "own log", last, decisions, log, lines, notUnderstood, compared, warnings)
    }

    private fun take(line: String) {
        val json = LogLine.content(line)
        when {
            json == null -> return notUnderstood.count("<ms> TAB I TAB {json}", number)
            "spec" in json -> begin(json)
            "mission" in json -> step(json)
            "reading" in json -> lines.count("readings", number)
            "sensor" in json -> lines.count("other sensors", number)
            "pass" in json -> lines.count("cells left without a reading", number)
            else -> notUnderstood.count("spec, mission, reading, sensor or pass", number)
        }
        recorded.line(line)
    }

    private fun begin(json: JsonObject) {
        lines.count("beginnings", number)
        val spec = missionOf(json) ?: return notUnderstood.count("a mission", number)
        val date = (json["date"] as? JsonPrimitive)?.contentOrNull.orEmpty()
        val start = LogStart(
            (json["time"] as? JsonPrimitive)?.doubleOrNull?.toLong() ?: 0,
            date,
            (json["boat"] as? JsonPrimitive)?.contentOrNull,
            (json["virtual"] as? JsonPrimitive)?.booleanOrNull,
        )
        val before = if (mission == null) null else recovered()
        link = RecordedLink()
        lastTime = Double.NEGATIVE_INFINITY
        mission = Mission(spec, link, MissionLog(log, start, spec), recovered = before)
    }

    /** The mission that is replayed from a first line on; null where none can be read. */
    private fun missionOf(first: JsonObject): MissionSpec? {
        val own = try {
            MissionSpec.fromJson(first["spec"].toString())
        } catch (wrong: JsonProblem) {
            if (refused == null) {
                refused = wrong.words
                refusedLine = number
            }
            null
        }
        if (other == null || own?.boat?.mixing != Mixing.VECTORED) return other ?: own
        return other.copy(boat = other.boat.copy(mixing = Mixing.VECTORED))
    }

    /** What a mission that goes on at this line knows: the log's own readings, or those that another mission took. */
    private fun recovered(): RecoveredMission? {
        val recovery = MissionRecovery()
        if (other == null) {
            BoundedLines(content.reader {}).use { all ->
                for (line in all.asSequence().take((number - 1).toInt())) recovery.line(line)
            }
        } else {
            log.forEach(recovery::line)
        }
        return recovery.recovered()
    }

    private fun step(json: JsonObject) {
        lines.count("steps", number)
        val mission = mission ?: return notUnderstood.count("a mission before its steps", number)
        val record = json["mission"] as? JsonObject
        val time =
            (record?.get("t_s") as? JsonPrimitive)?.doubleOrNull ?: return notUnderstood.count("a step's t_s", number)
        if (time <= lastTime) notUnderstood.count("a step later than the one before it", number)
        lastTime = time
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
        for (charge in came.list("phone")) {
            mission.phoneCharge((charge as? JsonPrimitive)?.doubleOrNull ?: Double.NaN)
        }
        for (fix in came.list("fix")) {
            val (time, latitude, longitude) = numbers(fix) ?: continue
            val isPlace = latitude in LatLon.LATITUDES_DEG && longitude in LatLon.LONGITUDES_DEG
            if (!isPlace) {
                notUnderstood.count("a place", number)
                continue
            }
            mission.fix(BoatTime(time), LatLon(latitude, longitude))
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
                if (wish == null) notUnderstood.count("an order that is known", number) else mission.wish = wish
            }
        }
    }

    private fun JsonObject.list(key: String): List<JsonElement> = (get(key) as? JsonArray).orEmpty()

    /** Three numbers, NaN for null; null, and counted, where [json] is something else. */
    private fun numbers(json: JsonElement): List<Double>? {
        val all = (json as? JsonArray)?.map { (it as? JsonPrimitive)?.doubleOrNull ?: Double.NaN }
        val isPlace = all != null && all.size == TRIPLE
        if (!isPlace) notUnderstood.count("three numbers", number)
        return all.takeIf { isPlace }
    }

    private companion object {
        const val TRIPLE = 3
        const val OTHERWISE =
            "the log is not what this program makes of what its mission heard: another version wrote it, or it " +
                "was cut, joined or changed; map and decisions are those of the replay"
    }
}
