package stillwater.estimate

import kotlin.math.ceil
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sin

/**
 * How much fixes and a boat scatter, of which [logs] are the logarithms: a fix, m; the speed along the heading and the
 * drift, as random walks, m/s per √s; the place beside them, m per √s.
 */
internal class FixNoise(val logs: DoubleArray) {
    val fix = exp(logs[0])

    // Variances.
    val r = fix * fix
    val along = exp(2 * logs[1])
    val drift = exp(2 * logs[2])
    val place = exp(2 * logs[3])
}

/**
 * Where a boat was, from all its fixes, before and after, and its headings: what a log can tell when all is over.
 *
 * A filter that drives the boat knows the fixes until now alone, and is behind where the boat turns. Here a Kalman filter
 * goes forwards and Bryson and Frazier's smoother back (Bierman 1977, doi:10.1137/0714031, which inverts no matrix larger
 * than a fix), over position p, speeds a along and b across the heading ψ, and the drift c of the water:
 *
 *     ṗ = (a cos ψ − b sin ψ, a sin ψ + b cos ψ) + c
 *
 * with a, b and c random walks, and white noise on p beside them. b is leeway or a compass that is off. How large these and
 * the errors of fixes are is found by their likelihood, so that nothing need be known of receiver, compass and boat.
 * Without headings c is the boat's own velocity.
 *
 * A fix farther than [GATE] deviations from where the others lead is left out; after [MOST_REFUSED] in a row, and after
 * [LONGEST_GAP] s without one, the boat may be anywhere. Immutable once made.
 *
 * @param fixes what was logged. Retained.
 */
public class FixSmoother internal constructor(private val fixes: LoggedFixes, given: FixNoise?) {
    private val east = reckoned { cos(it) }
    private val north = reckoned { sin(it) }
    private val noise: FixNoise = given ?: likeliest()

    public constructor(fixes: LoggedFixes) : this(fixes, null)

    /** Standard deviation of a fix, each axis, m, that suits the log. */
    public val fixDeviation: Double get() = noise.fix

    /** Fixes that were left out. */
    public val refused: Int

    init {
        val pass = Pass(Nodes(fixes.times))
        pass.forward(noise)
        refused = pass.refused
    }

    /** Whether [time], s, is between two fixes no more than [LONGEST_GAP] s apart, or at one. */
    public fun knows(time: Double): Boolean {
        val found = fixes.times.binarySearch(time)
        val after = -found - 1
        return found >= 0 ||
            (after in 1 until fixes.times.size && fixes.times[after] - fixes.times[after - 1] <= LONGEST_GAP)
    }

    /**
     * Where the boat was at each of [times], s, strictly growing: metres east, then metres north, each as long as [times].
     * NaN where it [knows] nothing.
     */
    public fun at(times: DoubleArray): Pair<DoubleArray, DoubleArray> {
        val known = times.filter { knows(it) }.toDoubleArray()
        val nodes = Nodes(known)
        val pass = Pass(nodes)
        pass.forward(noise)
        pass.backward()
        fun at(column: DoubleArray) = DoubleArray(times.size) { i ->
            val k = nodes.times.binarySearch(times[i])
            if (k >= 0 && knows(times[i])) column[k] else Double.NaN
        }
        return at(pass.smoothX) to at(pass.smoothY)
    }

    /** Coordinate search on the logarithms, with steps that shrink. */
    private fun likeliest(): FixNoise {
        val pass = Pass(Nodes(fixes.times))
        var best = FixNoise(START.copyOf())
        if (fixes.times.size < FEWEST) return best
        var score = pass.forward(best)
        var step = LARGEST_STEP
        while (step > SMALLEST_STEP) {
            var isBetter = false
            for (i in START.indices) {
                // The other way only where one way is no better.
                val next = SIGNS.asSequence().map { moved(best, i, it * step) }
                    .map { it to pass.forward(it) }
                    .firstOrNull { it.second > score } ?: continue
                best = next.first
                score = next.second
                isBetter = true
            }
            if (!isBetter) step /= 2
        }
        return best
    }

