package stillwater.wire

/** Takes one line of bytes. */
public fun interface LineSink {
    /**
     * Takes the line that stands in [bytes] from [start] until [end], without its terminator.
     *
     * @param bytes the framer's or the caller's buffer. Not modified, not retained: it is written to again afterwards.
     */
    public fun line(bytes: ByteArray, start: Int, end: Int)
}

/**
 * Cuts a stream of bytes into lines, however the stream was cut into pieces.
 *
 * A line ends with CR or LF; empty lines are passed over. A line longer than [longest] is dropped whole and counted, and
 * the next one is read again. Bytes are not looked at otherwise: what is no text is the codec's to refuse. The memory is
 * [longest] bytes for good. A line that lies whole in one piece is not copied. Allocates nothing. Confined to one thread.
 *
 * Source: the boards end lines in CR, LF or both (Platypus firmware v4.2.0, its serial console).
 *
 * @property longest longest line that is passed on, bytes, at least 1. The Platypus board's own buffer has 512.
 * @param sink where lines go. Retained.
 * @throws IllegalArgumentException if [longest] is below 1.
 */
public class LineFramer(private val sink: LineSink, public val longest: Int = 1024) {
    init {
        require(longest >= 1) { "longest ($longest bytes) must be at least 1" }
    }

    private val held = ByteArray(longest)
    private var holding = 0
    private var dropping = false

    /** Lines passed on. */
    public var lines: Long = 0
        private set

    /** Lines dropped because they were longer than [longest]. */
    public var oversized: Long = 0
        private set

    /** Bytes taken. */
    public var bytesTaken: Long = 0
        private set

    /** Takes the [length] bytes of [bytes] from [offset]. Not modified, not retained. */
    public fun accept(bytes: ByteArray, offset: Int = 0, length: Int = bytes.size - offset) {
        bytesTaken += length
        val end = offset + length
        var start = offset
        for (at in offset until end) {
            val byte = bytes[at]
            if (byte <= CR && (byte == LF || byte == CR)) {
                finish(bytes, start, at)
                start = at + 1
            }
        }
        hold(bytes, start, end)
    }

    /** Forgets a line that has begun: the stream was cut, and what follows is not its rest. */
    public fun reset() {
        holding = 0
        dropping = false
    }

    private fun finish(bytes: ByteArray, start: Int, end: Int) {
        if (holding == 0 && !dropping) {
            if (end - start > longest) {
                oversized++
            } else if (end > start) {
                lines++
                sink.line(bytes, start, end)
            }
            return
        }
        hold(bytes, start, end)
        if (!dropping) {
            lines++
            sink.line(held, 0, holding)
        }
        reset()
    }

    private fun hold(bytes: ByteArray, start: Int, end: Int) {
        if (dropping) return
        if (holding + (end - start) > longest) {
            oversized++
            dropping = true
            holding = 0
            return
        }
        bytes.copyInto(held, holding, start, end)
        holding += end - start
    }

    private companion object {
        const val CR: Byte = 13
        const val LF: Byte = 10
    }
}
