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

    /** Gives all of it to [bank]. */
    fun play(bank: LagBank) {
        for (i in 0 until size) {
            if (slots[i] == LagBank.NONE) bank.leave() else bank.take(slots[i], times[i], values[i])
        }
    }
}
