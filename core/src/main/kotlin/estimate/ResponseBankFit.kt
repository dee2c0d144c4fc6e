package stillwater.estimate

import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/** A sensor of two parameters as a [SensorFit]. Eqs. (14) to (17) of core/docs/SelfCalibratingEstimator.md. */
internal class ResponseBankFit(belief: SelfCalibratingSettings) : SensorFit(belief) {
    private val bank = ResponseBank()
    private val surface = QuadraticSurface()
    private val ridge = MisfitRidge()
    private val cut = CutParameter()

    /** The cell whose truth was last asked for, which the surface shows then. */
    private var asked = LagBank.NONE

    /** Slope of half the misfit over σ² and its second derivatives, the belief included, in the bank's steps. */
    private var slopeFirst = 0.0
    private var slopeSecond = 0.0
    private var curveFirst = 1.0
    private var curveSecond = 1.0
    private var curveBoth = 0.0

    /** Where the best parameters lie from the bank's middle, in its steps. */
    private var placeFirst = 0.0
    private var placeSecond = 0.0

    /** Variance of the second, in its steps squared. */
    private var spreadSecond = 1.0

    /** How far above [placeSecond] the middle of the second's interval lies, in its steps. */
    private var leanSecond = 0.0

    /** What is assumed of the sensor. */
    var kind: ResponseBankKind = ResponseBankKind.ASYMMETRIC

    /** Where the search starts. */
    private var startFirst = belief.mean

    /** The most likely first parameter. */
    val first: Double get() = upToDate().let { bank.first + placeFirst * bank.firstStep }

    /** The most likely second parameter. */
    val second: Double get() = upToDate().let { bank.second + placeSecond * bank.secondStep }

    /** Logarithm of the time constant, s, or of its mean or sum. */
    val logTime: Double get() = kind.logTime(first, second)

    /** Variance of [logTime]. */
    val logTimeVariance: Double
        get() = kind.shear(second).let { maxOf(0.0, firstVariance - 2 * it * covariance + it * it * secondVariance) }

    /** Variance of [first]. */
    val firstVariance: Double
        get() = alongRidge.let { (certain(1 / curveFirst) + tilt * tilt * it) * bank.firstStep * bank.firstStep }

    /** Variance of [second]. */
    val secondVariance: Double get() = alongRidge * bank.secondStep * bank.secondStep

    /** Covariance of [first] and [second]. */
    val covariance: Double get() = alongRidge.let { -tilt * it * bank.firstStep * bank.secondStep }

    /** A variance in steps squared: once the nodes stay where they are, the surface is not exact to better than this. */
    private fun certain(variance: Double) = if (follows) maxOf(variance, EXACT * EXACT) else variance

    /** Variance of the second parameter, in its steps squared. */
    private val alongRidge: Double
        get() = upToDate().let { spreadSecond * ridge.tightness } +
            if (follows) ridge.offset * ridge.offset + EXACT * EXACT else 0.0

    /** From now on there is no tape to start over from. */
    fun follow() {
        follows = true
    }

    private var follows = false

    /** How much the first parameter gives way when the second moves, in the bank's steps. */
    private val tilt: Double get() = curveBoth / curveFirst

    /** As [other] is, but for what it knows of the cells. */
    fun becomeLike(other: ResponseBankFit) {
        val from = other.bank
        bank.reset(kind, from.first, from.firstStep, from.second, from.secondStep, other.noiseVariance)
        slopeFirst = other.slopeFirst
        slopeSecond = other.slopeSecond
        curveFirst = other.curveFirst
        curveSecond = other.curveSecond
        curveBoth = other.curveBoth
        placeFirst = other.placeFirst
        placeSecond = other.placeSecond
        spreadSecond = other.spreadSecond
        leanSecond = other.leanSecond
        ridge.becomeLike(other.ridge)
        startFirst = other.startFirst
        startSecond = other.startSecond
        isFitted = other.isFitted
        most = other.most
        judgeAs(other)
    }

    override val here: Int get() = bank.here
    override val before: Int get() = bank.before

    override fun enter(slot: Int, from: Double, until: Double) = bank.enter(slot, from, until)

    override fun add(slot: Int, seconds: Double, value: Double) = bank.take(slot, seconds, value)

    override fun end() = bank.leave()

    /** The first fit starts from this time constant, s; later ones from the last. */
    fun startFrom(timeConstant: Double) {
        if (!isFitted) startFirst = ln(timeConstant)
    }

