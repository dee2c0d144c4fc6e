package stillwater.replay

/** Lines of a log by what they hold, or by what was expected of them. Confined to one thread. */
internal class LineCounts {
    private class Lines(val first: Long) {
        var count = 0L
    }

    private val kinds = LinkedHashMap<String, Lines>()

    /** How many of each kind, in the order in which they came first. */
    val counts: Map<String, Long> get() = kinds.mapValues { it.value.count }

    /** The number of the first line of each kind, counted from 1. */
    val first: Map<String, Long> get() = kinds.mapValues { it.value.first }

    /** Line number [line] is one more of [kind]. */
    fun count(kind: String, line: Long) {
        kinds.getOrPut(kind) { Lines(line) }.count++
    }
}
