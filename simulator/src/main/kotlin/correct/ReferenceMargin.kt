package stillwater.correct

import stillwater.estimate.CorrectedTrack
import stillwater.estimate.TrackSeries
import kotlin.math.abs
import kotlin.math.ceil
import kotlin.math.sqrt

/**
 * How far a reference lies outside the intervals of the track that was corrected with what it taught: an effect that no
 * response tried has, such as one of flow or of temperature, shows there and nowhere else.
 *
 * Intervals are wide enough at a row by the factor ((d² − (1.96 σ)²)₊)^½ / h, with d the reference's distance from the
 * value, h the interval's half on that side, and σ the reference's own white noise, from what d changes by between rows
 * next to each other; 0 where a gap lies between all. The factor that is enough at 95 % of the rows is taken for all
 * rows; it is never below 1. The sensor was learned on the same rows, so that nothing guarantees as much on others: it
 * is for a boat that does what it did there, in such water. An interval without any width is outside, and no factor
 * helps it.
 *
 * @property rows rows with a reference. @property covered share of them within their intervals as they were, and the
 * reference's noise. @property heldOut the same for rows of each tenth of the log, widened by what the others ask for;
 * the sensor was learned on all.
 * @property factor by which intervals have to be wider, at least 1.
 */
internal class ReferenceMargin private constructor(
    val rows: Int,
    val covered: Double,
    val heldOut: Double,
    val factor: Double,
) {
    /** Whether there are rows enough to tell how wide intervals have to be. */
    val isEnough: Boolean get() = rows >= FEWEST

    /** Whether intervals are too narrow by more than chance: of few rows by far. */
    val isMisfit: Boolean get() = (isEnough && factor > MISFIT) || (rows >= FEW && factor > FAR)

    /** [track] with intervals that hold the reference as often as they say. */
    fun widened(track: CorrectedTrack): CorrectedTrack = if (isMisfit) track.scaledBy(factor) else track

    companion object {
        /** Rows with a reference below which their share says little. */
        private const val FEWEST = 100

        /** The same where intervals are too narrow by a factor that even rows which all err alike do not give by chance. */
        private const val FEW = 30
        private const val FAR = 2.0
        private const val NOMINAL = 0.95
        private const val TWO_SIDED = 1.96
        private const val NORMAL = 1.4826

        /** A factor that neighbouring rows, which err alike, give now and then for nothing. */
        private const val MISFIT = 1.15
        private const val BLOCKS = 10

        /** Of [track], the correction of [series], against [references], NaN where there is none; rows that are clipped
         * or wild are not looked at. */
        fun of(series: TrackSeries, track: CorrectedTrack, references: DoubleArray): ReferenceMargin {
            val rows = (0 until series.size).filter {
                references[it].isFinite() && !track.clipped[it] && !track.outlying[it]
            }
            if (rows.size < BLOCKS) return ReferenceMargin(rows.size, Double.NaN, Double.NaN, 1.0)
            val off = DoubleArray(rows.size) { references[rows[it]] - track.values[rows[it]] }
            // Across a gap the correction's own error changes as well.
            val near = (1 until rows.size).filter {
                series.times[rows[it]] - series.times[rows[it - 1]] <= series.gapLimit
            }
            val changes = near.map { abs(off[it] - off[it - 1]) }.sorted()
            val noise = if (changes.isEmpty()) 0.0 else NORMAL / sqrt(2.0) * changes[changes.size / 2]
            val needed = DoubleArray(rows.size) { i ->
                val row = rows[i]
                val edge = if (off[i] > 0) track.upper[row] else track.lower[row]
                val half = abs(edge - track.values[row])
                val beyond = sqrt(maxOf(0.0, off[i] * off[i] - TWO_SIDED * TWO_SIDED * noise * noise))
                when {
                    beyond == 0.0 -> 0.0
                    half > 0 -> beyond / half
                    else -> Double.POSITIVE_INFINITY
                }
            }
            fun block(i: Int) = (i.toLong() * BLOCKS / rows.size).toInt()
            var inside = 0
            for (block in 0 until BLOCKS) {
                val enough = enough(needed.filterIndexed { i, _ -> block(i) != block })
                inside += needed.indices.count { block(it) == block && needed[it] <= enough }
            }
            val covered = needed.count { it <= 1 }.toDouble() / rows.size
            return ReferenceMargin(rows.size, covered, inside.toDouble() / rows.size, enough(needed.toList()))
        }

        private fun enough(needed: List<Double>): Double {
            val at = ceil(NOMINAL * (needed.size + 1)).toInt().coerceAtMost(needed.size)
            val enough = needed.sorted().take(at).lastOrNull { it.isFinite() } ?: 1.0
            return maxOf(1.0, enough)
        }
    }
}
