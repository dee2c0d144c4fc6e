package stillwater.estimate

import kotlin.math.sqrt

/**
 * A sensor model of a [SelfCalibratingEstimator], fitted to the readings together with the truth of every cell.
 *
 * Everything is in scaled values: readings minus the prior's midpoint, over its width. Slots number the cells in the
 * order of their first visit.
 *
 * @property belief what is believed of the time constant beforehand.
 */
internal abstract class SensorFit(protected val belief: SelfCalibratingSettings) {
    /** σ², variance of the readings about the sensor's state, scaled. */
    var noiseVariance: Double = FIRST_NOISE * FIRST_NOISE
        get() = upToDate().let { field }
        private set

    /** Sum of squares left at the best parameters, the weak belief about σ included. */
    var misfit: Double = 0.0
        get() = upToDate().let { field }
        private set

    /** Readings, and agreements between visits, beyond the numbers fitted, the weak belief about σ included. */
    var freedom: Double = FIRST_FREEDOM
        get() = upToDate().let { field }
        private set

    /** Whether successive innovations are not clearly alike, eq. (13). */
    var isWhite: Boolean = true
        get() = upToDate().let { field }
        private set

    /** Whether successive innovations are not even half as alike as speaks against the model. */
    var isClearlyWhite: Boolean = true
        get() = upToDate().let { field }
        private set

    /** Whether readings were taken since the parameters were read off. */
    private var isBehind = false

    /** [noiseVariance] when the parameters were last settled: what they are read off with, whenever they are asked for. */
    protected var settledNoise: Double = noiseVariance
        private set

    /** Slot of the cell the sensor is in, [LagBank.NONE] if not known. */
    abstract val here: Int

    /** Slot of the cell it was in before. */
    abstract val before: Int

    /** Fits the parameters to [tape] and is then as if it had taken all of it. */
    abstract suspend fun calibrate(tape: Recording)

    /** Takes a reading in the cell with [slot]; equal slots in a row are one visit. [settle] comes before a visit. */
    fun take(slot: Int, seconds: Double, value: Double) {
        add(slot, seconds, value)
        isBehind = true
    }

    /** The boat came into the cell with [slot], see [ReadingPlayer.enter]. [settle] comes before. */
    abstract fun enter(slot: Int, from: Double, until: Double)

    /** The boat left without a reading of where it went. */
    fun leave() {
        end()
        isBehind = true
    }

    /** [take], as far as the filters go. */
    protected abstract fun add(slot: Int, seconds: Double, value: Double)

    /** [leave], as far as the filters go. */
    protected abstract fun end()

    /** Reads parameters and noise off the filters, with [settledNoise] for the noise, and judges them. */
    protected abstract fun readOff()

    /** What was taken since the parameters were read off shows in them: for each that is asked for. */
    protected fun upToDate() {
        if (!isBehind) return
        isBehind = false
        readOff()
    }

    /** Reads the parameters off, and with what is left the noise that they are read off with from now on. */
    fun settle() {
        upToDate()
        settledNoise = noiseVariance
    }

    /** The same of filters that have gone through a tape. */
    protected fun learn() {
        isBehind = true
        settle()
    }

    /** Truth of the cell with [slot]. */
    abstract fun truth(slot: Int): Double

    /** Variance of the [truth] last asked for, what the parameters and the noise leave open included. */
    abstract fun variance(): Double

    /**
     * How far above the [truth] last asked for the middle of its interval lies: not 0 where a parameter may be at the end
     * of what it can be.
     */
    open fun lean(): Double = 0.0

    /** Takes [variance] for the noise's. */
    protected fun assume(variance: Double) {
        isBehind = false
        noiseVariance = variance
        settledNoise = variance
    }

    /** Judged as [other] was. */
    protected fun judgeAs(other: SensorFit) {
        assume(other.noiseVariance)
        misfit = other.misfit
        freedom = other.freedom
        isWhite = other.isWhite
        isClearlyWhite = other.isClearlyWhite
    }

    /** From the sum of squares left, the degrees of freedom and the sum of products of successive innovations. */
    protected fun judge(left: Double, free: Double, succession: Double) {
        misfit = maxOf(0.0, left) + FIRST_FREEDOM * FIRST_NOISE * FIRST_NOISE
        freedom = FIRST_FREEDOM + maxOf(0.0, free)
        noiseVariance = misfit / freedom
        // The correlation of white noise has the standard deviation 1/√freedom, eq. (13).
        val correlation = succession / misfit
        val most = LEAST_CORRELATION + DEVIATIONS / sqrt(freedom)
        isWhite = freedom < FEWEST_TO_JUDGE || correlation <= most
        isClearlyWhite = freedom < FEWEST_TO_JUDGE || correlation <= most / 2
    }

    companion object {
        /** Readings beyond the numbers fitted that it takes to judge a model. */
        const val FEWEST_TO_JUDGE = 64

        /** What is believed of σ beforehand, in widths of the prior, and how many readings that is worth. */
        const val FIRST_NOISE = 1e-3
        const val FIRST_FREEDOM = 2.0

        /** Correlation of successive innovations that speaks against the model: this much and so many deviations. */
        private const val LEAST_CORRELATION = 0.02
        private const val DEVIATIONS = 4.5
    }
}
