package stillwater.diagnose.noise

import io.kotest.property.Arb
import io.kotest.property.PropTestConfig
import io.kotest.property.arbitrary.int
import io.kotest.property.checkAll
import kotlinx.coroutines.runBlocking
import stillwater.diagnose.algebra.Cholesky
import stillwater.diagnose.algebra.dot
import stillwater.diagnose.algebra.squares
import kotlin.math.abs
import kotlin.math.exp
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class PlacedNoiseTest {
    /** Some noise at uneven times, some rows not in use, some after gaps, with errors of fixes. */
    private class Some(seed: Int, val n: Int) {
        val random = Random(seed)
        val times = DoubleArray(n).also { times ->
            for (i in 1 until n) times[i] = times[i - 1] + random.nextDouble(0.1, 9.0)
        }
        val shocks = Shocks(
            DoubleArray(n) { if (random.nextInt(4) == 0) random.nextDouble(0.0, 5.0) else 0.0 },
            // Another lag than that of the places would be a state of its own.
            DoubleArray(n) { Double.NaN },
        ).takeIf { random.nextBoolean() }
        val used = BooleanArray(n) { random.nextInt(5) > 0 }
        val noise = CorrelatedNoise(
            times,
            random.nextDouble(0.0, 0.99),
            random.nextDouble(0.1, 50.0),
            used,
            shocks,
        )
        val places = PlaceErrors(
            DoubleArray(n) { random.nextDouble(-1.0, 1.0) },
            DoubleArray(n) { random.nextDouble(-1.0, 1.0) },
            random.nextDouble(0.0, 9.0),
            random.nextDouble(0.1, 50.0),
            random.nextDouble(0.5, 50.0),
        )

        fun column() = DoubleArray(n) { random.nextDouble(-3.0, 3.0) }
    }

    private fun ofAny(first: Long, rows: Arb<Int>, law: (Some, String) -> Unit) = runBlocking<Unit> {
        checkAll(PropTestConfig(first, iterations = 200), Arb.int(), rows) { seed, n ->
            law(Some(seed, n), "seed $seed")
        }
    }

    /** wᵀ (W c) and (Wᵀ w)ᵀ c are the same number, for any column c and any w. */
    @Test
    fun turnedIsTheTransposeOfWhitening() = ofAny(20_266, Arb.int(1, 40)) { some, said ->
        val noise = PlacedNoise(some.noise, some.places)
        val c = some.column()
        val w = some.column()
        val white = DoubleArray(some.n).also { noise.whiten(c, it) }
        val turned = DoubleArray(some.n).also { noise.turned(w, it) }
        assertEquals(dot(w, white), dot(turned, c), 1e-8 * (1 + abs(dot(w, white))), said)
        assertTrue(white.indices.all { some.used[it] || white[it] == 0.0 }, said)
    }

    /** Both at once are to the bit what each is alone. */
    @Test
    fun whiteningTwoAtOnceIsWhiteningEach() = ofAny(20_270, Arb.int(1, 40)) { some, said ->
        val noise = PlacedNoise(some.noise, some.places)
        val columns = List(2) { some.column() }
        val alone = columns.map { column -> DoubleArray(some.n).also { noise.whiten(column, it) } }
        noise.whitenBoth(columns[0], columns[1])
        for (k in 0..1) assertContentEquals(alone[k], columns[k], "column $k, $said")
    }

    /** How much of what came before row j is left of it at row i of a lag. */
    private fun Some.kept(i: Int, j: Int) = exp(-(times[i] - times[j]) / places.timeConstant)

    /** The covariance of rows [a] and [b] as the class states it, worked out sum by sum. */
    private fun Some.covariance(a: Int, b: Int): Double {
        var sum = noise.share * exp(-abs(times[a] - times[b]) / noise.time) + if (a == b) 1 - noise.share else 0.0
        fun weight(i: Int, j: Int) = if (j == 0) 0.0 else (1 - kept(j, j - 1)) * kept(i, j)
        for (i in 0..a) {
            for (j in 0..b) {
                val alike = places.variance * exp(-abs(times[i] - times[j]) / places.time)
                val slopes = places.east[i] * places.east[j] + places.north[i] * places.north[j]
                sum += weight(a, i) * weight(b, j) * slopes * alike
            }
        }
        if (shocks != null) for (i in 0..minOf(a, b)) sum += kept(a, i) * kept(b, i) * shocks.variance[i]
        return sum
    }

    /** r' C⁻¹ r and ln |C|, worked out with the whole matrix; and the score is of both. */
    @Test
    fun whitenedSquaresAndDeterminantAreThoseOfTheCovariance() = ofAny(20_267, Arb.int(1, 12)) { some, said ->
        val rows = some.times.indices.filter { some.used[it] }
        val factor = Cholesky(
            Array(rows.size) { a -> DoubleArray(a + 1) { b -> some.covariance(rows[a], rows[b]) } },
        )
        val column = some.column()
        val noise = PlacedNoise(some.noise, some.places)
        val out = DoubleArray(some.n).also { noise.whiten(column, it) }
        val half = factor.half(DoubleArray(rows.size) { column[rows[it]] })
        // A billionth of the variance is added to each innovation, which is a hundredth at least.
        assertEquals(squares(half), squares(out), 1e-6 * squares(half) + 1e-12, said)
        assertEquals(factor.logDeterminant, noise.logDeterminant, 1e-5, said)
        if (rows.isEmpty()) return@ofAny
        val score = some.noise.twiceLogLikelihood(squares(out)) + some.noise.logDeterminant - noise.logDeterminant
        assertEquals(score, PlacedNoise.score(column, some.noise, some.places).twice, 1e-6 * (1 + abs(score)), said)
    }

    /** Fixes that are right add nothing. */
    @Test
    fun withoutErrorsItIsTheNoiseItself() = ofAny(20_268, Arb.int(1, 40)) { some, said ->
        val still = CorrelatedNoise(some.times, some.noise.share, some.noise.time, some.used)
        val right = some.places.let { PlaceErrors(it.east, it.north, 0.0, it.time, it.timeConstant) }
        val column = some.column()
        val expected = DoubleArray(some.n).also { still.whiten(column, it) }
        val found = DoubleArray(some.n).also { PlacedNoise(still, right).whiten(column, it) }
        for (i in found.indices) assertEquals(expected[i], found[i], 1e-9, said)
    }
}
