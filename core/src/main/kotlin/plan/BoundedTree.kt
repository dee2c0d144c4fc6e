package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Plan
import kotlin.math.abs

/**
 * The bounded planner's tree of paths and the queue of its open ends, in arrays that are used again for every plan.
 *
 * Most children are never polled, so that a child becomes a node only then, and one move before the horizon only where
 * its neighbours may promise enough to end the best path. What waits in the queue is a family: children of one node that
 * are worth the same and came one after the other. All children that teach nothing are one; it stays in the queue until
 * its last child is polled. Nodes are numbered as they were polled; node 0 is the root. The queue polls the child with
 * the highest priority, and of equal ones the one that came last, so that a tie is followed in depth. Where no child of
 * a node, nor what comes after it, can be the best path's end, the children are only counted: what they still do is to
 * use up polls and orders. No call allocates once the arrays have grown.
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

    /**
     * How often the boat was at each place, of those that may be beside a node, before it came to the node: in three
     * bits, here, in [twos] and in [fours], at the place's slot. Seven times, or more often, is the most.
     */
    private var ones = LongArray(FIRST_NODES)
    private var twos = LongArray(FIRST_NODES)
    private var fours = LongArray(FIRST_NODES)
    private var sensors = DoubleArray(FIRST_NODES)

    // Families: the node they come from, or COUNTED, and, in the place after it, their directions and one, packed as an
    // order is, the last in the lowest bits; what each child is worth.
    private var origins = IntArray(2 * FIRST_FAMILIES)
    private var worths = DoubleArray(FIRST_FAMILIES)
    private var families = 0
    private val queue = NodeQueue(FIRST_FAMILIES)

    /** Polls that come next: of counted children that are worth more than all that waits in the queue. */
    private var due = 0

    /**
     * Of the neighbours of a node that teach something, one after the other: what the path to each is worth, and those
     * that teach nothing and came before it, packed.
     */
    private val totals = DoubleArray(NeighbourOrder.ALL)
    private val alikes = IntArray(NeighbourOrder.ALL)

    private var pathPlaces = IntArray(FIRST_DEPTH)

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

    /** Whether each poll draws an order, whatever it polls; where nodes at the horizon are polled, those draw none. */
    private val alwaysDraws = settings.choice == PathChoice.BEST

    /** Whether no child waits to be polled. */
    val exhausted: Boolean get() = queue.isEmpty && due == 0

    /** Whether there is a path to choose. */
    val hasChoice: Boolean
        get() = if (settings.choice == PathChoice.BEST) bestParent != NONE else lastPolled != ROOT

    /** Empties the tree, for a boat in the cell [start] of [map] whose sensor shows [sensor], finite or not. */
    fun begin(map: FieldMap, start: Int, sensor: Double) {
        // No path has more moves than nodes are polled.
        cells.read(map, start, minOf(settings.horizon, settings.expansions))
        queue.clear()
        size = 0
        families = 0
        due = 0
        bestValue = 0.0
        bestParent = NONE
        lastPolled = ROOT
        sensors[ROOT] = sensor
        push(NONE, 1, 0.0, 0.0)
    }

    /** Polls the child with the highest priority and adds its neighbours to its path, unless it is at the horizon. */
    fun advance() {
        // First of all: it waits for nothing that follows, but the neighbours wait for it.
        val drawn = if (alwaysDraws) order.drawn() else 0
        if (due > 0) {
            due--
            return
        }
        val family = queue.peek()
        val parent = origins[2 * family]
        val children = origins[2 * family + 1]
        val others = children ushr BITS
        if (others == 0) queue.poll() else origins[2 * family + 1] = others
        if (parent == COUNTED) return
        val isRoot = parent == NONE
        val place = if (isRoot) cells.start else places[parent] + cells.steps[(children and MASK) - 1]
        val depth = if (isRoot) 0 else depths[parent] + 1
        val value = worths[family]
        val sensor = if (isRoot) sensors[ROOT] else leaving(sensors[parent], cells.middles[place])
        if (depth == lastBranching) {
            // Visits make no cell worth more. A sum that is no number tells nothing.
            if (!(value + promisedBeside(place, sensor) <= bestValue)) {
                finish(add(parent, place, depth, sensor), place, value, sensor, drawn)
            }
            return
        }
        val node = add(parent, place, depth, sensor)
        if (value > 0) lastPolled = node
        if (depth + 1 == lastBranching && value + cells.widest + cells.widest <= bestValue) {
            count(node, place, depth + 1, value, sensor)
        } else if (depth < settings.horizon) {
            branch(node, place, depth + 1, value, sensor, if (alwaysDraws) drawn else order.drawn())
        }
    }

    /** No cell beside [place] promises more than this to a [sensor] that leaves it. */
    private fun promisedBeside(place: Int, sensor: Double): Double =
        cells.promisedBeside[place] + abs(sensor - cells.middles[place])

    /** Whether no cell beside [place] teaches a [sensor] that leaves it anything, for certain. */
    private fun isDull(place: Int, sensor: Double): Boolean =
        cells.promisedBeside[place] <= 0 && abs(sensor - cells.middles[place]) <= cells.slack

    private fun add(parent: Int, place: Int, depth: Int, sensor: Double): Int {
        val node = size++
        if (node == places.size) growNodes()
        places[node] = place
        parents[node] = parent
        depths[node] = depth
        sensors[node] = sensor
        if (parent != NONE && settings.discountVisits) {
            visit(node, parent)
        } else {
            ones[node] = 0L
            twos[node] = 0L
            fours[node] = 0L
        }
        return node
    }

    /** Counts the visit of [parent]'s place for [node]; seven stay seven. */
    private fun visit(node: Int, parent: Int) {
        val slot = 1L shl (places[parent] ushr cells.slotShift)
        // From edge to edge the other places are not beside the node.
        val before = if (cells.slotShift == 1) parents[parent] else parent
        val one = if (before == NONE) 0L else ones[before]
        val two = if (before == NONE) 0L else twos[before]
        val four = if (before == NONE) 0L else fours[before]
        val carry = one and slot
        val carryOn = two and carry
        val full = four and carryOn
        ones[node] = (one xor slot) or full
        twos[node] = (two xor carry) or full
        fours[node] = four or carryOn
    }

    /** What the [sensor] is expected to show on leaving a place whose bounds have that [middle]. */
    private fun leaving(sensor: Double, middle: Double): Double =
        sensor + maxOf(-settings.maxChange, minOf(settings.maxChange, middle - sensor))

    /**
     * Makes the neighbours of [node] its children, of [depth], in the order [packed].
     *
     * Which of them teach something is anybody's guess, the processor's too: they are told apart without a jump, and
     * queued when it is known how many they are.
     */
    private fun branch(node: Int, place: Int, depth: Int, value: Double, sensor: Double, packed: Int) {
        val one = ones[node]
        val two = twos[node]
        val four = fours[node]
        val widths = cells.widths
        val middles = cells.middles
        val steps = cells.steps
        // The family of neighbours that teach nothing.
        val flat = if (perMove) value / depth else value
        var alike = 0
        if (isDull(place, sensor)) {
            order.forEach(packed) { direction ->
                val isCell = cellMask(widths[place + steps[direction]])
                alike = (alike shl (isCell and BITS)) or (direction + 1 and isCell)
            }
            if (alike != 0) push(node, alike, value, flat)
            return
        }
        val totals = totals
        val alikes = alikes
        var teaching = 0
        var found = 0
        order.forEach(packed) { direction ->
            val next = place + steps[direction]
            val width = widths[next]
            // Below the value where it promises less than nothing, as the rim does.
            val total = value + discounted(width - abs(middles[next] - sensor), node, next, one, two, four)
            totals[found] = total
            alikes[found] = alike
            val teaches = if (total > value) ALL_BITS else 0
            teaching = teaching or ((direction + 1 and teaches) shl BITS * found)
            found -= teaches
            val isAlike = cellMask(width) and teaches.inv()
            alike = (alike shl (isAlike and BITS)) or (direction + 1 and isAlike)
        }
        val length = length(alike)
        for (i in 0 until found) {
            val total = totals[i]
            val direction = (teaching and MASK) - 1
            teaching = teaching ushr BITS
            if (total > bestValue) best(total, node, place + steps[direction])
            val priority = if (perMove) total / depth else total
            if (priority == flat) {
                // Rounding queues this one among them: those that came before it are a family of their own.
                val later = length - length(alikes[i])
                val before = alike ushr later
                if (before != 0) push(node, before, value, flat)
                alike = alike and (1 shl later) - 1
            }
            push(node, direction + 1, total, priority)
        }
        if (alike != 0) push(node, alike, value, flat)
    }

    /** All bits set where a [width] is that of a cell, none in the rim, where it is less than 0. */
    private fun cellMask(width: Double): Int = (width.toRawBits() ushr Long.SIZE_BITS - 1).toInt() - 1

    /** The bits that the directions in [packed] take, each with one added. */
    private fun length(packed: Int): Int = Int.SIZE_BITS - packed.countLeadingZeroBits() / BITS * BITS

    /**
     * Counts the neighbours of [node] as its children, of [depth], which is one move before the horizon, where none of
     * them can end the best path. In which order they are polled then makes no difference. Seldom called: written out,
     * it stays out of its caller's code, which is faster without it.
     */
    private fun count(node: Int, place: Int, depth: Int, value: Double, sensor: Double) {
        val one = ones[node]
        val two = twos[node]
        val four = fours[node]
        val widths = cells.widths
        val middles = cells.middles
        val steps = cells.steps
        val waiting = queue.bestPriority
        var alike = 0
        order.forEachAsNumbered { direction ->
            val next = place + steps[direction]
            val width = widths[next]
            if (width >= 0) {
                val promise = width - abs(middles[next] - sensor)
                var total = value
                if (promise > 0) total += discounted(promise, node, next, one, two, four)
                val priority = if (perMove) total / depth else total
                if (priority >= waiting) {
                    due++
                } else if (total > value) {
                    push(COUNTED, 1, total, priority)
                } else {
                    alike = (alike shl BITS) or 1
                }
            }
        }
        if (alike != 0) push(COUNTED, alike, value, if (perMove) value / depth else value)
    }

    /**
     * Looks whether a neighbour of [node], in the order [packed], ends the best path; at the horizon that is all it can
     * do. None that teaches nothing does: the path to [node] itself is worth no more than the best.
     */
    private fun finish(node: Int, place: Int, value: Double, sensor: Double, packed: Int) {
        val one = ones[node]
        val two = twos[node]
        val four = fours[node]
        val widths = cells.widths
        val middles = cells.middles
        val steps = cells.steps
        order.forEach(packed) { direction ->
            val next = place + steps[direction]
            val promise = widths[next] - abs(middles[next] - sensor)
            val total = value + discounted(promise, node, next, one, two, four)
            if (total > bestValue) best(total, node, next)
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
     * What is left of [promise], which may be below 0, for a boat that goes to [place] from [node], when its visits on the
     * path are taken into account, of which [one], [two] and [four] are the node's bits.
     *
     * The path is gone through only where the boat was there very often, or where another place on the path may have the
     * same slot; and not for a promise below 0, which stays below 0 whatever it is divided by.
     */
    private fun discounted(promise: Double, node: Int, place: Int, one: Long, two: Long, four: Long): Double {
        val slot = place ushr cells.slotShift
        val count = ((one ushr slot) and 1L) + 2 * ((two ushr slot) and 1L) + 4 * ((four ushr slot) and 1L)
        val isCertain = count < cells.uncertainVisits || promise <= 0
        return promise / (1 + if (isCertain) count.toInt() else visits(node, place))
    }

    /** How often [place] occurs on the path to the node [last]. O(moves). */
    private fun visits(last: Int, place: Int): Int {
        var count = 0
        var at = last
        while (at != NONE) {
            if (places[at] == place) count++
            at = parents[at]
        }
        return count
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
        ones = ones.copyOf(capacity)
        twos = twos.copyOf(capacity)
        fours = fours.copyOf(capacity)
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

        const val ALL_BITS = -1

        /** Instead of a family's node: its children are only counted. */
        const val COUNTED = -2

        const val FIRST_NODES = 256
        const val FIRST_FAMILIES = 1024
        const val BITS = NeighbourOrder.BITS
        const val MASK = NeighbourOrder.MASK
        const val FIRST_DEPTH = 16
    }
}
