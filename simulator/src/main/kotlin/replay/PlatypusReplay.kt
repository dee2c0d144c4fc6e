package stillwater.replay

import stillwater.io.BoundedLines
import stillwater.io.LogContent
import stillwater.io.PlatypusClock
import stillwater.io.PlatypusEntry
import stillwater.io.PlatypusLine
import stillwater.io.PlatypusLog
import stillwater.io.PlatypusVersion
import stillwater.io.SensorChoice
import stillwater.io.UtmZone
import stillwater.mission.LogStart
import stillwater.mission.Mission
import stillwater.mission.MissionLog
import stillwater.mission.MissionSpec
import stillwater.model.BoatTime
import stillwater.model.LatLon
import stillwater.model.Utm
import stillwater.report.counted

/**
 * Feeds a Platypus boat's log through a mission: its poses as fixes and compass, its sensors' readings as a board's
 * lines.
 *
 * Steps are taken ten times a second of the log's time; a gap of more than [LONGEST_GAP] s is passed over after that
 * time. The boat went where it was then steered, so the mission's waypoints are not reached: what is shown is what it
 * would have made of the readings, and when it would have held, gone home or stopped.
 *
 * @param content the log. @param version of its format. @param wanted mission to replay; null for one made around the
 *   log. @param log takes the replay's own. Retained, not closed. @param sensor whose readings a mission made around
 *   the log maps; null for that with the most.
 */
internal class PlatypusReplay(
    private val content: LogContent,
    private val version: PlatypusVersion,
    private val wanted: MissionSpec?,
    private val log: LineSpool,
    private val sensor: SensorChoice? = null,
) {
    private val lines = LineCounts()
    private val notUnderstood = LineCounts()
    private var number = 0L
    private val warnings = ArrayList<String>()
    private val decisions = Decisions()
    private val board = RecordedBoard()
    private var gaps = 0
    private var now = 0.0
    private var lastPlace: LatLon? = null
    private var lastFix = Double.NEGATIVE_INFINITY

    /** Replays it all. */
    fun run(): Replayed {
        val madeUp = MadeUpMission(content, version, sensor)
        val spec = wanted ?: madeUp.spec(warnings)
        val start = LogStart(0, "replay of ${content.file.fileName}")
        val mission = Mission(spec, board.link, MissionLog(log, start, spec))
        mission.start()
        val parser = PlatypusLine(version)
        val clock = PlatypusClock()
        var zero = Double.NaN
        BoundedLines(content.reader {}).use { all ->
            for (line in all) {
                number++
                if (line.isBlank()) continue
                val entry = parser.parse(line)
                if (entry is PlatypusEntry.Unreadable) {
                    notUnderstood.count(entry.expected, number)
                    continue
                }
                if (entry is PlatypusEntry.Start) clock.start(entry.epochMillis, parser.millis)
                val seconds = clock.secondsAt(parser.millis, parser.clock)
                if (seconds.isNaN()) {
                    notUnderstood.count("a time not before the last one", number)
                    continue
                }
                if (zero.isNaN()) zero = seconds
                stepUntil(mission, seconds - zero)
                feed(mission, entry, BoatTime(seconds - zero))
            }
        }
        stepUntil(mission, now + STEP)
        if (gaps > 0) warnings += "${counted(gaps, "gap")} of more than $LONGEST_GAP s passed over"
        val format = "Platypus log ${version.release}"
        return Replayed(spec, format, mission, decisions, log, lines, notUnderstood, null, warnings, madeUp.probe)
    }

    private fun stepUntil(mission: Mission, seconds: Double) {
        val from = now
        while (now + STEP <= seconds + ROUNDING) {
            if (now - from > LONGEST_GAP) {
                gaps++
                now = seconds
                return
            }
            now += STEP
            board.beat()
            mission.step(BoatTime(now))
            decisions.note(mission, BoatTime(now))
        }
    }

    private fun feed(mission: Mission, entry: PlatypusEntry, time: BoatTime) {
        when (entry) {
            is PlatypusEntry.Pose -> pose(mission, entry, time)
            is PlatypusEntry.Sensor ->
                if (board.say(entry)) {
                    lines.count("sensor ${entry.type}", number)
                } else {
                    notUnderstood.count("numbers of a sensor known here, not '${entry.type}'", number)
                }
            is PlatypusEntry.Start -> lines.count("beginnings", number)
            else -> lines.count("commands, gains and others that a mission does not need", number)
        }
    }

    private fun pose(mission: Mission, pose: PlatypusEntry.Pose, time: BoatTime) {
        if (pose.heading.isFinite()) mission.compass(time, pose.heading, Double.NaN)
        val place = if (PlatypusLog.isPlaceholder(pose)) null else placeOf(pose)
        when {
            PlatypusLog.isPlaceholder(pose) -> lines.count("poses before the first fix", number)
            place == null -> notUnderstood.count("a place on the globe", number)
            isNews(place, time) -> {
                lines.count("poses", number)
                mission.fix(time, place)
            }
            else -> lines.count("poses said again", number)
        }
    }

    /**
     * The boats log ten poses a second of a receiver that has one fix a second: the same place again is no second fix.
     */
    private fun isNews(place: LatLon, time: BoatTime): Boolean {
        if (place == lastPlace && time.seconds - lastFix < FIX_PERIOD) return false
        lastPlace = place
        lastFix = time.seconds
        return true
    }

    companion object {
        /** Longest stretch without a line that is stepped through, s. */
        const val LONGEST_GAP = 60.0
        private const val STEP = 0.1

        /** A little under a second: stamps are late by some ms now and then. */
        private const val FIX_PERIOD = 0.95
        private const val ROUNDING = 1e-9

        /** Where [pose] is; null where that is nowhere. */
        fun placeOf(pose: PlatypusEntry.Pose): LatLon? {
            val zone = UtmZone.parse(pose.zone) ?: return null
            if (pose.easting !in EASTINGS || pose.northing !in NORTHINGS) return null
            return Utm(pose.easting, pose.northing, zone.number, zone.north).toLatLon()
        }

        private val EASTINGS = 0.0..1e6
        private val NORTHINGS = 0.0..1e7
    }
}
