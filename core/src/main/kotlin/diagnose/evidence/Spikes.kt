package stillwater.diagnose.evidence

import stillwater.diagnose.algebra.squares
import stillwater.diagnose.median
import stillwater.diagnose.noise.CorrelatedNoise
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/** Single rows that stick out of their neighbours. */
internal object Spikes {
    private const val HALF_WINDOW = 3
    private const val TIMES_SPREAD = 5.5
    private const val NORMAL = 1.4826

    /** Of the variance: with more than that of white noise all is as good as white. */
    private const val MOSTLY_FRESH = 0.95
    private val FREEDOMS = listOf(3, 5, 8, 15, 30)

    /** Degrees of freedom of tails so heavy that a fourth moment is infinite, and that is no noise beside normal one. */
    private const val HEAVIEST = 4
    private val WIDTHS = listOf(0.85, 0.9, 0.95, 1.0, 1.05)

    /** How far a row is off the middle of those beside it, over the longer of the ways there: 1 of a single row, else ½. */
    private const val RETURNED = 0.75

    /**
     * The rows whose residual is more than 5.5 robust standard deviations off the median of the seven around it.
     *
     * A model that is wrong elsewhere has residuals that neighbours share; those are not single.
     *
     * @param isStill whether no noise moves a row, which then says nothing of the deviation.
     */
    fun of(residuals: DoubleArray, isStill: (Int) -> Boolean = { false }): List<Int> {
        val n = residuals.size
        if (n < 4 * HALF_WINDOW) return emptyList()
        val off = off(residuals)
        val moved = off.filterIndexed { i, _ -> !isStill(i) }
        if (moved.isEmpty()) return emptyList()
        val spread = NORMAL * median(DoubleArray(moved.size) { abs(moved[it]) })
        if (!(spread > 0)) return emptyList()
        return off.indices.filter { i ->
            val beside = maxOf(abs(off.getOrElse(i - 1) { 0.0 }), abs(off.getOrElse(i + 1) { 0.0 }))
            abs(off[i]) > TIMES_SPREAD * spread && beside < 0.8 * abs(off[i])
        }
    }

    /**
     * Whether row [i] of [residuals] is off by itself: after a jump, or after what fades slowly, they stay where they
     * are, and the rows beside a wild one are off only what it makes of their middle.
     */
    fun isSingle(residuals: DoubleArray, i: Int): Boolean {
        if (i == 0 || i == residuals.size - 1) return true
        val off = abs(residuals[i] - (residuals[i - 1] + residuals[i + 1]) / 2)
        return off > RETURNED * maxOf(abs(residuals[i] - residuals[i - 1]), abs(residuals[i] - residuals[i + 1]))
    }

    /** Standard deviation of [residuals], of which single ones may be wild. */
    fun spread(residuals: DoubleArray): Double {
        val robust = NORMAL * median(DoubleArray(residuals.size) { abs(residuals[it]) })
        return if (robust > 0) robust else sqrt(squares(residuals) / maxOf(residuals.size, 1)).coerceAtLeast(1e-300)
    }

    /** That [count] readings are off, in words. */
    fun words(count: Int): String = "$count single reading${if (count == 1) " is" else "s are"} far off"

    private fun off(residuals: DoubleArray) = DoubleArray(residuals.size) { i ->
        val from = (i - HALF_WINDOW).coerceIn(0, residuals.size - 1 - 2 * HALF_WINDOW)
        residuals[i] - median(residuals.copyOfRange(from, from + 2 * HALF_WINDOW + 1))
    }

