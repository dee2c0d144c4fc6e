package stillwater.diagnose.evidence

import org.hipparchus.special.Erf
import stillwater.diagnose.algebra.dot
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.response.ModelFit
import kotlin.math.PI
import kotlin.math.ceil
import kotlin.math.exp
import kotlin.math.sqrt

/**
 * How likely the best of all places for jumps gains so much where there are none.
 *
 * The gain of a jump at row k is Z(k)², with Z standard normal, and Z(k), Z(k + 1) correlated as their columns are:
 * under white noise nearly wholly, so that a thousand places are worth some ten, under noise that wanders hardly at
 * all. With θ² = 2 (1 − correlation) and ν(x) for steps that are not small,
 * P(max Z² > b²) ≈ 2 (1 − Φ(b)) + b φ(b) Σ θ² ν(bθ). The best few places are taken for independent scans: the chance of
 * their sum, over the orders in which they may be taken.
 *
 * Source: Siegmund and Yakir 2007, The Statistics of Gene Mapping, ch. 5 (ν and the maximum over steps); Zhang and
 * Siegmund 2007, doi:10.1111/j.1541-0420.2006.00662.x (jumps). Differs: columns of noise that is not white.
 *
 * @param steps θ of each step between rows next to each other that was looked at, radians.
 * @param weight how many steps each stands for.
 */
internal class JumpScan(private val steps: DoubleArray, private val weight: Double) {
    /** Probability that one jump gains [gain] or more somewhere. */
    fun single(gain: Double): Double {
        if (!(gain > 1)) return 1.0
        val b = sqrt(gain)
        val crossings = steps.sumOf { it * it * continuity(b * it) } * weight
        return minOf(1.0, Erf.erfc(b / sqrt(2.0)) + b * density(b) * crossings)
    }

    /**
     * Probability that [count] jumps gain [gain] or more by chance, where as many as are best were taken: the chance is
     * shared, each more jump has half as much as one less.
     */
    fun pValue(gain: Double, count: Int): Double {
        val counted = minOf(gain, MOST_GAIN)
        val cells = maxOf(ceil(counted / CELL).toInt(), 0)
        fun reached(cell: Int) = single(cell * counted / maxOf(cells, 1))
        if (count == 1) return minOf(1.0, FIRST_SHARE * reached(cells))
        val one = DoubleArray(cells + 1, ::reached)
        var tail = one
        var shares = FIRST_SHARE
        for (k in 2..count) {
            tail = sum(one, tail)
            shares *= 2.0 / k
        }
        return minOf(1.0, shares * tail[cells])
    }

    /** How likely the sum of two independent numbers reaches the start of each cell, from 0 on; theirs the same way. */
    private fun sum(one: DoubleArray, other: DoubleArray) = DoubleArray(one.size) { i ->
        var likely = one[i]
        for (j in 0 until i) likely += (one[j] - one[j + 1]) * other[i - j - 1]
        minOf(1.0, likely)
    }

    companion object {
        private const val CELL = 0.25

        /** One over the share that one jump has of the chance. */
        private const val FIRST_SHARE = 2.0

        /** What gains more counts as this: it is no chance either way, and the sums take the square of it. */
        private const val MOST_GAIN = 300.0
        private const val MOST_STEPS = 100

        /** The scan of the rows from [edge] to as far from the end, on top of [fit], under its noise. */
        fun of(fit: ModelFit, edge: Int): JumpScan {
            val basis = Evidence.orthonormal(fit.jacobian.toList())
            return of(fit.model.series.size, edge, MOST_STEPS) { rows ->
                val columns = JumpPlaces.columns(fit, rows.flatMap { listOf(it, it + 1) }, basis)
                columns.chunked(2) { (one, next) -> angle(squares(one), squares(next), dot(one, next)) }
            }
        }

        /**
         * The scan of the rows from [edge] to as far from the end of [rows]; [most] of the steps between them are looked
         * at, of which [angles] tells θ, radians, of those from each row given to the next.
         */
        fun of(rows: Int, edge: Int, most: Int, angles: (List<Int>) -> List<Double>): JumpScan {
            val all = rows - 2 * edge - 1
            if (all < 1) return JumpScan(doubleArrayOf(), 0.0)
            val looked = minOf(all, most)
            val places = List(looked) { k -> edge + ((k + 0.5) * all / looked).toInt() }
            return JumpScan(angles(places).toDoubleArray(), all / looked.toDouble())
        }

        /** θ between two columns of the square sums [one] and [other], whose products' sum is [product], radians. */
        fun angle(one: Double, other: Double, product: Double): Double {
            val lengths = sqrt(one * other)
            return if (lengths > 0) sqrt(maxOf(0.0, 2 * (1 - product / lengths))) else 0.0
        }

        /** ν of [x]: 1 for small steps, 2/x² where neighbours say nothing of each other. */
        private fun continuity(x: Double): Double {
            if (x < SMALL) return 1.0
            val half = x / 2
            val below = below(half)
            return 2 / x * (below - 0.5) / (half * below + density(half))
        }

        private const val SMALL = 1e-6

        private fun below(x: Double) = 1 - Erf.erfc(x / sqrt(2.0)) / 2

        private fun density(x: Double) = exp(-x * x / 2) / sqrt(2 * PI)
    }
}
