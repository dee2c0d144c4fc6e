package stillwater.estimate

/**
 * Groups of blocks, over which evidence is counted, and how much each block counts.
 *
 * Blocks of a track follow each other through ever other water, and groups are of [GROUP] or more neighbours in time. Where a
 * track goes round and round on one course the same few places are passed another way each time, and what they say
 * is the same each time: a group is then a place, and its blocks count together as one.
 *
 * @property of group of each block. @property count number of groups, 0 without blocks. @property weights what a block
 * counts, 1 at the most.
 */
internal class RevisitGroups private constructor(val of: IntArray, val count: Int, val weights: DoubleArray) {
    /** Whether groups are places, passed again and again. */
    val arePlaces: Boolean get() = weights.any { it < 1 }

    companion object {
        private const val GROUP = 6
        private const val MOST_GROUPS = 20

        /** Of fewer places scatter tells no response from another, and three groups rule out none. */
        private const val FEW_PLACES = 8
        private const val NOT_RULING = 3

        /** Groups of the [blocks] of [nodes], of a track that goes round and round if it [isRepeated]. */
        fun of(nodes: TrackNodes, blocks: List<RevisitBlock>, isRepeated: Boolean): RevisitGroups = when {
            blocks.isEmpty() -> RevisitGroups(IntArray(0), 0, DoubleArray(0))
            isRepeated -> byPlace(nodes, blocks)
            else -> inTime(blocks.size)
        }

        private fun inTime(blocks: Int): RevisitGroups {
            val count = (blocks / GROUP).coerceIn(2, MOST_GROUPS)
            val of = IntArray(blocks) { (it.toLong() * count / blocks).toInt() }
            return RevisitGroups(of, count, DoubleArray(blocks) { 1.0 })
        }

        /** Blocks whose middles are no farther apart than a block is long are at one place. */
        private fun byPlace(nodes: TrackNodes, blocks: List<RevisitBlock>): RevisitGroups {
            val lengths = blocks.map { nodes.distance(it.start, it.start + RevisitBlocks.BLOCK - 1) }.sorted()
            val reach = lengths[lengths.size / 2]
            val centres = ArrayList<Int>()
            val places = IntArray(blocks.size) { index ->
                val middle = blocks[index].start + RevisitBlocks.BLOCK / 2
                val known = centres.indexOfFirst { nodes.distance(it, middle) <= reach }
                if (known >= 0) known else centres.size.also { centres += middle }
            }
            val counts = IntArray(centres.size).also { for (place in places) it[place]++ }
            val groups = centres.size.coerceIn(2, if (centres.size < FEW_PLACES) NOT_RULING else MOST_GROUPS)
            return RevisitGroups(
                IntArray(blocks.size) { places[it] % groups },
                groups,
                DoubleArray(blocks.size) { 1.0 / counts[places[it]] },
            )
        }
    }
}
