package stillwater.estimate

import org.junit.jupiter.api.Test
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.ln
import kotlin.math.min
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.random.asJavaRandom
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class FixSmootherTest {
    /** A boat that surveys legs of 60 m at 0.8 m/s in a current, 4 m apart, and what it logs. */
    private class Boat(seed: Int, deviation: Double, offset: Double = 0.0, seconds: Int = 600) {
        private val random = Random(seed).asJavaRandom()
        val x = DoubleArray(10 * seconds + 1)
        val y = DoubleArray(x.size)
        private val heading = DoubleArray(x.size)
        val fixTimes = DoubleArray(seconds + 1) { it.toDouble() }

        init {
            for (k in 1 until x.size) {
                val t = k * 0.1
                val leg = (t / 80).toInt()
                val left = t - 80 * leg
                heading[k] = when {
                    left > 75 -> PI / 2
                    leg % 2 == 0 -> 0.0
                    else -> PI
                }
                val speed = if (left < 3) 0.8 * left / 3 else 0.8
                x[k] = x[k - 1] + 0.1 * (speed * cos(heading[k]) + 0.1)
                y[k] = y[k - 1] + 0.1 * (speed * sin(heading[k]) - 0.05)
            }
        }

        val fixX = DoubleArray(fixTimes.size) { x[10 * it] + deviation * random.nextGaussian() }
        val fixY = DoubleArray(fixTimes.size) { y[10 * it] + deviation * random.nextGaussian() }
        private val compassTimes = DoubleArray(x.size) { it * 0.1 }
        private val compass = DoubleArray(x.size) { heading[it] + offset + 0.02 * random.nextGaussian() }

        fun fixes(withHeadings: Boolean = true, from: (Int) -> Boolean = { true }): LoggedFixes {
            val kept = fixTimes.indices.filter(from)
            fun of(column: DoubleArray) = DoubleArray(kept.size) { column[kept[it]] }
            return if (withHeadings) {
                LoggedFixes(of(fixTimes), of(fixX), of(fixY), compassTimes, compass)
            } else {
                LoggedFixes(of(fixTimes), of(fixX), of(fixY))
            }
        }

        /** Root mean square of how far off the places of [smoother] are between the fixes, m. */
        fun error(smoother: FixSmoother): Double {
            val times = DoubleArray(fixTimes.size - 1) { it + 0.5 }
            val (east, north) = smoother.at(times)
            return sqrt(times.indices.map { hypot(east[it] - x[10 * it + 5], north[it] - y[10 * it + 5]) }.meanSquare())
        }
    }

    @Test
    fun findsHowGoodFixesAreAndWhereTheBoatWas() {
        for (seed in 1..4) {
            for (deviation in doubleArrayOf(0.3, 1.5, 4.0)) {
                val boat = Boat(seed, deviation)
                val smoother = FixSmoother(boat.fixes())
                val error = boat.error(smoother)
                assertEquals(0.0, ln(smoother.fixDeviation / deviation), 0.15, "seed $seed: ${smoother.fixDeviation} m")
                assertTrue(error < 0.5 * deviation * sqrt(2.0), "seed $seed, $deviation m: off by $error m")
                assertEquals(0, smoother.refused)
            }
        }
    }

    @Test
    fun headingsTellMoreThanFixesAloneAlsoFromACompassThatIsOff() {
        for (seed in 1..4) {
            val boat = Boat(seed, 1.5)
            val alone = boat.error(FixSmoother(boat.fixes(withHeadings = false)))
            assertTrue(alone < 1.5, "seed $seed: off by $alone m without headings")
            for (offset in doubleArrayOf(0.0, 0.3)) {
                val with = boat.error(FixSmoother(Boat(seed, 1.5, offset).fixes()))
                assertTrue(with < 0.75 * alone, "seed $seed, compass off by $offset: $with m, without $alone m")
            }
        }
    }

    @Test
    fun fixesOfACentimetreAreBelieved() {
        for (deviation in doubleArrayOf(0.0, 0.01, 0.05)) {
            val error = Boat(seed = 5, deviation).let { it.error(FixSmoother(it.fixes())) }
            assertTrue(error < 0.05, "$deviation m: off by $error m")
        }
    }

    /** Without headings the drift is a Wiener process: places are the means of a Gaussian process, solved here at once. */
    @Test
    fun isTheMeanOfTheSameProcessSolvedAtOnce() {
        val random = Random(7)
        val times = DoubleArray(25)
        for (i in 1 until times.size) times[i] = times[i - 1] + 0.2 + 4 * random.nextDouble()
        val x = DoubleArray(times.size) { sin(0.2 * times[it]) + random.nextDouble() }
        val y = DoubleArray(times.size) { 3 * random.nextDouble() }
        val noise = FixNoise(doubleArrayOf(ln(0.4), ln(0.1), ln(0.07), ln(0.05)))
        val wanted = DoubleArray(40) { 0.1 + it * (times.last() - 0.2) / 39 }
        val (east, north) = FixSmoother(LoggedFixes(times, x, y), noise).at(wanted)
        fun covariance(a: Double, b: Double): Double {
            val s = min(a, b)
            val wandering = noise.drift * (s * s * maxOf(a, b) / 2 - s * s * s / 6)
            return 1e8 + 4.0 * a * b + wandering + noise.place * s
        }
        val k = Array(times.size) { i ->
            DoubleArray(times.size) { covariance(times[i], times[it]) + if (i == it) noise.r else 0.0 }
        }
        for ((column, found) in listOf(x to east, y to north)) {
            val weights = solved(k, DoubleArray(times.size) { column[it] - column[0] })
            for (i in wanted.indices) {
                val mean = column[0] + times.indices.sumOf { weights[it] * covariance(wanted[i], times[it]) }
                assertEquals(mean, found[i], 1e-4, "at ${wanted[i]} s")
            }
        }
    }

    @Test
    fun aWildFixIsLeftOut() {
        val boat = Boat(seed = 8, deviation = 0.5)
        boat.fixX[300] += 400.0
        val smoother = FixSmoother(boat.fixes())
        assertEquals(1, smoother.refused)
        assertTrue(boat.error(smoother) < 0.5, "off by ${boat.error(smoother)} m")
    }

    @Test
    fun aBoatThatWasCarriedAwayIsFoundAgain() {
        val boat = Boat(seed = 9, deviation = 0.5)
        for (i in 300..600) boat.fixY[i] += 500.0
        val smoother = FixSmoother(boat.fixes())
        assertEquals(FixSmoother.MOST_REFUSED, smoother.refused)
        val (_, north) = smoother.at(doubleArrayOf(290.0, 320.0, 500.0))
        assertEquals(boat.y[2900], north[0], 1.0)
        assertEquals(boat.y[3200] + 500, north[1], 1.0)
        assertEquals(boat.y[5000] + 500, north[2], 1.0)
    }

    @Test
    fun nothingIsKnownBesideTheFixesAndInLongGaps() {
        val smoother = FixSmoother(Boat(seed = 10, deviation = 0.5).fixes { it !in 200..240 })
        assertFalse(smoother.knows(220.0))
        assertFalse(smoother.knows(-0.5))
        assertFalse(smoother.knows(600.5))
        assertTrue(smoother.knows(0.0) && smoother.knows(198.5) && smoother.knows(600.0))
        val (east, north) = smoother.at(doubleArrayOf(-0.5, 100.0, 220.0, 300.0))
        assertEquals(listOf(true, false, true, false), east.map { it.isNaN() })
        assertEquals(listOf(true, false, true, false), north.map { it.isNaN() })
    }

    @Test
    fun sparseFixesAreFollowedByTheirHeadings() {
        val boat = Boat(seed = 11, deviation = 0.5)
        val smoother = FixSmoother(boat.fixes { it % 5 == 0 })
        assertTrue(boat.error(smoother) < 0.7, "off by ${boat.error(smoother)} m")
    }

    @Test
    fun oneFixIsEnough() {
        val smoother = FixSmoother(LoggedFixes(doubleArrayOf(3.0), doubleArrayOf(1.0), doubleArrayOf(2.0)))
        val (east, north) = smoother.at(doubleArrayOf(3.0))
        assertEquals(1.0, east[0], 1e-6)
        assertEquals(2.0, north[0], 1e-6)
    }

    @Test
    fun refusesWhatIsNoTrack() {
        val two = doubleArrayOf(1.0, 2.0)
        fun assertRefused(times: DoubleArray, x: DoubleArray, headingTimes: DoubleArray, headings: DoubleArray) {
            assertFailsWith<IllegalArgumentException> { LoggedFixes(times, x, two, headingTimes, headings) }
        }
        assertRefused(doubleArrayOf(), doubleArrayOf(), two, two)
        assertRefused(two, doubleArrayOf(1.0), two, two)
        assertRefused(two.reversedArray(), two, two, two)
        assertRefused(two, doubleArrayOf(1.0, Double.NaN), two, two)
        assertRefused(two, two, two, doubleArrayOf(1.0))
        assertRefused(two, two, doubleArrayOf(1.0, 1.0), two)
    }

    private fun solved(k: Array<DoubleArray>, right: DoubleArray): DoubleArray {
        val n = right.size
        val a = Array(n) { k[it].copyOf() }
        val b = right.copyOf()
        for (i in 0 until n) {
            val pivot = (i until n).maxBy { abs(a[it][i]) }
            a[i] = a[pivot].also { a[pivot] = a[i] }
            b[i] = b[pivot].also { b[pivot] = b[i] }
            for (r in i + 1 until n) {
                val share = a[r][i] / a[i][i]
                for (c in i until n) a[r][c] -= share * a[i][c]
                b[r] -= share * b[i]
            }
        }
        for (i in n - 1 downTo 0) b[i] = (b[i] - (i + 1 until n).sumOf { a[i][it] * b[it] }) / a[i][i]
        return b
    }

    private companion object {
        fun List<Double>.meanSquare() = sumOf { it * it } / size
    }
}
