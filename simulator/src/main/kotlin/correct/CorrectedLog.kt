package stillwater.correct

import kotlinx.coroutines.Dispatchers
import kotlinx.coroutines.async
import kotlinx.coroutines.awaitAll
import kotlinx.coroutines.runBlocking
import stillwater.diagnose.MeasuredSeries
import stillwater.estimate.CandidateResponse
import stillwater.estimate.CorrectedTrack
import stillwater.estimate.LikelyResponse
import stillwater.estimate.ReferenceLearner
import stillwater.estimate.Response
import stillwater.estimate.ResponseChoice
import stillwater.estimate.ResponseKind
import stillwater.estimate.ResponseLearner
import stillwater.estimate.RevisitLearner
import stillwater.estimate.TrackCorrector
import stillwater.estimate.TrackSeries
import stillwater.estimate.UndoableSensor
import stillwater.estimate.rateLimit
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
import kotlin.math.abs
import kotlin.random.Random

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
 * @property origin where the sensor comes from. @property choice the candidates and what is left open, or null where
 * nothing
 *   was chosen. @property spec the sensor, the most likely if several are open. @property track the field along the
 * track.
 * @property statistics of the readings. @property before legs as measured, or null. @property after legs as corrected.
 * @property learnedOn readings that the sensor was learned on. @property blocks runs of the track held against others.
 * @property withoutReference readings left out because the reference is missing there.
 * @property held whether the reference looks held over each step, as in a simulation: the sensor is that of such steps.
 */
