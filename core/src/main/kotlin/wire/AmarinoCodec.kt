package stillwater.wire

/**
 * Reads what a board of the original Amarino protocol sends.
 *
 * Each token is 0x12 text 0x13; a message is a flag, its values, and the token "\n". The flags: `o` dissolved oxygen,
 * `e` ES-2, `s` 5TE, `d` depth, `r` rudder, `t` thruster, `v` voltage, `i` current. A 0x12 within a token begins it anew,
 * so that a lost byte costs one message. Memory is [LONGEST_TOKEN] bytes and [NumberList.CAPACITY] numbers for good.
 *
 * Source: CRW Amarino firmware (MeetAndroid). Never throws on data. Confined to one thread.
 *
 * @param sink where messages go. Retained.
 */
public class AmarinoCodec(private val sink: MessageSink) {
    /** What could not be read so far, by kind. */
    public val malformed: MalformedCounts = MalformedCounts()

    private val token = ByteArray(LONGEST_TOKEN)
    private var length = 0
    private var inToken = false
    private var flag = NO_FLAG
    private val values = DoubleArray(NumberList.CAPACITY)
    private var size = 0
    private var fault: Malformed? = null

    /** Takes the [count] bytes of [bytes] from [offset]. Not modified, not retained. */
    public fun accept(bytes: ByteArray, offset: Int = 0, count: Int = bytes.size - offset) {
        for (i in offset until offset + count) {
            val byte = bytes[i]
            when {
                byte == BEGIN -> {
                    if (inToken) fault = Malformed.SYNTAX
                    inToken = true
                    length = 0
                }
                byte == END -> if (inToken) endToken() else fault = Malformed.SYNTAX
                !inToken -> fault = Malformed.SYNTAX
                length == LONGEST_TOKEN -> {
                    fault = Malformed.OVERSIZED
                    inToken = false
                }
                else -> token[length++] = byte
            }
        }
    }

    private fun endToken() {
        inToken = false
        if (length == 1 && token[0] == NEW_LINE) return endMessage()
        if (flag == NO_FLAG) {
            if (length == 1) flag = token[0].toInt().toChar() else fault = Malformed.SYNTAX
            return
        }
        var start = 0
        while (start < length && token[start] == ByteCursor.BLANK) start++
        val value = Decimal.parse(token, start, length)
        if (value.isNaN() || size == values.size) fault = Malformed.BAD_VALUE else values[size++] = value
    }

    private fun endMessage() {
        val problem = fault
        val message = if (problem == null) message() else null
        if (problem != null) {
            malformed.count(problem)
        } else if (message == null) {
            malformed.count(if (flag in FLAGS) Malformed.BAD_VALUE else Malformed.UNKNOWN_TARGET)
        } else {
            sink.message(message)
        }
        flag = NO_FLAG
        size = 0
        fault = null
    }

    private fun message(): Message? {
        val port = Message.NO_PORT
        return when {
            flag == 'e' -> if (size == 2) Message.Conductivity(port, values[0], values[1]) else null
            flag == 's' -> if (size > 0) Message.Other(port, "5te", values.take(size)) else null
            size != 1 -> null
            else -> when (flag) {
                'o' -> Message.Oxygen(port, values[0])
                'd' -> Message.Depth(port, values[0])
                'v' -> Message.Battery(port, values[0])
                'r' -> Message.Servo(0, values[0])
                't' -> Message.Motor(0, values[0], Double.NaN)
                'i' -> Message.Other(port, "current", listOf(values[0]))
                else -> null
            }
        }
    }

    private companion object {
        const val BEGIN: Byte = 0x12
        const val END: Byte = 0x13
        const val NEW_LINE: Byte = 10
        const val LONGEST_TOKEN = 64
        const val NO_FLAG = '\u0000'
        const val FLAGS = "oesdrtvi"
    }
}
