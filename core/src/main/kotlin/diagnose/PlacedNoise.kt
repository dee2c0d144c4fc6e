package stillwater.diagnose

import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * [noise] and what [places] add to it, on the log's own times.
 *
 * Whitening is the Kalman filter of four states, of which c is what wanders of the noise, e the error of the place on
 * either axis, and s what the lag has kept of what these did: s ← a s + (1 − a) (gradient · e), a = exp(−Δt/τ). Its gains
 * do not depend on the data, so that a column costs O(n). Rows not in use are passed over. See core/docs/Diagnosis.md, (11e).
 */
internal class PlacedNoise(noise: CorrelatedNoise, places: PlaceErrors) {
    private val used = noise.used
    private val n = used.size
    private val keep = DoubleArray(n)
    private val keepPlace = DoubleArray(n)
    private val keepShown = DoubleArray(n)
    private val east = DoubleArray(n)
    private val north = DoubleArray(n)
    private val gain = DoubleArray(n)
    private val gainEast = DoubleArray(n)
    private val gainNorth = DoubleArray(n)
    private val gainShown = DoubleArray(n)
    private val scale = DoubleArray(n)

    /** Sum over the rows in use of ln of the innovation's variance. */
    val logDeterminant: Double

    init {
        var sum = 0.0
        val filter = Filter(noise, places)
        for (i in 0 until n) {
            filter.step(i)
            keep[i] = filter.keep
            keepPlace[i] = filter.keepPlace
            keepShown[i] = filter.keepShown
            east[i] = filter.east
            north[i] = filter.north
            if (!used[i]) continue
            gain[i] = filter.gain
            gainEast[i] = filter.gainEast
            gainNorth[i] = filter.gainNorth
            gainShown[i] = filter.gainShown
            scale[i] = 1 / sqrt(filter.innovation)
            sum += ln(filter.innovation)
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
            c *= keep[i]
            e *= keepPlace[i]
            f *= keepPlace[i]
            s = keepShown[i] * s + east[i] * e + north[i] * f
            if (used[i]) {
                val innovation = column[i] - c - s
                out[i] = innovation * scale[i]
                c += gain[i] * innovation
                e += gainEast[i] * innovation
                f += gainNorth[i] * innovation
                s += gainShown[i] * innovation
            } else {
                out[i] = 0.0
            }
        }
    }

    /** Writes Wᵀ [whitened] into [out], which may be the same, where whitening is W. */
    fun turned(whitened: DoubleArray, out: DoubleArray) {
        var c = 0.0
        var e = 0.0
        var f = 0.0
        var s = 0.0
        for (i in whitened.indices.reversed()) {
            val innovation = if (used[i]) {
                gain[i] * c + gainEast[i] * e + gainNorth[i] * f + gainShown[i] * s + scale[i] * whitened[i]
            } else {
                0.0
            }
            out[i] = innovation
            c = keep[i] * (c - innovation)
            s -= innovation
            e = keepPlace[i] * (e + east[i] * s)
            f = keepPlace[i] * (f + north[i] * s)
            s *= keepShown[i]
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
            if (dt != last) {
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
