package stillwater.diagnose

/**
 * How a task is done for each of some numbers: one after the other, or at once on threads of the caller; core has none.
 *
 * Tasks may have loops of their own and wait for each other: a loop must end where no other thread is free, and a thread
 * that waits for its end may do tasks of that loop alone.
 */
public fun interface Loops {
    /** Does [task] for each number below [count], in any order, and returns when all is done. Tasks write nothing shared unguarded. */
    public fun each(count: Int, task: (Int) -> Unit)

    public companion object {
        /** One after the other. */
        public val IN_TURN: Loops = Loops { count, task -> repeat(count, task) }
    }
}

/** What [task] makes of each of [items], in their order; it may be asked about several at once. */
internal fun <T, R : Any> Loops.all(items: List<T>, task: (T) -> R): List<R> {
    val found = ArrayList<R?>(items.map { null })
    each(items.size) { found[it] = task(items[it]) }
    return found.map { checkNotNull(it) }
}