    /** A coarse search over both parameters, then Newton's steps within a region that shrinks with the uncertainty. */
    override suspend fun calibrate(tape: Recording) {
        fit(tape)
        measureRidge(tape)
    }

    private suspend fun fit(tape: Recording) {
        limit(tape)
        if (!isFitted) search(tape)
        descend(tape)
        isFitted = true
        var firstStep = FIRST_STEP * WIDEST_FIRST
        var secondStep = FIRST_STEP * widest()
        repeat(MOST_ROUNDS) {
            play(tape, firstStep, secondStep)
            learn()
            val wantedFirst = (2 * sqrt(firstVariance)).coerceIn(NARROWEST, WIDEST_FIRST)
            val wantedSecond = (2 * sqrt(spreadSecond) * bank.secondStep).coerceIn(NARROWEST * widest(), widest())
            val changeFirst = placeFirst.coerceIn(-1.0, 1.0) * firstStep
            val reach = bank.secondStep
            val changeSecond = (bank.second + placeSecond.coerceIn(-1.0, 1.0) * reach)
                .coerceIn(kind.least + reach, most - reach) - bank.second
            val isStill = changeFirst * changeFirst * curveFirst <= CLOSE * firstStep * firstStep &&
                changeSecond * changeSecond * curveSecond <= CLOSE * reach * reach
            val isNarrow = firstStep <= 2 * wantedFirst && reach <= 2 * wantedSecond
            // No bank's step is wider than half of what its second parameter can be.
            val isWide = 2 * firstStep >= wantedFirst && 2 * reach >= minOf(wantedSecond, (most - kind.least) / 2)
            if (isStill && isNarrow && isWide) return
            startFirst += changeFirst
            startSecond = bank.second + changeSecond
            firstStep = narrowed(firstStep, abs(changeFirst), wantedFirst)
            secondStep = narrowed(reach, abs(changeSecond), wantedSecond)
        }
        play(tape, firstStep, secondStep)
        learn()
    }

    private suspend fun measureRidge(tape: Recording) {
        val step = bank.secondStep
        // All five where a sensor can be, about the middle filter or as near to it as that.
        val nearest = bank.second.coerceAtMost(most - 2 * step).coerceAtLeast(kind.least + 2 * step)
        if (nearest + 2 * step > most) return ridge.forget()
        val shift = (nearest - bank.second) / step
        fun first(place: Double) = bank.first + (slopeFirst - curveBoth * place) / curveFirst * bank.firstStep

        fun second(place: Double) = bank.second + place * step
        ridge.measure(tape, { first(shift + it) to second(shift + it) }, kind, noiseVariance) { left, first ->
            val off = (first - belief.mean) / belief.spread
            left / (2 * noiseVariance) + off * off / 2
        }
        if (shift != 0.0) ridge.forgetTightness()
    }

    /** The next step: no narrower than wanted or than the last change, and narrowing no faster than by four. */
    private fun narrowed(step: Double, change: Double, wanted: Double) =
        if (wanted >= step) minOf(wanted, 4 * step) else maxOf(wanted, change, step / 4)

    private var startSecond = 0.0

    /** Whether the search may start from the last fit. */
    private var isFitted = false

    /** How much of [lag]'s misfit over its σ² this kind promises to explain, from one look near that lag. */
    suspend fun glance(tape: Recording, lag: LagFit): Double {
        isFitted = false
        startSecond = kind.least.coerceAtLeast(0.0)
        limit(tape)
        assume(lag.noiseVariance)
        // Two lags are looked at where the shorter is a little, with the sum that the one has.
        startFirst = ln(lag.timeConstant) + kind.bend(GLANCE * widest())
        bank.comparesKinds = true
        play(tape, minOf(WIDEST_FIRST, 2 * lag.relativeUncertainty), GLANCE * widest())
        bank.comparesKinds = false
        learn()
        return (lag.misfit - misfit) / lag.noiseVariance
    }

    /** The [misfit] to [tape] that it would have with the prior of all kinds. */
    suspend fun comparableMisfit(tape: Recording): Double {
        if (kind.flatness == 1.0) return misfit
        return ridge.compare(tape, kind, first, second, noiseVariance) + FIRST_FREEDOM * FIRST_NOISE * FIRST_NOISE
    }

