package stillwater.plan

/**
 * A queue of numbered nodes that polls the one with the highest priority, and of equal ones the one with the highest
 * number. Nodes must be pushed in the order of their numbers. A priority that is not above 0, or no number, counts as 0.
 *
 * Priorities are sorted into [BUCKETS] buckets by their first bits, [PER_OCTAVE] to a factor of two; each bucket is a
 * pairing heap, so that even if all priorities fall into one of them a poll takes O(log n) on average. A push is O(1),
 * and so is a poll where buckets hold few. Where a node goes, and whether its bucket was empty, are anybody's guess, the
 * processor's too: no jump depends on them, and an empty bucket has a node that is below all. No call allocates once the
 * arrays have grown. Source: Fredman, Sedgewick, Sleator and Tarjan 1986, doi:10.1007/BF01840439, the two-pass variant;
 * Dial 1969, doi:10.1145/363269.363610, for the buckets.
 *
 * @param capacity nodes it holds before it grows.
 */
internal class NodeQueue(capacity: Int) {
    // Nodes have their numbers plus one here: place 0 is the node that is below all, which no link of another leads from.

    /** The bits of each node's priority, which are in the order of the priorities. */
    private var keys = LongArray(capacity + 1).also { it[NONE] = BELOW_ALL }

    /** First child of a node, and in the place after it the next child of its parent. */
    private var links = IntArray(2 * (capacity + 1))

    /** The best node of each bucket; a bit of [filled] says which have one, one of [groups] which words have such a bit. */
    private val heads = IntArray(BUCKETS)
    private val filled = LongArray(BUCKETS / WORD)
    private var groups = 0L

    /** First bits of the priority that belongs to bucket 0; set by the first priority above 0. */
    private var lowest = UNSET

    /** The best bucket that has a node, known before the next poll asks for it; [EMPTY] where none has. */
    private var top = EMPTY

    /** Whether no node waits. */
    val isEmpty: Boolean get() = top < 0

    /** Priority of the best node; less than 0 where none waits. */
    val bestPriority: Double get() = if (isEmpty) NO_PRIORITY else Double.fromBits(keys[heads[top]])

    /** Forgets all nodes. */
    fun clear() {
        while (groups != 0L) {
            val word = LAST_BIT - groups.countLeadingZeroBits()
            heads.fill(NONE, word * WORD, (word + 1) * WORD)
            filled[word] = 0L
            groups = groups xor (1L shl word)
        }
        lowest = UNSET
        top = EMPTY
    }

    /** Adds [node]. */
    fun push(node: Int, priority: Double) {
        val at = node + 1
        if (at >= keys.size) grow(at)
        val key = if (priority > 0) priority.toRawBits() else 0L
        keys[at] = key
        val bucket = bucketOf(key)
        val word = bucket / WORD
        filled[word] = filled[word] or (1L shl bucket)
        groups = groups or (1L shl word)
        top = maxOf(top, bucket)
        val head = heads[bucket]
        val child = links[2 * head]
        // All bits set where the node goes below the head, none where it goes above. Of equal ones the newer goes above.
        val below = ((key - keys[head]) shr LAST_BIT).toInt()
        val above = below.inv()
        links[2 * at] = head and above
        links[2 * at + 1] = child and below
        links[2 * head] = (at and below) or (child and above)
        heads[bucket] = (head and below) or (at and above)
    }

    /** The best node, which stays. */
    fun peek(): Int {
        check(top >= 0) { "nothing in an empty queue" }
        return heads[top] - 1
    }

    /** As [filled] and [groups] say. */
    private fun bestBucket(): Int {
        if (groups == 0L) return EMPTY
        val word = LAST_BIT - groups.countLeadingZeroBits()
        return word * WORD + LAST_BIT - filled[word].countLeadingZeroBits()
    }

    /** Takes the best node out. */
    fun poll(): Int {
        check(top >= 0) { "nothing in an empty queue" }
        val bucket = top
        val word = bucket / WORD
        val best = heads[bucket]
        val child = links[2 * best]
        heads[bucket] = if (links[2 * child + 1] == NONE) child else merged(child)
        // 1 where nothing is left of the bucket, and of its word.
        val isEmpty = (child - 1 ushr Int.SIZE_BITS - 1).toLong()
        val left = filled[word] xor (isEmpty shl bucket)
        filled[word] = left
        groups = groups xor (((left or -left) ushr LAST_BIT xor 1L) shl word)
        top = bestBucket()
        return best - 1
    }

    /** The heap of all siblings from [first] on: in pairs from the first to the last, then from the last back. */
    private fun merged(first: Int): Int {
        var pairs = NONE
        var at = first
        while (at != NONE) {
            val other = links[2 * at + 1]
            if (other == NONE) {
                links[2 * at + 1] = pairs
                pairs = at
                break
            }
            val next = links[2 * other + 1]
            val pair = joined(at, other)
            links[2 * pair + 1] = pairs
            pairs = pair
            at = next
        }
        var heap = pairs
        at = links[2 * heap + 1]
        while (at != NONE) {
            val next = links[2 * at + 1]
            heap = joined(heap, at)
            at = next
        }
        links[2 * heap + 1] = NONE
        return heap
    }

    /** The heap of two. */
    private fun joined(one: Int, other: Int): Int {
        val isOne = keys[one] > keys[other] || (keys[one] == keys[other] && one > other)
        val above = if (isOne) one else other
        val below = if (isOne) other else one
        links[2 * below + 1] = links[2 * above]
        links[2 * above] = below
        return above
    }

    private fun bucketOf(key: Long): Int {
        if (key == 0L) return 0
        val bits = (key ushr DROPPED_BITS).toInt()
        if (lowest == UNSET) lowest = bits - BELOW_FIRST
        return (bits - lowest).coerceIn(0, BUCKETS - 1)
    }

    private fun grow(at: Int) {
        val size = maxOf(2 * keys.size, at + 1)
        keys = keys.copyOf(size)
        links = links.copyOf(2 * size)
    }

    private companion object {
        const val NONE = 0
        const val EMPTY = -1
        const val BELOW_ALL = -1L
        const val NO_PRIORITY = -1.0
        const val WORD = 64
        const val LAST_BIT = 63

        /** A word of groups has a bit for each word of buckets. */
        const val BUCKETS = WORD * WORD
        const val PER_OCTAVE = 256

        /** Of a Double's 52 bits after the exponent the first 8 count. */
        const val DROPPED_BITS = 44

        /** Ten octaves below the first priority, and six above. */
        const val BELOW_FIRST = 10 * PER_OCTAVE
        const val UNSET = Int.MIN_VALUE
    }
}
