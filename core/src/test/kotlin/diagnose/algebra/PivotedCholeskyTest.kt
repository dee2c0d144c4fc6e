package stillwater.diagnose.algebra

import io.kotest.property.Arb
import io.kotest.property.PropTestConfig
import io.kotest.property.arbitrary.int
import io.kotest.property.checkAll
import kotlinx.coroutines.runBlocking
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.hypot
import kotlin.math.ln
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class PivotedCholeskyTest {
    private val config = PropTestConfig(seed = 20_262, iterations = 200)

    /** [rows] directions in a space of [rank] dimensions, times [variance]: what they have in common has that rank. */
    private fun matrix(random: Random, rows: Int, rank: Int, variance: Double): Array<DoubleArray> {
        val directions = Array(rows) {
            val own = DoubleArray(rank) { random.nextDouble(-1.0, 1.0) }
            val length = sqrt(squares(own))
            DoubleArray(rank) { k -> sqrt(variance) * own[k] / length }
        }
        return Array(rows) { a -> DoubleArray(rows) { b -> dot(directions[a], directions[b]) } }
    }

    private fun left(matrix: Array<DoubleArray>, factor: PivotedCholesky, a: Int, b: Int) =
        matrix[a][b] - factor.columns.sumOf { it[a] * it[b] }

    @Test
    fun aMatrixIsItsFactorTimesItselfWithAsManyColumnsAsItsRank() = runBlocking<Unit> {
        checkAll(config, Arb.int(), Arb.int(1, 24), Arb.int(1, 8)) { seed, rows, rank ->
            val random = Random(seed)
            val variance = exp(random.nextDouble(ln(1e-3), ln(1e3)))
            val matrix = matrix(random, rows, rank, variance)
            // Well above roundings, which a pivot as small makes larger.
            val factor = PivotedCholesky.of(rows, variance, 1e-9 * variance, rows) { a, b -> matrix[a][b] }
            assertTrue(factor.columns.size <= minOf(rows, rank), "${factor.columns.size} of rank $rank, seed $seed")
            for (a in 0 until rows) {
                for (b in 0 until rows) {
                    val rest = abs(left(matrix, factor, a, b))
                    assertTrue(rest <= 2e-9 * variance, "$rest of $variance between $a and $b, seed $seed")
                }
            }
        }
    }

    /** Of places on a plane that are alike the nearer they are: a rank as full as roundings let it be. */
    @Test
    fun itStopsAsSoonAsNoRowLacksMoreThanMayBeLeft() = runBlocking<Unit> {
        checkAll(config, Arb.int(), Arb.int(2, 40)) { seed, rows ->
            val random = Random(seed)
            val places = List(rows) { random.nextDouble(0.0, 4.0) to random.nextDouble(0.0, 4.0) }
            val matrix = Array(rows) { a ->
                DoubleArray(rows) { b ->
                    val d = hypot(places[a].first - places[b].first, places[a].second - places[b].second)
                    exp(-d * d / 2)
                }
            }
            val most = random.nextInt(1, rows + 1)
            val left = exp(random.nextDouble(ln(1e-6), ln(0.5)))
            val factor = PivotedCholesky.of(rows, 1.0, left, most) { a, b -> matrix[a][b] }
            val said = "$left of $rows rows, $most columns at most, seed $seed"
            val lacking = DoubleArray(rows) { left(matrix, factor, it, it) }
            assertTrue(factor.columns.size == most || lacking.all { it < left + ROUNDING }, said)
            // What is left is a covariance, too: between two rows no more than of each.
            for (a in 0 until rows) {
                for (b in 0 until a) {
                    val bound = sqrt(maxOf(lacking[a], 0.0) * maxOf(lacking[b], 0.0))
                    assertTrue(abs(left(matrix, factor, a, b)) <= bound + ROUNDING, said)
                }
            }
            assertTrue(factor.columns.size <= most, said)
            assertEquals(factor.columns.size, factor.pivots.toSet().size, said)
            for ((k, pivot) in factor.pivots.withIndex()) {
                // Before a column was added its row lacked most, and more than may be left.
                fun lack(row: Int) = 1 - factor.columns.take(k).sumOf { it[row] * it[row] }
                assertTrue(lack(pivot) >= left - ROUNDING, said)
                assertTrue((0 until rows).all { lack(it) <= lack(pivot) + ROUNDING }, said)
            }
        }
    }

    private companion object {
        /** Of some dozens of numbers below one, over the root of the smallest pivot, 1e-3. */
        const val ROUNDING = 1e-10
    }
}
