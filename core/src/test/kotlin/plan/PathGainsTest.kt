package stillwater.plan

import stillwater.field.FieldMap
import stillwater.field.SpatialCorrelation
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals

class PathGainsTest {
    private val gains = PathGains()
    private val gaussian = SpatialCorrelation { columns, rows -> exp(-(columns * columns + rows * rows) / 8.0) }

    private fun map(random: Random, correlation: SpatialCorrelation?) = randomMap(random, 7, 6).also {
        for (cell in 0 until it.grid.size) if (random.nextInt(3) == 0) it.countVisit(cell)
        it.correlation = correlation
    }

    /** The same in the plainest way: all widths anew for each visit. */
    private class Naive(val map: FieldMap) {
        val grid: Grid = map.grid
        val widths = DoubleArray(grid.size) { maxOf(0.0, map.upper(it) - map.lower(it)) }
        val visits = IntArray(grid.size) { map.visits(it) }

        fun visit(cell: Int): Double {
            val before = widths.sum()
            val own = widths[cell]
            val count = visits[cell]++
            widths[cell] = own * sqrt(count / (count + 1.0))
            val correlation = map.correlation
            if (count > 0 || correlation == null) return before - widths.sum()
            for (other in widths.indices) {
                val columns = other % 7 - cell % 7
                val rows = other / 7 - cell / 7
                if (visits[other] > 0 || columns !in -3..3 || rows !in -3..3) continue
                val rho = correlation.between(columns, rows)
                if (rho * rho < 0.05) continue
                val part = if (own < widths[other]) own / widths[other] else 1.0
                widths[other] *= 1 - (1 - sqrt(1 - rho * rho)) * part
            }
            return before - widths.sum()
        }
    }

    @Test
    fun aPathTakesAwayWhatThePlainestWayTakes() {
        for (seed in 1..50) {
            val random = Random(seed)
            val map = map(random, if (seed % 3 == 0) null else gaussian)
            val naive = Naive(map)
            gains.begin(map)
            repeat(15) {
                val cell = random.nextInt(map.grid.size)
                // Sums of 42 numbers of at most 1.
                assertEquals(naive.visit(cell), gains.visit(cell), 1e-13, "seed $seed")
            }
            for (cell in 0 until map.grid.size) assertEquals(naive.widths[cell], gains.width(cell), 1e-15)
        }
    }

    @Test
    fun whatIsTakenBackLeavesNoTrace() {
        val random = Random(1)
        val map = map(random, gaussian)
        gains.begin(map)
        val first = gains.visit(20)
        val mark = gains.mark()
        val second = List(30) { gains.visit(it) }
        gains.undo(mark)
        assertEquals(second, List(30) { gains.visit(it) })
        gains.undo(0)
        assertEquals(first, gains.visit(20))
    }

    @Test
    fun widthsThatAreNoneCountAsNone() {
        val map = FieldMap(Grid.unit(2, 2), Interval.UNIT)
        map.setBounds(0, Double.NaN, 1.0)
        map.setBounds(1, 0.7, 0.3)
        map.setBounds(2, Double.NEGATIVE_INFINITY, 1.0)
        gains.begin(map)
        assertEquals(listOf(0.0, 0.0), listOf(gains.visit(0), gains.visit(1)))
        assertEquals(1e100, gains.visit(2))
    }
}
