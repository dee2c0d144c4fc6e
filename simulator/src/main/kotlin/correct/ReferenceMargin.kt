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
 * value, h the interval's half on that side, and σ the reference's own white noise, from what d changes by from row to
 * row. The factor that is enough at 95 % of the rows is taken for all rows, as a split conformal prediction does; it is
 * never below 1. It holds where the boat does what it did where there was a reference.
 *
 * @property rows rows with a reference. @property covered share of them within their intervals as they were, and the
 * reference's noise. @property heldOut the same for rows of each tenth of the log, widened by what the others ask for.
 * @property factor by which intervals have to be wider, at least 1.
 */
internal class ReferenceMargin private constructor(
    val rows: Int,
    val covered: Double,
    val heldOut: Double,
    val factor: Double,
) {
    /** Whether intervals are too narrow by more than chance. */
    val isMisfit: Boolean get() = rows >= FEWEST && factor > MISFIT

    /** [track] with intervals that hold the reference as often as they say. */
    fun widened(track: CorrectedTrack): CorrectedTrack = if (isMisfit) track.scaledBy(factor) else track

    companion object {
        /** Rows with a reference below which their share says little. */
        private const val FEWEST = 100
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
            val changes = DoubleArray(rows.size - 1) { abs(off[it + 1] - off[it]) }.apply { sort() }
            val noise = NORMAL / sqrt(2.0) * changes[changes.size / 2]
            val needed = DoubleArray(rows.size) { i ->
                val row = rows[i]
                val half = if (off[i] >
                    0
                ) {
                    track.upper[row] - track.values[row]
                } else {
                    track.values[row] - track.lower[row]
                }
                val beyond = sqrt(maxOf(0.0, off[i] * off[i] - TWO_SIDED * TWO_SIDED * noise * noise))
                if (beyond == 0.0) 0.0 else beyond / half
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
            return maxOf(1.0, needed.sorted()[at - 1])
        }
    }
}
