package stillwater.diagnose.blind

import stillwater.diagnose.SineTrack
import stillwater.diagnose.algebra.dot
import stillwater.diagnose.algebra.squares
import kotlin.math.abs
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals

/** Products of jumps are told without making a column of each, and are those of the columns. */
class BlindJumpTest {
    private val n = 150
    private val fit = SineTrack(n).fit(BooleanArray(n) { it !in 60..62 })
    private val rows = listOf(3, 40, 41, 61, 62, 100, n - 1)
    private val columns = rows.map { row -> fit.unlike(DoubleArray(n) { if (it >= row) 1.0 else 0.0 }) }
    private val rest = DoubleArray(n) { sin(it * it / 3.0) }

    private fun assertNear(expected: Double, found: Double, which: String) =
        // Some hundred roundings of sums of a hundred numbers near one.
        assertEquals(expected, found, 1e-11 * (1 + abs(expected)), which)

    @Test
    fun theyAreThoseOfTheColumns() {
        val jumps = fit.jumps(rows)
        val explained = BlindJump.Rest(fit, rest)
        for (a in rows.indices) {
            assertNear(squares(columns[a]), jumps[a].length, "row ${rows[a]}")
            assertNear(dot(columns[a], rest), jumps[a].product(explained), "row ${rows[a]}")
            val products = jumps[a].products(jumps)
            for (b in rows.indices) {
                assertNear(dot(columns[a], columns[b]), jumps[a].product(jumps[b]), "rows ${rows[a]}, ${rows[b]}")
                assertNear(dot(columns[a], columns[b]), products[b], "rows ${rows[a]}, ${rows[b]} of all")
            }
        }
    }

    @Test
    fun whatTheWaterForetellsOfARowIsTheSameOfManyAtOnce() {
        val halves = fit.halfRows(20, 30)
        val design = fit.design.rows(20, 30)
        for (i in 0 until 10) {
            val row = DoubleArray(design.size) { design[it][i] }
            assertNear(dot(row, fit.solved(row)), halves.sumOf { it[i] * it[i] }, "row $i")
        }
    }
}
