package stillwater.diagnose

import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.expm1
import kotlin.math.ln
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * Looks for what no cause of the list explains in a log without a reference.
 *
 * @param canShowShape whether the log can show the response's shape at all: not where not even a time constant and a
 *   dead time can be told apart, nor where waves of the water are missing.
 */
internal class BlindLooks(
    private val state: BlindState,
    private val trials: BlindTrials,
    private val canShowShape: Boolean,
) {
    private val series = state.model.series
    private val n = series.size
    private val prediction = DoubleArray(n) { series.values[it] - state.residuals[it] }
    private val value = standard(prediction)
    private val rate = standard(
        DoubleArray(n) { i ->
            val from = maxOf(i - 1, 0)
            val to = minOf(i + 1, n - 1)
            if (to == from) 0.0 else (prediction[to] - prediction[from]) / (series.times[to] - series.times[from])
        },
    )

    /** All looks. */
    fun all(): List<BlindTrial> = shapes().map { it.lessSure(DOUBT) } + periodic()

    private fun shapes(): List<BlindTrial> = buildList {
        val age = standard(series.times)
        add(
            trials.look(
                "the value itself (a curved calibration, or water that was not the same on all passes)",
                listOf(product(value, value), cube(value)),
            ),
        )
        add(trials.look("the rate of change, more at some times than at others", listOf(followed(product(rate, age)))))
        val uneven = listOf(followed(product(rate, value)))
        add(trials.look("the rate of change, more at some values than at others", uneven))
        add(trials.look("the value, more at some times than at others", listOf(product(value, age))))
        if (canShowShape) add(trials.lookAtWater("what was there before (the response has another shape)", earlier()))
        if (median(series.speed) > SLOWEST) heading()
    }

    private fun MutableList<BlindTrial>.heading() {
        val heading = series.heading
        val turns = listOf(1, 2).flatMap { k ->
            listOf(DoubleArray(n) { cos(k * heading[it]) }, DoubleArray(n) { sin(k * heading[it]) })
        }
        add(trials.look("the heading", turns))
        add(trials.look("the speed", listOf(standard(series.speed))))
    }

    /** The water as lags of several times show it: any response is near a sum of these. */
    private fun earlier(): List<DoubleArray> {
        val tau = maxOf(state.timeConstant, series.period)
        return SHARES.map { share -> followed(state.water, share * tau) }
    }

    /** [column] as a lag of [tau] s shows it. */
    private fun followed(column: DoubleArray, tau: Double = state.timeConstant): DoubleArray {
        var s = column[0]
        return DoubleArray(n) { i ->
            val dt = if (i == 0) 0.0 else series.times[i] - series.times[i - 1]
            s += -expm1(-dt / tau) * (column[i] - s)
            s
        }
    }

    /** The strongest of all frequencies that the log can tell apart and the water cannot imitate. */
    private fun periodic(): BlindTrial {
        val highest = 0.4 / series.period
        // Water that changes goes to and fro a few times in a log as well.
        val lowest = FEWEST_TURNS / maxOf(series.duration, 1e-9)
        val count = minOf(((highest - lowest) * series.duration).toInt(), MOST_FREQUENCIES)
        if (count < 2) return trials.look("time, periodically", emptyList())
        val powers = powers(count, lowest, highest)
        val best = powers.indices.maxBy { powers[it] / beside(powers, it) }
        val frequency = lowest + (highest - lowest) * best / (count - 1)
        // Noise has its own colours: a period must stand out of those beside it.
        val floor = beside(powers, best) / (squares(trials.residual) / 2)
        val waves = listOf(
            DoubleArray(n) { cos(2 * PI * frequency * (series.times[it] - series.times[0])) },
            DoubleArray(n) { sin(2 * PI * frequency * (series.times[it] - series.times[0])) },
        )
        val period = "%.3g".format(java.util.Locale.ROOT, 1 / frequency)
        return trials.look("time, with a period of $period s", waves, 2 * ln(count.toDouble()), floor)
    }

    private fun powers(count: Int, lowest: Double, highest: Double) = DoubleArray(count) { k ->
        val f = lowest + (highest - lowest) * k / (count - 1)
        val z = trials.residual
        var even = 0.0
        var odd = 0.0
        for (i in 0 until n) {
            val phase = 2 * PI * f * (series.times[i] - series.times[0])
            even += z[i] * cos(phase)
            odd += z[i] * sin(phase)
        }
        even * even + odd * odd
    }

    /** The mean power of frequencies near the [k]-th, from their median, which what leaks into them hardly moves. */
    private fun beside(powers: DoubleArray, k: Int): Double {
        val near = (maxOf(0, k - BESIDE)..minOf(powers.size - 1, k + BESIDE)).filter { abs(it - k) > 1 }
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

        /** How many times too small p-values are where fixes jitter in steep water; a period stands out of its own. */
        const val DOUBT = 10.0
        const val MOST_FREQUENCIES = 500
        const val BESIDE = 12
        const val FEWEST_TURNS = 10.0
        val SHARES = doubleArrayOf(0.1, 0.5, 2.0, 5.0).toList()
    }
}
