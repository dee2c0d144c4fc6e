package stillwater.plan

/**
 * The bounded planner's tree of paths and the queue of its open nodes, in arrays that are used again for every plan.
 *
 * Nodes are numbered in the order in which they are added; 0 is the root. The queue polls the node with the highest
 * priority, and of equal ones the one that was added last, so that a tie is followed in depth. No call allocates once
 * the arrays have grown.
 *
 * @param capacity nodes it holds before it grows.
 */
internal class SearchTree(capacity: Int) {
    private var cells = IntArray(capacity)
    private var parents = IntArray(capacity)
    private var depths = IntArray(capacity)
    private var values = DoubleArray(capacity)
    private var sensors = DoubleArray(capacity)
    private var priorities = DoubleArray(capacity)
    private var heap = IntArray(capacity)
    private var open = 0

    /** Nodes in the tree. */
    var size: Int = 0
        private set

    /** Whether no node waits to be polled. */
    val exhausted: Boolean get() = open == 0

    fun cell(node: Int): Int = cells[node]

    /** The node before [node] on its path; −1 for the root. */
    fun parent(node: Int): Int = parents[node]

    /** Moves from the root to [node]. */
    fun depth(node: Int): Int = depths[node]

    /** Value gathered from the root to [node]. */
    fun value(node: Int): Double = values[node]

    /** The sensor's expected reading on leaving [node]. */
    fun sensor(node: Int): Double = sensors[node]

    /** Times [cell] occurs on the path from the root to [node], both included. O(depth). */
    fun visitsOnPath(node: Int, cell: Int): Int {
        var visits = 0
        var at = node
        while (at >= 0) {
            if (cells[at] == cell) visits++
            at = parents[at]
        }
        return visits
    }

    /** Empties the tree. */
    fun clear() {
        size = 0
        open = 0
    }

    /** Adds a node and puts it into the queue where [queued]. */
    fun add(cell: Int, parent: Int, value: Double, sensor: Double, priority: Double, queued: Boolean) {
        if (size == cells.size) grow()
        val node = size++
        cells[node] = cell
        parents[node] = parent
        depths[node] = if (parent < 0) 0 else depths[parent] + 1
        values[node] = value
        sensors[node] = sensor
        priorities[node] = priority
        if (queued) push(node)
    }

    /** Takes the open node with the highest priority out of the queue. */
    fun poll(): Int {
        check(open > 0) { "poll of an empty queue" }
        val first = heap[0]
        val moved = heap[--open]
        var place = 0
        while (true) {
            var child = 2 * place + 1
            if (child >= open) break
            if (child + 1 < open && before(heap[child + 1], heap[child])) child++
            if (!before(heap[child], moved)) break
            heap[place] = heap[child]
            place = child
        }
        heap[place] = moved
        return first
    }

    private fun push(node: Int) {
        var place = open++
        while (place > 0) {
            val above = (place - 1) / 2
            if (!before(node, heap[above])) break
            heap[place] = heap[above]
            place = above
        }
        heap[place] = node
    }

    private fun before(a: Int, b: Int): Boolean =
        priorities[a] > priorities[b] || (priorities[a] == priorities[b] && a > b)

    private fun grow() {
        val capacity = 2 * size
        cells = cells.copyOf(capacity)
        parents = parents.copyOf(capacity)
        depths = depths.copyOf(capacity)
        values = values.copyOf(capacity)
        sensors = sensors.copyOf(capacity)
        priorities = priorities.copyOf(capacity)
        heap = heap.copyOf(capacity)
    }
}
