package stillwater.wire

/** The parts of a sensor's object, where they lie in the line, and what they mean. Reused from line to line. */
internal class SensorWords {
    private val starts = IntArray(KEYS.size) { ABSENT }
    private val stops = IntArray(KEYS.size)
    private val numbers = NumberList()

    fun clear() = starts.fill(ABSENT)

    /** Number of the key last read by [cursor], or [NO_KEY]. */
    fun key(cursor: ByteCursor): Int {
        for (i in KEYS.indices) if (cursor.reads(KEYS[i])) return i
        return NO_KEY
    }

    /** Remembers where the value of [key] lies. */
    fun take(key: Int, cursor: ByteCursor) {
        if (key == NO_KEY) return
        starts[key] = cursor.start
        stops[key] = cursor.stop
    }

    /** Hands what the object says to [sink], or answers what is wrong with it. */
    inline fun say(port: Int, bytes: ByteArray, sink: (Message) -> Unit): Malformed? {
        if (starts[TYPE] == ABSENT) {
            val position = number(bytes, POSITION)
            if (starts[POSITION] == ABSENT) return Malformed.UNKNOWN_TARGET
            if (position.isNaN()) return Malformed.BAD_VALUE
            sink(Message.Servo(port, position))
            return null
        }
        val type = type(bytes)
        if (type == "hds" || type == "gps") {
            if (starts[DATA] == ABSENT) return Malformed.BAD_VALUE
            return when (val sentence = Nmea.read(port, bytes, starts[DATA], stops[DATA])) {
                is Sentence.Said -> null.also { sink(sentence.message) }
                is Sentence.Broken -> sentence.kind
                Sentence.Unused -> null
            }
        }
        val message = message(type, port, bytes) ?: return Malformed.BAD_VALUE
        sink(message)
        return null
    }

    /** The type's name; no new string for those that are known. */
    fun type(bytes: ByteArray): String {
        val start = starts[TYPE]
        val length = stops[TYPE] - start
        for (i in TYPES.indices) {
            val name = NAMES[i]
            if (name.size != length) continue
            var same = 0
            while (same < length && name[same] == bytes[start + same]) same++
            if (same == length) return TYPES[i]
        }
        return String(bytes, start, length, Charsets.ISO_8859_1)
    }

    fun number(bytes: ByteArray, key: Int): Double =
        if (starts[key] == ABSENT) Double.NaN else Decimal.parse(bytes, starts[key], stops[key])

    fun message(type: String, port: Int, bytes: ByteArray): Message? {
        if (type == "winch") return number(bytes, DEPTH).takeIf { it.isFinite() }?.let { Message.Winch(port, it) }
        if (starts[DATA] == ABSENT) return null
        // The EZO boards part a value from further ones, such as saturation, by a comma; the others by a blank.
        val separator = if (type == "imu" || type == "atlas_do") ',' else ' '
        if (!numbers.read(bytes, starts[DATA], stops[DATA], separator)) return null
        val values = numbers.values
        return when (type) {
            "battery" -> Message.Battery(port, values[0])
            "atlas_do" -> Message.Oxygen(port, values[0])
            "atlas_ph" -> if (numbers.size == 1) Message.Acidity(port, values[0]) else null
            "es2" -> if (numbers.size == 2) Message.Conductivity(port, values[0], values[1]) else null
            "imu" -> imu(port, values)
            else -> Message.Other(port, type, values.take(numbers.size))
        }
    }

    private fun imu(port: Int, values: DoubleArray): Message? {
        if (numbers.size != IMU_VALUES) return null
        for (i in 1 until IMU_VALUES) if (values[i] !in 0.0..3.0) return null
        val levels = IntArray(IMU_VALUES) { values[it].toInt() }
        return Message.Imu(port, values[0], levels[1], levels[2], levels[3], levels[4])
    }

    companion object {
        const val NO_KEY = -1
        const val ABSENT = -1
        const val TYPE = 0
        const val DATA = 1
        const val DEPTH = 2
        const val POSITION = 3
        private const val IMU_VALUES = 5
        private val KEYS = listOf("type", "data", "depth", "p").map { it.encodeToByteArray() }.toTypedArray()
        private val TYPES = arrayOf("battery", "atlas_do", "atlas_ph", "es2", "hds", "gps", "imu", "winch")
        private val NAMES = TYPES.map { it.encodeToByteArray() }.toTypedArray()
    }
}
