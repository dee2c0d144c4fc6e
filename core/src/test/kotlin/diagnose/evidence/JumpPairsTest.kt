package stillwater.diagnose.evidence

import stillwater.diagnose.algebra.dot
import stillwater.diagnose.algebra.squares
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNull

class JumpPairsTest {
    private val random = Random(SEED)
    private val n = 40
    private val rows = listOf(3, 9, 14, 22, 30)
    private val columns = rows.map { row -> DoubleArray(n) { if (it >= row) 1.0 else 0.0 } }

    private fun best(rest: DoubleArray, apart: Int) = JumpPairs.best(
        rows,
        apart,
        DoubleArray(rows.size) { dot(columns[it], rest) },
        DoubleArray(rows.size) { squares(columns[it]) },
    ) { i, j -> dot(columns[i], columns[j]) }

    @Test
    fun whatTwoGainIsTheSquareSumOfTheirFit() {
        val rest = DoubleArray(n) { random.nextDouble() - 0.5 }
        for (i in rows.indices) {
            for (j in i + 1 until rows.size) {
                val basis = Evidence.orthonormal(listOf(columns[i], columns[j]))
                val gain = JumpPairs.gain(
                    dot(columns[i], rest),
                    dot(columns[j], rest),
                    squares(columns[i]),
                    squares(columns[j]),
                    dot(columns[i], columns[j]),
                )
                assertEquals(basis.sumOf { dot(it, rest) * dot(it, rest) }, gain, 1e-12, "$i, $j, seed $SEED")
            }
        }
    }

    @Test
    fun twoThatUndoEachOtherAreFound() {
        val rest = DoubleArray(n) { (if (it in 14 until 22) 1.0 else 0.0) + 0.1 * random.nextDouble() }
        assertEquals(14 to 22, best(rest, apart = 1), "seed $SEED")
    }

    @Test
    fun twoThatAreNearerThanAllowedAreNot() {
        val rest = DoubleArray(n) { if (it in 9 until 14) 1.0 else 0.0 }
        assertEquals(9 to 14, best(rest, apart = 5))
        assertEquals(3 to 14, best(rest, apart = 6))
        assertNull(best(rest, apart = n))
    }

    @Test
    fun twoThatAreTheSameGainNothing() {
        assertEquals(0.0, JumpPairs.gain(1.0, 1.0, 2.0, 2.0, 2.0))
        assertEquals(0.0, JumpPairs.gain(1.0, 0.0, 2.0, 0.0, 0.0))
    }

    private companion object {
        const val SEED = 20261127L
    }
}
