package stillwater.correct

import kotlinx.coroutines.Dispatchers
import kotlinx.coroutines.async
import kotlinx.coroutines.awaitAll
import kotlinx.coroutines.runBlocking
import stillwater.diagnosis.ReferenceSteps
import stillwater.estimate.CandidateResponse
import stillwater.estimate.CorrectedTrack
import stillwater.estimate.LikelyResponse
import stillwater.estimate.ReferenceLearner
import stillwater.estimate.Response
import stillwater.estimate.ResponseChoice
import stillwater.estimate.ResponseKind
import stillwater.estimate.ResponseLearner
import stillwater.estimate.RevisitLearner
import stillwater.estimate.TrackAgreement
import stillwater.estimate.TrackCorrector
import stillwater.estimate.TrackSeries
import stillwater.estimate.UnusableReadings
import stillwater.estimate.ZeroWander
import stillwater.estimate.atLeastAsNested
import stillwater.estimate.rateLimit
import stillwater.io.LogProblem
import stillwater.io.SurveyLog
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import stillwater.survey.Wording.Companion.duration
import kotlin.random.Random

/**
 * What a log says about its sensor.
 *
 * @property origin where it comes from. @property choice the candidates, or null where nothing was chosen.
 * @property likely the responses to undo. @property hinted one that is too weakly hinted at to count among them, but
 * that intervals have to hold, or null. @property stages the most likely, with its calibration.
 * @property readings what was learned on. @property blocks runs held against others. @property withoutReference
 * readings without one. @property held whether the reference looks held over each step. @property fault why the
 * reference was not learned from, or null. @property isPart whether usable readings were too many to learn on all.
 * @property scatter by how much delays of single runs scatter beyond what fixes may be off, s, where passes tell; once
 * asked for, because it takes a while.
 * @property alike runs that tell nothing, because all passes near them go the same way at the same speed.
 * @property stillBoat why passes of the usable readings teach nothing, as the boat lay still; null where it did not.
 */
internal data class Learned(
    val origin: SensorOrigin,
    val choice: ResponseChoice?,
    val likely: List<LikelyResponse>,
    val stages: List<SensorStage>,
    val readings: Int = 0,
    val blocks: Int = 0,
    val withoutReference: Int = 0,
    val held: Boolean = false,
    val fault: String? = null,
    val hinted: LikelyResponse? = null,
    val isPart: Boolean = false,
    val stillBoat: String? = null,
    val alike: Int = 0,
    private val scatter: Lazy<Double>? = null,
) {
    /** What is undone of [stages] before the [likely] responses are: of a given sensor all that is not in its response. */
    val calibration: List<SensorStage>
        get() = if (origin == SensorOrigin.GIVEN) {
            stages
        } else {
            stages.filter { it is SensorStage.Calibration || it is SensorStage.Wander }
        }

    /** Whether delays differ along a track on which too few crossings, see [agreement], show that better. */
    fun isUneven(agreement: TrackAgreement): Boolean = (unevenness(agreement) ?: 0.0) > 0

    /** By how much delays of single runs scatter, s; null where crossings, see [agreement], show it better, or nothing. */
    fun unevenness(agreement: TrackAgreement): Double? = scatter?.takeIf { agreement.ratio.isNaN() }?.value

    /**
     * How far the zero may have wandered on [track], the correction of [series]; null where crossings, see [agreement],
     * show it better, or the sensor was not learned from passes.
     */
    fun wander(series: TrackSeries, track: CorrectedTrack, agreement: TrackAgreement): ZeroWander? {
        val isLooked = agreement.ratio.isNaN() && (origin == SensorOrigin.REVISITS || origin == SensorOrigin.RATE)
        return if (isLooked) ZeroWander.of(series, track) else null
    }

    /** [track] with the intervals that passes ask for. */
    fun agreed(track: CorrectedTrack, agreement: TrackAgreement): CorrectedTrack = when {
        // What a given sensor's intervals are is the giver's: they are told of, not changed. "Passes" of a boat that
        // lay still are none, and have no say in the intervals either.
        origin == SensorOrigin.GIVEN || stillBoat != null -> track
        isUneven(agreement) -> agreement.widened(track, unevenness(agreement) ?: 0.0)
        else -> agreement.widened(track)
    }
}

/** Learns a log's sensor, from passes through the same water or from a reference. */
internal object SensorLearning {
    /** More readings than this are learned on in the middle of a log only. */
    const val MOST_LEARNED = 20_000

    /** A part of which nothing can be learned is not cut in half below this. */
    private const val FEWEST_LEARNED = 2_500

    /** Seed of the bootstrap. */
    const val SEED = 1L

    private const val FEWEST = 30

    /** A log that is not many times as long as a lag that it does not tell from none tells nothing of lags. */
    private const val FEW_LAGS = 10

    /** The water between rows with a reference is not known where it bends by half of what is left of the readings. */
    const val MOST_ROUGHNESS = 0.5

