package stillwater.diagnose.noise

import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * [noise] and what [places] add to it, on the log's own times.
 *
 * Whitening is the Kalman filter of four states, of which c is what wanders of the noise, e the error of the place on
 * either axis, and s what the lag has kept of what these did: s ← a s + (1 − a) (gradient · e), a = exp(−Δt/τ). Its gains
 * do not depend on the data, so that a column costs O(n). Rows not in use are passed over. Shocks to the sensor's state are
 * shocks to s, and fade as that does, with the lag of [places]. See core/docs/Diagnosis.md, (11e).
 */
internal class PlacedNoise(noise: CorrelatedNoise, places: PlaceErrors) {
    private val used = noise.used
    private val n = used.size

    /** What whitening does at each row, [FACTORS] numbers a row. */
    private val factors = DoubleArray(n * FACTORS)

    /** Sum over the rows in use of ln of the innovation's variance. */
    val logDeterminant: Double

    init {
        var sum = 0.0
        val filter = Filter(noise, places)
        for (i in 0 until n) {
            filter.step(i)
            filter.write(factors, i * FACTORS)
            if (used[i]) {
                filter.writeGains(factors, i * FACTORS)
                sum += ln(filter.innovation)
            }
        }
        logDeterminant = sum
    }

    /** Whitens [column] into [out], which may be the same, both of length n; rows not in use become 0. */
    fun whiten(column: DoubleArray, out: DoubleArray) {
        var c = 0.0
        var e = 0.0
        var f = 0.0
        var s = 0.0
        for (i in column.indices) {
            val at = i * FACTORS
            c *= factors[at + KEEP]
            e *= factors[at + KEEP_PLACE]
            f *= factors[at + KEEP_PLACE]
            s = factors[at + KEEP_SHOWN] * s + factors[at + EAST] * e + factors[at + NORTH] * f
            val innovation = if (used[i]) column[i] - c - s else 0.0
            out[i] = innovation * factors[at + SCALE]
            c += factors[at + GAIN] * innovation
            e += factors[at + GAIN_EAST] * innovation
            f += factors[at + GAIN_NORTH] * innovation
            s += factors[at + GAIN_SHOWN] * innovation
        }
    }

    /** Whitens [one] and [two], which are modified, at the price of little more than one. */
    fun whitenBoth(one: DoubleArray, two: DoubleArray) {
        var c = 0.0
        var e = 0.0
        var f = 0.0
        var s = 0.0
        var cTwo = 0.0
        var eTwo = 0.0
        var fTwo = 0.0
        var sTwo = 0.0
        for (i in one.indices) {
            val at = i * FACTORS
            val keepPlace = factors[at + KEEP_PLACE]
            c *= factors[at + KEEP]
            cTwo *= factors[at + KEEP]
            e *= keepPlace
            eTwo *= keepPlace
            f *= keepPlace
            fTwo *= keepPlace
            s = factors[at + KEEP_SHOWN] * s + factors[at + EAST] * e + factors[at + NORTH] * f
            sTwo = factors[at + KEEP_SHOWN] * sTwo + factors[at + EAST] * eTwo + factors[at + NORTH] * fTwo
            val innovation = if (used[i]) one[i] - c - s else 0.0
            val innovationTwo = if (used[i]) two[i] - cTwo - sTwo else 0.0
            one[i] = innovation * factors[at + SCALE]
            two[i] = innovationTwo * factors[at + SCALE]
            c += factors[at + GAIN] * innovation
            cTwo += factors[at + GAIN] * innovationTwo
            e += factors[at + GAIN_EAST] * innovation
            eTwo += factors[at + GAIN_EAST] * innovationTwo
            f += factors[at + GAIN_NORTH] * innovation
            fTwo += factors[at + GAIN_NORTH] * innovationTwo
            s += factors[at + GAIN_SHOWN] * innovation
            sTwo += factors[at + GAIN_SHOWN] * innovationTwo
        }
    }

    /** Writes Wᵀ [whitened] into [out], which may be the same, where whitening is W. */
    fun turned(whitened: DoubleArray, out: DoubleArray) {
        var c = 0.0
        var e = 0.0
        var f = 0.0
        var s = 0.0
        for (i in whitened.indices.reversed()) {
            val at = i * FACTORS
            val innovation = factors[at + GAIN] * c + factors[at + GAIN_EAST] * e + factors[at + GAIN_NORTH] * f +
                factors[at + GAIN_SHOWN] * s + factors[at + SCALE] * whitened[i]
            out[i] = innovation
            c = factors[at + KEEP] * (c - innovation)
            s -= innovation
            e = factors[at + KEEP_PLACE] * (e + factors[at + EAST] * s)
            f = factors[at + KEEP_PLACE] * (f + factors[at + NORTH] * s)
            s *= factors[at + KEEP_SHOWN]
        }
    }

    /** The states' covariance, over the noise's variance, from row to row. */
    private class Filter(private val noise: CorrelatedNoise, private val places: PlaceErrors) {
        private var cc = noise.share
        private var ce = 0.0
        private var cf = 0.0
        private var cs = 0.0
        private var ee = places.variance
        private var ef = 0.0
        private var es = 0.0
        private var ff = places.variance
        private var fs = 0.0
        private var ss = 0.0

