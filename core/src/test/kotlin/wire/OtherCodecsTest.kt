package stillwater.wire

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.assertThrows
import stillwater.model.Actuation
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class OtherCodecsTest {
    private val messages = mutableListOf<Message>()
    private val amarino = AmarinoCodec { messages += it }

    private fun tokens(vararg tokens: String) =
        tokens.joinToString("") { "\u0012$it\u0013" }.toByteArray(Charsets.ISO_8859_1)

    @Test
    fun amarinoMessagesAreReadAndBrokenOnesCostThemselvesOnly() {
        amarino.accept(tokens("e", "249.0", " 19.4", "\n", "o", "7.5", "\n"))
        amarino.accept(tokens("o", "7.x", "\n", "y", "1", "\n", "v", "12.1", "\n"))
        amarino.accept(byteArrayOf(0x12, 'o'.code.toByte(), 0x12, 'o'.code.toByte(), 0x13))
        amarino.accept(tokens("7.5", "\n", "d", "2.5", "\n"))
        assertEquals(
            listOf(
                Message.Conductivity(-1, 249.0, 19.4),
                Message.Oxygen(-1, 7.5),
                Message.Battery(-1, 12.1),
                Message.Depth(-1, 2.5),
            ),
            messages,
        )
        assertEquals(1, amarino.malformed[Malformed.BAD_VALUE])
        assertEquals(1, amarino.malformed[Malformed.UNKNOWN_TARGET])
        assertEquals(1, amarino.malformed[Malformed.SYNTAX])
    }

    @Test
    fun commandsReadAsTheFirmwareWantsThem() {
        val cases = mapOf(
            Command.Move(Actuation.Differential(0.3, -0.5)) to """{"m0":{"v":0.300},"m1":{"v":-0.500}}""",
            Command.Move(Actuation.Vectored(0.3, 0.2)) to """{"m0":{"v":0.300},"s0":{"p":-0.200}}""",
            Command.Move(Actuation.Differential(-0.0, -0.0001)) to """{"m0":{"v":0},"m1":{"v":0}}""",
            Command.Arm to """{"e":{"cmd":"arm"}}""",
            Command.Disarm to """{"e":{"cmd":"disarm"}}""",
            Command.AskState to """{"e":{"info":"state"}}""",
            Command.SetSensor(1, PortSensor.ATLAS_DO) to """{"e":{"s1":"AtlasDO"}}""",
            Command.CompensateTemperature(1, 19.44) to """{"s1":{"temp":"19.4"}}""",
            Command.CompensateConductivity(1, 249.0) to """{"s1":{"ec":"249"}}""",
            Command.Sample(0) to """{"s0":{"sample":true}}""",
        )
        for ((command, line) in cases) assertEquals("$line\n", PlatypusEncoder.encode(command).decodeToString())
        val drive = AmarinoEncoder.encode(Command.Move(Actuation.Differential(0.4, 0.6))).decodeToString()
        assertEquals("v0.500;0.0;0.0;0.0;0.0;0.100\u0013", drive)
        assertThrows<IllegalArgumentException> { Actuation.Differential(Double.NaN, 0.0) }
        assertThrows<IllegalArgumentException> { Command.Sample(10) }
    }

    @Test
    fun ezoRepliesAreRead() {
        fun decode(text: String) = EzoReply.decode(text.toByteArray(Charsets.ISO_8859_1))
        assertEquals(EzoReply.Oxygen(8.42, Double.NaN), decode("8.42"))
        assertEquals(EzoReply.Oxygen(8.42, 91.5), decode("8.42,91.5"))
        for (code in EzoCode.entries) assertEquals(EzoReply.Status(code), decode(code.word))
        assertEquals(EzoReply.Answer("?T,19.5"), decode("?T,19.5"))
        assertEquals(EzoReply.Unreadable(Malformed.UNKNOWN_TARGET), decode("*XX"))
        assertEquals(EzoReply.Unreadable(Malformed.BAD_VALUE), decode("8.4.2"))
        assertEquals(EzoReply.Unreadable(Malformed.BINARY), decode("\u00ff8.42"))
        assertEquals(EzoReply.Unreadable(Malformed.SYNTAX), decode(""))
    }

    @Test
    fun numbersAreTheNearestDoubles() {
        val random = Random(77)
        repeat(20_000) {
            val text = when (it % 4) {
                0 -> random.nextDouble(-1e3, 1e3).toString()
                1 -> "%.6f".format(java.util.Locale.ROOT, random.nextDouble(-20.0, 20.0))
                2 -> Double.fromBits(random.nextLong()).takeIf { v -> v.isFinite() }?.toString() ?: "0"
                else -> random.nextLong().toString()
            }
            val bytes = text.encodeToByteArray()
            assertEquals(text.toDouble(), Decimal.parse(bytes, 0, bytes.size), text)
        }
        for (text in listOf("", "-", ".", "1e", "1e+", "0x1p3", "1f", "NaN", "Infinity", "1e999", "1 ", "--1")) {
            val bytes = text.encodeToByteArray()
            assertTrue(Decimal.parse(bytes, 0, bytes.size).isNaN(), "'$text'")
        }
    }
}