    /** Responses before a rate limit: of a slow path what is left of the readings says too little. */
    private val BEFORE_LIMIT = ResponseKind.entries.filterNot {
        it == ResponseKind.SLEW || it == ResponseKind.FLOW || it.hasTwoPaths
    }

    /** Of which how long a single lag may be is all that there is to know. */
    private val SINGLE = setOf(ResponseKind.NONE, ResponseKind.FIRST_ORDER)
    private val NO_LAG = listOf(LikelyResponse(listOf(Response()), 1.0))

    /**
     * What passes of [all] through the same water say, without those readings that are [unusable].
     *
     * @param hasFixes whether positions are fixes on the globe, which wander.
     */
    fun byRevisits(
        all: TrackSeries,
        unusable: UnusableReadings = UnusableReadings.none(all.size),
        hasFixes: Boolean = false,
    ): Learned {
        val series = if (unusable.isNone) all else all.at((0 until all.size).filter(unusable::isUsable))
        val isStuck = series.size < FEWEST || isFlat(series.values)
        val stillBoat = StillBoat.why(series, hasFixes)
        if (isStuck || stillBoat != null) return nothing(all.size).copy(stillBoat = stillBoat)
        val rate = series.rateLimit()
        if (rate.isFinite()) return byRate(series, rate)
        val (part, learner) = learnable(series)
        val choice = choice(learner, ResponseKind.entries - ResponseKind.SLEW) { learner.copy() }
            ?.takeUnless { learner.alike > 0 && isUnknown(it) } ?: return nothing(part.size).copy(alike = learner.alike)
        val stages = choice.first.response.stages(series.referenceSpeed)
        return Learned(
            SensorOrigin.REVISITS,
            choice,
            choice.likely(),
            stages,
            part.size,
            learner.blocks,
            hinted = choice.likelyHint(),
            isPart = part.size < series.size,
            alike = learner.alike,
            scatter = lazy { learner.unevenness(choice.first.response) },
        )
    }

    /** Whether [choice] leaves a lag more open than it is where nothing is known. */
    private fun isUnknown(choice: ResponseChoice): Boolean {
        val lag = choice.standings.first { it.candidate.kind == ResponseKind.FIRST_ORDER }.candidate.interval(0)
        return lag.endInclusive > maxOf(UnknownLag.USUAL, ReferenceLearner.MOST_FACTOR * lag.start)
    }

    /** As much of [series] as passes can be learned from, and what learns from it. */
    private fun learnable(series: TrackSeries): Pair<TrackSeries, RevisitLearner> {
        var part = series.middle(MOST_LEARNED)
        var learner = RevisitLearner.of(part)
        // The longer the part, the longer the runs that are held against others: legs may be too short for them.
        while (learner.blocks == 0 && part.size > FEWEST_LEARNED) {
            part = series.middle(part.size / 2)
            learner = RevisitLearner.of(part)
        }
        return part to learner
    }

    /**
     * A sensor that follows no faster than [rate], sensor units/s: what it would show without that limit is what passes
     * say of the lag before it. Where it is at its limit that is a guess, first one that knows of no lag and then one
     * by the lag found.
     */
    private fun byRate(all: TrackSeries, rate: Double): Learned {
        val series = all.middle(MOST_LEARNED)
        val limit = ResponseKind.SLEW.response(rate)
        val alone = listOf(LikelyResponse(listOf(limit), 1.0))
        val isPart = series.size < all.size
        val nothing = Learned(SensorOrigin.RATE, null, alone, limit.stages(), series.size, isPart = isPart)
        fun limited(open: LikelyResponse) =
            LikelyResponse(open.responses.map { it.copy(slewRate = rate) }, open.weight)

        fun learned(freed: DoubleArray): Learned {
            val (part, learner) = learnable(series.withValues(freed))
            val choice = choice(learner, BEFORE_LIMIT) { learner.copy() } ?: return nothing
            return Learned(
                SensorOrigin.RATE,
                choice,
                choice.likely().map(::limited),
                choice.first.response.copy(slewRate = rate).stages(),
                part.size,
                learner.blocks,
                isPart = part.size < all.size,
                scatter = lazy { learner.unevenness(choice.first.response) },
            )
        }
        val first = learned(TrackCorrector(series).correct(alone).values)
        val lag = first.choice?.first?.response ?: return nothing
        val water = TrackCorrector(
            series,
        ).correct(listOf(LikelyResponse(listOf(lag.copy(slewRate = rate)), 1.0))).values
        return learned(shown(series, water, lag))
    }

    /** What a sensor with [response] shows of [water], which runs straight from row to row. */
    private fun shown(series: TrackSeries, water: DoubleArray, response: Response): DoubleArray {
        val sensor = SensorSpec("", response.stages()).build(water[0], Random(SEED))
        return DoubleArray(water.size) { i ->
            val before = maxOf(0, i - 1)
            // Held over a step, an input's mean is that of its ends.
            sensor.step((water[before] + water[i]) / 2, series.times[i] - series.times[before], Conditions.NONE)
        }
    }

