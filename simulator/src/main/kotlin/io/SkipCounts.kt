package stillwater.io

/** How many rows or lines of a log were not used, by reason, in the order in which the reasons first came up. */
class SkipCounts {
    private val counts = LinkedHashMap<String, Long>()

    /** Counts one more row that was left out for [reason]. */
    fun count(reason: String) {
        counts.merge(reason, 1L, Long::plus)
    }

    /** Counts of all reasons so far. */
    fun toMap(): Map<String, Long> = LinkedHashMap(counts)
}
