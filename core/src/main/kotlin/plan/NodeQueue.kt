package stillwater.plan

/**
 * A queue of numbered nodes that polls the one with the highest priority, and of equal ones the one with the highest
 * number. Nodes must be pushed in the order of their numbers.
 *
 * Priorities are sorted into [BUCKETS] buckets by their first bits, [PER_OCTAVE] to a factor of two; each bucket is a
 * pairing heap, so that even if all priorities fall into one of them a poll takes O(log n) on average. A push is O(1),
 * and so is a poll where buckets hold few. No call allocates once the arrays have grown. Source: Fredman, Sedgewick,
 * Sleator and Tarjan 1986, doi:10.1007/BF01840439, the two-pass variant; Dial 1969, doi:10.1145/363269.363610, for the
 * buckets.
 *
 * @param capacity nodes it holds before it grows.
 */
internal class NodeQueue(capacity: Int) {
    private var priorities = DoubleArray(capacity)

    /** First child of a node, and in the place after it the next child of its parent. */
    private var links = IntArray(2 * capacity)

    /** The best node of each bucket that its bit says to hold any; a bit of [groups] stands for a word of [filled]. */
    private val heads = IntArray(BUCKETS)
    private val filled = LongArray(BUCKETS / WORD)
    private var groups = 0L

    /** First bits of the priority that belongs to bucket 0; set by the first priority above 0. */
    private var lowest = UNSET

    /** Whether no node waits. */
    val isEmpty: Boolean get() = groups == 0L

    /** Forgets all nodes. */
    fun clear() {
        filled.fill(0L)
        groups = 0L
        lowest = UNSET
    }

    /** Adds [node]. */
    fun push(node: Int, priority: Double) {
        if (node >= priorities.size) grow(node)
        priorities[node] = priority
        links[2 * node + 1] = NONE
        val bucket = bucketOf(priority)
        val word = bucket / WORD
        val bit = 1L shl bucket
        if (filled[word] and bit == 0L) {
            filled[word] = filled[word] or bit
            groups = groups or (1L shl word)
            links[2 * node] = NONE
            heads[bucket] = node
            return
        }
        val head = heads[bucket]
        // Of equal priorities the newer one goes first.
        if (priorities[head] > priority) {
            links[2 * node] = NONE
            links[2 * node + 1] = links[2 * head]
            links[2 * head] = node
        } else {
            links[2 * node] = head
            heads[bucket] = node
        }
    }

    /** The best node, which stays. */
    fun peek(): Int = heads[bestBucket()]

    private fun bestBucket(): Int {
        check(groups != 0L) { "nothing in an empty queue" }
        val word = LAST_BIT - groups.countLeadingZeroBits()
        return word * WORD + LAST_BIT - filled[word].countLeadingZeroBits()
    }

    /** Takes the best node out. */
    fun poll(): Int {
        val bucket = bestBucket()
        val word = bucket / WORD
        val best = heads[bucket]
        val child = links[2 * best]
        if (child != NONE) {
            heads[bucket] = if (links[2 * child + 1] == NONE) child else merged(child)
        } else {
            filled[word] = filled[word] xor (1L shl bucket)
            if (filled[word] == 0L) groups = groups xor (1L shl word)
        }
        return best
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
        val isOne = priorities[one] > priorities[other] || (priorities[one] == priorities[other] && one > other)
        val above = if (isOne) one else other
        val below = if (isOne) other else one
        links[2 * below + 1] = links[2 * above]
        links[2 * above] = below
        return above
    }

    private fun bucketOf(priority: Double): Int {
        // 0, what is below and what is no number go last.
        if (!(priority > 0)) return 0
        val bits = (priority.toRawBits() ushr DROPPED_BITS).toInt()
        if (lowest == UNSET) lowest = bits - BELOW_FIRST
        return (bits - lowest).coerceIn(0, BUCKETS - 1)
    }

    private fun grow(node: Int) {
        val capacity = maxOf(2 * priorities.size, node + 1)
        priorities = priorities.copyOf(capacity)
        links = links.copyOf(2 * capacity)
    }

    private companion object {
        const val NONE = -1
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
