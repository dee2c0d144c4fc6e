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
    private val amounts = DoubleArray(starts.size)

    /** What a displacement at the start of each stretch has become at each reading, length n; to be set. */
    val fading = DoubleArray(series.size)

    /** Readings that count beside those that tell where stretches begin, length n. Not to be modified. */
    val counts: BooleanArray = usable.copyOf().also { counts ->
        for (k in starts.indices) rows(k).firstOrNull { usable[it] }?.let { counts[it] = false }
    }

    private fun rows(k: Int) = starts[k] until (if (k + 1 < starts.size) starts[k + 1] else series.size)

    /** A displacement of one in [fading] at the start of each stretch: downward where [column] begins below, as it says. */
    fun displace(column: DoubleArray? = null) {
        for (k in starts.indices) amounts[k] = if (column == null) 1.0 else amount(column, k)
        fading.fill(0.0)
        for (k in starts.indices) fading[starts[k]] = if (amounts[k] < 0) -1.0 else 1.0
    }

    /** Takes what looks like [fading] off [column], at readings that say something. */
    fun takeOff(column: DoubleArray) {
        for (k in starts.indices) {
            val amount = amount(column, k)
            for (i in rows(k)) column[i] -= amount * fading[i]
        }
    }

    private fun amount(column: DoubleArray, k: Int): Double {
        var own = 0.0
        var with = 0.0
        for (i in rows(k)) {
            if (!usable[i]) continue
            own += fading[i] * fading[i]
            with += fading[i] * column[i]
        }
        return if (own > 0) with / own else 0.0
    }
}