    /** [noise] with its logarithm [i] changed [by] that, within what is asked. */
    private fun moved(noise: FixNoise, i: Int, by: Double): FixNoise {
        val logs = noise.logs.copyOf()
        logs[i] = (logs[i] + by).coerceIn(LEAST[i], MOST[i])
        return FixNoise(logs)
    }

    /** The integral of [part] of the heading until each of its times. */
    private fun reckoned(part: (Double) -> Double): DoubleArray {
        val sum = DoubleArray(fixes.headings.size)
        for (k in 1 until sum.size) {
            val dt = fixes.headingTimes[k] - fixes.headingTimes[k - 1]
            val mean = (part(fixes.headings[k]) + part(fixes.headings[k - 1])) / 2
            sum[k] = sum[k - 1] + if (dt <= LONGEST_SILENCE) mean * dt else 0.0
        }
        return sum
    }

    /** Moments of the fixes and of what is [wanted], and others between so that none are more than a second apart. */
    private inner class Nodes(wanted: DoubleArray) {
        val times: DoubleArray
        val fix: IntArray

        init {
            val own = (fixes.times.asSequence() + wanted.asSequence()).toSortedSet()
            val all = ArrayList<Double>(own.size)
            for (time in own) {
                val last = all.lastOrNull()
                // Between headings a step turns; without any it is exact, however long.
                if (last != null && time - last <= LONGEST_GAP && fixes.headings.isNotEmpty()) {
                    val parts = ceil((time - last) / LONGEST_STEP - ROUNDING).toInt()
                    for (k in 1 until parts) all += last + (time - last) * k / parts
                }
                all += time
            }
            times = all.toDoubleArray()
            fix = IntArray(times.size) { fixes.times.binarySearch(times[it]).coerceAtLeast(NONE) }
        }
    }

