package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.algebra.dot
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.evidence.Settling
import stillwater.diagnose.evidence.Trial
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import java.util.Locale
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.ln
import kotlin.math.sin

/**
 * What is no cause of the list and explains a log in the place of a drift or of jumps of the model [last], those of [chosen]
 * alone: an offset that settles, a gain that drifts, an offset that goes with the heading.
 */
internal class SlowRivals(private val last: ModelFit, chosen: List<Trial>) {
    private val series = last.model.series
    private val slow = chosen.filter { it.term.cause in LIKE }
    private val columns = last.free.indices.filter { last.free[it] }.zip(last.jacobian.toList())
    private val own = slow.flatMap { trial ->
        last.model.slotOrNull(trial.term)?.let { it until it + width(trial) } ?: IntRange.EMPTY
    }
    private val basis by lazy { Evidence.orthonormal(columns.filter { (i, _) -> i !in own }.map { it.second }) }

    /** What is left, whitened, without the drift and the jumps, and without what all other numbers take. */
    private val all by lazy {
        // Both act on the readings as they are, so that what they add is their column times their number.
        val before = last.whitened.copyOf()
        for ((i, column) in columns) {
            if (i in own) for (row in before.indices) before[row] += last.numbers[i] * column[row]
        }
        Evidence.without(before, basis)
    }

    /**
     * Something in their place.
     *
     * @property gain squares that it takes off. @property numbers of its own. @property words for the reader.
     */
    private class Rival(val gain: Double, val numbers: Int, val words: String)

    /** What is to be said; null where nothing is in their place or the log is not clearly likelier with it. */
    fun words(): String? {
        if (slow.isEmpty()) return null
        val rows = last.noise.rows
        val theirs = Evidence.ratio(squares(all), squares(last.whitened), rows) - slow.sumOf { it.cost }
        fun worth(rival: Rival) =
            Evidence.ratio(squares(all), squares(all) - rival.gain, rows) - 2 * rival.numbers - CHOICE
        val best = listOfNotNull(settled(), drifting(), turned()).maxBy(::worth)
        return best.words.takeIf { worth(best) > maxOf(theirs, 0.0) + CLEARLY }
    }

    private fun settled(): Rival = Settling.TIMES.map { it * series.duration }.map { time ->
        val (gain, size) = of(listOf(Settling.column(series, time)))
        Rival(gain, 1, Settling.words(size, time))
    }.maxBy { it.gain }

    /** A gain that goes up or down evenly; null where the truth never changes, for there is none. */
    private fun drifting(): Rival? {
        if (ConstantTruth.isOf(series)) return null
        val shown = last.predicted
        val offset = last.numbers[ResponseModel.OFFSET]
        val column = DoubleArray(series.size) { (shown[it] - offset) * (series.times[it] - series.times[0]) }
        val (gain, size) = of(listOf(column))
        val way = if (size > 0) "rises" else "falls"
        val change = "%.2g".format(Locale.ROOT, 100 * abs(size) * series.duration)
        return Rival(gain, 1, "a gain that $way by $change % over the log, as of a membrane that is fouled or wears")
    }

    /** An offset that goes with the heading; one jump may well have come at a turn. */
    private fun turned(): Rival? {
        if (!series.isMoving || slow.sumOf { width(it) } < 2) return null
        val heading = series.heading
        val east = DoubleArray(series.size) { cos(heading[it]) }
        val north = DoubleArray(series.size) { sin(heading[it]) }
        val words = "an offset that goes with the heading, as of stray light, a current or the boat's own wake"
        return Rival(of(listOf(east, north)).first, 2, words)
    }

    private fun width(trial: Trial) = last.model.width(trial.term)

    /** Squares of [all] that [shown], sensor units, take off, and how large the first of these is. */
    private fun of(shown: List<DoubleArray>): Pair<Double, Double> {
        val white = shown.map { column -> DoubleArray(column.size).also { last.noise.whiten(column, it) } }
        val free = white.map { Evidence.without(it, basis) }
        val known = free.indices.filter { squares(free[it]) > LEAST * squares(white[it]) }.map { free[it] }
        if (known.isEmpty()) return 0.0 to 0.0
        val gain = Evidence.orthonormal(known).sumOf { direction -> dot(direction, all).let { it * it } }
        return gain to dot(known[0], all) / squares(known[0])
    }

    private companion object {
        val LIKE = setOf(Cause.DRIFT, Cause.OFFSET_STEPS)

        /** Twice a log-likelihood: of the choice among as many, of which an offset's times are much alike. */
        val CHOICE = 2 * ln(Settling.TIMES.size.toDouble())

        /** Twice the logarithm of odds of 10:1. */
        const val CLEARLY = 4.6
        const val LEAST = 1e-9
    }
}
