package stillwater.estimate

import kotlin.math.abs
import kotlin.math.round
import kotlin.math.sqrt

/** The slew-limited sensor as a [SensorFit]: its parameter is the rate r. */
internal class SlewFit(belief: SelfCalibratingSettings) : SensorFit(belief) {
    private val filter = SlewFilter()
    private val slopes = DoubleArray(belief.recalled)
    private var start = 1.0
    private var asked = LagBank.NONE

    /** The most likely rate r, widths of the prior a second. */
    val rate: Double get() = filter.rate

    /** Standard deviation of ln r. */
    val relativeUncertainty: Double get() = sqrt(filter.rateVariance) / rate

    /** Variance left within visits, scaled. */
    val varianceWithin: Double get() = filter.varianceWithin

    override val here: Int get() = maxOf(filter.here, LagBank.NONE)
    override val before: Int get() = filter.before

    /** Whether the readings of [tape] ever move: if not, every rate explains them. */
    var moves: Boolean = false
        private set

    /** Step to which readings are rounded, 0 if they are not. */
    private var resolution = 0.0

    override fun enter(slot: Int, from: Double, until: Double) = filter.enter(slot, from, until)

    override fun add(slot: Int, seconds: Double, value: Double) = filter.take(slot, seconds, value)

    override fun end() = filter.leave()

    override suspend fun calibrate(tape: Recording) {
        moves = false
        resolution = resolution(tape)
        val noise = firstNoise(tape)
        val count = slopes(tape)
        tape.spend(tape.size)
        if (count == 0) return
        val slowest = slopes[count / 2]
        val fastest = maxOf(slopes[count - 1], fastestStep(tape, sqrt(noise)))
        if (!(fastest > 0)) return
        moves = true
        assume(noise)
        scan(tape, maxOf(slowest, fastest / WIDEST), fastest)
        // What is left says how much noise there is, and that how far to trust the rate.
        repeat(ROUNDS) {
            score(tape, start)
            learn()
            start = rate
        }
        score(tape, start)
        learn()
    }

    /** As [other] is, but for what it knows of the cells. */
    fun becomeLike(other: SlewFit) {
        moves = other.moves
        resolution = other.resolution
        start = other.start
        if (other.rate > 0) filter.reset(other.rate, other.relativeUncertainty, other.noiseVariance)
        judgeAs(other)
    }

    override fun readOff() = judge(filter.misfit, filter.freedom, filter.succession)

    private suspend fun score(tape: Recording, rate: Double): Double {
        filter.reset(rate, KNOWN, noiseVariance)
        tape.play(filter)
        return filter.score
    }

    private suspend fun scan(tape: Recording, slowest: Double, fastest: Double) {
        var least = Double.POSITIVE_INFINITY
        var candidate = slowest
        while (candidate <= MARGIN * fastest) {
            val score = score(tape, candidate)
            if (score < least) {
                least = score
                start = candidate
            }
            candidate *= GRID
        }
    }

    /** Slopes over [SPAN] readings of a visit, without sign, ascending. */
    private fun slopes(tape: Recording): Int {
        var count = 0
        for (i in SPAN until tape.size) {
            if (tape.slot(i) == LagBank.NONE || !isOneStay(tape, i, SPAN)) continue
            val elapsed = tape.time(i) - tape.time(i - SPAN)
            if (elapsed > 0) slopes[count++] = abs(tape.value(i) - tape.value(i - SPAN)) / elapsed
        }
        slopes.sort(0, count)
        return count
    }

    /**
     * The largest slope over fewer readings than [SPAN] of which [noise] leaves no doubt: where the water differs by less
     * than the sensor moves in [SPAN] readings, it has come to rest before.
     */
    private fun fastestStep(tape: Recording, noise: Double): Double {
        var fastest = 0.0
        for (span in 1 until SPAN) {
            for (i in span until tape.size) {
                if (tape.slot(i) == LagBank.NONE || !isOneStay(tape, i, span)) continue
                val moved = abs(tape.value(i) - tape.value(i - span)) - BEYOND_NOISE * noise
                val elapsed = tape.time(i) - tape.time(i - span)
                if (moved > fastest * elapsed && elapsed > 0) fastest = moved / elapsed
            }
        }
        return fastest
    }