    /** One pass over [nodes]; row i of the covariance is at SIZE · i. */
    private inner class Pass(private val nodes: Nodes) {
        private val n = nodes.times.size
        private val state = DoubleArray(SIZE)
        private val p = DoubleArray(SIZE * SIZE)
        private val wayX = ways(east)
        private val wayY = ways(north)
        private val unknown = BooleanArray(n) { it > 0 && isUnknown(nodes.times[it - 1], nodes.times[it]) }

        // Of each node: the state expected and its covariance with the position; the gain, empty where no fix was taken;
        // and the innovation over its covariance.
        private val expected = Array(n) { DoubleArray(2) }
        private val covariance = Array(n) { DoubleArray(2 * SIZE) }
        private val gain = Array(n) { DoubleArray(2 * SIZE) }
        private val isTaken = BooleanArray(n)

        /** Nodes at which what was before tells nothing: the first, and those after a gap or too many fixes refused. */
        private val isFirst = BooleanArray(n)
        private val pull = Array(n) { DoubleArray(2) }

        /** Fixes that the last pass left out. */
        var refused = 0
            private set

        /** Places after [backward], m. */
        val smoothX = DoubleArray(n)
        val smoothY = DoubleArray(n)

        /** What [sum] of the heading grows by up to each node. */
        private fun ways(sum: DoubleArray): DoubleArray {
            val at = DoubleArray(n) { k -> sum.at(nodes.times[k]) }
            return DoubleArray(n) { k -> if (k == 0) 0.0 else at[k] - at[k - 1] }
        }

        private fun DoubleArray.at(time: Double): Double =
            if (isEmpty()) 0.0 else straight(fixes.headingTimes, time)

        /** Whether headings were known and are silent for long between [from] and [to]. */
        private fun isUnknown(from: Double, to: Double): Boolean {
            val heard = fixes.headingTimes
            if (heard.isEmpty()) return false
            val after = heard.binarySearch(to).let { if (it >= 0) it else -it - 1 }
            val isOutside = after == 0 || (after == heard.size && to - heard.last() > LONGEST_SILENCE)
            return isOutside || (after < heard.size && heard[after] - heard[after - 1] > LONGEST_SILENCE && from < to)
        }

        /** Filters by [noise]; answers the logarithm of the density of the fixes, but for a constant. */
        fun forward(noise: FixNoise): Double {
            var score = 0.0
            var inRow = 0
            refused = 0
            for (k in 0 until n) {
                val dt = if (k == 0) 0.0 else nodes.times[k] - nodes.times[k - 1]
                val fix = nodes.fix[k]
                isFirst[k] = k == 0 || dt > LONGEST_GAP || (inRow >= MOST_REFUSED && fix != NONE)
                if (isFirst[k]) start(fix, noise.r) else advance(k, dt, noise)
                keep(k)
                if (fix == NONE) continue
                score += if (isFirst[k]) OUTLYING else take(k, fix, noise.r)
                inRow = if (isFirst[k] || isTaken[k]) 0 else inRow + 1
                if (inRow > 0) refused++
            }
            return score
        }

        /** Begins at [fix]: what was before tells nothing. */
        private fun start(fix: Int, r: Double) {
            state.fill(0.0)
            p.fill(0.0)
            state[0] = fixes.x[fix]
            state[1] = fixes.y[fix]
            for (i in 0 until SIZE) p[SIZE * i + i] = if (i < 2) r else FASTEST * FASTEST
            p[SIZE * ACROSS + ACROSS] = LEEWAY * LEEWAY
        }

        private fun advance(k: Int, dt: Double, noise: FixNoise) {
            val c = wayX[k]
            val s = wayY[k]
            state[0] += c * state[ALONG] - s * state[ACROSS] + dt * state[DRIFT]
            state[1] += s * state[ALONG] + c * state[ACROSS] + dt * state[DRIFT + 1]
            for (j in 0 until SIZE) {
                p[j] += c * p[SIZE * ALONG + j] - s * p[SIZE * ACROSS + j] + dt * p[SIZE * DRIFT + j]
                p[SIZE + j] += s * p[SIZE * ALONG + j] + c * p[SIZE * ACROSS + j] + dt * p[SIZE * (DRIFT + 1) + j]
            }
            for (i in 0 until SIZE) {
                val row = SIZE * i
                p[row] += c * p[row + ALONG] - s * p[row + ACROSS] + dt * p[row + DRIFT]
                p[row + 1] += s * p[row + ALONG] + c * p[row + ACROSS] + dt * p[row + DRIFT + 1]
            }
            val blind = if (unknown[k]) FASTEST * FASTEST * dt * dt else 0.0
            for (i in 0 until 2) {
                val drift = DRIFT + i
                p[SIZE * i + i] += noise.place * dt + noise.drift * dt * dt * dt / 3 + blind
                p[SIZE * i + drift] += noise.drift * dt * dt / 2
                p[SIZE * drift + i] += noise.drift * dt * dt / 2
                p[SIZE * drift + drift] += noise.drift * dt
            }
            p[SIZE * ALONG + ALONG] += noise.along * dt
            p[SIZE * ACROSS + ACROSS] += noise.drift * dt
        }

        private fun keep(k: Int) {
            expected[k][0] = state[0]
            expected[k][1] = state[1]
            p.copyInto(covariance[k], 0, 0, 2 * SIZE)
            isTaken[k] = false
        }

        /** Takes fix number [fix] at node [k], unless it is too far off; answers the logarithm of its density. */
        private fun take(k: Int, fix: Int, r: Double): Double {
            val ex = fixes.x[fix] - state[0]
            val ey = fixes.y[fix] - state[1]
            val sxx = p[0] + r
            val sxy = p[1]
            val syy = p[SIZE + 1] + r
            val det = sxx * syy - sxy * sxy
            val px = (syy * ex - sxy * ey) / det
            val py = (sxx * ey - sxy * ex) / det
            val off = ex * px + ey * py
            if (off > GATE * GATE) return OUTLYING
            isTaken[k] = true
            pull[k][0] = px
            pull[k][1] = py
            val g = gain[k]
            for (i in 0 until SIZE) {
                val a = p[SIZE * i]
                val b = p[SIZE * i + 1]
                g[2 * i] = (syy * a - sxy * b) / det
                g[2 * i + 1] = (sxx * b - sxy * a) / det
            }
            for (i in 0 until SIZE) state[i] += g[2 * i] * ex + g[2 * i + 1] * ey
            // P ← P − K (the covariance of the fix with the state), which are the first two rows.
            val rows = covariance[k]
            for (i in 0 until SIZE) {
                for (j in i until SIZE) {
                    p[SIZE * i + j] -= g[2 * i] * rows[j] + g[2 * i + 1] * rows[SIZE + j]
                    p[SIZE * j + i] = p[SIZE * i + j]
                }
            }
            return -(ln(det) + off) / 2
        }

        /** What later fixes say of each node: the adjoint of the state, λ, goes back through gains and steps. */
        fun backward() {
            val adjoint = DoubleArray(SIZE)
            for (k in n - 1 downTo 0) {
                if (isTaken[k]) {
                    val g = gain[k]
                    for (axis in 0 until 2) {
                        pull[k][axis] += (0 until SIZE).sumOf { g[2 * it + axis] * adjoint[it] }
                    }
                    adjoint[0] -= pull[k][0]
                    adjoint[1] -= pull[k][1]
                }
                val rows = covariance[k]
                smoothX[k] = expected[k][0] - (0 until SIZE).sumOf { rows[it] * adjoint[it] }
                smoothY[k] = expected[k][1] - (0 until SIZE).sumOf { rows[SIZE + it] * adjoint[it] }
                val dt = if (k == 0) 0.0 else nodes.times[k] - nodes.times[k - 1]
                if (isFirst[k]) {
                    adjoint.fill(0.0)
                    continue
                }
                val (lx, ly) = adjoint
                adjoint[ALONG] += wayX[k] * lx + wayY[k] * ly
                adjoint[ACROSS] += wayX[k] * ly - wayY[k] * lx
                adjoint[DRIFT] += dt * lx
                adjoint[DRIFT + 1] += dt * ly
            }
        }
    }

