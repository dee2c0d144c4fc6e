package stillwater.diagnose

import java.util.Locale
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.expm1
import kotlin.math.ln
import kotlin.math.pow
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * Looks for what no cause of the list explains in a log without a reference.
 *
 * @param canShowShape whether the log can show the response's shape at all: not where not even a time constant and a
 *   dead time can be told apart.
 */
internal class BlindLooks(
    private val state: BlindState,
    private val tries: BlindTrials,
    private val canShowShape: Boolean,
) {
    private val series = state.model.series
    private val n = series.size
    private val tau = maxOf(state.timeConstant, series.period)
    private val prediction = DoubleArray(n) { series.values[it] - state.residuals[it] }
    private val value = standard(prediction)
    private val rate = standard(
        DoubleArray(n) { i ->
            val from = maxOf(i - 1, 0)
            val to = minOf(i + 1, n - 1)
            if (to == from) 0.0 else (prediction[to] - prediction[from]) / (series.times[to] - series.times[from])
        },
    )

    /** All looks; of the same kinds in the same order whatever the model of a log is. */
    val list: List<BlindLook> by lazy { shapes() + periodic() }

    /** What each of [list] gains. */
    val trials: List<BlindTrial> by lazy { list.map(tries::looked) }

    /** The [index]-th of [list] with water and noise of its own. */
    fun refitted(index: Int): RefittedLook = tries.refitted(list[index], trials[index])

    private fun shapes(): List<BlindLook> = buildList {
        val age = standard(series.times)
        add(
            BlindLook(
                "the value itself (a curved calibration, or water that was not the same on all passes)",
                listOf(product(value, value), cube(value)),
            ),
        )
        add(BlindLook("the rate of change, more at some times than at others", listOf(followed(product(rate, age)))))
        val uneven = listOf(followed(product(rate, value)))
        add(BlindLook("the rate of change, more at some values than at others", uneven))
        add(BlindLook("the value, more at some times than at others", listOf(product(value, age))))
        if (canShowShape) {
            add(
                BlindLook(
                    "what was there before (the response has another shape)",
                    earlier(),
                    ofWater = true,
                    isLoose = true,
                ),
            )
            add(ringing())
        }
        if (median(series.speed) > SLOWEST) heading()
    }

    private fun MutableList<BlindLook>.heading() {
        val heading = series.heading
        val turns = listOf(1, 2).flatMap { k ->
            listOf(DoubleArray(n) { cos(k * heading[it]) }, DoubleArray(n) { sin(k * heading[it]) })
        }
        add(BlindLook("the heading", turns, ofBoat = true))
        add(BlindLook("the speed", listOf(standard(series.speed)), ofBoat = true))
    }

    /** The period with which the response most likely rings: [PERIODS] from a time constant to twenty. */
    private fun ringing(): BlindLook {
        val shortest = maxOf(tau, SHORTEST * series.period)
        val searched = 2 * ln(PERIODS.toDouble())
        return (0 until PERIODS).map { k ->
            val period = shortest * (LONGEST * tau / shortest).pow(k / (PERIODS - 1.0))
            val said = "%.3g".format(Locale.ROOT, period)
            BlindLook(
                "what was there before (the response rings with a period of $said s)",
                rung(period),
                searched,
                ofWater = true,
            )
        }.maxBy { tries.looked(it).gain }
    }

    /**
     * What a lightly damped mode of [period] s would show of the water, at once and a quarter of a turn later, less
     * what the lag does of as much.
     */
    private fun rung(period: Double): List<DoubleArray> {
        val turn = 2 * PI / period
        val fade = DAMPING * turn
        val size = fade * fade + turn * turn
        val water = state.water
        // Between two rows the water is the mean of both: q' = (−fade + i turn) q + u.
        var re = water[0] * fade / size
        var im = water[0] * turn / size
        val own = followed(water)
        val atOnce = DoubleArray(n)
        val later = DoubleArray(n)
        for (i in 0 until n) {
            val dt = if (i == 0) 0.0 else series.times[i] - series.times[i - 1]
            val u = (water[i] + water[maxOf(i - 1, 0)]) / 2
            val c = exp(-fade * dt) * cos(turn * dt)
            val s = exp(-fade * dt) * sin(turn * dt)
            val was = re
            re = c * was - s * im + u * (s * turn - (c - 1) * fade) / size
            im = s * was + c * im - u * (s * fade + (c - 1) * turn) / size
            atOnce[i] = turn * (re - own[i] * fade / size)
            later[i] = turn * (im - own[i] * turn / size)
        }
        return listOf(atOnce, later)
    }

    /**
     * What other lags would show of the water less what this one does: any response is near a sum of these, and what is
     * as large in water that stands still says nothing of the response.
     */
    private fun earlier(): List<DoubleArray> {
        val own = followed(state.water)
        return SHARES.map { share ->
            val other = followed(state.water, share * tau)
            DoubleArray(n) { other[it] - own[it] }
        }
    }

    /** [column] as a lag of [tau] s shows it. */
    private fun followed(column: DoubleArray, tau: Double = this.tau): DoubleArray {
        var s = column[0]
        return DoubleArray(n) { i ->
            val dt = if (i == 0) 0.0 else series.times[i] - series.times[i - 1]
            s += -expm1(-dt / tau) * (column[i] - s)
            s
        }
    }

    /** The strongest of all frequencies that the log can tell apart and the water cannot imitate. */
    private fun periodic(): BlindLook {
        val highest = 0.4 / series.period
        // Over long gaps, as of a clock that was set after the first rows, there would be frequencies without end.
        val span = minOf(series.duration, MOST_SPAN * n * series.period)
        // Water that changes goes to and fro a few times in a log as well.
        val lowest = FEWEST_TURNS / maxOf(span, 1e-9)
        val step = 1 / (FINER * span)
        val count = ((highest - lowest) / step).toInt()
        if (count < 2 * BESIDE) return BlindLook("time, periodically", emptyList())
        val powers = powers(tries.residual, lowest, step, count)
        val best = powers.indices.maxBy { powers[it] / beside(powers, it) }
        val closer = powers(tries.residual, lowest + (best - 1) * step, step / CLOSER, 2 * CLOSER + 1)
        val frequency = lowest + (best - 1) * step + closer.indices.maxBy { closer[it] } * step / CLOSER
        val waves = listOf(wave(frequency, ::cos), wave(frequency, ::sin))
        val period = "%.3g".format(Locale.ROOT, 1 / frequency)
        // Noise has its own colours: a period must stand out of those beside it.
        val near = maxOf(0, best - BESIDE)..minOf(count - 1, best + BESIDE)
        return BlindLook(
            "time, with a period of $period s",
            waves,
            2 * ln(count.toDouble()),
            { z -> beside(powers(z, lowest + near.first * step, step, near.count()), best - near.first) / squares(z) },
        )
    }

    private fun wave(frequency: Double, shape: (Double) -> Double) =
        DoubleArray(n) { shape(2 * PI * frequency * (series.times[it] - series.times[0])) }

    /**
     * How much of [z] goes with each of [count] frequencies from [lowest] on, [step] Hz apart: of white noise on average
     * its square sum.
     */
    private fun powers(z: DoubleArray, lowest: Double, step: Double, count: Int): DoubleArray {
        val cosines = wave(lowest, ::cos)
        val sines = wave(lowest, ::sin)
        val turnCosines = wave(step, ::cos)
        val turnSines = wave(step, ::sin)
        return DoubleArray(count) {
            var even = 0.0
            var odd = 0.0
            for (i in 0 until n) {
                val c = cosines[i]
                val s = sines[i]
                even += z[i] * c
                odd += z[i] * s
                cosines[i] = c * turnCosines[i] - s * turnSines[i]
                sines[i] = s * turnCosines[i] + c * turnSines[i]
            }
            even * even + odd * odd
        }
    }

    /** The mean power of frequencies near the [k]-th, from their median, which what leaks into them hardly moves. */
    private fun beside(powers: DoubleArray, k: Int): Double {
        val near = (maxOf(0, k - BESIDE)..minOf(powers.size - 1, k + BESIDE)).filter { abs(it - k) > FINER }
        return maxOf(median(DoubleArray(near.size) { powers[near[it]] }) / ln(2.0), 1e-300)
    }

    private fun product(a: DoubleArray, b: DoubleArray) = DoubleArray(n) { a[it] * b[it] }

    private fun cube(a: DoubleArray) = DoubleArray(n) { a[it] * a[it] * a[it] }

    private fun standard(column: DoubleArray): DoubleArray {
        val mean = column.average()
        val spread = sqrt(column.sumOf { (it - mean) * (it - mean) } / n)
        return DoubleArray(n) { if (abs(spread) > 0) (column[it] - mean) / spread else 0.0 }
    }

    private companion object {
        const val SLOWEST = 0.02

        /** Frequencies looked at for each that the log tells apart, and between two of them about the best. */
        const val FINER = 2
        const val CLOSER = 4

        /** Times as long as its rows side by side, from which on a log with gaps is not asked for more frequencies. */
        const val MOST_SPAN = 4.0

        /** Frequencies on either side that tell the noise there. */
        const val BESIDE = 12 * FINER
        const val FEWEST_TURNS = 10.0

        /** Periods that a response may ring with; the shortest in rows, the longest in time constants. */
        const val PERIODS = 14
        const val SHORTEST = 4.0
        const val LONGEST = 20.0

        /** Damping over the critical one: a ring has faded to a third after a turn and a half. */
        const val DAMPING = 0.12
        val SHARES = doubleArrayOf(0.1, 0.5, 2.0, 5.0).toList()
    }
}
