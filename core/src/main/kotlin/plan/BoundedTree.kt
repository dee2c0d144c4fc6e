package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Plan
import kotlin.math.abs

/**
 * The bounded planner's tree of paths and the queue of its open ends, in arrays that are used again for every plan.
 *
 * Most children are never polled, so that a child becomes a node only then, and one move before the horizon only where
 * its neighbours may be wide enough to end the best path. What waits in the queue is a family: children of one node that
 * are worth the same and came one after the other. All children that teach nothing are one; it stays in the queue until
 * its last child is polled. Nodes are numbered as they were polled; node 0 is the root. The queue polls the child with
 * the highest priority, and of equal ones the one that came last, so that a tie is followed in depth. No call allocates
 * once the arrays have grown.
 *
 * @param settings of the planner.
 * @param order in which neighbours become children. Retained.
 */
internal class BoundedTree(private val settings: BoundedPlannerSettings, private val order: NeighbourOrder) {
    private val perMove = settings.priority == Priority.VALUE_PER_MOVE
    private val cells = ReachableCells(order.ways)

    // Nodes.
    private var places = IntArray(FIRST_NODES)
    private var parents = IntArray(FIRST_NODES)
    private var depths = IntArray(FIRST_NODES)
    private var values = DoubleArray(FIRST_NODES)
    private var sensors = DoubleArray(FIRST_NODES)

    // Families: the node they come from and, in the place after it, their directions and one, packed as an order is,
    // the last in the lowest bits; what each child is worth.
    private var origins = IntArray(2 * FIRST_FAMILIES)
    private var worths = DoubleArray(FIRST_FAMILIES)
    private var families = 0
    private val queue = NodeQueue(FIRST_FAMILIES)

    // The path last walked to, by depth, and one more than the times each place occurs on it.
    private var pathNodes = IntArray(FIRST_DEPTH)
    private var pathPlaces = IntArray(FIRST_DEPTH)
    private var pathLength = 0
    private var divisors = DoubleArray(0)

    /** Nodes in the tree. */
    var size: Int = 0
        private set

    /** The best end of a path so far: what it is worth, the node before it and its place. The first of equal ones. */
    private var bestValue = 0.0
    private var bestParent = NONE
    private var bestPlace = 0

    /** The node polled last of those whose path is worth something; the root where none is. */
    private var lastPolled = ROOT

    /** Depth of nodes whose children cannot be expanded; where the original's choice polls them too, none. */
    private val lastBranching = if (settings.choice == PathChoice.BEST) settings.horizon - 1 else NONE

    /** Whether no child waits to be polled. */
    val exhausted: Boolean get() = queue.isEmpty

    /** Whether there is a path to choose. */
    val hasChoice: Boolean
        get() = if (settings.choice == PathChoice.BEST) bestParent != NONE else lastPolled != ROOT

    /** Empties the tree, for a boat in the cell [start] of [map] whose sensor shows [sensor], finite or not. */
    fun begin(map: FieldMap, start: Int, sensor: Double) {
        while (pathLength > 0) divisors[places[pathNodes[--pathLength]]] = 1.0
        // No path has more moves than nodes are polled.
        cells.read(map, start, minOf(settings.horizon, settings.expansions))
        if (divisors.size < cells.places) divisors = DoubleArray(cells.places) { 1.0 }
        queue.clear()
        size = 0
        families = 0
        bestValue = 0.0
        bestParent = NONE
        lastPolled = ROOT
        sensors[ROOT] = sensor
        push(NONE, 1, 0.0, 0.0)
    }

    /** Polls the child with the highest priority and adds its neighbours to its path, unless it is at the horizon. */
    fun advance() {
        val family = queue.peek()
        val parent = origins[2 * family]
        val children = origins[2 * family + 1]
        val others = children ushr BITS
        if (others == 0) queue.poll() else origins[2 * family + 1] = others
        val isRoot = parent == NONE
        val place = if (isRoot) cells.start else places[parent] + cells.steps[(children and MASK) - 1]
        val depth = if (isRoot) 0 else depths[parent] + 1
        val value = worths[family]
        if (depth == lastBranching) {
            // Drawn in any case: the orders that follow depend on it.
            val packed = order.drawn()
            // Neither a visit nor a sensor makes a cell worth more than it is wide.
            if (value + cells.widestBeside[place] > bestValue) finish(add(parent, place, depth, value), packed)
            return
        }
        val node = add(parent, place, depth, value)
        if (value > 0) lastPolled = node
        if (depth < settings.horizon) branch(node, depth + 1)
    }

    private fun add(parent: Int, place: Int, depth: Int, value: Double): Int {
        val node = size++
        if (node == places.size) growNodes()
        places[node] = place
        parents[node] = parent
        depths[node] = depth
        values[node] = value
        if (parent != NONE) sensors[node] = towards(sensors[parent], cells.middles[place])
        return node
    }

    /** What the sensor that entered a cell at [sensor] is expected to show on leaving it. */
    private fun towards(
        sensor: Double,
        middle: Double,
    ): Double = sensor + maxOf(-settings.maxChange, minOf(settings.maxChange, middle - sensor))

