package stillwater.estimate

/**
 * The first readings of a survey, kept to be gone through again.
 *
 * @param capacity readings and interruptions it holds.
 */
internal class ReadingTape(capacity: Int) {
    private val slots = IntArray(capacity)
    private val times = DoubleArray(capacity)
    private val values = DoubleArray(capacity)

    /** Readings and interruptions on the tape. */
    var size: Int = 0
        private set

    /** Whether all there was is on the tape. */
    var isComplete: Boolean = true
        private set

    /** Slot of the cell in which reading [i] was taken, [LagBank.NONE] for an interruption. */
    fun slot(i: Int): Int = slots[i]

    /** When reading [i] was taken, s. */
    fun time(i: Int): Double = times[i]

    /** What reading [i] said, scaled. */
    fun value(i: Int): Double = values[i]

    /** Mean time spent in a cell at a stretch, s; 0 for an empty tape. */
    fun meanStay(): Double {
        var sum = 0.0
        var stays = 0
        for (i in 0 until size) {
            if (slots[i] == LagBank.NONE) continue
            val goesOn = i > 0 && slots[i - 1] != LagBank.NONE
            if (goesOn) sum += times[i] - times[i - 1]
            if (!goesOn || slots[i] != slots[i - 1]) stays++
        }
        return if (stays == 0) 0.0 else sum / stays
    }

    /** Keeps a reading, where there is room; [slot] may be [LagBank.NONE] for an interruption. */
    fun add(slot: Int, seconds: Double, value: Double) {
        if (size == slots.size) {
            isComplete = false
            return
        }
        slots[size] = slot
        times[size] = seconds
        values[size++] = value
    }
}
