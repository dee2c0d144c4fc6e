package stillwater.estimate

import kotlin.math.hypot

/**
 * A short run of a track and the runs of other passes through the same water that it is held against.
 *
 * @property firsts first node of each run, the passes before, the block itself last.
 * @property lengths nodes in each run, in the same order.
 */
internal class RevisitBlock(val firsts: IntArray, val lengths: IntArray) {
    /** First node of the block. */
    val start: Int get() = firsts.last()
}

/**
 * Finds where a track comes back to water it has been in, or near to: crossings, neighbouring legs, casts.
 *
 * A pass is a local minimum in time of the distance to the block's middle. Of the passes not much farther away than
 * passes usually are, the last before the block and the first after it are taken; where one side has none, the first
 * there that is not very far, and where it has none at all, one more of the other.
 *
 * Where a track goes round and round on one course ([isRepeated]) only passes count that go another way or at another speed:
 * those that go as the block does agree with it whatever the sensor's delay, and foretell it so well that the others have
 * no say beside them.
 */
internal class RevisitBlocks(private val nodes: TrackNodes, private val mostBlocks: Int) {
    private class Pass(val node: Int, val distance: Double, val isUnlike: Boolean)

    /** Runs near which all passes go the same way at the same speed; known once blocks are found. */
    var alike: Int = 0
        private set

    /** Whether these are so many that the track goes round and round on one course; known once blocks are found. */
    var isRepeated: Boolean = false
        private set

    /** The blocks in the order of time; empty where the track never comes back, or never another way. */
    fun find(): List<RevisitBlock> {
        val starts = starts()
        val passes = starts.map { passes(it) }
        val nearest = passes.mapNotNull { found -> found.minOfOrNull { it.distance } }.sorted()
        if (nearest.isEmpty()) return emptyList()
        val reach = FARTHEST * nearest[nearest.size / 2] + ownLength(starts)
        val near = passes.map { found -> found.filter { it.distance <= reach } }
        alike = near.count { found -> found.isNotEmpty() && found.none { it.isUnlike } }
        isRepeated = FEW_ALIKE * alike > near.count { it.isNotEmpty() }
        return starts.indices.mapNotNull { i ->
            block(starts[i], if (isRepeated) passes[i].filter { it.isUnlike } else passes[i], reach)
        }
    }

    /** Usual way along a block, m. */
    private fun ownLength(starts: List<Int>): Double {
        val lengths = starts.map { nodes.distance(it, it + BLOCK - 1) }.sorted()
        return if (lengths.isEmpty()) 0.0 else lengths[lengths.size / 2] / 2
    }

    private fun starts(): List<Int> {
        val all = ArrayList<Int>()
        var i = 0
        while (i + BLOCK <= nodes.size) {
            if (nodes.first[i + BLOCK - 1] == nodes.first[i]) {
                all += i
                i += BLOCK
            } else {
                i++
            }
        }
        if (all.size <= mostBlocks) return all
        return List(mostBlocks) { all[(it.toLong() * all.size / mostBlocks).toInt()] }
    }

    private fun passes(start: Int): List<Pass> {
        val x = nodes.xs[start + BLOCK / 2]
        val y = nodes.ys[start + BLOCK / 2]
        val distances = DoubleArray(nodes.size) { hypot(nodes.xs[it] - x, nodes.ys[it] - y) }
        val found = ArrayList<Pass>()
        var i = 0
        while (i < nodes.size) {
            val near = i in start - OWN..start + BLOCK + OWN
            if (!near && isMinimum(distances, i)) {
                found += Pass(i, distances[i], isUnlike(start + BLOCK / 2, i))
                i += BLOCK
            } else {
                i++
            }
        }
        return found
    }

    /** Whether the boat goes through nodes [a] and [b] in other directions, or at other speeds. */
    private fun isUnlike(a: Int, b: Int): Boolean = TrackCrossings.areUnlike(velocity(a), velocity(b))

    /** By as many nodes either way as a block has halves, m/s. */
    private fun velocity(node: Int): Pair<Double, Double> {
        val from = maxOf(nodes.first[node], node - BLOCK / 2)
        var to = minOf(nodes.size - 1, node + BLOCK / 2)
        while (nodes.first[to] != nodes.first[node]) to--
        val time = nodes.times[to] - nodes.times[from]
        if (!(time > 0)) return 0.0 to 0.0
        return (nodes.xs[to] - nodes.xs[from]) / time to (nodes.ys[to] - nodes.ys[from]) / time
    }

    private fun isMinimum(distances: DoubleArray, node: Int): Boolean {
        val here = distances[node]
        for (other in maxOf(0, node - BLOCK)..minOf(nodes.size - 1, node + BLOCK)) {
            if (distances[other] < here || (distances[other] == here && other < node)) return false
        }
        return true
    }

    private fun block(start: Int, passes: List<Pass>, reach: Double): RevisitBlock? {
        val before = passes.filter { it.node < start }.reversed()
        val after = passes.filter { it.node > start }
        val nearBefore = before.filter { it.distance <= reach }
        val nearAfter = after.filter { it.distance <= reach }
        if (nearBefore.isEmpty() && nearAfter.isEmpty()) return null
        val chosen = listOfNotNull(
            nearBefore.firstOrNull() ?: balancing(before, reach),
            nearAfter.firstOrNull() ?: balancing(after, reach),
        ).toMutableList()
        if (chosen.size < 2) (nearBefore.getOrNull(1) ?: nearAfter.getOrNull(1))?.let { chosen += it }
        val ranges = chosen.map { run(it.node, start) }.filter { it.last - it.first + 1 >= FEWEST }
        if (ranges.isEmpty()) return null
        val firsts = ranges.map { it.first } + start
        val lengths = ranges.map { it.last - it.first + 1 } + BLOCK
        return RevisitBlock(firsts.toIntArray(), lengths.toIntArray())
    }

    /**
     * The first of [passes] not beyond some times the [reach], or null. Legs in pairs have their near passes all on one
     * side, where water that lies at a slant looks like a delay; on the other side it looks like the contrary.
     */
    private fun balancing(passes: List<Pass>, reach: Double) = passes.firstOrNull { it.distance <= BALANCING * reach }

    /** Nodes about [node], in its stretch and not in the block at [start]. */
    private fun run(node: Int, start: Int): IntRange {
        var from = maxOf(nodes.first[node], node - RUN / 2)
        var to = minOf(nodes.size - 1, node + RUN / 2 - 1)
        while (nodes.first[to] != nodes.first[node]) to--
        if (node < start) to = minOf(to, start - 1) else from = maxOf(from, start + BLOCK)
        return from..to
    }

    companion object {
        /** Nodes in a block. */
        const val BLOCK = 12

        /** Nodes in a run of another pass. */
        const val RUN = 20

        private const val FEWEST = 6

        /** One run in so many that is passed the same way each time is not chance: of lawnmowers it is one in 40. */
        private const val FEW_ALIKE = 10
        private const val OWN = 2 * BLOCK
        private const val FARTHEST = 1.6
        private const val BALANCING = 3.0
    }
}
