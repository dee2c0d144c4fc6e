package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.Loops
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.evidence.SmallShifts
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.noise.Shocks
import stillwater.diagnose.response.LinearResponse
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.Term
import stillwater.diagnose.response.UnknownTruth
import stillwater.diagnose.track.SmoothTrack
import stillwater.diagnose.water.WaterModes
import kotlin.math.abs
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Finds the likeliest numbers of models of a log without a reference.
 *
 * @property loops how fits that do not wait for each other are done. @param progress told how much of [best] is done, a
 *   share within 0..1 that grows.
 */
internal class BlindSearch private constructor(
    private val series: MeasuredSeries,
    val loops: Loops,
    private val progress: (Double) -> Unit,
    private var ground: BlindGround,
) {
    constructor(series: MeasuredSeries, loops: Loops = Loops.IN_TURN, progress: (Double) -> Unit = {}) :
        this(series, loops, progress, BlindGround(series, loops))

    private val n = series.size

    /** Where the boat was. */
    val track: SmoothTrack get() = ground.track

    /** How far fixes scatter. */
    val fixes: FixScatter get() = ground.fixes
    val steep: SteepNoise get() = ground.steep

    /** Quantities of the log. */
    val scales: Scales get() = ground.scales
    val designs get() = ground.designs
    private val rough get() = ground.rough

    /** Rows that are fitted. */
    val used = BooleanArray(n) { true }

    private val most = most(n).coerceAtMost(MOST_WAVES)

    /** The water's waves; few until [best] has told which are needed. */
    val modes: WaterModes get() = fine ?: rough
    private var fine: WaterModes? = null

    /** What gaps in the log leave open; null where there are none. */
    val gaps: UnknownTruth? by lazy { UnknownTruth.ofGaps(series) }

    /** What is not known of the sensor's state after gaps in the log; null while that is not asked, and where there are none. */
    private var shocks: Shocks? = null

    /** Noise of which [share] wanders over so many [steps]. */
    fun noise(share: Double, steps: Double) = noiseOver(share, steps * series.period)

    private fun noiseOver(share: Double, time: Double) =
        CorrelatedNoise(series.times, share, time, used, shocks)

    /** [state] with gaps after which the sensor may show anything, for as long as its lag takes. */
    private fun shaken(state: BlindState): BlindState {
        val open = gaps ?: return state
        val now = state.fit.design.noise
        shocks = open.shocks(state.timeConstant, 1.0, sqrt(state.variance), isHeld = false)
        return again(state, now.with(noiseOver(now.noise.share, now.noise.time)))
    }

    /** The same search in readings that are less by [change], length n. */
    fun less(change: DoubleArray): BlindSearch {
        val values = DoubleArray(n) { series.values[it] - change[it] }
        return copy(series.withReadings(values))
    }

    /** The same search in [readings]; what is found there changes nothing here. */
    fun copy(readings: MeasuredSeries = series): BlindSearch {
        val other = BlindSearch(readings, loops, {}, ground)
        used.copyInto(other.used)
        other.fine = fine
        other.steps = steps
        other.shocks = shocks
        other.lastVariance = lastVariance
        return other
    }

    /** The likeliest model with a lag alone, on the course that it is likeliest on. */
    fun best(): BlindState {
        var best = bestOnTrack()
        if (!fixes.isWide(best)) return best
        val courses = SmoothTrack.wider(series)
        repeat(COURSES) {
            val course = likelierCourse(courses, best) ?: return best
            val other = BlindSearch(series, loops, {}, BlindGround(series, loops, course))
            val next = other.bestOnTrack()
            if (next.score < best.score + CLEARLY) return best
            ground = other.ground
            shocks = other.shocks
            best = begun(next)
        }
        return best
    }

    private fun bestOnTrack(): BlindState {
        val guess = BlindNoise(noise(FIRST_SHARE, FIRST_STEPS), DoubleArray(n) { 1.0 })
        var variances = DoubleArray(0)
        val coarse = LAGS.map { steps ->
            settled(emptyList(), base(steps * series.period), guess, variances, modes = rough)
                .also {
                    variances = it.variances
                    progress(ROUGH * (LAGS.indexOf(steps) + 1) / LAGS.size)
                }
        }
        // With few waves first. The lag before the noise: what a wrong lag leaves would be taken for noise
        // that wanders.
        val found = stepped(improved(shaken(improved(coarse.maxBy { it.score }))))
        // Without errors of fixes: such as few waves tell may take a long lag for themselves.
        val first = quieted(found, steep::without)
        progress(2 * ROUGH)
        var state = shaken(finer(improved(first)))
        fine = state.modes
        state = placed(state)
        // More waves may explain what looked like noise that wanders.
        progress(3 * ROUGH)
        state = improved(improved(requieted(evened(state))))
        val was = steps
        // Few waves may have told wrongly whether steps are held.
        state = stepped(state)
        if (steps != was) state = improved(requieted(evened(state)))
        state = restarted(state)
        lastVariance = state.variance
        return state
    }

    /** [state] with as many waves as it takes; where even those it has are too few, at the lag they tell. */
    private fun finer(state: BlindState): BlindState {
        fun at(waves: WaterModes, lag: Double) =
            settled(emptyList(), base(lag), state.fit.design.noise, DoubleArray(0), FIRST_ROUNDS, waves)
        if (WaterDetail.isEnough(state)) return redone(state)
        val best = at(rough.flat(most), state.timeConstant)
        if (best.isResolved) return redone(best)
        val others = LAGS.map { it * series.period }.filter { abs(ln(it / state.timeConstant)) > FAR_LAG }
        return redone((others.map { at(best.modes, it) } + best).maxBy { it.score })
    }

    private fun redone(state: BlindState) = WaterDetail(this, most).of(state)

    /** [state] with finer waves where those it has may be too few, as likely as can be; null where they are not. */
    fun deeper(state: BlindState): BlindState? {
        if (state.isResolved) return null
        return WaterDetail(this, most).deeper(state)?.let { restarted(climbed(requieted(evened(it)))) }
    }

    /** [state], from which on all that follows begins. */
    fun begun(state: BlindState): BlindState {
        fine = state.modes
        steps = state.model.steps
        lastVariance = state.variance
        return state
    }

    /** The noise's variance that [best] found, sensor units². */
    var lastVariance: Double = 0.0
        private set

    /** How the truth goes on between the rows. */
    var steps: Steps = Steps.EVEN
        private set

    /** [state], or the same with steps held that were not, or the other way round, as the log says. */
    fun stepped(state: BlindState): BlindState {
        val least = state.score + if (steps.isHeld) -HELD else HELD
        val later = SmallShifts.kept(state.model, state.numbers, steps.other)
        return within(steps.other, least) {
            onArmOrWay(improved(again(state, state.fit.design.noise, later)))
        } ?: state
    }

    /**
     * Only the lag and [terms] of [state], with steps [to] and what suits that, as all that follows has them; null if
     * below [least].
     */
    fun turned(state: BlindState, to: Steps, least: Double, terms: List<Term> = emptyList()) = within(to, least) {
        val own = model(terms, state.modes, state.water).carried(state.model, state.numbers)
        fullySuited(settled(terms, own, state.fit.design.noise, state.variances, before = state))
    }

    private fun within(to: Steps, least: Double, fitted: () -> BlindState): BlindState? {
        val was = steps
        steps = to
        return fitted().takeIf { it.score > least } ?: null.also { steps = was }
    }

    /** Numbers of a lag of [timeConstant] s. */
    fun base(timeConstant: Double) = doubleArrayOf(timeConstant, 1.0, 0.0, 0.0)

    /** [state] with each row's spread of noise as its residuals say, as long as that suits it better. */
    fun evened(state: BlindState): BlindState {
        val now = state.fit.design.noise
        val noise = noiseOver(now.noise.share, now.noise.time)
        var best = if (now.noise.rows == noise.rows) state else again(state, now.with(noise))
        repeat(EVENINGS) {
            val next = again(best, steep.of(best, noise))
            val gain = next.score - best.score
            if (gain > 0) best = next
            if (!(gain > ENOUGH)) return best
        }
        return best
    }

    /** [state] under [noise], with [numbers], and the water for that. */
    fun again(state: BlindState, noise: BlindNoise, numbers: DoubleArray = state.numbers) =
        settled(state.model.terms, numbers, noise, state.variances, before = state)

    /**
     * [state] with those of its [free] numbers that fit better, in at most [steps] steps, and the water for them.
     *
     * Numbers that are hardly better are left as they are: what the sensor shows of the water's waves is then known, and
     * the water alone is found.
     */
    fun improved(
        state: BlindState,
        free: BooleanArray = free(state.model),
        steps: Int = STEPS,
    ): BlindState {
        val found = BlindDescent(this, state).from(state.model, state.numbers, free, steps)
        val isBetter = state.fit.rows * ln(state.left / found.left) > HARDLY
        if (!isBetter && state.lastGain < HARDLY) return state
        val numbers = if (isBetter) found.numbers else state.numbers
        val noise = state.fit.design.noise
        return settled(state.model.terms, numbers, noise, state.variances, before = state)
    }

    /**
     * [state] with the numbers that fit better and the water for them, in turn, as long as that makes it likelier, and
     * steps that gain no more than the last one may lead to [least].
     */
    fun climbed(state: BlindState, least: Double = Double.NEGATIVE_INFINITY): BlindState {
        var best = state
        for (left in MOST_CLIMBS - 1 downTo 0) {
            if (best.isAtEnd) return best
            val next = improved(best)
            val gain = next.score - best.score
            if (gain > 0) best = next else best.isAtEnd = true
            if (!(gain > ENOUGH) || best.score + left * gain < least) return best
        }
        return best
    }

    /** Which numbers of [model] are fitted: the lag's and the terms'. */
    fun free(model: ResponseModel) =
        BooleanArray(model.parameters.size) { it == ResponseModel.TIME_CONSTANT || it >= ResponseModel.BASE }

    /**
     * The water for the sensor with [terms] and [numbers].
     *
     * @param variances of the bands to begin with; empty for none. @param rounds times that variances are fitted.
     * @param before a state whose water is near.
     */
    fun settled(
        terms: List<Term>,
        numbers: DoubleArray,
        noise: BlindNoise,
        variances: DoubleArray,
        rounds: Int = ROUNDS,
        modes: WaterModes? = null,
        before: BlindState? = null,
    ): BlindState {
        val waves = modes ?: before?.modes ?: this.modes
        val own = numbers.copyOf().also { it[ResponseModel.FIRST] = 0.0 }
        val columns = designs.shown(terms, own, waves, steps)
        var heights = before?.fit?.heights?.takeIf { it.size == columns.size } ?: DoubleArray(columns.size)
        var bands = variances.takeIf { it.size == waves.bands } ?: waves.first
        var at = numbers.copyOf().also { it[ResponseModel.FIRST] = heights.last() }
        var model = model(terms, waves, designs.along(waves, heights))
        var residuals = residuals(model, at)
        fun fit() =
            BlindFit(designs.designed(columns, ShownRows.of(model, at), noise), precisions(bands, waves), heights)
        var fit = fit()
        var was = 0.0
        var left = 0.0
        for (round in 0..rounds) {
            if (round > 0) {
                was = fit.score(left)
                bands = WaterVariances.next(fit, left, waves)
                fit = fit()
            }
            val change = fit.change(residuals)
            heights = DoubleArray(heights.size) { heights[it] + change[it] }
            model = model(terms, waves, designs.along(waves, heights))
            at = at.copyOf().also { it[ResponseModel.FIRST] = heights.last() }
            fit = fit.at(heights)
            residuals = residuals(model, at)
            left = fit.left(residuals)
        }
        val gained = fit.score(left) - was
        return BlindState(model, at, fit, bands, residuals, left, waves, before?.behind.orEmpty(), gained)
    }

    /** The sensor with [terms] in [water], whose waves are [modes]. */
    fun model(terms: List<Term>, modes: WaterModes, water: DoubleArray) =
        ResponseModel(series.withReference(water), terms, steps, scales, modes.behind)

    private fun residuals(model: ResponseModel, numbers: DoubleArray): DoubleArray {
        val out = DoubleArray(n)
        model.predict(numbers, out)
        for (i in 0 until n) out[i] = series.values[i] - out[i]
        return out
    }

    /**
     * [waters], those of places so far [behind] the fixes, m, as the linear parts of the sensor show them; their [bends]
     * where they are kept.
     */
    fun seen(
        terms: List<Term>,
        numbers: DoubleArray,
        waters: Array<DoubleArray>,
        behind: Double,
        bends: LinearResponse.Bends? = null,
    ): Array<DoubleArray> = designs.seen(terms, numbers, waters, steps, behind, bends)

    /** The waters of [modes] with [heights] along the track. */
    fun along(modes: WaterModes, heights: Array<DoubleArray>): Array<DoubleArray> = designs.along(modes, heights)

    private fun precisions(variances: DoubleArray, modes: WaterModes) = DoubleArray(modes.size + 1) { k ->
        if (k == 0 || k == modes.size) FLAT else 1 / variances[modes.band[k]].coerceIn(LEAST, WaterModes.MOST)
    }

    companion object {
        /** Causes that show a sum of waters as the sum of what they show of each. */
        val LINEAR = setOf(
            Cause.SECOND_ORDER_RESPONSE,
            Cause.TWO_PATH_RESPONSE,
            Cause.DEAD_TIME,
            Cause.FLOW_DEPENDENT_RESPONSE,
            Cause.TEMPERATURE_DEPENDENT_RESPONSE,
            Cause.POSITION_OFFSET,
        )
        const val MOST_WAVES = 450

        /** Times that a likelier course is looked for. */
        const val COURSES = 3

        /** Twice a log-likelihood by which all is likelier along another course than by chance of the search. */
        const val CLEARLY = 30.0

        /** Share of the search that one of its parts is. */
        const val ROUGH = 0.25
        const val FEWEST_WAVES = 30

        /** Waves at most that so many [rows] are asked for. */
        fun most(rows: Int): Int = maxOf(rows * 2 / 5, FEWEST_WAVES)

        /** Logarithm of the ratio of lags from which on one is not found from the other. */
        const val FAR_LAG = 0.5

        const val FIRST_SHARE = 0.8
        const val FIRST_STEPS = 5.0
        const val FIRST_ROUNDS = 5

        const val ROUNDS = 2

        /**
         * Twice the gain in log-likelihood from which steps are held: water in the field is not, and a response of another
         * shape looks like it somewhat.
         */
        const val HELD = 8.0
        const val STEPS = 8
        const val EVENINGS = 4

        /** Twice the gain in log-likelihood below which nothing is tried once more. */
        const val ENOUGH = 2.0

        /** The same for which numbers, or the variances of the water's waves, stay as they are: next to no error of theirs. */
        const val HARDLY = 0.05
        const val FLAT = 1e-8
        const val LEAST = 1e-8
        val LAGS = doubleArrayOf(0.1, 1.5, 3.0, 6.0, 12.0, 24.0).toList()

        /** Shares of the noise that may wander, and over how many rows. */
        val SHARES = doubleArrayOf(0.0, 0.2, 0.5, 0.8, 0.95)
        val TIMES = doubleArrayOf(3.0, 10.0, 35.0)
        const val MOST_CLIMBS = 5
    }
}
