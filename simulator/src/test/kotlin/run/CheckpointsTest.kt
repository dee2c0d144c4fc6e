package stillwater.run

import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.ValueSource
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class CheckpointsTest {
    @Test
    fun namedOnesAreTheIssues() {
        assertEquals(listOf(50, 100, 200, 500, 1000, 2000), Checkpoints.NAMED)
    }

    @ParameterizedTest
    @ValueSource(ints = [1, 2, 9, 10, 49, 50, 51, 500, 999, 2000, 2001, 100_000_000, Int.MAX_VALUE])
    fun theyAscendFromTheFirstMoveToTheLastWithTheNamedAmongThem(moves: Int) {
        val checkpoints = Checkpoints.upTo(moves)
        assertEquals(checkpoints.sorted().distinct(), checkpoints)
        assertEquals(1, checkpoints.first())
        assertEquals(moves, checkpoints.last())
        val due = Checkpoints.NAMED.filter { it <= moves }
        assertTrue(checkpoints.containsAll(due), "$due are not all in $checkpoints")
    }

    @Test
    fun aDecadeHasAboutADozen() {
        assertEquals(
            listOf(100, 120, 150, 200, 250, 300, 400, 500, 600, 700, 800, 900),
            Checkpoints.upTo(2000).filter { it in 100 until 1000 },
        )
        assertEquals((1..9).toList(), Checkpoints.upTo(2000).filter { it < 10 })
    }

    @Test
    fun aTrialOfOneMoveHasOneCheckpoint() {
        assertEquals(listOf(1), Checkpoints.upTo(1))
    }
}
