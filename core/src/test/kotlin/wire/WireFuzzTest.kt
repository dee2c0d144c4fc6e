package stillwater.wire

import org.junit.jupiter.api.Test
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Garbage and valid lines by a grammar, from a fixed seed; `-Dstillwater.fuzz.lines=10000000` runs the long one. */
class WireFuzzTest {
    private val rounds = Integer.getInteger("stillwater.fuzz.lines", 50_000)
    private val random = Random(20_261_120)
    private var heard = 0L
    private var oxygen = 0L
    private var oxygenSum = 0.0
    private val codec = PlatypusCodec {
        heard++
        if (it is Message.Oxygen && it.port == MARKED_PORT) {
            oxygen++
            oxygenSum += it.milligramsPerLitre
        }
    }
    private val framer = LineFramer(codec)
    private val amarino = AmarinoCodec { heard++ }

    @Test
    fun everyValidLineAmongGarbageIsDecoded() {
        var sent = 0L
        var sum = 0.0
        repeat(rounds) {
            val garbage = garbage()
            framer.accept(garbage)
            amarino.accept(garbage)
            EzoReply.decode(garbage)
            if (random.nextInt(4) > 0) return@repeat
            val value = random.nextInt(2000) / 100.0
            sent++
            sum += value
            feed("\r\n{\"s$MARKED_PORT\":{\"type\":\"atlas_do\",\"data\":\"$value\"}}\r\n".encodeToByteArray())
        }
        assertEquals(sent, oxygen)
        // The same numbers added in the same order: equal bit for bit.
        assertEquals(sum, oxygenSum)
        assertTrue(heard > oxygen, "garbage holds valid lines too")
        assertTrue(codec.malformed.total > rounds / 10, "and broken ones: ${codec.malformed}")
    }

    /** In pieces of random length, so that the framer holds parts. */
    private fun feed(bytes: ByteArray) {
        val cut = random.nextInt(bytes.size)
        framer.accept(bytes, 0, cut)
        framer.accept(bytes, cut)
    }

    private fun garbage(): ByteArray = when (random.nextInt(6)) {
        0 -> random.nextBytes(random.nextInt(1, 64))
        1 -> line().encodeToByteArray()
        2 -> (line() + "\n").encodeToByteArray().also { it[random.nextInt(it.size)] = random.nextInt().toByte() }
        3 -> line().let { it.substring(random.nextInt(it.length)) }.encodeToByteArray()
        4 -> line().let { it.substring(0, random.nextInt(it.length)) }.encodeToByteArray()
        else -> String(
            CharArray(random.nextInt(1, 40)) {
                ALPHABET[random.nextInt(ALPHABET.length)]
            },
        ).encodeToByteArray()
    }

    private fun line(): String = "{" + List(random.nextInt(1, 4)) { pair(0) }.joinToString(",") + "}"

    private fun pair(depth: Int): String = "\"${KEYS[random.nextInt(KEYS.size)]}\":" + when (random.nextInt(5)) {
        0 -> number()
        1 -> "\"${TYPES[random.nextInt(TYPES.size)]}\""
        2 -> "\"${number()} ${number()}\""
        else -> if (depth > 3) "true" else "{" + List(random.nextInt(3)) { pair(depth + 1) }.joinToString(",") + "}"
    }

    private fun number(): String = when (random.nextInt(4)) {
        0 -> random.nextInt().toString()
        1 -> random.nextDouble().toString()
        2 -> Double.fromBits(random.nextLong()).toString()
        else -> "-"
    }

    private companion object {
        /** Not among [KEYS], so that what the garbage says of itself is told apart. */
        const val MARKED_PORT = 7
        const val ALPHABET = "{}[]\":,.0123456789eE+-msv\u0012\u0013\n\r\\\t nul"
        val KEYS = listOf("m0", "m1", "s1", "s4", "e", "error", "args", "type", "data", "v", "c", "p", "depth", "")
        val TYPES =
            listOf("atlas_do", "es2", "hds", "gps", "imu", "state", "battery", "\$SDDBT,1,f,2,M", "\\\"", "winch")
    }
}
