package stillwater.plan

import org.junit.jupiter.api.Test
import stillwater.property.drawn
import stillwater.property.forEvery
import java.util.PriorityQueue
import kotlin.math.pow
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class NodeQueueTest {
    private class Node(val index: Int, val priority: Double)

    private val kinds = listOf<(Random) -> Double>(
        // All in one bucket and nearly all different; few and many ties; all sizes there are; zeros.
        { 1 + 1e-6 * it.nextDouble() },
        { it.nextInt(3) * 0.25 },
        { it.nextDouble() },
        { 10.0.pow(it.nextInt(-320, 309)) },
        { if (it.nextBoolean()) 0.0 else it.nextInt(2) * 1e-3 },
        { Double.MAX_VALUE * it.nextInt(1, 3) },
    )

    @Test
    fun pollsWhatAPriorityQueuePolls() {
        forEvery(drawn { it.nextLong() }, cases = 200) { seed ->
            val random = Random(seed)
            val queue = NodeQueue(capacity = 1 + random.nextInt(8))
            for (kind in kinds) {
                queue.clear()
                val oracle = PriorityQueue(compareByDescending<Node> { it.priority }.thenByDescending { it.index })
                var pushed = 0
                repeat(500) {
                    if (oracle.isNotEmpty() && random.nextInt(5) < 2) {
                        assertEquals(oracle.poll().index, queue.poll(), "seed $seed")
                    } else {
                        val node = Node(pushed++, kind(random))
                        oracle += node
                        queue.push(node.index, node.priority)
                    }
                    assertEquals(oracle.isEmpty(), queue.isEmpty)
                }
                while (oracle.isNotEmpty()) assertEquals(oracle.poll().index, queue.poll(), "seed $seed")
                assertTrue(queue.isEmpty)
            }
        }
    }

    @Test
    fun whatIsNoNumberGoesLastAndNothingIsLost() {
        val queue = NodeQueue(capacity = 1)
        listOf(Double.NaN, 1.0, Double.POSITIVE_INFINITY, -1.0, Double.NaN).forEachIndexed(queue::push)
        assertEquals(listOf(2, 1), List(2) { queue.poll() })
        assertEquals(setOf(0, 3, 4), List(3) { queue.poll() }.toSet())
        assertTrue(queue.isEmpty)
    }
}
