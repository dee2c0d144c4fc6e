package stillwater.survey

import stillwater.io.ReadingSink
import stillwater.model.BoatTime
import stillwater.model.Conditions

/** Some thousand readings of a log, without their conditions: so many are handed from one thread to another at once. */
internal class ReadingBlock {
    private val numbers = DoubleArray(CAPACITY * WIDTH)

    /** How many there are. */
    var size: Int = 0
        private set

    /** Whether no other finds room. */
    val isFull: Boolean get() = size == CAPACITY

    /** Adds a reading of the time [seconds], s, at ([x], [y]), m in the log's frame. */
    fun add(seconds: Double, x: Double, y: Double, value: Double) {
        val at = size++ * WIDTH
        numbers[at] = seconds
        numbers[at + 1] = x
        numbers[at + 2] = y
        numbers[at + 3] = value
    }

    /** Hands all readings to [sink]. */
    fun read(sink: ReadingSink) {
        for (at in 0 until size * WIDTH step WIDTH) {
            sink.take(BoatTime(numbers[at]), numbers[at + 1], numbers[at + 2], numbers[at + 3], Conditions.NONE)
        }
    }

    private companion object {
        const val WIDTH = 4
        const val CAPACITY = 1 shl 13
    }
}