    private fun isOneStay(tape: Recording, i: Int, span: Int): Boolean {
        for (before in i - span until i) if (tape.slot(before) != tape.slot(i)) return false
        return true
    }

    /** Second differences are mostly noise: their median gives the noise's variance. */
    private fun firstNoise(tape: Recording): Double {
        var count = 0
        for (i in 2 until tape.size) {
            if (tape.slot(i) == LagBank.NONE || !isOneStay(tape, i, 2)) continue
            slopes[count++] = abs(tape.value(i) - 2 * tape.value(i - 1) + tape.value(i - 2))
        }
        slopes.sort(0, count)
        val median = if (count == 0) 0.0 else slopes[count / 2]
        return maxOf(median * median / MEDIAN_SQUARED, LEAST_NOISE * LEAST_NOISE)
    }

    /** The least difference of successive readings of [tape], if all others are multiples of it; 0 otherwise. */
    private fun resolution(tape: Recording): Double {
        var least = Double.POSITIVE_INFINITY
        for (i in 1 until tape.size) {
            val difference = abs(tape.value(i) - tape.value(i - 1))
            if (difference > NOTHING && difference < least) least = difference
        }
        for (i in 1 until tape.size) {
            val steps = abs(tape.value(i) - tape.value(i - 1)) / least
            if (!(abs(steps - round(steps)) < WHOLE)) return 0.0
        }
        return if (least.isFinite()) least else 0.0
    }

    override fun truth(slot: Int): Double {
        asked = slot
        return filter.truth(slot)
    }

    override fun variance(): Double {
        val information = filter.information(asked)
        if (information > 0) return 1 / information + filter.common(asked, resolution)
        look()
        val reach = (highest - lowest) / 2 / SensorChoice.quantile(freedom)
        return reach * reach
    }

    override fun lean(): Double {
        if (filter.information(asked) > 0) return 0.0
        look()
        return (highest + lowest) / 2 - filter.truth(asked)
    }

    /**
     * The 95 % interval of a truth that was not reached beyond doubt: at rest where the sensor is, or anywhere between the bounds
     * if it moves on, by the probability of either. What is left out is at the end that no reading set: in water that hangs
     * together the truth is rather near to what was seen.
     */
    private fun look() {
        val value = filter.truth(asked)
        lowest = filter.lower(asked)
        highest = filter.upper(asked)
        val left = LEFT_OUT / maxOf(LEFT_OUT, filter.movingOn(asked)) * (highest - lowest)
        val isUp = lowest > SlewFilter.LEAST
        val isDown = highest < -SlewFilter.LEAST
        val least = lowest
        val most = highest
        if (isUp && isDown) {
            // Where it has rather come to rest all that is left out is at the end far from there.
            val isResting = filter.movingOn(asked) < HALF
            val below = if (!isResting) {
                HALF
            } else if (value > (least + most) / 2) {
                1.0
            } else {
                0.0
            }
            lowest += below * left
            highest -= (1 - below) * left
        } else if (isUp) {
            highest -= left
        } else if (isDown) {
            lowest += left
        }
        // A state at rest is known as well to either side.
        if (isUp && value < (least + most) / 2) highest = maxOf(highest, minOf(most, 2 * value - least))
        if (isDown && value > (least + most) / 2) lowest = minOf(lowest, maxOf(least, 2 * value - most))
    }

    private var lowest = 0.0
    private var highest = 0.0

    private companion object {
        const val ROUNDS = 2
        const val SPAN = 5

        /** Difference of two readings that noise does not make, standard deviations of one: 5.7 of the difference. */
        const val BEYOND_NOISE = 8.0
        const val WIDEST = 10.0
        const val MARGIN = 1.2
        const val GRID = 1.04

        /** How far the rate may be off the grid, relative. */
        const val KNOWN = 0.03
        const val LEAST_NOISE = 1e-5

        /** Difference of readings that no digit makes, scaled, and how far from a multiple the sum of digits may be. */
        const val NOTHING = 1e-9
        const val WHOLE = 1e-3

        /** Of a belief. */
        const val LEFT_OUT = 0.05
        const val HALF = 0.5

        /** Square of the median of a standard normal's size, times 6, the variance of a second difference. */
        const val MEDIAN_SQUARED = 0.6745 * 0.6745 * 6
    }
}