    public companion object {
        /** Longest time between two fixes over which the boat is followed, s. */
        public const val LONGEST_GAP: Double = 30.0

        /** A fix farther off than so many standard deviations is left out. */
        public const val GATE: Double = 6.0

        /** After so many fixes left out in a row the boat may be anywhere. */
        public const val MOST_REFUSED: Int = 5

        /** Position, speed along and across the heading, drift. */
        private const val SIZE = 6
        private const val ALONG = 2
        private const val ACROSS = 3
        private const val DRIFT = 4
        private const val NONE = -1

        /** Fewer fixes tell nothing of their noise. */
        private const val FEWEST = 30
        private const val LONGEST_STEP = 1.0
        private const val ROUNDING = 1e-6

        /** Headings farther apart do not say how the boat went between them, s. */
        private const val LONGEST_SILENCE = 2.0

        /** Of a boat and of water, and of a boat across its heading, m/s. */
        private const val FASTEST = 2.0
        private const val LEEWAY = 0.3

        /** Logarithm of the density of a fix that is left out: one in a thousand, anywhere within some 10 m. */
        private val OUTLYING = -ln(1e3) - ln(100.0)

        /** Where the search begins, and within what: better than 1 cm no receiver is. */
        private val START = doubleArrayOf(ln(1.5), ln(0.1), ln(0.02), ln(0.1))
        private val LEAST = doubleArrayOf(ln(0.01), ln(1e-4), ln(1e-4), ln(1e-4))
        private val MOST = doubleArrayOf(ln(100.0), ln(3.0), ln(3.0), ln(10.0))
        private val SIGNS = doubleArrayOf(1.0, -1.0)
        private val LARGEST_STEP = ln(4.0)
        private const val SMALLEST_STEP = 0.1
    }
}
