package stillwater.wire

/**
 * What an Atlas EZO oxygen circuit says on its own serial line.
 *
 * Source: Atlas Scientific EZO-DO data sheet, UART mode (9600 8N1, lines end in CR).
 */
public sealed interface EzoReply {
    /**
     * A reading.
     *
     * @property milligramsPerLitre mg/L, resolution 0.01.
     * @property saturation %; NaN where it is not sent.
     */
    public data class Oxygen(val milligramsPerLitre: Double, val saturation: Double) : EzoReply

    /** A response code. */
    public data class Status(val code: EzoCode) : EzoReply

    /** The answer to a question, such as `?T,19.5`. */
    public data class Answer(val text: String) : EzoReply

    /** What cannot be read, and why. */
    public data class Unreadable(val kind: Malformed) : EzoReply

    public companion object {
        /** Reads the line in [bytes] from [start] until [end]. Never throws on data. */
        public fun decode(bytes: ByteArray, start: Int = 0, end: Int = bytes.size): EzoReply {
            for (i in start until end) if (bytes[i] !in 32..126) return Unreadable(Malformed.BINARY)
            if (end <= start) return Unreadable(Malformed.SYNTAX)
            val text = String(bytes, start, end - start, Charsets.ISO_8859_1)
            if (text[0] == '?') return Answer(text)
            if (text[0] == '*') {
                val code = EzoCode.entries.firstOrNull { it.word == text }
                return code?.let { Status(it) } ?: Unreadable(Malformed.UNKNOWN_TARGET)
            }
            val numbers = NumberList()
            if (!numbers.read(bytes, start, end, ',')) return Unreadable(Malformed.BAD_VALUE)
            return Oxygen(numbers.values[0], if (numbers.size > 1) numbers.values[1] else Double.NaN)
        }
    }
}

/** Response codes of the EZO circuits. [word] is what is sent. */
public enum class EzoCode(public val word: String) {
    /** The command was understood. */
    OK("*OK"),

    /** An unknown command. */
    ERROR("*ER"),

    /** Supply above 5.5 V. */
    OVER_VOLTAGE("*OV"),

    /** Supply below 3.1 V. */
    UNDER_VOLTAGE("*UV"),

    /** The circuit was reset. */
    RESET("*RS"),

    /** The circuit has started. */
    READY("*RE"),

    /** The circuit sleeps. */
    SLEEP("*SL"),

    /** The circuit was woken. */
    AWAKE("*WA"),
}
