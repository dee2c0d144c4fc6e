package stillwater.wire

/** Turns lines into messages; never throws on data. */
public interface LineCodec : LineSink {
    /** What could not be read so far, by kind. */
    public val malformed: MalformedCounts
}

/**
 * Reads what a Platypus board sends, of both firmware generations.
 *
 * An object is taken whole or not at all, so that a line that was cut says nothing. Where a line's beginning is broken,
 * reading starts again at its next brace: a line whose terminator was lost costs neither itself nor its neighbour. What
 * the board echoes inside an error is not read: it is this side's own words. A drive in it has the form of what the
 * board says of its motors, so motors are believed only at the beginning of a line or behind a whole object, for the
 * beginning of the error may have been spoilt, and only where nothing is left of the error behind them, for it may be
 * missing, as where a link was lost. Every line that holds something unreadable is counted once, under the kind met
 * first. A number is never guessed: what is not finite or not all digits is counted.
 *
 * The lines carry no checksum: a digit that was changed on the way reads as another number. The mission's plausibility
 * test is there for that.
 *
 * Source: Platypus firmware v4.2.0 (`{"m0":{"v":..,"c":..}}`, `{"s1":{"type":..,"data":".."}}`, `{"e":{..}}`,
 * `{"error":..,"args":..}` with args not escaped) and the master branch (no `c`). Confined to one thread. About the
 * time of one pass over the bytes; allocates only the messages.
 *
 * @param sink where messages go. Retained.
 */
public class PlatypusCodec(private val sink: MessageSink) : LineCodec {
    override val malformed: MalformedCounts = MalformedCounts()

    /** Lines that gave at least one message. */
    public var understood: Long = 0
        private set

    private val cursor = ByteCursor()
    private val sensors = SensorWords()
    private val pending = arrayOfNulls<Message>(MOST_MESSAGES)
    private var waiting = 0
    private var fault: Malformed? = null

    override fun line(bytes: ByteArray, start: Int, end: Int) {
        fault = null
        var said = false
        var at = nextBrace(bytes, start, end)
        if (at < 0) return notice(bytes, start, end)
        if (!blank(bytes, start, at)) note(if (isText(bytes, start, at)) Malformed.SYNTAX else Malformed.BINARY)
        var isEcho = isBehindText(bytes, start, at)
        while (at >= 0) {
            if (isError(bytes, at, end)) {
                refused(bytes, at, end)
                said = true
                break
            }
            waiting = 0
            cursor.open(bytes, at, end)
            if (topObject()) {
                said = said || waiting > 0
                val from = cursor.at
                at = nextBrace(bytes, from, end)
                handOn(isEcho || isBeforeText(bytes, from, at, end))
                isEcho = isBehindText(bytes, from, at)
                if (!blank(bytes, from, if (at < 0) end else at)) note(Malformed.SYNTAX)
            } else {
                note(if (isText(bytes, at, end)) Malformed.SYNTAX else Malformed.BINARY)
                at = nextBrace(bytes, at + 1, end)
                isEcho = true
            }
        }
        if (said) understood++
        fault?.let { malformed.count(it) }
    }

    /** Whether more stands between [from] and [at] than what is left of a line's end. */
    private fun isBehindText(bytes: ByteArray, from: Int, at: Int) = at - from > TERMINATOR && !blank(bytes, from, at)

    /**
     * Whether text follows at [from], before the brace at [at] or before [end] where there is none. An echo is followed
     * by a quote and a brace; two lines that have become one may have what is left of a line's end between them.
     */
    private fun isBeforeText(bytes: ByteArray, from: Int, at: Int, end: Int): Boolean {
        if (at < 0) return !blank(bytes, from, end)
        for (i in from until at) if (bytes[i] == ByteCursor.QUOTE || bytes[i] == ByteCursor.CLOSE) return true
        return false
    }

    private fun handOn(isEcho: Boolean) {
        for (i in 0 until waiting) {
            val message = pending[i] ?: continue
            if (!isEcho || message !is Message.Motor) sink.message(message)
        }
    }

    private fun note(kind: Malformed) {
        if (fault == null) fault = kind
    }

    private fun add(message: Message) {
        if (waiting < MOST_MESSAGES) pending[waiting++] = message else note(Malformed.SYNTAX)
    }

    /** Whether a well-formed object stands at the cursor; what it says is pending afterwards. */
    private fun topObject(): Boolean {
        if (!cursor.pass(ByteCursor.OPEN)) return false
        if (cursor.pass(ByteCursor.CLOSE)) return true
        do {
            if (!cursor.string()) return false
            val letter = cursor.bytes[cursor.start]
            val index = index()
            val isEvent = cursor.stop - cursor.start == 1 && letter == 'e'.code.toByte()
            if (!cursor.pass(ByteCursor.COLON)) return false
            val ok = when {
                isEvent -> event()
                index >= 0 && letter == 'm'.code.toByte() -> motor(index)
                index >= 0 && letter == 's'.code.toByte() -> sensor(index)
                else -> {
                    note(Malformed.UNKNOWN_TARGET)
                    cursor.skipValue()
                }
            }
            if (!ok) return false
        } while (cursor.pass(ByteCursor.COMMA))
        return cursor.pass(ByteCursor.CLOSE)
    }

    /** The number after the letter of the key last read, such as 0 in "m0"; -1 where there is none. */
    private fun index(): Int {
        if (cursor.stop - cursor.start != 2) return -1
        val digit = cursor.bytes[cursor.start + 1] - '0'.code
        return if (digit in 0..9) digit else -1
    }

