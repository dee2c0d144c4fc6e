package stillwater.plan

import org.junit.jupiter.api.Test
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class LawnmowerTest {
    private val shapes =
        (1..7).flatMap { columns -> (1..7).map { rows -> columns to rows } } + listOf(10 to 10, 3 to 20)

    /** The tour of [pattern] on every shape that has it, with the moves of one period, the closing one included. */
    private fun forEveryTour(
        pattern: LawnmowerPattern,
        check: (grid: Grid, tour: List<Int>, moves: List<Pair<Int, Int>>) -> Unit,
    ) {
        var checked = 0
        for ((columns, rows) in shapes) {
            val grid = Grid.unit(columns, rows)
            if (!Lawnmower.fits(grid, pattern)) continue
            val tour = Lawnmower.tour(grid, pattern).toList()
            val moves = if (tour.size > 1) tour.zip(tour.drop(1) + tour.first()) else emptyList()
            check(grid, tour, moves)
            checked++
        }
        assertTrue(checked > 20, "$checked shapes")
    }

    @Test
    fun everyPatternVisitsEveryCell() {
        for (pattern in LawnmowerPattern.entries) {
            forEveryTour(pattern) { grid, tour, _ ->
                assertEquals((0 until grid.size).toSet(), tour.toSet(), "$pattern")
            }
        }
    }

    @Test
    fun fourDirectionsEntersEveryCellFromEachOfItsNeighbours() {
        forEveryTour(LawnmowerPattern.FOUR_DIRECTIONS) { grid, _, moves ->
            val all = (0 until grid.size).flatMap { cell -> neighbours(grid, cell).map { it to cell } }
            assertEquals(all.toSet(), moves.toSet(), "${grid.columns} x ${grid.rows}")
        }
    }

    @Test
    fun everyMoveIsAnEdgeStepButTheRastersJumps() {
        for (pattern in LawnmowerPattern.entries - LawnmowerPattern.RASTER) {
            forEveryTour(pattern) { grid, tour, moves ->
                for ((from, to) in moves) {
                    assertTrue(
                        shareAnEdge(grid, from, to),
                        "$pattern $from to $to on ${grid.columns} x ${grid.rows}: $tour",
                    )
                }
            }
        }
        forEveryTour(LawnmowerPattern.RASTER) { grid, _, moves ->
            for ((from, to) in moves) {
                val endOfRow = from % grid.columns == grid.columns - 1
                assertTrue(if (endOfRow) to % grid.columns == 0 else to == from + 1, "$from to $to")
            }
        }
    }

    @Test
    fun theHamiltonianCycleVisitsEveryCellOnce() {
        forEveryTour(LawnmowerPattern.HAMILTONIAN_CYCLE) { grid, tour, _ -> assertEquals(grid.size, tour.size) }
    }

    @Test
    fun theHamiltonianCycleExistsWhereAnyDoes() {
        // A cycle on a chequered board has as many white cells as black ones, and a row of one has no way back.
        for ((columns, rows) in shapes) {
            val exists = columns > 1 && rows > 1 && (columns * rows) % 2 == 0
            val grid = Grid.unit(columns, rows)
            assertEquals(exists, Lawnmower.fits(grid, LawnmowerPattern.HAMILTONIAN_CYCLE), "$columns x $rows")
            if (!exists) {
                val error = assertFailsWith<IllegalArgumentException> {
                    Lawnmower.tour(grid, LawnmowerPattern.HAMILTONIAN_CYCLE)
                }
                assertTrue("$columns x $rows" in error.message.orEmpty(), error.message)
            }
            for (pattern in LawnmowerPattern.entries - LawnmowerPattern.HAMILTONIAN_CYCLE) {
                assertTrue(Lawnmower.fits(grid, pattern))
            }
        }
    }

    @Test
    fun backAndForthTakesEveryMoveInBothDirections() {
        forEveryTour(LawnmowerPattern.BACK_AND_FORTH) { grid, tour, moves ->
            assertEquals(moves.toSet(), moves.map { (from, to) -> to to from }.toSet())
            assertEquals(maxOf(1, 2 * grid.size - 2), tour.size)
        }
    }

    @Test
    fun rowsThenColumnsPassesEveryEdgeOfTheGrid() {
        forEveryTour(LawnmowerPattern.ROWS_THEN_COLUMNS) { grid, _, moves ->
            val passed = moves.flatMap { (from, to) -> listOf(from to to, to to from) }.toSet()
            for (cell in 0 until grid.size) {
                for (neighbour in neighbours(grid, cell)) {
                    assertTrue(cell to neighbour in passed, "$cell to $neighbour on ${grid.columns} x ${grid.rows}")
                }
            }
        }
    }

    @Test
    fun rowsThenColumnsEntersMostCellsFromSeveralSides() {
        forEveryTour(LawnmowerPattern.ROWS_THEN_COLUMNS) { grid, _, moves ->
            if (grid.columns < 3 || grid.rows < 3) return@forEveryTour
            val entries = moves.distinct().groupBy({ it.second }, { it.first })
            for (cell in 0 until grid.size) {
                val sides = entries.getValue(cell).size
                // A corner of an odd grid where a pass ends is turned in once; all others are crossed both ways.
                val corner = neighbours(grid, cell).size == 2
                assertTrue(corner || sides >= 2, "cell $cell of ${grid.columns} x ${grid.rows} from $sides sides")
            }
        }
    }

    @Test
    fun theToursOfASmallGridByHand() {
        // Cells of 3 x 2: 0 1 2 / 3 4 5.
        val grid = Grid.unit(3, 2)
        for ((pattern, tour) in listOf(
            LawnmowerPattern.HAMILTONIAN_CYCLE to listOf(0, 3, 4, 5, 2, 1),
            LawnmowerPattern.BACK_AND_FORTH to listOf(0, 1, 2, 5, 4, 3, 4, 5, 2, 1),
            LawnmowerPattern.RASTER to listOf(0, 1, 2, 3, 4, 5),
        )) {
            assertEquals(tour, Lawnmower.tour(grid, pattern).toList(), "$pattern")
        }
        // 3 x 3: by rows 0 … 8, then by columns from 8.
        assertEquals(
            listOf(0, 1, 2, 5, 4, 3, 6, 7, 8, 5, 2, 1, 4, 7, 6, 3),
            Lawnmower.tour(Grid.unit(3, 3), LawnmowerPattern.ROWS_THEN_COLUMNS).toList(),
        )
    }

    private val plan = Plan()

    private fun Lawnmower.next(columns: Int, rows: Int, cell: Int): Int {
        val map = flatMap(columns, rows)
        plan.add(9.0, 9.0)
        assertEquals(PlanOutcome.Planned, plan(map, map.grid.center(cell), Double.NaN, StopCondition.NEVER, plan))
        return cells(plan, map.grid).single()
    }

    @Test
    fun followsItsTourForEver() {
        for (pattern in LawnmowerPattern.entries) {
            val tour = Lawnmower.tour(Grid.unit(4, 4), pattern).toList()
            val lawnmower = Lawnmower(pattern)
            val driven = generateSequence(0) { lawnmower.next(4, 4, it) }.take(2 * tour.size + 1).toList()
            assertEquals(tour + tour + tour.first(), driven, "$pattern")
        }
    }

    @Test
    fun startsWhereTheBoatIsAndPicksUpAfterItWasMoved() {
        for (pattern in LawnmowerPattern.entries) {
            val tour = Lawnmower.tour(Grid.unit(4, 4), pattern).toList()
            for (cell in 0 until 16) {
                val fresh = Lawnmower(pattern)
                assertEquals(tour[(tour.indexOf(cell) + 1) % tour.size], fresh.next(4, 4, cell), "$pattern from $cell")
            }
            val moved = Lawnmower(pattern)
            var cell = 0
            repeat(3) { cell = moved.next(4, 4, cell) }
            val elsewhere = tour[tour.size - 3]
            assertEquals(tour[tour.indexOf(elsewhere) + 1], moved.next(4, 4, elsewhere), "$pattern")
        }
    }

    @Test
    fun askedAgainBeforeTheBoatLeftItRepeatsTheMove() {
        // On the way back the cell's first visit is on the way there: the direction must not turn.
        for (pattern in LawnmowerPattern.entries) {
            val patient = Lawnmower(pattern)
            val impatient = Lawnmower(pattern)
            var cell = 0
            repeat(40) { move ->
                val next = patient.next(3, 4, cell)
                repeat(3) { assertEquals(next, impatient.next(3, 4, cell), "$pattern, move $move from $cell") }
                cell = next
            }
        }
    }

    @Test
    fun aGridWithoutACycleIsMownBackAndForth() {
        for ((columns, rows) in listOf(3 to 3, 5 to 1, 1 to 4)) {
            val cycle = Lawnmower(LawnmowerPattern.HAMILTONIAN_CYCLE)
            val there = Lawnmower(LawnmowerPattern.BACK_AND_FORTH)
            var cell = 0
            repeat(30) {
                val next = there.next(columns, rows, cell)
                assertEquals(next, cycle.next(columns, rows, cell))
                cell = next
            }
        }
    }

    @Test
    fun aNewMapIsANewTour() {
        val lawnmower = Lawnmower(LawnmowerPattern.RASTER)
        assertEquals(1, lawnmower.next(3, 2, 0))
        assertEquals(2, lawnmower.next(2, 3, 1))
    }

    @Test
    fun aSingleCellHasNowhereToGoAndOffTheMapIsSaid() {
        for (pattern in LawnmowerPattern.entries) {
            plan.add(9.0, 9.0)
            val lawnmower = Lawnmower(pattern)
            val single = flatMap(1, 1)
            assertEquals(
                PlanOutcome.NothingToGain,
                lawnmower.plan(single, Position(0.5, 0.5), 0.5, StopCondition.NEVER, plan),
            )
            assertEquals(0, plan.size)
            for (from in listOf(Position(2.0, 0.5), Position(0.5, Double.NaN))) {
                plan.add(9.0, 9.0)
                assertEquals(PlanOutcome.OffMap, lawnmower.plan(flatMap(2, 2), from, 0.5, StopCondition.NEVER, plan))
                assertEquals(0, plan.size)
            }
        }
    }
}