    private fun widest(): Double = when (kind) {
        ResponseBankKind.ASYMMETRIC -> 0.3
        ResponseBankKind.DEAD_TIME -> 0.15 * exp(startFirst)
        ResponseBankKind.SECOND_ORDER -> 0.04
    }

    /**
     * Largest second parameter. A dead time longer by a whole stay is the same sensor to a survey whose stays are of
     * one length, with the map moved by a cell: none longer than a mean stay is looked for.
     */
    private var most = 0.0

    private fun limit(tape: Recording) {
        most = if (kind == ResponseBankKind.DEAD_TIME) tape.meanStay() else kind.most
    }

    private suspend fun search(tape: Recording) {
        val from = startFirst
        least = Double.POSITIVE_INFINITY
        var shortest = Double.NEGATIVE_INFINITY
        for (stretch in STRETCHES) {
            for (share in shares()) {
                val second = if (kind == ResponseBankKind.DEAD_TIME) share * most else share
                val cost = cost(tape, from + stretch, second, isBeaten)
                if (cost < least || (cost == least && stretch < shortest)) {
                    least = cost
                    shortest = stretch
                    startFirst = from + stretch
                    startSecond = second
                }
            }
        }
    }

    /** A compass search: downhill along either parameter or both, with steps that halve where neither leads down. */
    private suspend fun descend(tape: Recording) {
        var bestFirst = startFirst
        var bestSecond = startSecond.coerceIn(kind.least, most)
        least = cost(tape, bestFirst, bestSecond)
        val share = if (isFitted) FIRST_STEP else 1.0
        var firstStep = share * FIRST_REACH
        var secondStep = share * if (kind == ResponseBankKind.DEAD_TIME) most / 10 else widest()
        var halvings = 0
        while (halvings < HALVINGS) {
            // The best of all ways, so that a mirrored survey goes the mirrored way.
            val fromFirst = bestFirst
            val fromSecond = bestSecond
            for (way in 0 until WAYS) {
                val first = fromFirst + FIRST_WAY[way] * firstStep
                val second = (fromSecond + SECOND_WAY[way] * secondStep).coerceIn(kind.least, most)
                val cost = cost(tape, first, second, isBeaten)
                if (cost < least) {
                    least = cost
                    bestFirst = first
                    bestSecond = second
                }
            }
            if (bestFirst == fromFirst && bestSecond == fromSecond) {
                firstStep /= 2
                secondStep /= 2
                halvings++
            }
        }
        startFirst = bestFirst
        startSecond = bestSecond
        cost(tape, bestFirst, bestSecond)
        judge(bank.misfit(0), bank.freedom, bank.succession)
        settle()
    }

    /** The least cost so far: others are gone through as long as they can come below it. */
    private var least = 0.0
    private val isBeaten = { cost(bank.leastMisfit()) > least }

    private suspend fun cost(
        tape: Recording,
        first: Double,
        second: Double,
        isBeaten: () -> Boolean = Recording.NEVER,
    ): Double {
        bank.resetMiddle(kind, first, second, noiseVariance)
        tape.play(bank, isBeaten)
        return if (isBeaten()) Double.POSITIVE_INFINITY else cost(bank.misfit(0))
    }

    private fun cost(misfit: Double): Double {
        val off = bank.first - belief.mean
        return misfit / noiseVariance + off * off / (belief.spread * belief.spread)
    }

    private fun shares() = when (kind) {
        ResponseBankKind.ASYMMETRIC -> RATIOS
        ResponseBankKind.DEAD_TIME -> DELAYS
        ResponseBankKind.SECOND_ORDER -> PRODUCTS
    }

    private suspend fun play(tape: Recording, firstStep: Double, secondStep: Double) {
        // The nodes must not leave what a sensor can be.
        val reach = minOf(secondStep, (most - kind.least) / 2)
        startSecond = startSecond.coerceIn(kind.least + reach, most - reach)
        bank.reset(kind, startFirst, firstStep, startSecond, reach, noiseVariance)
        tape.play(bank)
    }

