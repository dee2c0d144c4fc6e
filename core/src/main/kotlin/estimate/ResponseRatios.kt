package stillwater.estimate

import kotlin.math.abs
import kotlin.math.sqrt

/**
 * Learns how far from the truth a sensor is at a given slope, from cells that were measured more than once.
 *
 * Model: ψ = v + k⁺ g⁺ − k⁻ g⁻ + e, with v the reading and g the slope at the end of a stay, g⁺ = max(g, 0), g⁻ =
 * max(−g, 0), and Var e = a² + b² g². Two stays in one cell have one ψ, so that their difference tells k⁺, k⁻, a and b,
 * eqs. (3) to (6) of core/docs/BoundedExtendedFilter.md. Weighted least squares; a pair that is farther off than
 * [FARTHEST] of its standard deviations weighs as if it were that far. O(1), no allocation.
 */
internal class ResponseRatios {
    private var up2 = 0.0
    private var upDown = 0.0
    private var down2 = 0.0
    private var upY = 0.0
    private var downY = 0.0
    private var cells = 0
    private var seen = 0
    private var upVariance = 0.0
    private var downVariance = 0.0
    private var covariance = 0.0

    private var spread11 = 0.0
    private var spread12 = 0.0
    private var spread22 = 0.0
    private var spreadY1 = 0.0
    private var spreadY2 = 0.0
    private var judged = 0

    /** k⁺, s: distance to the truth per slope of a rising sensor. Meaningful once [known]. */
    var rising: Double = 0.0
        private set

    /** k⁻, s: the same of a falling sensor. Meaningful once [known]. */
    var falling: Double = 0.0
        private set

    /** a², the variance that is left at slope 0, sensor units squared. */
    var base: Double = 0.0
        private set

    /** b², the variance of a ratio from stay to stay, s². */
    var perSlope: Double = 0.0
        private set

    /** Whether enough stays were compared to use what was learned. */
    val known: Boolean get() = cells >= FEWEST_CELLS && judged >= FEWEST && rising > 0 && falling > 0

    /**
     * Takes two stays in one cell, or a stay and the mean of those before.
     *
     * @param difference the later one's v less the earlier one's, sensor units.
     * @param up the earlier g⁺ less the later one, sensor units/s.
     * @param down the later g⁻ less the earlier one, sensor units/s.
     * @param stays a² is in the difference so many times: 2 for two stays.
     * @param noise variance of a reading, sensor units squared; above 0.
     * @param slopeNoise variance of a slope, sensor units² / s².
     * @param firstOfCell whether the cell has shown no two stays of clearly different slopes before.
     * @return whether the two stays' slopes are clearly different.
     */
    fun add(
        difference: Double,
        up: Double,
        down: Double,
        stays: Double,
        noise: Double,
        slopeNoise: Double,
        firstOfCell: Boolean,
    ): Boolean {
        val slopes = up * up + down * down
        if (!(difference * difference).isFinite() || !slopes.isFinite()) return false
        val clear = slopes > CLEAR * slopeNoise * stays
        val a2 = maxOf(base, noise)
        // A pair whose slopes are alike says nothing of k, only of a.
        if (clear) {
            val residual = difference - rising * up - falling * down
            val variance = stays * a2 + maxOf(perSlope, STRICTEST * rising * falling) * slopes
            val far = if (known) abs(residual) / sqrt(variance) else 0.0
            val weight = minOf(1.0, FARTHEST / maxOf(far, FARTHEST)) / variance
            up2 += weight * up * up
            upDown += weight * up * down
            down2 += weight * down * down
            upY += weight * up * difference
            downY += weight * down * difference
            if (firstOfCell) {
                cells++
                quantile = quantile(cells)
            }
            solve()
        }
        explained += (noise + rising * falling * slopeNoise - explained) / minOf(++seen, RECENT)
        if (rising > 0) judge(difference - rising * up - falling * down, stays, slopes, a2)
        return clear
    }

    /** What noise alone makes of a², sensor units squared. */
    private var explained = 0.0

