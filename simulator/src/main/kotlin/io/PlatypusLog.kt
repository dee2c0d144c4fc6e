package stillwater.io

import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Utm
import java.nio.file.Path
import kotlin.math.abs

/**
 * A log of a Platypus boat: the readings of one of its sensors, each placed where the boat was at the reading's time.
 *
 * That is between its poses; in a mission's log, which has the fixes and headings as well, where all of these together
 * say ([MissionFixes]). Such a log is read twice, and its times are kept.
 *
 * Poses before the first GPS fix are a placeholder that looks like a place; they are left out and counted. A log
 * whose name ends in `.incomplete` may have its last line cut.
 */
internal class PlatypusLog private constructor(
    private val content: LogContent,
    private val version: PlatypusVersion,
    private val sensor: SensorChoice,
    private val choice: LogChoice,
) : SurveyLog {
    override val file: Path get() = content.file
    override val format = "Platypus log ${version.release}"
    override val quantity = sensor.toString()
    override val xName = "x_m"
    override val oneDimensional = false
    override var frame: LocalFrame? = null
        private set

    /** Where the fixes put the readings; null in a log without any. */
    private val places: MissionPlaces? by lazy {
        if (content.head.none { MISSION in it }) return@lazy null
        val fixes = MissionFixes()
        pass({}, fixes) { _, seconds, _, _, _ -> fixes.reading(seconds) }
        frame?.let { fixes.places(it) }
    }

    override fun read(progress: (Long) -> Unit, sink: ReadingSink): LogPass {
        val places = places
        val jumps = PositionJumps(speedUnit)
        var k = 0
        val pass = pass(progress, null) { line, seconds, trackX, trackY, value ->
            // A log that a mission still writes has more now.
            val placed = places?.takeIf { k < it.times.size && it.times[k] == seconds && !it.x[k].isNaN() }
            val x = placed?.x?.get(k) ?: trackX
            val y = placed?.y?.get(k) ?: trackY
            k++
            jumps.take(line, seconds, x, y)
            sink.take(BoatTime(seconds), x, y, value, Conditions.NONE)
        }
        return pass.copy(warnings = pass.warnings + listOfNotNull(places?.note, jumps.note), jumps = jumps.count)
    }

    private fun pass(progress: (Long) -> Unit, fixes: MissionFixes?, sink: PlacedSink): LogPass {
        val pass = Pass(fixes, sink)
        BoundedLines(content.reader(progress = progress)).use { lines ->
            for (line in lines) pass.take(line, lines.peek())
        }
        return pass.end()
    }

    private val poseAge = choice.maxPoseAge ?: LogChoice.USUAL_POSE_AGE

    private data class Pending(val line: Long, val seconds: Double, val value: Double)

    /** Takes the reading of a line, at a time in s, where the poses put it: metres east and north. */
    private fun interface PlacedSink {
        fun take(line: Long, seconds: Double, x: Double, y: Double, value: Double)
    }

    /** One reading of the file from its beginning. */
    private inner class Pass(private val inputs: MissionFixes?, private val sink: PlacedSink) {
        private val lines = PlatypusLine(version)
        private val clock = PlatypusClock()
        private val track = PoseTrack(poseAge)
        private val catalogue = SensorCatalogue()
        private val skips = SkipCounts()
        private val pending = ArrayDeque<Pending>()
        private val following = PlatypusLine(version)
        private val backward = BackwardRuns("lines")
        private var latestLine = 0L
        private var number = 0L
        private var readings = 0L
        private var lastSensorSeconds = Double.NEGATIVE_INFINITY
        private var placeholders = 0L
        private var fixes = 0L

        fun take(line: String, next: String?) {
            number++
            if (line.isBlank()) return
            val entry = lines.parse(line)
            if (entry is PlatypusEntry.Unreadable) {
                if (next == null && file.fileName.toString().endsWith(".incomplete")) {
                    return skips.count("truncated last line")
                }
                return refuse(entry.expected, quoted(line), "unreadable lines")
            }
            if (entry is PlatypusEntry.Start) clock.start(entry.epochMillis, lines.millis)
            if (isAhead(next)) {
                return refuse("a time before the next line's", "${lines.millis} ms", TimeFault.AHEAD.reason)
            }
            val seconds = clock.secondsAt(lines.millis, lines.clock, lines.step)
            if (seconds.isNaN()) {
                backward.refused(latestLine)
                return refuse("a time not before the last one", "${lines.millis} ms", TimeFault.BACK.reason)
            }
            backward.accepted()
            latestLine = number
            if (inputs != null) lines.inputs(line)?.let { inputs.take(seconds, it) }
            when (entry) {
                is PlatypusEntry.Pose -> takePose(seconds, entry)
                is PlatypusEntry.Sensor -> takeSensor(seconds, entry)
                else -> Unit
            }
            // A pose that comes later than this is of no use to the readings that wait for one.
            emit(seconds - poseAge)
        }

        /** Whether the line's stamp alone is ahead; where lines have a time of day, that one says how time goes on. */
        private fun isAhead(next: String?): Boolean {
            if (next == null || !lines.clock.isNaN() || !clock.isJump(lines.millis)) return false
            val entry = following.parse(next)
            if (entry is PlatypusEntry.Unreadable || entry is PlatypusEntry.Start) return false
            return clock.isAhead(lines.millis, following.millis)
        }

        private fun takePose(seconds: Double, pose: PlatypusEntry.Pose) {
            val zone = UtmZone.parse(pose.zone)
                ?: return refuse("a UTM zone 1North to 60South", quoted(pose.zone), "poses in no UTM zone")
            if (isPlaceholder(pose)) {
                placeholders++
                return skips.count("poses before the first fix")
            }
            val onTheMap = pose.easting in 0.0..LARGEST_EASTING && pose.northing in 0.0..LARGEST_NORTHING
            if (!onTheMap) {
                val found = "${pose.easting}, ${pose.northing}"
                return refuse("UTM easting in 0..1000000 m, northing in 0..10000000 m", found, "poses off the globe")
            }
            val place = Utm(pose.easting, pose.northing, zone.number, zone.north).toLatLon()
            val frame = frameFrom(place)
            val local = frame.toLocal(place)
            if (!FixReach.holds(frame.origin, place.latitudeDeg, place.longitudeDeg, local.x, local.y)) {
                val found = "${pose.easting}, ${pose.northing} in ${pose.zone}"
                return refuse(FixReach.EXPECTED, found, FixReach.REASON)
            }
            fixes++
            track.add(seconds, local.x, local.y)
        }

        private fun frameFrom(place: LatLon) = frame ?: LocalFrame(place).also { frame = it }

        private fun takeSensor(seconds: Double, entry: PlatypusEntry.Sensor) {
            catalogue.add(entry)
            if (entry.type != sensor.type || (sensor.channel != null && entry.channel != sensor.channel)) return
            if (sensor.channel == null && catalogue.channels(sensor.type).size > 1) {
                val found = "channels ${catalogue.channels(sensor.type).joinToString(" and ")}"
                throw problem("--value ${sensor.type}#CHANNEL", found, null)
            }
            val value = entry.data.getOrElse(sensor.field) { Double.NaN }
            when {
                sensor.field >= entry.data.size ->
                    refuse("at least ${sensor.field + 1} numbers", "${entry.data.size}", "readings without the field")
                !value.isFinite() -> refuse("a finite number", "none", "readings that are no number")
                abs(value) > SquareReach.LARGEST ->
                    refuse(
                        "a number within -${SquareReach.LARGEST}..${SquareReach.LARGEST}",
                        "$value",
                        "readings out of all bounds",
                    )
                seconds <= lastSensorSeconds -> {
                    val fault = if (seconds < lastSensorSeconds) TimeFault.BACK else TimeFault.DUPLICATE
                    refuse("a ${sensor.type} time after $lastSensorSeconds s", "$seconds s", fault.reason)
                }
                else -> {
                    lastSensorSeconds = seconds
                    pending.addLast(Pending(number, seconds, value))
                }
            }
        }

        /** Hands on what has a pose on either side of it, and what has waited since before [deadline] s. */
        private fun emit(deadline: Double) {
            while (true) {
                val reading = pending.firstOrNull() ?: return
                if (track.latest < reading.seconds && reading.seconds >= deadline) return
                pending.removeFirst()
                if (track.find(reading.seconds)) {
                    readings++
                    sink.take(reading.line, reading.seconds, track.x, track.y, reading.value)
                } else {
                    skips.count("readings without a pose")
                }
            }
        }

        private fun refuse(expected: String, found: String, reason: String) {
            if (choice.skipBadRows) skips.count(reason) else throw problem(expected, found, reason)
        }

        private fun problem(expected: String, found: String, reason: String?) =
            LogProblem(file, number, null, expected, found, reason)

        fun end(): LogPass {
            emit(Double.POSITIVE_INFINITY)
            fun whole(expected: String, found: String) = LogProblem(file, null, null, expected, found)
            if (catalogue.channels(sensor.type).isEmpty()) throw whole("readings of $sensor", "$catalogue")
            if (fixes == 0L && placeholders > 0) {
                throw whole("poses with a GPS fix", "only the placeholder before the first fix ($placeholders poses)")
            }
            if (fixes == 0L) throw whole("poses", "none")
            return LogPass(readings, skips.toMap(), listOfNotNull(backward.note))
        }
    }

    companion object {
        /** Only a mission's log has steps. */
        private const val MISSION = "\"mission\":{"
        private const val LARGEST_EASTING = 1e6
        private const val LARGEST_NORTHING = 1e7
        private const val PLACEHOLDER_EASTING = 476_608.34
        private const val PLACEHOLDER_NORTHING = 4_671_214.4
        private const val PLACEHOLDER_ZONE = "17North"
        private const val PLACEHOLDER_TOLERANCE = 1.0

        /** Whether [pose] is what the boats log before their first GPS fix. */
        fun isPlaceholder(pose: PlatypusEntry.Pose) = pose.zone == PLACEHOLDER_ZONE &&
            abs(pose.easting - PLACEHOLDER_EASTING) <= PLACEHOLDER_TOLERANCE &&
            abs(pose.northing - PLACEHOLDER_NORTHING) <= PLACEHOLDER_TOLERANCE

        fun open(content: LogContent, version: PlatypusVersion, choice: LogChoice): PlatypusLog {
            fun problem(expected: String, found: String) = LogProblem(content.file, null, null, expected, found)
            val columns = choice.copy(value = null).named
            if (columns.isNotEmpty()) {
                throw problem("a survey CSV for column ${columns.first()}", "a Platypus log, which has no columns")
            }
            choice.timing?.let { throw problem("a survey CSV for $it", "a Platypus log, whose times need none") }
            val sensor = if (choice.value == null) {
                onlySensor(content, version, ::problem)
            } else {
                SensorChoice.parse(choice.value)
                    ?: throw problem("--value TYPE[#CHANNEL][.FIELD]", fieldHint(content, version, choice.value))
            }
            return PlatypusLog(content, version, sensor, choice)
        }

        private fun onlySensor(
            content: LogContent,
            version: PlatypusVersion,
            problem: (String, String) -> LogProblem,
        ): SensorChoice {
            val catalogue = catalogue(content, version)
            val choices = catalogue.choices()
            return choices.singleOrNull() ?: throw when {
                choices.isEmpty() -> problem("readings of a sensor", "$catalogue")
                else -> problem("--value with one of ${choices.joinToString(", ")}", "$catalogue")
            }
        }

        private fun fieldHint(content: LogContent, version: PlatypusVersion, value: String) =
            "${quoted(value)}; the log has ${catalogue(content, version)}"

        private fun catalogue(content: LogContent, version: PlatypusVersion): SensorCatalogue {
            val catalogue = SensorCatalogue()
            val parser = PlatypusLine(version)
            BoundedLines(content.reader {}).use { lines ->
                for (line in lines) (parser.parse(line) as? PlatypusEntry.Sensor)?.let(catalogue::add)
            }
            return catalogue
        }
    }
}
