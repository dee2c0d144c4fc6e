package stillwater.app.link

/**
 * Bytes on their way from one thread to another, a fixed number of them.
 *
 * @param capacity bytes held at most, at least 1.
 */
internal class ByteRing(capacity: Int) {
    private val held = ByteArray(capacity)
    private var first = 0
    private var count = 0

    /** Takes the first [length] of [bytes] as far as there is room. @return how many found none. */
    @Synchronized
    fun put(bytes: ByteArray, length: Int): Int {
        val taken = minOf(length, held.size - count)
        for (index in 0 until taken) held[(first + count + index) % held.size] = bytes[index]
        count += taken
        return length - taken
    }

    /** Moves bytes to [into], oldest first. @return how many. */
    @Synchronized
    fun take(into: ByteArray): Int {
        val taken = minOf(into.size, count)
        for (index in 0 until taken) into[index] = held[(first + index) % held.size]
        first = (first + taken) % held.size
        count -= taken
        return taken
    }

    @Synchronized
    fun clear() {
        count = 0
    }
}
