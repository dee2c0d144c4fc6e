package stillwater.diagnose

import kotlin.math.abs
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Residuals that are drawn vary together as those of a model that is right do. */
class NullResidualsTest {
    private val n = 60
    private val draws = 20_000

    /** Elements of a covariance that are off by more than five standard errors, which chance makes one in two million. */
    private fun far(drawn: List<DoubleArray>, expected: (Int, Int) -> Double) = (0 until n).sumOf { a ->
        (0..a).count { b ->
            val found = drawn.sumOf { it[a] * it[b] } / drawn.size
            val error = sqrt((expected(a, a) * expected(b, b) + expected(a, b) * expected(a, b)) / drawn.size)
            abs(found - expected(a, b)) > 5 * error + 1e-12
        }
    }

    @Test
    fun whereTheWaterIsInferredTheyAreWhatItLeaves() {
        val fit = SineTrack(n).fit(BooleanArray(n) { it !in 20..22 })
        val rest = fit.unforeseen(0, n)
        val isUsed = BooleanArray(n) { it !in 20..22 }
        fun expected(a: Int, b: Int) = if (isUsed[a] && isUsed[b]) rest[a][b] else 0.0
        val drawn = fit.nullResiduals(draws, Random(20_261_201))
        assertEquals(0, far(drawn, ::expected))
        val kept = (0 until n).sumOf { expected(it, it) } / isUsed.count { it }
        assertTrue(kept < 0.9, "the water takes a part of the noise: $kept is left")
    }

    @Test
    fun whereFewNumbersAreFittedTheyAreIndependentAndNoneOnRowsThatAreNotUsed() {
        val drawn = independentResiduals(BooleanArray(n) { it != 7 }).draw(draws, Random(20_261_202))
        assertEquals(0, far(drawn) { a, b -> if (a == b && a != 7) 1.0 else 0.0 })
        assertTrue(drawn.all { it[7] == 0.0 })
    }

    @Test
    fun ofSomeRowsTheyAreThose() {
        val all = NullResiduals { count, _ -> List(count) { k -> DoubleArray(5) { it + 10.0 * k } } }
        val some = all.of(intArrayOf(1, 4)).draw(2, Random(1))
        assertEquals(listOf(listOf(1.0, 4.0), listOf(11.0, 14.0)), some.map { it.toList() })
    }
}
