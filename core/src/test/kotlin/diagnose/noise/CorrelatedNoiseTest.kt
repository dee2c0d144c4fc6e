package stillwater.diagnose.noise

import io.kotest.property.Arb
import io.kotest.property.PropTestConfig
import io.kotest.property.arbitrary.boolean
import io.kotest.property.arbitrary.int
import io.kotest.property.checkAll
import kotlinx.coroutines.runBlocking
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.Cholesky
import stillwater.diagnose.algebra.dot
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.response.NoiseSearch
import stillwater.diagnose.response.Scales
import stillwater.diagnose.three
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class CorrelatedNoiseTest {
    private val times = DoubleArray(4000) { it + 0.2 * (it % 3) }
    private val used = BooleanArray(times.size) { true }

    /**
     * Noise of unit variance, of which [share] is correlated over [time]; sums of twelve even numbers are nearly
     * normal.
     */
    private fun noise(share: Double, time: Double): DoubleArray {
        val random = Random(5)
        fun normal() = (1..12).sumOf { random.nextDouble() } - 6
        var state = normal()
        return DoubleArray(times.size) { i ->
            val keep = if (i == 0) 0.0 else exp(-(times[i] - times[i - 1]) / time)
            state = keep * state + sqrt(1 - keep * keep) * normal()
            sqrt(share) * state + sqrt(1 - share) * normal()
        }
    }

    @Test
    fun whiteningLeavesNoCorrelationBetweenNeighbours() {
        val z = DoubleArray(times.size)
        CorrelatedNoise(times, 0.7, 8.0, used).whiten(noise(0.7, 8.0), z)
        val next = (1 until z.size).sumOf { z[it] * z[it - 1] } / squares(z)
        // Three standard errors of the correlation of 4000 independent numbers are 0.047.
        assertTrue(abs(next) < 0.047, "correlation $next")
        assertEquals(1.0, squares(z) / z.size, 0.07, "variance: three standard errors, sqrt(2 / 4000) each")
    }

    @Test
    fun theLikeliestNoiseIsNearTheTrueOne() {
        val series = MeasuredSeries(times, times, times, times, null)
        val search = NoiseSearch(Scales(series), noise(0.7, 8.0), used, 200.0)
        val found = search.near(null)
        // About four standard errors at this length, from repeated draws.
        assertEquals(0.7, found.share, 0.1)
        assertEquals(8.0, found.time, 3.0)
        val again = search.near(found)
        assertEquals(found.share, again.share, 0.05, "begun where it was found")
        assertEquals(found.time, again.time, 0.5, "begun where it was found")
    }

    /** Of a row alone says what its whitened impulse has in common with the residuals. */
    @Test
    fun impulsesAreThoseOfEachRow() = ofAnyNoise(20_270, Arb.int(1, 60)) { noise, n, random, seed ->
        val z = DoubleArray(n) { if (noise.used[it]) random.nextDouble(-10.0, 10.0) else 0.0 }
        val found = noise.impulses(z)
        for (i in 0 until n) {
            val impulse = DoubleArray(n).also { it[i] = 1.0 }
            noise.whiten(impulse, impulse)
            val expected = if (noise.used[i]) dot(impulse, z) / sqrt(squares(impulse)) else 0.0
            assertEquals(expected, found[i], 1e-6 * (1 + abs(expected)), "row $i of $n, seed $seed")
        }
    }

    /** What several shares score in one pass is what each scores whitened by itself. */
    @Test
    fun sharesScoreTogetherAsEachDoesAlone() = ofAnyNoise(20_269, Arb.int(1, 400)) { noise, n, random, seed ->
        val residuals = DoubleArray(n) { random.nextDouble(-10.0, 10.0) }
        val series = MeasuredSeries(noise.times, residuals, residuals, residuals, null)
        val shares = doubleArrayOf(0.0, noise.share, 0.999)
        val scales = Scales(series, shocks = noise.shocks)
        val scores = NoiseSearch(scales, residuals, noise.used, 50.0).scores(noise.time, shares)
        for (k in shares.indices) {
            val alone = CorrelatedNoise(noise.times, shares[k], noise.time, noise.used, noise.shocks)
            val white = DoubleArray(n).also { alone.whiten(residuals, it) }
            val expected = alone.twiceLogLikelihood(squares(white))
            assertEquals(expected, scores[k], 1e-7 * (1 + abs(expected)), "share ${shares[k]}, seed $seed")
        }
    }

    @Test
    fun rowsNotInUseCountForNothing() {
        val half = BooleanArray(times.size) { it % 2 == 0 }
        val z = DoubleArray(times.size)
        CorrelatedNoise(times, 0.5, 8.0, half).whiten(noise(0.5, 8.0), z)
        assertTrue(z.indices.all { half[it] || z[it] == 0.0 })
    }

    /** Both at once are to the bit what each is alone. */
    @Test
    fun whiteningTwoAtOnceIsWhiteningEach() = ofAnyNoise(20_263, Arb.int(0, 40)) { noise, n, random, seed ->
        val columns = List(2) { DoubleArray(n) { random.nextDouble(-10.0, 10.0) } }
        val alone = columns.map { column -> DoubleArray(n).also { noise.whiten(column, it) } }
        noise.whitenBoth(columns[0], columns[1])
        for (k in 0..1) assertContentEquals(alone[k], columns[k], "column $k, seed $seed")
    }

    /** wᵀ (W c) and (Wᵀ w)ᵀ c are the same number, for any column c and any w. */
    @Test
    fun turnedIsTheTransposeOfWhitening() = ofAnyNoise(20_265, Arb.int(1, 40)) { noise, n, random, seed ->
        val (c, w) = List(2) { DoubleArray(n) { random.nextDouble(-10.0, 10.0) } }
        val white = DoubleArray(n).also { noise.whiten(c, it) }
        val turned = DoubleArray(n).also { noise.turned(w, it) }
        assertEquals(dot(w, white), dot(turned, c), 1e-8 * (1 + abs(dot(w, white))), "seed $seed")
    }

    private fun shocks(n: Int, random: Random) = Shocks(
        DoubleArray(n) { if (random.nextInt(4) == 0) random.nextDouble(0.0, 5.0) else 0.0 },
        DoubleArray(n) { random.nextDouble(0.0, 1.0) },
    )

    /** Asks [law] of noise on so many [rows] at uneven times, some not in use, a truth in doubt or not. */
    private fun ofAnyNoise(first: Long, rows: Arb<Int>, law: (CorrelatedNoise, Int, Random, Int) -> Unit) =
        runBlocking<Unit> {
            checkAll(PropTestConfig(first, iterations = 200), Arb.int(), rows, Arb.boolean()) { seed, n, isShaken ->
                val random = Random(seed)
                var now = 0.0
                val times = DoubleArray(n) { now.also { now += random.nextDouble(0.1, 9.0) } }
                val shocks = shocks(n, random)
                val some = BooleanArray(n) { random.nextInt(5) > 0 }
                val share = random.nextDouble(0.0, 1.0)
                val time = random.nextDouble(0.1, 50.0)
                law(CorrelatedNoise(times, share, time, some, shocks.takeIf { isShaken }), n, random, seed)
            }
        }

    /** The variance at each row of what [shocks] have left of themselves. */
    private fun variances(shocks: Shocks): DoubleArray {
        var shaken = 0.0
        return DoubleArray(shocks.keep.size) { i ->
            shaken = shocks.keep[i] * shocks.keep[i] * shaken + shocks.variance[i]
            shaken
        }
    }

    /** r' C⁻¹ r and ln |C| of the covariance that the class states, worked out with the whole matrix. */
    @Test
    fun whitenedSquaresAndDeterminantAreThoseOfTheCovariance() = runBlocking<Unit> {
        checkAll(PropTestConfig(seed = 20_264, iterations = 200), Arb.int(), Arb.int(1, 20)) { seed, n ->
            val random = Random(seed)
            var now = 0.0
            val times = DoubleArray(n) { now.also { now += random.nextDouble(0.1, 9.0) } }
            val share = random.nextDouble(0.0, 0.99)
            val time = random.nextDouble(0.1, 50.0)
            val some = BooleanArray(n) { random.nextInt(5) > 0 }
            val rows = times.indices.filter { some[it] }
            val shocks = shocks(n, random).takeIf { random.nextBoolean() }
            val shaken = shocks?.let(::variances)
            fun covariance(a: Int, b: Int): Double {
                val even = share * exp(-(times[a] - times[b]) / time) + if (a == b) 1 - share else 0.0
                if (shocks == null || shaken == null) return even
                return even + shaken[b] * (b + 1..a).fold(1.0) { left, i -> left * shocks.keep[i] }
            }
            val lower = Array(rows.size) { a -> DoubleArray(a + 1) { b -> covariance(rows[a], rows[b]) } }
            val column = DoubleArray(n) { random.nextDouble(-3.0, 3.0) }
            val noise = CorrelatedNoise(times, share, time, some, shocks)
            val out = DoubleArray(n).also { noise.whiten(column, it) }
            val factor = Cholesky(lower)
            val half = factor.half(DoubleArray(rows.size) { column[rows[it]] })
            // A billionth of the variance is added to each innovation, which is a hundredth at least.
            assertEquals(squares(half), squares(out), 1e-6 * squares(half) + 1e-12, "seed $seed")
            assertEquals(factor.logDeterminant, noise.logDeterminant, 1e-5, "seed $seed")
        }
    }
}