    override fun readOff() {
        for (i in 0 until ResponseBank.NODES) surface.set(i, bank.misfit(i))
        val scale = 1 / (2 * settledNoise)
        val spread = bank.firstStep / belief.spread
        curveFirst = maxOf(0.0, surface.curveFirst * scale) + spread * spread
        slopeFirst = -surface.slopeFirst * scale + (belief.mean - bank.first) / belief.spread * spread
        // The second parameter is hardly believed to be anything: within a few of the widest steps.
        val tie = bank.secondStep / (SECOND_SPREAD * widest())
        curveSecond = maxOf(0.0, surface.curveSecond * scale) + tie * tie
        slopeSecond = -surface.slopeSecond * scale
        val tied = MOST_CORRELATED * sqrt(curveFirst * curveSecond)
        curveBoth = (surface.curveBoth * scale).coerceIn(-tied, tied)
        spreadSecond = curveFirst / determinant()
        placeSecond = (curveFirst * slopeSecond - curveBoth * slopeFirst) / determinant()
        leanSecond = 0.0
        truncate((kind.least - bank.second) / bank.secondStep, (most - bank.second) / bank.secondStep)
        placeSecond = placeSecond.coerceIn(-FARTHEST, FARTHEST)
        placeFirst = ((slopeFirst - curveBoth * placeSecond) / curveFirst).coerceIn(-FARTHEST, FARTHEST)
        // Far from its nodes the surface is not to be trusted: something was left at each of them.
        var least = Double.POSITIVE_INFINITY
        for (i in 0 until ResponseBank.NODES) least = minOf(least, bank.misfit(i))
        judge(
            maxOf(surface.at(placeFirst, placeSecond), least - MOST_BELOW * settledNoise),
            bank.freedom,
            bank.succession,
        )
    }

    /** The second parameter lies between [low] and [high] for certain; eq. (16). */
    private fun truncate(low: Double, high: Double) {
        if (!cut.take(placeSecond, spreadSecond, low, high)) return
        spreadSecond = cut.variance
        placeSecond = if (kind == ResponseBankKind.SECOND_ORDER) cut.meanByShare else cut.mean
        leanSecond = cut.mean - placeSecond
    }

    private fun determinant() = curveFirst * curveSecond - curveBoth * curveBoth

    override fun truth(slot: Int): Double {
        upToDate()
        asked = slot
        for (i in 0 until ResponseBank.NODES) surface.set(i, bank.truth(slot, i))
        return surface.at(placeFirst, placeSecond)
    }

    override fun variance(): Double {
        val byFirst = surface.slopeFirst + surface.curveFirst * placeFirst + surface.curveBoth * placeSecond
        val bySecond = surface.slopeSecond + surface.curveSecond * placeSecond + surface.curveBoth * placeFirst
        val byRidge = bySecond - tilt * byFirst
        return noiseVariance / bank.information(asked, 0) + byFirst * byFirst * certain(1 / curveFirst) +
            byRidge * byRidge * alongRidge
    }

    override fun lean(): Double {
        if (leanSecond == 0.0) return 0.0
        val byFirst = surface.slopeFirst + surface.curveFirst * placeFirst + surface.curveBoth * placeSecond
        val bySecond = surface.slopeSecond + surface.curveSecond * placeSecond + surface.curveBoth * placeFirst
        return leanSecond * (bySecond - tilt * byFirst)
    }

    private companion object {
        val STRETCHES = doubleArrayOf(0.0, -0.3, 0.3, -0.6, 0.6, -0.9, -1.2, -1.5)
        const val WAYS = 8
        val FIRST_WAY = doubleArrayOf(1.0, -1.0, 0.0, 0.0, 1.0, -1.0, 1.0, -1.0)
        val SECOND_WAY = doubleArrayOf(0.0, 0.0, 1.0, -1.0, 1.0, -1.0, -1.0, 1.0)
        val RATIOS = doubleArrayOf(-1.0, -0.5, 0.5, 1.0)
        val DELAYS = doubleArrayOf(0.05, 0.15, 0.3, 0.5, 0.7, 0.9)
        val PRODUCTS = doubleArrayOf(0.06, 0.14, 0.22)
        const val WIDEST_FIRST = 0.15
        const val NARROWEST = 3e-3
        const val SECOND_SPREAD = 10.0
        const val MOST_CORRELATED = 0.99
        const val FARTHEST = 2.0
        const val FIRST_REACH = 0.2
        const val FIRST_STEP = 0.3
        const val HALVINGS = 5
        const val GLANCE = 0.3
        const val MOST_BELOW = 8.0
        const val EXACT = 0.125
        const val CLOSE = 0.03
        const val MOST_ROUNDS = 10
    }
}