        var keep = 1.0
        var keepPlace = 1.0
        var keepShown = 1.0

        /** What the lag lets through of an error to the east, sensor units/m. */
        var east = 0.0
        var north = 0.0

        /** The innovation's variance. */
        var innovation = 1.0
        var gain = 0.0
        var gainEast = 0.0
        var gainNorth = 0.0
        var gainShown = 0.0

        private var last = Double.NaN

        /** To row [i]. */
        fun step(i: Int) {
            val times = noise.times
            val dt = if (i == 0) 0.0 else times[i] - times[i - 1]
            // Even times differ by a rounding error.
            if (!(abs(dt - last) < CorrelatedNoise.SAME * dt)) {
                keep = exp(-dt / noise.time)
                keepPlace = exp(-dt / places.time)
                keepShown = exp(-dt / places.timeConstant)
                last = dt
            }
            east = (1 - keepShown) * places.east[i]
            north = (1 - keepShown) * places.north[i]
            foretell()
            noise.shocks?.let { ss += it.variance[i] }
            if (noise.used[i]) take()
        }

        /** Puts how the states go on to this row into [factors] from [at] on. */
        fun write(factors: DoubleArray, at: Int) {
            factors[at + KEEP] = keep
            factors[at + KEEP_PLACE] = keepPlace
            factors[at + KEEP_SHOWN] = keepShown
            factors[at + EAST] = east
            factors[at + NORTH] = north
        }

        /** Puts what the innovation of this row, which is in use, does into [factors] from [at] on. */
        fun writeGains(factors: DoubleArray, at: Int) {
            factors[at + GAIN] = gain
            factors[at + GAIN_EAST] = gainEast
            factors[at + GAIN_NORTH] = gainNorth
            factors[at + GAIN_SHOWN] = gainShown
            factors[at + SCALE] = 1 / sqrt(innovation)
        }

        private fun foretell() {
            cc = keep * keep * cc + noise.share * (1 - keep * keep)
            ce *= keep * keepPlace
            cf *= keep * keepPlace
            ee = keepPlace * keepPlace * ee + places.variance * (1 - keepPlace * keepPlace)
            ff = keepPlace * keepPlace * ff + places.variance * (1 - keepPlace * keepPlace)
            ef *= keepPlace * keepPlace
            val esKept = keepPlace * keepShown * es
            val fsKept = keepPlace * keepShown * fs
            ss = keepShown * keepShown * ss + 2 * (east * esKept + north * fsKept) +
                east * east * ee + 2 * east * north * ef + north * north * ff
            cs = keep * keepShown * cs + east * ce + north * cf
            es = esKept + east * ee + north * ef
            fs = fsKept + east * ef + north * ff
        }

        private fun take() {
            innovation = cc + 2 * cs + ss + 1 - noise.share + CorrelatedNoise.SMALLEST
            val c = cc + cs
            val e = ce + es
            val f = cf + fs
            val s = cs + ss
            gain = c / innovation
            gainEast = e / innovation
            gainNorth = f / innovation
            gainShown = s / innovation
            cc -= gain * c
            ce -= gain * e
            cf -= gain * f
            cs -= gain * s
            ee -= gainEast * e
            ef -= gainEast * f
            es -= gainEast * s
            ff -= gainNorth * f
            fs -= gainNorth * s
            ss -= gainShown * s
        }
    }

    /** Twice the log-likelihood, less a constant, at the noise's likeliest [variance], sensor units². */
    class Score(val twice: Double, val variance: Double)

    companion object {
        private const val TINY = 1e-290

        // Of a row's factors: what is left of each state, what the lag lets through of errors, gains, and the scale.
        private const val KEEP = 0
        private const val KEEP_PLACE = 1
        private const val KEEP_SHOWN = 2
        private const val EAST = 3
        private const val NORTH = 4
        private const val GAIN = 5
        private const val GAIN_EAST = 6
        private const val GAIN_NORTH = 7
        private const val GAIN_SHOWN = 8
        private const val SCALE = 9
        private const val FACTORS = 10

        /** How likely [residuals] are under [noise] and what [places] add to it. */
        fun score(residuals: DoubleArray, noise: CorrelatedNoise, places: PlaceErrors): Score {
            val filter = Filter(noise, places)
            var squares = 0.0
            var sum = 0.0
            var c = 0.0
            var e = 0.0
            var f = 0.0
            var s = 0.0
            for (i in residuals.indices) {
                filter.step(i)
                c *= filter.keep
                e *= filter.keepPlace
                f *= filter.keepPlace
                s = filter.keepShown * s + filter.east * e + filter.north * f
                if (!noise.used[i]) continue
                val left = residuals[i] - c - s
                squares += left * left / filter.innovation
                sum += ln(filter.innovation)
                c += filter.gain * left
                e += filter.gainEast * left
                f += filter.gainNorth * left
                s += filter.gainShown * left
            }
            val variance = maxOf(squares / maxOf(noise.rows, 1), TINY)
            return Score(-noise.rows * ln(variance) - sum, variance)
        }
    }
}