    /**
     * Twice the log-likelihood ratio of normal noise with a share of even outliers against normal noise alone, for
     * white [residuals]. Share, size and spread are each the likeliest.
     */
    fun ratio(residuals: DoubleArray): Mixture {
        val n = residuals.size
        val alone = sqrt(squares(residuals) / maxOf(n, 1))
        if (!(alone > 0)) return Mixture(0.0, 0.0, 0.0)
        val robust = NORMAL * median(DoubleArray(n) { abs(residuals[it]) })
        val plain = -n * ln(alone) - n / 2.0
        var best = Mixture(0.0, 0.0, 0.0)
        val largest = residuals.maxOf { abs(it) }
        for (shrink in doubleArrayOf(0.9, 0.94, 0.97, 0.985, 1.0)) {
            for (spread in doubleArrayOf(shrink * alone, shrink * robust)) {
                for (share in doubleArrayOf(0.002, 0.005, 0.01, 0.02, 0.04)) {
                    val score = mixture(residuals, spread, share, largest)
                    if (2 * (score - plain) > best.ratio) best = Mixture(2 * (score - plain), share, largest)
                }
            }
        }
        return best
    }

    /**
     * The likeliest noise with Student's tails for [residuals] that were whitened by [noise]: all of it has tails, or only
     * what comes anew with each row; what wanders is a sum of much and has none.
     */
    fun student(residuals: DoubleArray, noise: CorrelatedNoise): StudentTails {
        val all = student(residuals)
        if (noise.freshShare > MOSTLY_FRESH) return all
        // Much that is normal and a little with the heaviest tails is what single wrong readings in normal noise look like.
        val part = student(residuals, noise.freshShare, FREEDOMS.filter { it > HEAVIEST })
        return part.takeIf { it.ratio > all.ratio } ?: all
    }

    /**
     * The likeliest noise with Student's tails, of as many degrees of freedom as [freedoms], for white [residuals], of whose
     * squares [share] has them ([TailedNoise]).
     */
    fun student(residuals: DoubleArray, share: Double = 1.0, freedoms: List<Int> = FREEDOMS): StudentTails {
        val n = residuals.size
        val alone = sqrt(squares(residuals) / maxOf(n, 1))
        val robust = NORMAL * median(DoubleArray(n) { abs(residuals[it]) })
        if (!(robust > 0)) return StudentTails(0.0, TailedNoise(1, 1.0), Double.POSITIVE_INFINITY)
        val plain = -n * ln(alone) - n / 2.0
        return freedoms.flatMap { freedom ->
            val noise = TailedNoise(freedom, share)
            WIDTHS.map { width ->
                val spread = width * robust
                val sum = residuals.sumOf { r -> noise.logDensity(r / spread) }
                StudentTails(2 * (sum - n * ln(spread) - plain), noise, spread)
            }
        }.maxBy { it.ratio }
    }

    /** How far off a row of [residuals] is to stick out, by [of]; the seven around it change that by little. */
    fun farthest(residuals: DoubleArray): Double =
        TIMES_SPREAD * NORMAL * median(DoubleArray(residuals.size) { abs(residuals[it]) })

    private fun mixture(residuals: DoubleArray, spread: Double, share: Double, size: Double): Double {
        if (!(spread > 0)) return Double.NEGATIVE_INFINITY
        val wide = share / (2 * size) * sqrt(2 * PI)
        val narrow = (1 - share) / spread
        var sum = 0.0
        for (r in residuals) {
            val z = r / spread
            sum += ln(narrow * exp(-z * z / 2) + wide)
        }
        return sum
    }
}

/**
 * Normal noise with outliers.
 *
 * @property ratio twice the log-likelihood ratio against normal noise. @property share of the rows. @property size the
 * farthest.
 */
internal data class Mixture(val ratio: Double, val share: Double, val size: Double)

/**
 * Noise with Student's tails.
 *
 * @property ratio twice the log-likelihood ratio against normal noise. @property noise of what kind.
 * @property spread what it is multiplied by.
 */
internal data class StudentTails(val ratio: Double, val noise: TailedNoise, val spread: Double) {
    /** The share of rows that is farther off than [limit] either way. */
    fun beyond(limit: Double): Double = noise.beyond(limit / spread)
}