    private fun motor(index: Int): Boolean {
        if (!cursor.pass(ByteCursor.OPEN)) return false
        var velocity = Double.NaN
        var current = Double.NaN
        var bad = false
        do {
            if (!cursor.string()) return false
            val key = if (cursor.stop - cursor.start == 1) cursor.bytes[cursor.start].toInt().toChar() else ' '
            if (!cursor.pass(ByteCursor.COLON)) return false
            if (key != 'v' && key != 'c') {
                if (!cursor.skipValue()) return false
                continue
            }
            if (!cursor.word()) return false
            val value = Decimal.parse(cursor.bytes, cursor.start, cursor.stop)
            if (value.isNaN()) bad = true
            if (key == 'v') velocity = value else current = value
        } while (cursor.pass(ByteCursor.COMMA))
        if (!cursor.pass(ByteCursor.CLOSE)) return false
        if (bad || velocity.isNaN()) note(Malformed.BAD_VALUE) else add(Message.Motor(index, velocity, current))
        return true
    }

    private fun sensor(port: Int): Boolean {
        if (!cursor.pass(ByteCursor.OPEN)) return false
        sensors.clear()
        do {
            if (!cursor.string()) return false
            val key = sensors.key(cursor)
            if (!cursor.pass(ByteCursor.COLON)) return false
            val ok = when {
                key == SensorWords.NO_KEY -> cursor.skipValue()
                cursor.peek() == ByteCursor.QUOTE -> cursor.string()
                else -> cursor.word()
            }
            if (!ok) return false
            sensors.take(key, cursor)
        } while (cursor.pass(ByteCursor.COMMA))
        if (!cursor.pass(ByteCursor.CLOSE)) return false
        val problem = sensors.say(port, cursor.bytes, ::add)
        if (problem != null) note(problem)
        return true
    }

    /** `{"type":"state","data":"active"}`: what the board answers to a question about itself. */
    private fun event(): Boolean {
        if (!cursor.pass(ByteCursor.OPEN)) return false
        var state: BoardState? = null
        var isState = false
        do {
            if (!cursor.string()) return false
            val isType = cursor.reads(TYPE)
            val isData = cursor.reads(DATA)
            if (!cursor.pass(ByteCursor.COLON)) return false
            if (!isType && !isData) {
                if (!cursor.skipValue()) return false
                continue
            }
            if (!cursor.string()) return false
            if (isType) isState = cursor.reads(STATE)
            if (isData) state = stateOf(cursor.text())
        } while (cursor.pass(ByteCursor.COMMA))
        if (!cursor.pass(ByteCursor.CLOSE)) return false
        if (isState && state != null) add(Message.State(state)) else note(Malformed.UNKNOWN_TARGET)
        return true
    }

    private fun isError(bytes: ByteArray, start: Int, end: Int): Boolean {
        if (end - start < ERROR.size) return false
        for (i in ERROR.indices) if (bytes[start + i] != ERROR[i]) return false
        return true
    }

    /** The rest of the line is the board's complaint; args is what it got, not escaped, up to the closing `"}`. */
    private fun refused(bytes: ByteArray, start: Int, end: Int) {
        val text = String(bytes, start, end - start, Charsets.ISO_8859_1)
        val words = text.substringAfter(':', "").trimStart(' ', '"')
        val kind = BoardError.entries.first { words.startsWith(it.text) }
        val args = text.substringAfter("\"args\"", "").trimStart(':', ' ').removePrefix("\"").trimEnd()
        sink.message(Message.Refused(kind, args.removeSuffix("}").removeSuffix("\"")))
    }

    /** A line without a brace: plain text that begins with a letter is a notice. */
    private fun notice(bytes: ByteArray, start: Int, end: Int) {
        if (blank(bytes, start, end)) return
        if (!isText(bytes, start, end)) return malformed.count(Malformed.BINARY)
        val text = String(bytes, start, end - start, Charsets.ISO_8859_1).trim()
        val letters = text[0].isLetter() && text.none { it == '"' || it == '{' || it == '}' }
        if (!letters) return malformed.count(Malformed.SYNTAX)
        understood++
        val isState = text.startsWith(STATE_NOTICE)
        val state = if (isState) stateOf(text.substring(STATE_NOTICE.length).lowercase()) else null
        sink.message(state?.let { Message.State(it) } ?: Message.Notice(text))
    }

    private fun stateOf(word: String): BoardState? = BoardState.entries.firstOrNull { it.word == word.trim() }

    private fun nextBrace(bytes: ByteArray, start: Int, end: Int): Int {
        for (i in start until end) if (bytes[i] == ByteCursor.OPEN) return i
        return -1
    }

    private fun blank(bytes: ByteArray, start: Int, end: Int): Boolean {
        for (i in start until end) if (bytes[i] != ByteCursor.BLANK && bytes[i] != ByteCursor.TAB) return false
        return true
    }

    private fun isText(bytes: ByteArray, start: Int, end: Int): Boolean {
        for (i in start until end) if (bytes[i] !in PRINTABLE && bytes[i] != ByteCursor.TAB) return false
        return true
    }

    private companion object {
        const val MOST_MESSAGES = 16

        /** Bytes between two lines that have become one. */
        const val TERMINATOR = 2
        const val STATE_NOTICE = "STATE: "
        val PRINTABLE = 32.toByte()..126.toByte()
        val ERROR = "{\"error\"".encodeToByteArray()
        val TYPE = "type".encodeToByteArray()
        val DATA = "data".encodeToByteArray()
        val STATE = "state".encodeToByteArray()
    }
}
