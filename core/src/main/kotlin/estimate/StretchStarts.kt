package stillwater.estimate

/**
 * Where a sensor is when a stretch of readings begins: anywhere, because what it saw before was not logged. What is left
 * of that fades as its response has it, by an amount that each stretch tells by itself.
 *
 * The amount is that of least squares: all of a column that looks like the fading within a stretch is taken off it before
 * columns are held against each other (Frisch & Waugh 1933). A stretch's first usable reading is what tells it, and
 * counts for nothing else.
 *
 * @param series the readings. Retained. @param usable readings that say something, length n. Retained, not modified.
 */
internal class StretchStarts(private val series: TrackSeries, private val usable: BooleanArray) {
    private val starts = (0 until series.size).filter { it == 0 || series.isAfterGap(it) }.toIntArray()

    /** What a displacement at the start of each stretch has become at each reading, length n; to be set. */
    val fading = DoubleArray(series.size)

    /** Readings that count beside those that tell where stretches begin, length n. Not to be modified. */
    val counts: BooleanArray = usable.copyOf().also { counts ->
        for (k in starts.indices) rows(k).firstOrNull { usable[it] }?.let { counts[it] = false }
    }

    private fun rows(k: Int) = starts[k] until (if (k + 1 < starts.size) starts[k + 1] else series.size)

    /** A displacement of one in [fading] at the start of each stretch: downward where [column] begins below, as it says. */
    fun displace(column: DoubleArray? = null) {
        for (k in starts.indices) {
            val isBelow = column != null && product(column, k) < 0
            for (i in rows(k)) fading[i] = 0.0
            fading[starts[k]] = if (isBelow) -1.0 else 1.0
        }
    }

    /** Takes what looks like [fading] at readings that say something off each of [columns]. */
    fun takeOff(vararg columns: DoubleArray) {
        for (k in starts.indices) {
            val own = product(fading, k)
            if (!(own > 0)) continue
            for (column in columns) {
                val amount = product(column, k) / own
                for (i in rows(k)) column[i] -= amount * fading[i]
            }
        }
    }

    /** Of [column] and [fading], over what stretch [k] says. */
    private fun product(column: DoubleArray, k: Int): Double {
        var sum = 0.0
        for (i in rows(k)) if (usable[i]) sum += fading[i] * column[i]
        return sum
    }
}
