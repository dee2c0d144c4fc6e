package stillwater.diagnose.blind

import stillwater.diagnose.algebra.squares
import stillwater.diagnose.all
import stillwater.diagnose.median
import stillwater.diagnose.three
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.ln
import kotlin.math.sin

/**
 * Looks for what comes back with a period of its own, as interference does, in a log without a reference.
 *
 * Water that the boat passes at an even speed looks like slow periods, and takes nine tenths of them and more. What is
 * left of such a period is small, and no longer one frequency alone. A frequency is therefore held against what the
 * water leaves of it, and what is beside it is looked at without it.
 */
internal class BlindPeriods(private val state: BlindState, private val tries: BlindTrials) {
    private val series = state.model.series
    private val n = series.size

    // Over long gaps, as of a clock that was set after the first rows, there would be frequencies without end.
    private val span = minOf(series.duration, MOST_SPAN * n * series.period)

    // Water that changes goes to and fro a few times in a log as well.
    private val lowest = FEWEST_TURNS / maxOf(span, 1e-9)
    private val step = 1 / (FINER * span)
    private val count = ((0.4 / series.period - lowest) / step).toInt()

    /** Of each frequency, the share that the water leaves, from every [APART]-th of them. */
    private val own: DoubleArray by lazy {
        val known = ArrayList<Double>()
        while (known.size * APART < count + APART && (known.size < 2 || known.takeLast(2).any { it < ALL })) {
            val frequency = lowest + known.size * APART * step
            val white = state.fit.whitened(wave(frequency, if (known.size % 2 == 0) ::cos else ::sin))
            known += 1 - squares(state.fit.imitated(white)) / maxOf(squares(white), TINY)
        }
        DoubleArray(count) { k ->
            val from = k / APART
            val part = (k % APART).toDouble() / APART
            val there = known.getOrElse(from) { 1.0 }
            maxOf(there + part * (known.getOrElse(from + 1) { 1.0 } - there), LEAST_OWN)
        }
    }

    /** The period that serves best, of those that the log can tell apart. */
    fun look(): BlindLook {
        if (count < 2 * BESIDE) return BlindLook("time, periodically", emptyList())
        val powers = normed(tries.residual, 0..count - 1)
        val places = powers.indices.filter { k ->
            powers[k] >= powers[maxOf(k - 1, 0)] && powers[k] >= powers[minOf(k + 1, count - 1)]
        }
        val strongest = places.sortedByDescending { powers[it] }.take(CANDIDATES)
        // Noise has its own colours: a period must stand out of those beside it.
        val clear = places.associateWith { powers[it] / beside(powers, it) }
        val clearest = places.sortedByDescending { clear.getValue(it) }.take(CANDIDATES)
        val looks = (strongest + clearest).distinct().map(::look)
        return looks.zip(state.fit.design.loops.all(looks, tries::looked)).maxBy { (_, trial) -> trial.ratio }.first
    }

    private fun look(best: Int): BlindLook {
        val closer = powers(tries.residual, lowest + (best - 1) * step, step / CLOSER, 2 * CLOSER + 1)
        val frequency = lowest + (best - 1) * step + closer.indices.maxBy { closer[it] } * step / CLOSER
        return BlindLook(
            "time, with a period of ${three(1 / frequency)} s",
            listOf(wave(frequency, ::cos), wave(frequency, ::sin)),
            2 * ln(count.toDouble()),
            { of, z -> (if (of === state) this else BlindPeriods(of, tries)).colour(z, best) },
            ofTime = true,
        )
    }

    /** How much more of [z] goes with the frequencies beside the [k]-th than white noise has, of what the water leaves there. */
    private fun colour(z: DoubleArray, k: Int): Double {
        val near = maxOf(0, k - BESIDE)..minOf(count - 1, k + BESIDE)
        return beside(normed(z, near), k - near.first) / squares(z)
    }

    private fun wave(frequency: Double, shape: (Double) -> Double) =
        DoubleArray(n) { shape(2 * PI * frequency * (series.times[it] - series.times[0])) }

    /** [powers] of [z] at the frequencies [those], over the share of each that the water leaves. */
    private fun normed(z: DoubleArray, those: IntRange): DoubleArray {
        val powers = powers(z, lowest + those.first * step, step, those.count())
        return DoubleArray(powers.size) { powers[it] / own[those.first + it] }
    }

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
        return maxOf(median(DoubleArray(near.size) { powers[near[it]] }) / ln(2.0), TINY)
    }

    private companion object {
        /** Frequencies looked at for each that the log tells apart, and between two of them about the best. */
        const val FINER = 2
        const val CLOSER = 4

        /** Times as long as its rows side by side, from which on a log with gaps is not asked for more frequencies. */
        const val MOST_SPAN = 4.0

        /** Frequencies on either side that tell the noise there. */
        const val BESIDE = 12 * FINER
        const val FEWEST_TURNS = 10.0

        /** Frequencies that are tried as they are, of the strongest and of those that stand out. */
        const val CANDIDATES = 3

        /** Frequencies between two of which it is known what the water leaves; from [ALL] on it leaves those above, too. */
        const val APART = 16
        const val ALL = 0.99
        const val LEAST_OWN = 0.01
        const val TINY = 1e-300
    }
}
