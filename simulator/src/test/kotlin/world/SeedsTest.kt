package stillwater.world

import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotEquals
import kotlin.test.assertTrue

class SeedsTest {
    private fun Random.start() = List(8) { nextLong() }

    @Test
    fun theSameNameGivesTheSameStream() {
        assertEquals(Seeds(7).random("field", 3).start(), Seeds(7).random("field", 3).start())
    }

    @Test
    fun everyPartOfTheNameMatters() {
        val seeds = Seeds(7)
        val streams = listOf(
            seeds.random("field", 3),
            seeds.random("field", 4),
            seeds.random("fields", 3),
            seeds.random("noise", 3),
            seeds.random("field"),
            seeds.random("field", 3, 0),
            seeds.random("field", 0, 3),
            Seeds(8).random("field", 3),
        ).map { it.start() }
        assertEquals(streams.distinct(), streams)
    }

    @Test
    fun theOrderOfAskingDoesNotMatter() {
        val forwards = Seeds(1).let { seeds -> (0 until 20).map { seeds.random("a", it).start() } }
        val backwards = Seeds(1).let { seeds -> (19 downTo 0).map { seeds.random("a", it).start() } }
        assertEquals(forwards, backwards.reversed())
    }

    @Test
    fun drawingFromOneStreamLeavesTheOthersAlone() {
        val seeds = Seeds(1)
        val untouched = seeds.random("b").start()
        val one = seeds.random("a")
        repeat(1000) { one.nextLong() }
        assertEquals(untouched, seeds.random("b").start())
    }

    @Test
    fun neighbouringSeedsAndNumbersAreUnrelated() {
        for (streams in listOf(
            List(COUNT) { Seeds(it.toLong()).random("field", 0).nextDouble() },
            List(COUNT) { Seeds(1).random("field", it).nextDouble() },
        )) {
            // Four standard errors of the mean of uniform numbers, whose standard deviation is 1/√12; one fixed draw.
            assertEquals(0.5, streams.average(), 4 / sqrt(12.0 * COUNT))
            // The correlation of n pairs of unrelated numbers has the standard error 1/√n; four of them.
            val lagged = streams.zipWithNext { a, b -> (a - 0.5) * (b - 0.5) * 12 }.average()
            assertTrue(lagged in -4 / sqrt(COUNT.toDouble())..4 / sqrt(COUNT.toDouble()), "correlation $lagged")
        }
    }

    @Test
    fun zeroAndExtremeSeedsAreSeedsLikeAnyOther() {
        val starts = listOf(0L, 1L, -1L, Long.MIN_VALUE, Long.MAX_VALUE).map { Seeds(it).random("").start() }
        assertEquals(starts.distinct(), starts)
        for (start in starts) assertNotEquals(List(8) { 0L }, start)
    }

    private companion object {
        const val COUNT = 10_000
    }
}
