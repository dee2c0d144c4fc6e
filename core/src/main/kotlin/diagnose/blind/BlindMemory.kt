package stillwater.diagnose.blind

/**
 * The columns of the designs that were in use last; designs may be used on several threads at once.
 *
 * @param rows of each column.
 */
internal class BlindMemory(private val rows: Int) {
    private class Held(val columns: List<DoubleArray>) {
        var users = 1
    }

    /** The columns of each design, those in use last behind the others. */
    private val held = LinkedHashMap<BlindDesign, Held>()
    private var spare: List<DoubleArray>? = null

    /** The columns of [design] until it is [left]; null where they are not in memory. */
    @Synchronized
    fun taken(design: BlindDesign): List<DoubleArray>? {
        val own = held.remove(design) ?: return null
        held[design] = own
        own.users++
        return own.columns
    }

    /** Space for the columns of [design]: that of columns nobody uses, which are forgotten for them, or new. */
    @Synchronized
    fun space(design: BlindDesign): List<DoubleArray> {
        val most = (MOST_NUMBERS / (rows.toLong() * design.size)).coerceIn(2, MOST_DESIGNS)
        while (held.size >= most) {
            val oldest = held.remove(held.keys.first())
            // What is still used elsewhere is left to those who use it.
            if (oldest?.users == 0) spare = oldest.columns
        }
        val space = spare?.takeIf { it.size == design.size } ?: List(design.size) { DoubleArray(rows) }
        spare = null
        return space
    }

    /** Keeps the [columns] of [design], which is using them until it is [left]. */
    @Synchronized
    fun keep(design: BlindDesign, columns: List<DoubleArray>) {
        held[design] = Held(columns)
    }

    /** Says that one who used [columns] of [design] does not any more; others may have been made since these were forgotten. */
    @Synchronized
    fun left(design: BlindDesign, columns: List<DoubleArray>) {
        held[design]?.takeIf { it.columns === columns }?.let { it.users-- }
    }

    private companion object {
        /** Designs whose columns are in memory: two models that are compared, and what is tried on top of them. */
        const val MOST_DESIGNS = 6L

        /** Numbers in their columns, where more than two of them have so many: a hundred megabytes. */
        const val MOST_NUMBERS = 13_000_000L
    }
}
