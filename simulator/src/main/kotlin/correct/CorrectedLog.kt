package stillwater.correct

import stillwater.diagnose.ConditionGaps
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnosis.ConditionColumns
import stillwater.estimate.CorrectedTrack
import stillwater.estimate.LikelyResponse
import stillwater.estimate.Response
import stillwater.estimate.ResponseChoice
import stillwater.estimate.TrackAgreement
import stillwater.estimate.TrackCorrector
import stillwater.estimate.TrackSeries
import stillwater.estimate.UndoableSensor
import stillwater.estimate.UnusableReadings
import stillwater.estimate.ZeroWander
import stillwater.io.LogPass
import stillwater.io.LogProblem
import stillwater.io.SquareReach
import stillwater.io.SurveyLog
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import stillwater.survey.LegComparison
import stillwater.survey.LegFinder
import stillwater.survey.LegMismatch
import stillwater.survey.SurveyScan
import stillwater.survey.SurveyStatistics
import stillwater.survey.Track
import stillwater.survey.ValueResolution
import stillwater.survey.Wording.Companion.digits
import kotlin.math.abs

/** Where a [CorrectedLog]'s sensor comes from. */
enum class SensorOrigin(val label: String) {
    GIVEN("given"),
    REVISITS("learned from passes through the same water"),
    REFERENCE("learned from the reference column"),
    RATE("learned from the rate at which readings often run and that they do not exceed"),
    NOTHING("none: the log holds no evidence on the sensor"),
}

/**
 * A log with its sensor's response undone.
 *
 * @property log the log. @property pass what reading it came to. @property series its readings.
 * @property learned where the sensor comes from, and what it may be.
 * @property spec the sensor, the most likely if several are open.
 * @property unhinted the field along the track, with intervals that do not hold what the log only hints at.
 * @property hinted the same with intervals that do; null where it hints at nothing.
 * @property statistics of the readings. @property before legs as measured, or null. @property after legs as corrected.
 * @property agreement whether the track agrees with itself where it comes back, before its intervals were widened
 * for it. @property wander how far the sensor's zero may have wandered; null where that was not looked for, because
 * crossings or a reference show it. @property margin how far the reference lies outside [track]'s intervals before they
 * were widened for that; null where the sensor was not learned from one. @property unusable readings that say nothing, or one side only, of
 * the sensor's state.
 * @param conditions what the log holds beside the readings, by name.
 * @property bridged what was done where their numbers are missing, one sentence each.
 * @property unknown longest lag, s, that intervals hold of a sensor of which nothing is known, and the track if it has none;
 * null where something is known.
 */
