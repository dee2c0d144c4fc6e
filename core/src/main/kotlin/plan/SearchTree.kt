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
    private val queue = NodeQueue(capacity)

    // The path last walked to, by depth, and how often each cell occurs on it.
    private var pathNodes = IntArray(FIRST_DEPTH) { NONE }
    private var pathLength = 0
    private var visits = IntArray(0)

    /** Nodes in the tree. */
    var size: Int = 0
        private set

    /** Whether no node waits to be polled. */
    val exhausted: Boolean get() = queue.isEmpty

    fun cell(node: Int): Int = cells[node]

    /** The node before [node] on its path; −1 for the root. */
    fun parent(node: Int): Int = parents[node]

    /** Moves from the root to [node]. */
    fun depth(node: Int): Int = depths[node]

    /** Value gathered from the root to [node]. */
    fun value(node: Int): Double = values[node]

    /** The sensor's expected reading on leaving [node]. */
    fun sensor(node: Int): Double = sensors[node]

    /** Times [cell] occurs on the path last [walk]ed, both ends included. O(1). */
    fun visitsOnPath(cell: Int): Int = visits[cell]

    /**
     * Makes the path from the root to [node] the one of [visitsOnPath].
     *
     * O(moves that it does not share with the path walked before): the search mostly goes on where it is.
     */
    fun walk(node: Int) {
        val length = depths[node] + 1
        if (length > pathNodes.size) pathNodes = pathNodes.copyOf(2 * length)
        while (pathLength > length) visits[cells[pathNodes[--pathLength]]]--
        var at = node
        for (depth in length - 1 downTo pathLength) {
            pathNodes[depth] = at
            visits[cells[at]]++
            at = parents[at]
        }
        var depth = pathLength - 1
        while (depth >= 0 && pathNodes[depth] != at) {
            visits[cells[pathNodes[depth]]]--
            visits[cells[at]]++
            pathNodes[depth--] = at
            at = parents[at]
        }
        pathLength = length
    }

    /** Empties the tree, for a map of [gridSize] cells. */
    fun clear(gridSize: Int) {
        while (pathLength > 0) visits[cells[pathNodes[--pathLength]]]--
        if (visits.size < gridSize) visits = IntArray(gridSize)
        size = 0
        queue.clear()
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
        if (queued) queue.push(node, priority)
    }

    /** Takes the open node with the highest priority out of the queue. */
    fun poll(): Int = queue.poll()

    private fun grow() {
        val capacity = 2 * size
        cells = cells.copyOf(capacity)
        parents = parents.copyOf(capacity)
        depths = depths.copyOf(capacity)
        values = values.copyOf(capacity)
        sensors = sensors.copyOf(capacity)
    }

    private companion object {
        const val NONE = -1
        const val FIRST_DEPTH = 16
    }
}