    /** Whether distances are proportional to slopes so well that a slope tells a distance. */
    val proportional: Boolean
        get() = perSlope < LOOSEST * LOOSEST * rising * falling && base < UNEXPLAINED * explained

    /** 97.5 % quantile of Student's distribution, to first order in 1/ν, for the cells that the ratios rest on. */
    var quantile: Double = quantile(0)
        private set

    /** Variance of k⁺ [up] − k⁻ [down]: spread from stay to stay, and what is not known of the ratios themselves. */
    fun variance(up: Double, down: Double): Double =
        (perSlope + upVariance) * up * up + (perSlope + downVariance) * down * down - 2 * covariance * up * down

    /** k⁺ and k⁻ by least squares, held together by the belief that they are alike within half of their size. */
    private fun solve() {
        val together = up2 + 2 * upDown + down2
        if (!(together > 0)) return
        val both = (upY + downY) / together
        if (!(both > 0)) return
        val belief = 1 / (ALIKE * ALIKE * both * both)
        val p = up2 + belief
        val q = upDown - belief
        val r = down2 + belief
        val determinant = p * r - q * q
        if (!(determinant > 0)) return
        rising = (r * upY - q * downY) / determinant
        falling = (p * downY - q * upY) / determinant
        upVariance = r / determinant
        downVariance = p / determinant
        covariance = -q / determinant
        // A sensor does not come to rest beyond the truth.
        if (!(rising > 0) || !(falling > 0)) {
            rising = both
            falling = both
        }
    }

    /** a² and b² by weighted least squares of squared residuals, eq. (6). */
    private fun judge(residual: Double, stays: Double, slopes: Double, a2: Double) {
        val floor = FLOOR * FLOOR * rising * falling
        val expected = stays * a2 + maxOf(perSlope, floor) * slopes
        val most = if (judged >= FEWEST) CAP * expected else Double.MAX_VALUE
        val square = minOf(residual * residual, most)
        val weight = 1 / (expected * expected)
        if (!(weight * square * slopes).isFinite() || !(weight * slopes * slopes).isFinite()) return
        spread11 = KEPT * spread11 + weight * stays * stays
        spread12 = KEPT * spread12 + weight * stays * slopes
        spread22 = KEPT * spread22 + weight * slopes * slopes
        spreadY1 = KEPT * spreadY1 + weight * stays * square
        spreadY2 = KEPT * spreadY2 + weight * slopes * square
        judged++
        val determinant = spread11 * spread22 - spread12 * spread12
        var a = 0.0
        var b = 0.0
        if (determinant > SINGULAR * spread11 * spread22) {
            a = (spread22 * spreadY1 - spread12 * spreadY2) / determinant
            b = (spread11 * spreadY2 - spread12 * spreadY1) / determinant
        }
        // Neither is negative: where one would be, the other explains all.
        if (!(a > 0)) {
            a = 0.0
            b = if (spread22 > 0) spreadY2 / spread22 else 0.0
        } else if (!(b >= 0)) {
            a = spreadY1 / spread11
            b = 0.0
        }
        base = a
        perSlope = b
    }

    private companion object {
        /** 97.5 % quantile of the normal distribution. */
        const val NORMAL = 1.96
        const val FEWEST = 12
        const val FEWEST_CELLS = 6
        const val FARTHEST = 3.0
        const val CLEAR = 16.0

        /** Ratios are never believed to be alike to better than this share, squared. */
        const val STRICTEST = 1e-4
        const val ALIKE = 0.5
        const val UNEXPLAINED = 16.0
        const val RECENT = 64
        const val FLOOR = 0.1
        const val CAP = 16.0
        const val KEPT = 1 - 1.0 / 256

        /** b over k beyond which a slope tells no distance: at three standard deviations it may be none. */
        const val LOOSEST = 1.0 / 3
        const val SINGULAR = 1e-9

        fun quantile(cells: Int): Double = NORMAL + NORMAL * (NORMAL * NORMAL + 1) / (4.0 * maxOf(1, cells - 2))
    }
}