    private fun nothing(readings: Int) = Learned(SensorOrigin.NOTHING, null, NO_LAG, emptyList(), readings)

    /** What [all] references say of the readings of [series] but for the [unusable]. */
    fun byReference(
        log: SurveyLog,
        series: TrackSeries,
        all: References,
        unusable: UnusableReadings,
    ): Learned {
        val references = all.water
        val known = (0 until series.size).filter { references[it].isFinite() }
        val rows = known.middle(MOST_LEARNED)
        val telling = rows.filter(unusable::isUsable)
        if (telling.size < FEWEST) {
            val but = if (telling.size < rows.size) " that are neither wild nor at an end of the range" else ""
            val expected = "at least $FEWEST readings with a reference$but"
            throw LogProblem(log.file, null, null, expected, "${telling.size}")
        }
        if (telling.all { references[it] == references[telling[0]] }) {
            val found = "${references[telling[0]]} in every row"
            throw LogProblem(log.file, null, null, "a reference that changes", found)
        }
        if (telling.all { all.measured[it] == series.values[it] }) {
            val found = "the numbers of ${log.quantity} in every row that has one"
            throw LogProblem(log.file, null, null, "a reference of another instrument than the readings", found)
        }
        val part = series.at(rows)
        val reference = DoubleArray(rows.size) { references[rows[it]] }
        val out = unusable.at(rows)
        // A held reference has no noise, and one without its noise is as round as one that is held.
        val held = !all.isSmoothed && ReferenceLearner.isHeld(part, reference, out)
        fun another() = ReferenceLearner(part, reference, held, out)
        val learner = another()
        // Made only where it is asked for: it takes most of the time.
        val made = lazy { choice(learner, ResponseKind.entries, ::another) }
        val fault = fault(series, part, learner, made)
        val choice = if (fault == null) made.value else null
        if (choice == null) return byRevisits(series, unusable, log.frame != null).copy(fault = fault)

        // What is undone is a response to water that changes all the time.
        fun undone(open: LikelyResponse) =
            if (held) LikelyResponse(open.responses.map { it.sooner(part.medianStep / 2) }, open.weight) else open
        val response = choice.first.response
        val (gain, offset) = learner.calibration(response)
        val calibration = SensorStage.Calibration(if (gain == 0.0) 1.0 else gain, offset)
        val stages = response.stages(series.referenceSpeed) + listOfNotNull(calibration, learner.wander(response))
        return Learned(
            SensorOrigin.REFERENCE,
            choice,
            choice.likely().map(::undone),
            stages,
            part.size,
            learner.groups,
            all.measured.count { it.isNaN() },
            held,
            hinted = choice.likelyHint()?.let(::undone),
        )
    }

    /**
     * Why [learner], of the [part] of [series] with a reference, has nothing to learn from; null where it has. How long a
     * single lag may be says nothing where [choice] knows of another response that none is.
     */
    private fun fault(
        series: TrackSeries,
        part: TrackSeries,
        learner: ReferenceLearner,
        choice: Lazy<ResponseChoice?>,
    ): String? {
        val range = learner.lagRange()
        val length = part.times.last() - part.times.first()
        val least = if (range.start == 0.0) length / FEW_LAGS else ReferenceLearner.MOST_FACTOR * range.start
        fun isKnown() = choice.value?.open?.all {
            it.kind !in SINGLE && it.response.meanDelay < length / FEW_LAGS
        } == true
        if (range.endInclusive > least && !isKnown()) {
            val begin = if (range.start == 0.0) "none" else duration(range.start)
            val end = if (range.endInclusive.isInfinite()) "more than it is long" else duration(range.endInclusive)
            return "its ${part.size} rows, ${duration(length)} long, fit any lag from $begin to $end"
        }
        val isSparse = ReferenceSteps.isSparse(part.medianStep, series.medianStep)
        if (isSparse && learner.roughness() > MOST_ROUGHNESS) {
            val rows = "it has a row every ${duration(part.medianStep)} only"
            return "$rows, and the water between them is not known well enough"
        }
        return if (choice.value == null) "its ${part.size} rows are too few" else null
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
        return if (found.isEmpty()) null else ResponseChoice.of(learner.atLeastAsNested(found), Random(SEED))
    }
}

private fun UnusableReadings.at(rows: List<Int>) = UnusableReadings(
    BooleanArray(rows.size) { wild[rows[it]] },
    ByteArray(rows.size) { ends[rows[it]] },
)

private fun TrackSeries.middle(most: Int): TrackSeries =
    if (size <= most) this else at((0 until size).toList().middle(most))

/** Those in the middle, [most] of them or all. */
internal fun <T> List<T>.middle(most: Int): List<T> = drop(maxOf(0, (size - most) / 2)).take(most)
