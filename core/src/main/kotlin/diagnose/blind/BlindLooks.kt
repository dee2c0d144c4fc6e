package stillwater.diagnose.blind

import stillwater.diagnose.all
import stillwater.diagnose.evidence.Standard
import stillwater.diagnose.three
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.expm1
import kotlin.math.ln
import kotlin.math.pow
import kotlin.math.sin

/**
 * Looks for what no cause of the list explains in a log without a reference.
 *
 * @param canShowShape whether lags of other times are asked for: not where not even a time constant and a dead time can be
 *   told apart.
 */
internal class BlindLooks(
    private val state: BlindState,
    private val tries: BlindTrials,
    private val canShowShape: Boolean,
) {
    private val series = state.model.series
    private val n = series.size
    private val loops = state.fit.design.loops
    private val tau = maxOf(state.timeConstant, series.period)
    private val prediction = state.shown
    private val values = Standard(prediction)
    private val rates = Standard(rise(prediction))

    /** All looks; of the same kinds in the same order whatever the model of a log is. */
    val list: List<BlindLook> by lazy { shapes() + BlindPeriods(state, tries).look() }

    /** What each of [list] gains. */
    val trials: List<BlindTrial> by lazy { loops.all(list, tries::looked) }

    /** The [index]-th of [list] with water and noise of its own. */
    fun refitted(index: Int): RefittedLook = tries.refitted(list[index], trials[index])

    /** The look called [name] at what [of] makes of the value and its rate of change, both standard. */
    private fun shown(
        name: String,
        doubt: Double = BlindLook.DOUBT,
        of: (DoubleArray, DoubleArray) -> List<DoubleArray>,
    ): BlindLook {
        fun at(prediction: DoubleArray) = of(values.of(prediction), rates.of(rise(prediction)))
        fun changes(change: DoubleArray): List<DoubleArray> {
            val above = at(DoubleArray(n) { prediction[it] + change[it] })
            val below = at(DoubleArray(n) { prediction[it] - change[it] })
            return above.zip(below) { up, down -> DoubleArray(n) { (up[it] - down[it]) / 2 } }
        }
        return BlindLook(name, at(prediction), doubt = doubt, follow = ::changes)
    }

    /** The look at [what], of which [of] makes a column that has more at some times than at others. */
    private fun changing(what: String, of: (DoubleArray, DoubleArray) -> DoubleArray) =
        shown(what + AT_TIMES, BlindLook.DOUBT_OF_CHANGE) { value, rate ->
            listOf(of(value, rate))
        }

    private fun shapes(): List<BlindLook> = buildList {
        val age = standard(series.times)
        add(
            shown("the value itself (a curved calibration, or water that was not the same on all passes)") { value, _ ->
                listOf(product(value, value))
            },
        )
        add(changing(RATE) { _, rate -> followed(product(rate, age)) })
        add(
            shown("the rate of change, more at some values than at others") { value, rate ->
                listOf(followed(product(rate, value)))
            },
        )
        add(changing("the value") { value, _ -> product(value, age) })
        if (canShowShape) {
            add(
                BlindLook(
                    "what was there before (the response has another shape)",
                    earlier(),
                    ofWater = true,
                    isLoose = true,
                ),
            )
        }
        // Neither kind of lag does what a ring does.
        add(ringing())
        if (series.isMoving) heading()
    }

    private fun MutableList<BlindLook>.heading() {
        val heading = series.heading
        fun turns(k: Int) = listOf(DoubleArray(n) { cos(k * heading[it]) }, DoubleArray(n) { sin(k * heading[it]) })
        add(BlindLook("the heading", turns(1), ofBoat = true))
        add(BlindLook("the heading (not in one direction alone)", turns(1) + turns(2), ofBoat = true))
        add(BlindLook("the speed", listOf(standard(series.speed)), ofBoat = true))
    }

    /** The period with which the response most likely rings: [PERIODS] from a time constant to twenty. */
    private fun ringing(): BlindLook {
        val shortest = maxOf(tau, SHORTEST * series.period)
        val searched = 2 * ln(PERIODS.toDouble())
        val all = (0 until PERIODS).map { k ->
            val period = shortest * (LONGEST * tau / shortest).pow(k / (PERIODS - 1.0))
            val said = three(period)
            BlindLook(
                "what was there before (the response rings with a period of $said s)",
                rung(period),
                searched,
                ofWater = true,
            )
        }
        return all.zip(loops.all(all, tries::looked)).maxBy { (_, trial) -> trial.gain }.first
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

    private fun product(a: DoubleArray, b: DoubleArray) = DoubleArray(n) { a[it] * b[it] }

    private fun rise(column: DoubleArray) = DoubleArray(n) { series.rise(column, it, it) }

    private fun standard(column: DoubleArray) = Standard(column).of(column)

    companion object {
        private const val RATE = "the rate of change"
        private const val AT_TIMES = ", more at some times than at others"

        /** The name of the look at a lag that changes in time. */
        const val LAG_CHANGES = RATE + AT_TIMES

        /** Periods that a response may ring with; the shortest in rows, the longest in time constants. */
        private const val PERIODS = 14
        private const val SHORTEST = 4.0
        private const val LONGEST = 20.0

        /** Damping over the critical one: a ring has faded to a third after a turn and a half. */
        private const val DAMPING = 0.12
        private val SHARES = doubleArrayOf(0.1, 0.5, 2.0, 5.0).toList()
    }
}
