package stillwater.diagnose.evidence

import stillwater.diagnose.Verdict
import stillwater.diagnose.median
import stillwater.diagnose.three
import kotlin.math.abs
import kotlin.math.sqrt

/**
 * Noise that an instrument averages over its last readings, as sondes do.
 *
 * The mean over V of independent noise changes by what comes in less what drops out: (eₜ − eₜ₋ᵥ)/V. Noise models that decay
 * take what wanders in it, and what they leave is anti-correlated with itself V before, and at no other lag. Waves and
 * a rolling boat, which swing back, are alike again after twice that; readings that are repeated are no means.
 *
 * @property rows that are averaged. @property time that so many rows take, s. @property correlation of the residuals with
 *   themselves so long before.
 */
internal class AveragedNoise private constructor(val rows: Int, val time: Double, val correlation: Double) {
    /** As a part of a sentence. */
    fun words(): String =
        "what is left has a correlation of ${three(correlation)} with itself $rows rows before, as noise " +
            "has that an instrument $AVERAGES over ${three(time)} s: its readings would be late by half of that, " +
            "${three(time / 2)} s, beside what the sensor itself is late, in every channel that it averages so"

    /** The same as a sentence; null where [verdict] says that the instrument averages. */
    fun sentenceBeside(verdict: Verdict): String? {
        val isSaid = verdict is Verdict.Unexplained && AVERAGES in verdict.what
        return if (isSaid) null else "${words().replaceFirstChar(Char::uppercase)}."
    }

    companion object {
        /** What is said of such an instrument. */
        const val AVERAGES = "averages"

        /** Rows; fewer may be repeated readings, or a noise model that is a little off. */
        private const val FEWEST = 5
        private const val MOST = 60

        /** A lag is held against those so many rows before and after. */
        private const val BESIDE = 3

        /** Correlation below those beside it, and the same in standard errors, 1.5 of the squares of one correlation's. */
        private const val LEAST = 0.15
        private const val SURE = 6.0
        private const val SQUARES = 1.5

        /** Of the dip: as much may be left at twice the lag. */
        private const val SWINGS_BACK = 1.0 / 3

        /** Of the rows averaged: readings that stay the same for so long on average are repeated. */
        private const val REPEATED = 0.5

        /** Standard deviations at which single residuals are cut. */
        private const val FAR = 4.0
        private const val FEWEST_ROWS = 200

        /** What [whitened] residuals of [values], read at [times], s, say of it; null for nothing. */
        fun of(whitened: DoubleArray, values: DoubleArray, times: DoubleArray): AveragedNoise? {
            val n = whitened.size
            if (n < FEWEST_ROWS) return null
            val found = correlations(whitened)
            fun dip(lag: Int) = found[lag] - (found[lag - BESIDE] + found[lag + BESIDE]) / 2
            val rows = (FEWEST..MOST).minBy(::dip)
            val depth = dip(rows)
            val isSure = depth < -maxOf(LEAST, SURE * sqrt(SQUARES / n))
            if (!isSure || found[rows] >= 0 || abs(dip(2 * rows)) > SWINGS_BACK * abs(depth)) return null
            val different = 1 + (1 until n).count { values[it] != values[it - 1] }
            if (n > REPEATED * rows * different) return null
            val time = median(DoubleArray(n - rows) { times[it + rows] - times[it] })
            return AveragedNoise(rows, time, found[rows])
        }

        private fun correlations(whitened: DoubleArray): DoubleArray {
            val far = FAR * Spikes.spread(whitened)
            val z = DoubleArray(whitened.size) { whitened[it].coerceIn(-far, far) }
            val all = z.sumOf { it * it }
            return DoubleArray(2 * MOST + BESIDE + 1) { lag ->
                var sum = 0.0
                for (i in lag until z.size) sum += z[i] * z[i - lag]
                if (all > 0) sum / all else 0.0
            }
        }
    }
}
