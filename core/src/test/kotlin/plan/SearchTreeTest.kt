package stillwater.plan

import org.junit.jupiter.api.Test
import stillwater.property.drawn
import stillwater.property.forEvery
import java.util.PriorityQueue
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class SearchTreeTest {
    private class Node(val index: Int, val priority: Double)

    @Test
    fun pollsInTheOrderOfAPriorityQueue() {
        forEvery(drawn { it.nextLong() }, cases = 300) { seed ->
            val random = Random(seed)
            val tree = SearchTree(capacity = 1 + random.nextInt(8))
            // Of equal priorities the one added last.
            val queue = PriorityQueue(compareByDescending<Node> { it.priority }.thenByDescending { it.index })
            repeat(2) {
                tree.clear(gridSize = 1)
                queue.clear()
                var added = 0
                repeat(400) {
                    if (queue.isNotEmpty() && random.nextInt(5) < 2) {
                        assertEquals(queue.poll().index, tree.poll(), "seed $seed")
                    } else {
                        // Few distinct priorities: many ties.
                        val priority = random.nextInt(6) * 0.25
                        val queued = random.nextInt(4) > 0
                        tree.add(cell = 0, parent = added - 1, value = 0.0, sensor = 0.0, priority, queued)
                        if (queued) queue += Node(added, priority)
                        added++
                    }
                    assertEquals(queue.isEmpty(), tree.exhausted)
                    assertEquals(added, tree.size)
                }
                while (queue.isNotEmpty()) assertEquals(queue.poll().index, tree.poll(), "seed $seed")
                assertTrue(tree.exhausted)
            }
        }
    }

    @Test
    fun keepsWhatANodeIsWhileItGrows() {
        val tree = SearchTree(capacity = 1)
        tree.clear(gridSize = 8)
        val parents = List(200) { if (it == 0) -1 else it / 3 }
        for (node in 0 until 200) {
            tree.add(node % 7, parents[node], node * 0.5, -node * 0.25, priority = node * 1.0, queued = true)
        }
        for (node in 0 until 200) {
            assertEquals(node % 7, tree.cell(node))
            assertEquals(parents[node], tree.parent(node))
            assertEquals(node * 0.5, tree.value(node), 0.0)
            assertEquals(-node * 0.25, tree.sensor(node), 0.0)
            val path = generateSequence(node) { parents[it] }.takeWhile { it >= 0 }.toList()
            assertEquals(path.size - 1, tree.depth(node))
            tree.walk(node)
            for (cell in 0 until 8) assertEquals(path.count { it % 7 == cell }, tree.visitsOnPath(cell))
        }
        assertEquals(List(200) { 199 - it }, List(200) { tree.poll() })
    }

    @Test
    fun theVisitsOfAPathDoNotDependOnThePathWalkedBefore() {
        val random = Random(9)
        val tree = SearchTree(capacity = 4)
        tree.clear(gridSize = 5)
        // Chains with few branches: paths of up to a hundred moves, many of which share most of their way.
        val parents = List(300) { if (it == 0) -1 else maxOf(0, it - 1 - random.nextInt(4)) }
        parents.forEachIndexed { node, parent -> tree.add(node * 7 % 5, parent, 0.0, 0.0, 0.0, queued = false) }
        repeat(2000) {
            val node = random.nextInt(300)
            tree.walk(node)
            val path = generateSequence(node) { parents[it] }.takeWhile { it >= 0 }.toList()
            for (cell in 0 until 5) assertEquals(path.count { it * 7 % 5 == cell }, tree.visitsOnPath(cell))
        }
    }

    @Test
    fun clearEmptiesTheQueueToo() {
        val tree = SearchTree(capacity = 4)
        tree.clear(gridSize = 3)
        repeat(3) { tree.add(it, it - 1, 0.0, 0.0, 0.0, queued = true) }
        tree.walk(2)
        tree.clear(gridSize = 3)
        assertEquals(listOf(0, 0, 0), List(3) { tree.visitsOnPath(it) })
        assertEquals(0, tree.size)
        assertTrue(tree.exhausted)
        assertFailsWith<IllegalStateException> { tree.poll() }
    }
}
