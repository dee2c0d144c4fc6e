package stillwater.wire

/** Numbers parted by a character, as the sensors behind the boards send them; a fixed buffer, refilled. */
internal class NumberList {
    val values = DoubleArray(CAPACITY)
    var size = 0
        private set

    /**
     * Reads all numbers in [bytes] from [start] until [end], parted by any run of blanks or by one [separator].
     *
     * @return false where something is no finite number, or there are none or more than [CAPACITY].
     */
    fun read(bytes: ByteArray, start: Int, end: Int, separator: Char): Boolean {
        size = 0
        val mark = separator.code.toByte()
        var at = start
        while (at < end) {
            while (at < end && bytes[at] == BLANK) at++
            val from = at
            while (at < end && bytes[at] != mark && bytes[at] != BLANK) at++
            if (at == from && at == end && mark == BLANK) break
            val value = Decimal.parse(bytes, from, at)
            if (value.isNaN() || size == CAPACITY) return false
            values[size++] = value
            while (at < end && bytes[at] == BLANK) at++
            if (at < end && mark != BLANK) {
                if (bytes[at] != mark) return false
                at++
                if (at == end) return false
            }
        }
        return size > 0
    }

    companion object {
        const val CAPACITY = 8
        private const val BLANK: Byte = 32
    }
}
