package stillwater.diagnose

/** How a task is done for each of some numbers: one after the other, or at once on threads of the caller; core has none. */
public fun interface Loops {
    /** Does [task] for each number below [count], in any order, and returns when all is done. Tasks share nothing written. */
    public fun each(count: Int, task: (Int) -> Unit)

    public companion object {
        /** One after the other. */
        public val IN_TURN: Loops = Loops { count, task -> repeat(count, task) }
    }
}
