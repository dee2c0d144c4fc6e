package stillwater.estimate

import kotlin.math.abs
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Whether the readings bear out what every model of a [SelfCalibratingEstimator] takes for granted: that the water
 * changes at the cells' borders and nowhere else.
 *
 * Where it does, a model with all borders half a stay later explains the readings far worse, and what a model leaves is
 * no more than readings that follow each other scatter. In water that changes all the way the moved borders do as well:
 * each stay has a truth of its own, and a line of many pieces follows any curve. What such a fit says of the sensor is
 * chance, whatever its likelihood. Source: core/docs/SelfCalibratingEstimator.md, section "Whether the cells are even".
 *
 * @param tape the readings, taken to be of the cells that they say: borders are not heeded.
 */
internal class EvenCells(private val tape: Recording) {
    private val bank = ResponseBank()
    private var most = 0.0
    private val isWorse = { bank.leastMisfit() > most }

    /** Whether they bear it out, or are too few or too much alike to say, where [fit] was chosen. */
    suspend fun areBorneOut(fit: SensorFit): Boolean {
        tape.spend(tape.size)
        if (stays() < FEWEST_STAYS || !(variance() > ALIVE * fit.noiseVariance)) return true
        return when (fit) {
            // A slew limit shows in readings that rest, wherever the borders are.
            is SlewFit -> !leavesTooMuch(fit.varianceWithin)
            else -> Middle.of(fit)?.let { areBorneOut(it) } ?: true
        }
    }

    /** A response that the bank can play: of [kind], with its numbers and the noise's variance. */
    private class Middle(val kind: ResponseBankKind, val first: Double, val second: Double, val noise: Double) {
        companion object {
            /** That of [fit]; null where the bank has none like it. A lag alone is a dead time of nothing. */
            fun of(fit: SensorFit): Middle? = when (fit) {
                is LagFit -> Middle(ResponseBankKind.DEAD_TIME, ln(fit.timeConstant), 0.0, fit.noiseVariance)
                is ResponseBankFit -> Middle(fit.kind, fit.first, fit.second, fit.noiseVariance)
                else -> null
            }
        }
    }

    /** Plays all readings with [middle], slower or faster by [stretch] on a logarithm's scale. */
    private suspend fun play(middle: Middle, stretch: Double, isMoved: Boolean) {
        bank.resetMiddle(middle.kind, middle.first + stretch, middle.second, middle.noise)
        if (isMoved) playMoved() else tape.play(bank, isWorse)
    }

    /**
     * Whether the readings of each visit by themselves bear it out, where those of all do not with [fit]: then visits of
     * a cell had different water. What they disagree spoils a fit to all, and it tells nothing of borders.
     */
    suspend fun areBorneOutByEachVisit(fit: SensorFit): Boolean {
        val middle = Middle.of(fit) ?: return false
        most = Double.POSITIVE_INFINITY
        var here = Double.POSITIVE_INFINITY
        var moved = Double.POSITIVE_INFINITY
        for (stretch in STRETCHES) {
            play(middle, stretch, isMoved = false)
            here = minOf(here, bank.varianceWithin)
            play(middle, stretch, isMoved = true)
            moved = minOf(moved, bank.varianceWithin)
        }
        return moved > CLEARLY_WORSE * here
    }

    /** Stays that have a border to move: one of a single reading would move to the cell before as a whole. */
    private fun stays(): Int {
        var stays = 0
        for (i in 1 until tape.size) {
            val isSecond = isReading(i) && tape.slot(i) == tape.slot(i - 1)
            if (isSecond && (i == 1 || tape.slot(i - 2) != tape.slot(i))) stays++
        }
        return stays
    }

    private fun isReading(i: Int) = tape.slot(i) != LagBank.NONE

    private fun variance(): Double {
        var count = 0
        var mean = 0.0
        var squares = 0.0
        for (i in 0 until tape.size) {
            if (!isReading(i)) continue
            val off = tape.value(i) - mean
            mean += off / ++count
            squares += off * (tape.value(i) - mean)
        }
        return squares / count
    }

    /**
     * Whether [within], the variance that a model leaves within visits, is more than second differences of readings in
     * one stay show: those hold all the noise and some of the sensor's way. What rounds alike in successive readings
     * they do not hold, so the variance of rounding is added. Nor do they hold what visits disagree, which a drift, or
     * water that changed in between, makes large in the evenest of cells.
     */
    private fun leavesTooMuch(within: Double): Boolean {
        var count = 0
        var squares = 0.0
        var resolution = Double.POSITIVE_INFINITY
        for (i in 1 until tape.size) {
            if (!isReading(i) || tape.slot(i) != tape.slot(i - 1)) continue
            val step = abs(tape.value(i) - tape.value(i - 1))
            if (step > SAME) resolution = minOf(resolution, step)
            if (i < 2 || tape.slot(i) != tape.slot(i - 2)) continue
            val bend = tape.value(i) - 2 * tape.value(i - 1) + tape.value(i - 2)
            squares += bend * bend
            count++
        }
        if (count < SensorFit.FEWEST_TO_JUDGE || resolution.isInfinite()) return false
        val scatter = squares / count / BEND + resolution * resolution / ROUNDING
        return within > (1 + DEVIATIONS / sqrt(count.toDouble())) * scatter
    }

    private suspend fun areBorneOut(middle: Middle): Boolean {
        most = Double.POSITIVE_INFINITY
        play(middle, stretch = 0.0, isMoved = false)
        if (leavesTooMuch(bank.varianceWithin)) return false
        most = WORSE * bank.misfit(0)
        for (stretch in STRETCHES) {
            play(middle, stretch, isMoved = true)
            if (!isWorse()) return false
        }
        return true
    }

    /** Goes through the tape as [Recording.play] does, with each stay's first half of the cell before. */
    private suspend fun playMoved() {
        var from = 0
        var before = LagBank.NONE
        while (from < tape.size) {
            val slot = tape.slot(from)
            var to = from + 1
            while (to < tape.size && tape.slot(to) == slot) to++
            if (!isWorse()) {
                val border = if (before != LagBank.NONE) from + (to - from + 1) / 2 else from
                if (slot == LagBank.NONE) bank.leave() else take(from, border, to, before)
            }
            tape.spend((to - from) * bank.filters)
            before = slot
            from = to
        }
    }

    private fun take(from: Int, border: Int, to: Int, before: Int) {
        for (i in from until to) {
            val slot = if (i < border) before else tape.slot(i)
            bank.take(slot, tape.time(i), tape.value(i))
        }
    }

    private companion object {
        /** With fewer stays of more than a reading some moved borders explain the readings by chance. */
        const val FEWEST_STAYS = 24

        /** Readings whose variance is not so many times the noise's show no changes to place. */
        const val ALIVE = 20.0

        /** Moved borders are worse if they leave so many times as much. */
        const val WORSE = 1.1

        /** The same with what visits disagree left out, which is what tells uneven cells best. */
        const val CLEARLY_WORSE = 3.0

        /** Second differences have six times the variance of readings, rounding a twelfth of its step squared. */
        const val BEND = 6.0
        const val ROUNDING = 12.0

        /** Readings nearer to each other are the same reading, scaled. */
        const val SAME = 1e-9

        /** Two standard errors of the ratio of what is left and scatter, times the root of their number. */
        const val DEVIATIONS = 4.5

        /** Time constants tried with moved borders: logarithm of the factor. */
        val STRETCHES = doubleArrayOf(0.0, -0.4, 0.4, -0.8, 0.8)
    }
}