    /**
     * Makes the neighbours of [node] its children, of [depth]. The path is walked only where a neighbour that teaches
     * something may lie on it.
     */
    private fun branch(node: Int, depth: Int) {
        val value = values[node]
        val sensor = sensors[node]
        val place = places[node]
        val widths = cells.widths
        val middles = cells.middles
        val steps = cells.steps
        // The family of neighbours that teach nothing.
        val flat = if (perMove) value / depth else value
        var alike = 0
        var walked = !settings.discountVisits
        order.forEach { direction ->
            val next = place + steps[direction]
            val width = widths[next]
            if (width >= 0) {
                val promise = width - abs(middles[next] - sensor)
                var total = value
                if (promise > 0) {
                    if (!walked) walk(node)
                    walked = true
                    total += promise / divisors[next]
                }
                if (total > value) {
                    if (total > bestValue) best(total, node, next)
                    val priority = if (perMove) total / depth else total
                    if (priority == flat && alike != 0) {
                        // Rounding queues this one among them: those that came before it are a family of their own.
                        push(node, alike, value, flat)
                        alike = 0
                    }
                    push(node, direction + 1, total, priority)
                } else {
                    alike = (alike shl BITS) or (direction + 1)
                }
            }
        }
        if (alike != 0) push(node, alike, value, flat)
    }

    /**
     * Looks whether a neighbour of [node], in the order [packed], ends the best path; at the horizon that is all it can
     * do. Mostly none does even if none was visited before, which is looked at first: visits make no cell worth more.
     */
    private fun finish(node: Int, packed: Int) {
        val value = values[node]
        val sensor = sensors[node]
        val place = places[node]
        val widths = cells.widths
        val middles = cells.middles
        val steps = cells.steps
        var any = false
        for (direction in 0 until order.ways) {
            val next = place + steps[direction]
            if (value + (widths[next] - abs(middles[next] - sensor)) > bestValue) any = true
        }
        if (!any) return
        if (settings.discountVisits) walk(node)
        order.forEach(packed) { direction ->
            val next = place + steps[direction]
            val promise = widths[next] - abs(middles[next] - sensor)
            if (promise > 0) {
                val total = value + promise / divisors[next]
                if (total > bestValue) best(total, node, next)
            }
        }
    }

    private fun best(value: Double, parent: Int, place: Int) {
        bestValue = value
        bestParent = parent
        bestPlace = place
    }

    private fun push(parent: Int, directions: Int, value: Double, priority: Double) {
        val family = families++
        if (family == worths.size) growFamilies()
        origins[2 * family] = parent
        origins[2 * family + 1] = directions
        worths[family] = value
        queue.push(family, priority)
    }

    /**
     * Makes the path from the root to [node] the one of [divisors].
     *
     * O(moves that it does not share with the path walked before): the search mostly goes on where it is.
     */
    private fun walk(node: Int) {
        val length = depths[node] + 1
        if (length > pathNodes.size) pathNodes = pathNodes.copyOf(2 * length)
        while (pathLength > length) divisors[places[pathNodes[--pathLength]]]--
        var at = node
        for (depth in length - 1 downTo pathLength) {
            pathNodes[depth] = at
            divisors[places[at]]++
            at = parents[at]
        }
        var depth = pathLength - 1
        while (depth >= 0 && pathNodes[depth] != at) {
            divisors[places[pathNodes[depth]]]--
            divisors[places[at]]++
            pathNodes[depth--] = at
            at = parents[at]
        }
        pathLength = length
    }

    /** Writes the chosen path into [plan]. */
    fun write(plan: Plan) {
        if (settings.choice == PathChoice.BEST) {
            write(bestParent, bestPlace, plan)
        } else {
            write(parents[lastPolled], places[lastPolled], plan)
        }
    }

    private fun write(parent: Int, place: Int, plan: Plan) {
        val length = depths[parent] + 1
        if (length > pathPlaces.size) pathPlaces = pathPlaces.copyOf(2 * length)
        pathPlaces[length - 1] = place
        var at = parent
        for (depth in length - 2 downTo 0) {
            pathPlaces[depth] = places[at]
            at = parents[at]
        }
        for (depth in 0 until length) {
            val cell = cells.cell(pathPlaces[depth])
            plan.add(cells.grid.centerX(cell), cells.grid.centerY(cell))
        }
    }

    private fun growNodes() {
        val capacity = 2 * places.size
        places = places.copyOf(capacity)
        parents = parents.copyOf(capacity)
        depths = depths.copyOf(capacity)
        values = values.copyOf(capacity)
        sensors = sensors.copyOf(capacity)
    }

    private fun growFamilies() {
        val capacity = 2 * worths.size
        origins = origins.copyOf(2 * capacity)
        worths = worths.copyOf(capacity)
    }

    private companion object {
        const val NONE = -1
        const val ROOT = 0
        const val FIRST_NODES = 256
        const val FIRST_FAMILIES = 1024
        const val BITS = NeighbourOrder.BITS
        const val MASK = NeighbourOrder.MASK
        const val FIRST_DEPTH = 16
    }
}