class CorrectedLog internal constructor(
    val log: SurveyLog,
    val pass: LogPass,
    val series: TrackSeries,
    internal val learned: Learned,
    val spec: SensorSpec,
    val unhinted: CorrectedTrack,
    val hinted: CorrectedTrack?,
    val statistics: SurveyStatistics,
    val before: LegMismatch?,
    val after: LegMismatch?,
    val agreement: TrackAgreement,
    internal val wander: ZeroWander?,
    internal val margin: ReferenceMargin?,
    internal val unusable: UnusableReadings,
    private val conditions: Map<String, DoubleArray> = emptyMap(),
    internal val bridged: List<String> = emptyList(),
    internal val unknown: Pair<Double, CorrectedTrack>? = null,
) {
    /** Where the sensor comes from. */
    val origin: SensorOrigin get() = learned.origin

    /** The candidates and what is left open, or null where nothing was chosen. */
    val choice: ResponseChoice? get() = learned.choice

    /**
     * The field along the track. Its intervals hold what the log hints at where the log bounds it: a slow path that may
     * have any share leaves the water's level to belief, and no interval would be the log's.
     */
    val track: CorrectedTrack get() = hinted?.takeIf { choice?.hinted?.isBounded == true } ?: unhinted

    /** The intervals if the zero wandered as the log would have it; null where that does not look likely. */
    internal val wandered: CorrectedTrack? by lazy { wander?.takeIf { it.isSeen }?.widened(track) }

    /** Whether intervals were widened for delays that differ along the track: where no crossing shows them better. */
    internal val isWidenedForUnevenness: Boolean get() = learned.isUneven(agreement)

    /** Whether intervals were widened by what passes disagree: not a given sensor's, nor for "passes" of a boat that lay still. */
    internal val isWidenedForPasses: Boolean
        get() = agreement.isContradicted && learned.stillBoat == null && origin != SensorOrigin.GIVEN

    private val resolution: Double = resolution(statistics, series)

    /** The water if the sensor had no lag: readings smoothed as [track] is, and calibrated, with nothing undone. */
    private val smoothedValues: DoubleArray? by lazy {
        if (before == null || origin == SensorOrigin.NOTHING) return@lazy null
        val sensor = UndoableSensor.of(SensorSpec("", learned.calibration))
        val scaled = sensor.calibrated(series, conditions)
        val out = if (sensor.gain < 0) unusable.mirrored() else unusable
        TrackCorrector(scaled, resolution / abs(sensor.gain), out, sensor.wander, sensor.noise).correct(NO_LAG).values
    }

    /**
     * Legs smoothed as [after] is, with no lag undone: what of the difference between [before] and [after] is noise
     * smoothed, and what the lag; null where there are no legs, or where nothing was learned, which is the same.
     */
    val smoothed: LegMismatch? by lazy { smoothedValues?.let { legs(series, it) } }

    /**
     * How well a sensor that is learned on some legs corrects the others; empty where the sensor was not learned from
     * revisits or there are too few legs. Takes four times as long as the correction itself.
     *
     * @param between of a transect: places between which successive passes are compared, or null for all.
     */
    fun heldOut(between: ClosedFloatingPointRange<Double>? = null): List<HeldOutScore> {
        // A thinned track's points are not the rows.
        if (origin != SensorOrigin.REVISITS || before == null) return emptyList()
        if (series.size > SensorLearning.MOST_LEARNED) return emptyList()
        val range = between ?: series.xs.min()..series.xs.max()
        val passes = PassDifference(series.xs, before.legs.legs, range.start, range.endInclusive)
            .takeIf { log.oneDimensional }
        val plain = smoothed?.let { CorrectedLegs(it, checkNotNull(smoothedValues)) }
        return HeldOutLegs(CorrectedLegs(before, series.values), passes, plain) { rows ->
            val learned = SensorLearning.byRevisits(series.at(rows), hasFixes = log.frame != null)
            if (learned.choice == null) return@HeldOutLegs null
            val values = corrected(series, learned.likely, learned.calibration, resolution).values
            legs(series, values)?.let { CorrectedLegs(it, values) }
        }.scores()
    }

    /** The sensor's dead time, s, where it was given; else 0: what is learned is of a log that shows it. */
    private val deadTime: Double
        get() = if (origin == SensorOrigin.GIVEN) UndoableSensor.of(spec).response.deadTime else 0.0

    /** Rows of whose water the log says something: of the last ones a given sensor shows it after the log's end. */
    internal val told: Int
        get() = series.times.count { it + deadTime <= series.times.last() }

    companion object {
        /** Name of the condition that holds the reference. */
        const val REFERENCE = "reference"

        /** How the names of sensors begin that were learned from a log. */
        const val LEARNED = "learned from"

        private const val FEWEST = 30

        /** Why what a reference seemed to show is not undone. */
        private const val LOST =
            "undoing the responses that it leaves open would take the values farther than all that was ever measured"

        /** What is said of rows whose condition is not known for long: every row is corrected. */
        private const val BRIDGED_FAR = "guessed in the same way"

        /** Parts of a metre per second to which the reference speed is rounded. */
        private const val ROUND = 100.0
        private val NO_LAG = listOf(LikelyResponse(listOf(Response()), 1.0))

        /**
         * Reads [log] and corrects it.
         *
         * @param given the sensor, or null to learn it. @param hasReference whether readings carry [REFERENCE].
         * @param conditions column of each condition that readings carry beside it, by its name.
         * @param progress told how many bytes have been read.
         * @throws LogProblem if the log cannot be used.
         * @throws IllegalArgumentException if [given] cannot be undone.
         */
        fun of(
            log: SurveyLog,
            given: SensorSpec?,
            hasReference: Boolean,
            conditions: Map<String, String> = emptyMap(),
            progress: (Long) -> Unit = {},
        ): CorrectedLog {
            val undone = given?.let(UndoableSensor::of)
            undone?.let { requireConditions(it, conditions.keys, knowsSpeed(log, conditions.keys)) }
            val names = conditions.keys.toList()
            val rows = Rows(names.size)
            val scan = SurveyScan()
            val pass = read(log, names, rows, scan, progress)
            val plain = rows.series().also { series -> undone?.let { requireSeen(it, series) } }
            val measured = names.mapIndexed { i, name -> name to rows.condition(i) }.toMap()
            val bridged = ConditionColumns(log, conditions, plain.times, measured::getValue).bridged(BRIDGED_FAR)
            val others = withSpeed(plain, measured)
            val series = if (knowsSpeed(log, conditions.keys)) plain.withSpeedOf(others) else plain
            val shown = rows.references()
            SquareReach.require(log, series.values, shown)
            val statistics = scan.statistics()
            val resolution = resolution(statistics, series)
            val unusable = UnusableReadings.of(series, resolution, RangeEnds.beyondDoubt(given))
            val references = References.of(series, shown, unusable, isLearned = hasReference && undone == null)
            val tried = when {
                given != null -> given(given)
                hasReference -> SensorLearning.byReference(log, series, references, unusable)
                else -> SensorLearning.byRevisits(series, unusable, log.frame != null)
            }
            fun corrected(learned: Learned, likely: List<LikelyResponse> = learned.likely) =
                corrected(series, likely, learned.calibration, resolution, others, unusable)
            val first = corrected(tried)
            val isLost = isLost(tried, first, series, references.measured)
            val other = if (isLost) SensorLearning.byRevisits(series, unusable, log.frame != null) else null
            val learned = other?.copy(fault = LOST) ?: tried
            val narrow = if (isLost) corrected(learned) else first
            val spec = given ?: SensorSpec("$LEARNED ${log.file.fileName}", learned.stages + quantum(resolution))
            val agreement = TrackAgreement.of(series, narrow)
            val agreed = learned.agreed(narrow, agreement)
            // A given sensor's intervals are the giver's. All others must hold a reference that is there, learned from or not.
            val isMeasured = hasReference && learned.origin != SensorOrigin.GIVEN
            val margin = if (isMeasured) ReferenceMargin.of(series, agreed, references.measured) else null
            val lagless = margin?.widened(agreed) ?: agreed
            val unknown = UnknownLag.of(series, learned, isMeasured = margin?.isEnough == true)
            val unhinted = unknown?.held(lagless) { corrected(learned, it) } ?: lagless
            return CorrectedLog(
                log,
                pass,
                series,
                learned,
                spec,
                unhinted,
                // Where a reference says how far intervals have to reach, a hint has nothing to add.
                learned.hinted?.takeIf { margin?.isEnough != true }
                    ?.let { unhinted.holding(corrected(learned, listOf(it))) },
                statistics,
                legs(series, measured(series, learned.calibration, others, unusable)),
                legs(series, unhinted.values),
                agreement,
                learned.wander(series, narrow, agreement),
                margin,
                unusable,
                others,
                bridged + references.faults,
                unknown?.let { it.longest to lagless },
            )
        }

        private fun given(sensor: SensorSpec): Learned {
            val likely = LikelyResponse(listOf(UndoableSensor.of(sensor).response), 1.0)
            return Learned(SensorOrigin.GIVEN, null, listOf(likely), sensor.stages)
        }

        /** Puts all readings of [log] into [rows], with the conditions [names], and [scan]. */
        private fun read(
            log: SurveyLog,
            names: List<String>,
            rows: Rows,
            scan: SurveyScan,
            progress: (Long) -> Unit,
        ): LogPass {
            val pass = log.read(progress) { time, x, y, value, seen ->
                rows.add(time.seconds, x, y, value, seen[REFERENCE], *DoubleArray(names.size) { seen[names[it]] })
                scan.take(time, x, y, value, seen)
            }
            if (pass.readings < FEWEST) {
                val expected = "at least $FEWEST readings of ${log.quantity}"
                throw LogProblem(log.file, null, null, expected, "${pass.readings}")
            }
            return pass
        }

        /**
         * Whether what was [learned] from the [references] takes the values, on average of all rows of the [track], farther off
         * than these and the [series] reach together: then it is none of a sensor.
         */
        private fun isLost(
            learned: Learned,
            track: CorrectedTrack,
            series: TrackSeries,
            references: DoubleArray,
        ): Boolean {
            if (learned.origin != SensorOrigin.REFERENCE) return false
            val known = references.filter { it.isFinite() }
            val gain = UndoableSensor.of(SensorSpec("", learned.calibration)).gain
            val reach = known.max() - known.min() + (series.values.max() - series.values.min()) / abs(gain)
            return track.meanHalfWidth > reach
        }

        /** Whether [log] tells the speed: along a transect in any unit places do not, unless it is one of [conditions]. */
        private fun knowsSpeed(log: SurveyLog, conditions: Set<String>) =
            Conditions.SPEED in conditions || (log.hasPlaces && !log.oneDimensional)

        /** Refuses [conditions] that lack one that undoing [sensor] takes; places tell the speed if [knowsSpeed]. */
        private fun requireConditions(sensor: UndoableSensor, conditions: Set<String>, knowsSpeed: Boolean) {
            val told = if (knowsSpeed) conditions + Conditions.SPEED else conditions
            val missing = sensor.needs - told
            require(missing.isEmpty()) {
                "undoing it takes ${missing.joinToString(" and ") { "--condition $it=COLUMN" }}"
            }
        }

        /** Refuses [sensor] whose dead time no reading of [series] ends: none is of water within the log. */
        private fun requireSeen(sensor: UndoableSensor, series: TrackSeries) {
            val duration = series.times.last() - series.times.first()
            require(sensor.response.deadTime < duration) {
                "a dead time of ${digits(sensor.response.deadTime)} s in a log of ${digits(duration)} s"
            }
        }

        /** Readings of [series] with the calibration of [stages] undone, in the unit of what is corrected. */
        private fun measured(
            series: TrackSeries,
            stages: List<SensorStage>,
            conditions: Map<String, DoubleArray>,
            unusable: UnusableReadings,
        ): DoubleArray = UndoableSensor.of(SensorSpec("", stages))
            .calibrated(series.withValues(unusable.bridged(series)), conditions).values

        /** [series] with the calibration of [stages] undone, and the response that is one of [likely]. */
        private fun corrected(
            series: TrackSeries,
            likely: List<LikelyResponse>,
            stages: List<SensorStage>,
            resolution: Double,
            conditions: Map<String, DoubleArray> = emptyMap(),
            unusable: UnusableReadings = UnusableReadings.none(series.size),
        ): CorrectedTrack {
            val sensor = UndoableSensor.of(SensorSpec("", stages))
            val scaled = sensor.calibrated(series, conditions)
            val out = if (sensor.gain < 0) unusable.mirrored() else unusable
            return TrackCorrector(scaled, resolution / abs(sensor.gain), out, sensor.wander, sensor.noise)
                .correct(likely).widenedBy(sensor.play / 2)
        }

        /**
         * [conditions], their gaps bridged, and the speed, from the positions where the log does not hold it, as the
         * diagnosis takes them.
         */
        private fun withSpeed(series: TrackSeries, conditions: Map<String, DoubleArray>): Map<String, DoubleArray> {
            val measured = MeasuredSeries(series.times, series.xs, series.ys, series.values, null, conditions)
            val bridged = conditions.mapValues { (_, numbers) -> ConditionGaps(series.times, numbers).bridged }
            return bridged + (Conditions.SPEED to measured.speed)
        }

        private fun TrackSeries.withSpeedOf(conditions: Map<String, DoubleArray>): TrackSeries {
            val speeds = conditions.getValue(Conditions.SPEED)
            val usual = speeds.filter { it > 0 }.sorted().let { it.getOrNull(it.size / 2) } ?: return this
            return withSpeeds(speeds, maxOf(Math.round(usual * ROUND) / ROUND, 1 / ROUND))
        }

        /** Without a step the readings are taken as they are; where they hardly change theirs is not to be seen. */
        private fun resolution(statistics: SurveyStatistics, series: TrackSeries) =
            if (statistics.resolution.isFinite()) statistics.resolution else ValueResolution.atLeast(series.values)

        private fun quantum(resolution: Double) =
            if (resolution > 0) listOf(SensorStage.Quantum(resolution)) else emptyList()

        private fun legs(series: TrackSeries, values: DoubleArray): LegMismatch? {
            val scan = SurveyScan()
            for (i in 0 until series.size) {
                scan.take(
                    stillwater.model.BoatTime(series.times[i]),
                    series.xs[i],
                    series.ys[i],
                    values[i],
                    Conditions.NONE,
                )
            }
            val statistics = scan.statistics()
            val track: Track = scan.track()
            return LegComparison(statistics, track).compare(LegFinder(statistics).find(track))
        }
    }
}

/** Rows of a log as they come. */
private class Rows(others: Int) {
    private var columns = Array(COLUMNS + others) { DoubleArray(FIRST) }
    private var size = 0

    fun add(vararg row: Double) {
        if (size == columns[0].size) columns = Array(columns.size) { columns[it].copyOf(2 * size) }
        for (i in row.indices) columns[i][size] = row[i]
        size++
    }

    fun series() = TrackSeries(of(0), of(1), of(2), of(3))

    fun references(): DoubleArray = of(4)

    fun condition(i: Int): DoubleArray = of(COLUMNS + i)

    private fun of(column: Int) = columns[column].copyOf(size)

    private companion object {
        const val COLUMNS = 5
        const val FIRST = 1024
    }
}