class CorrectedLog internal constructor(
    val log: SurveyLog,
    val pass: LogPass,
    val series: TrackSeries,
    val origin: SensorOrigin,
    val choice: ResponseChoice?,
    val spec: SensorSpec,
    val track: CorrectedTrack,
    val statistics: SurveyStatistics,
    val before: LegMismatch?,
    val after: LegMismatch?,
    val learnedOn: Int,
    val blocks: Int,
    val withoutReference: Int,
    val held: Boolean,
    private val conditions: Map<String, DoubleArray> = emptyMap(),
) {
    private val resolution: Double = resolution(statistics, series)

    /** The water if the sensor had no lag: readings smoothed as [track] is, and calibrated, with nothing undone. */
    private val smoothedValues: DoubleArray? by lazy {
        if (before == null || origin == SensorOrigin.NOTHING) return@lazy null
        val sensor = UndoableSensor.of(SensorSpec("", spec.stages))
        val scaled = sensor.calibrated(series, conditions)
        TrackCorrector(scaled, resolution / abs(sensor.gain)).correct(NO_LAG).values
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
        if (origin != SensorOrigin.REVISITS || before == null || series.size > MOST_LEARNED) return emptyList()
        val range = between ?: series.xs.min()..series.xs.max()
        val passes = PassDifference(series.xs, before.legs.legs, range.start, range.endInclusive)
            .takeIf { log.oneDimensional }
        val plain = smoothed?.let { CorrectedLegs(it, checkNotNull(smoothedValues)) }
        return HeldOutLegs(CorrectedLegs(before, series.values), passes, plain) { rows ->
            val learned = byRevisits(series.at(rows))
            if (learned.choice == null) return@HeldOutLegs null
            val values = corrected(series, learned, learned.stages, resolution).values
            legs(series, values)?.let { CorrectedLegs(it, values) }
        }.scores()
    }

    /** What a log says about its sensor. */
    private class Learned(
        val origin: SensorOrigin,
        val choice: ResponseChoice?,
        val likely: List<LikelyResponse>,
        val stages: List<SensorStage>,
        val readings: Int,
        val blocks: Int,
        val withoutReference: Int = 0,
        val held: Boolean = false,
    )

    companion object {
        /** Name of the condition that holds the reference. */
        const val REFERENCE = "reference"

        /** More readings than this are learned on in the middle of a log only. */
        const val MOST_LEARNED = 20_000

        /** A part of which nothing can be learned is not cut in half below this. */
        private const val FEWEST_LEARNED = 2_500

        /** Seed of the bootstrap. */
        const val SEED = 1L

        private const val FEWEST = 30
        private val NO_LAG = listOf(LikelyResponse(listOf(Response()), 1.0))

        /**
         * Reads [log] and corrects it.
         *
         * @param given the sensor, or null to learn it. @param hasReference whether readings carry [REFERENCE].
         * @param conditions names of the conditions that readings carry beside it.
         * @param progress told how many bytes have been read.
         * @throws LogProblem if the log cannot be used.
         * @throws IllegalArgumentException if [given] cannot be undone.
         */
        fun of(
            log: SurveyLog,
            given: SensorSpec?,
            hasReference: Boolean,
            conditions: Collection<String> = emptyList(),
            progress: (Long) -> Unit = {},
        ): CorrectedLog {
            val undone = given?.let(UndoableSensor::of)
            val missing = undone?.needs.orEmpty() - conditions.toSet() - Conditions.SPEED
            require(missing.isEmpty()) {
                "undoing it takes ${missing.joinToString(" and ") { "--condition $it=COLUMN" }}"
            }
            val names = conditions.toList()
            val rows = Rows(names.size)
            val scan = SurveyScan()
            val pass = log.read(progress) { time, x, y, value, seen ->
                rows.add(time.seconds, x, y, value, seen[REFERENCE], *DoubleArray(names.size) { seen[names[it]] })
                scan.take(time, x, y, value, seen)
            }
            if (pass.readings < FEWEST) {
                throw LogProblem(
                    log.file,
                    null,
                    null,
                    "at least $FEWEST readings of ${log.quantity}",
                    "${pass.readings}",
                )
            }
            val series = rows.series()
            SquareReach.require(log, series.values, rows.references())
            val statistics = scan.statistics()
            val resolution = resolution(statistics, series)
            val learned = when {
                undone != null -> Learned(
                    SensorOrigin.GIVEN,
                    null,
                    listOf(LikelyResponse(listOf(undone.response), 1.0)),
                    given.stages,
                    0,
                    0,
                )
                hasReference -> byReference(log, series, rows.references())
                else -> byRevisits(series)
            }
            val spec = given ?: SensorSpec("learned from ${log.file.fileName}", learned.stages + quantum(resolution))
            val others = withSpeed(series, names.mapIndexed { i, name -> name to rows.condition(i) }.toMap())
            val track = corrected(series, learned, spec.stages, resolution, others)
            return CorrectedLog(
                log,
                pass,
                series,
                learned.origin,
                learned.choice,
                spec,
                track,
                statistics,
                legs(series, series.values),
                legs(series, track.values),
                learned.readings,
                learned.blocks,
                learned.withoutReference,
                learned.held,
                others,
            )
        }

        /** [series] with the response of [stages] undone as [learned] says. */
        private fun corrected(
            series: TrackSeries,
            learned: Learned,
            stages: List<SensorStage>,
            resolution: Double,
            conditions: Map<String, DoubleArray> = emptyMap(),
        ): CorrectedTrack {
            val sensor = UndoableSensor.of(SensorSpec("", stages))
            val scaled = sensor.calibrated(series, conditions)
            return TrackCorrector(scaled, resolution / abs(sensor.gain)).correct(learned.likely)
        }

        /** [conditions] and the speed, from the positions where the log does not hold it, as the diagnosis takes it. */
        private fun withSpeed(series: TrackSeries, conditions: Map<String, DoubleArray>): Map<String, DoubleArray> {
            val measured = MeasuredSeries(series.times, series.xs, series.ys, series.values, null, conditions)
            return conditions + (Conditions.SPEED to measured.speed)
        }

        /** Without a step the readings are taken as they are; where they hardly change theirs is not to be seen. */
        private fun resolution(statistics: SurveyStatistics, series: TrackSeries) =
            if (statistics.resolution.isFinite()) statistics.resolution else ValueResolution.atLeast(series.values)

        private fun quantum(resolution: Double) =
            if (resolution > 0) listOf(SensorStage.Quantum(resolution)) else emptyList()

        private fun byRevisits(series: TrackSeries): Learned {
            if (series.values.all { it == series.values[0] }) return nothing(series.size)
            val rate = series.rateLimit()
            if (rate.isFinite()) {
                val response = ResponseKind.SLEW.response(rate)
                val likely = listOf(LikelyResponse(listOf(response), 1.0))
                return Learned(SensorOrigin.RATE, null, likely, response.stages(), series.size, 0)
            }
            var part = series.middle(MOST_LEARNED)
            var learner = RevisitLearner.of(part)
            // The longer the part, the longer the runs that are held against others: legs may be too short for them.
            while (learner.blocks == 0 && part.size > FEWEST_LEARNED) {
                part = series.middle(part.size / 2)
                learner = RevisitLearner.of(part)
            }
            val choice = choice(learner, ResponseKind.entries - ResponseKind.SLEW) { learner.copy() }
                ?: return nothing(part.size)
            val stages = choice.first.response.stages()
            return Learned(SensorOrigin.REVISITS, choice, choice.likely(), stages, part.size, learner.blocks)
        }

        private fun nothing(readings: Int) = Learned(
            SensorOrigin.NOTHING,
            null,
            NO_LAG,
            emptyList(),
            readings,
            0,
        )

        private fun byReference(log: SurveyLog, series: TrackSeries, references: DoubleArray): Learned {
            val known = (0 until series.size).filter { references[it].isFinite() }
            if (known.size < FEWEST) {
                val expected = "at least $FEWEST readings with a reference"
                throw LogProblem(log.file, null, null, expected, "${known.size}")
            }
            if (known.all { references[it] == references[known[0]] }) {
                val found = "${references[known[0]]} in every row"
                throw LogProblem(log.file, null, null, "a reference that changes", found)
            }
            val usable = known.drop(maxOf(0, (known.size - MOST_LEARNED) / 2)).take(MOST_LEARNED)
            val part = series.at(usable)
            val reference = DoubleArray(usable.size) { references[usable[it]] }
            val held = ReferenceLearner.isHeld(part, reference)
            val learner = ReferenceLearner(part, reference, held)
            val choice =
                requireNotNull(choice(learner, ResponseKind.entries) { ReferenceLearner(part, reference, held) })
            // What is undone is a response to water that changes all the time.
            val likely = choice.likely().map { open ->
                if (!held) return@map open
                LikelyResponse(open.responses.map { it.sooner(part.medianStep / 2) }, open.weight)
            }
            val response = choice.first.response
            val (gain, offset) = learner.calibration(response)
            val stages = response.stages() + SensorStage.Calibration(if (gain == 0.0) 1.0 else gain, offset)
            return Learned(
                SensorOrigin.REFERENCE,
                choice,
                likely,
                stages,
                part.size,
                learner.groups,
                series.size - known.size,
                held,
            )
        }

        /** All [kinds] on all cores; each task has a learner of its own, the first one [learner]. */
        private fun choice(
            learner: ResponseLearner,
            kinds: List<ResponseKind>,
            another: () -> ResponseLearner,
        ): ResponseChoice? {
            if (learner.groups == 0) return null
            val half = kinds.size / 2
            val found: List<CandidateResponse> = runBlocking(Dispatchers.Default) {
                listOf(
                    async { kinds.take(half).mapNotNull(another()::candidate) },
                    async { kinds.drop(half).mapNotNull(learner::candidate) },
                ).awaitAll().flatten()
            }
            return if (found.isEmpty()) null else ResponseChoice.of(found, Random(SEED))
        }

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

private fun TrackSeries.at(rows: List<Int>): TrackSeries {
    fun of(values: DoubleArray) = DoubleArray(rows.size) { values[rows[it]] }
    return TrackSeries(of(times), of(xs), of(ys), of(values))
}

private fun TrackSeries.middle(most: Int): TrackSeries {
    if (size <= most) return this
    val from = (size - most) / 2
    return at((from until from + most).toList())
}
