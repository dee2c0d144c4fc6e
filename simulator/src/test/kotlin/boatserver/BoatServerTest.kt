package stillwater.boatserver

import org.junit.jupiter.api.Test
import stillwater.link.ServedWire
import stillwater.link.TcpServedWire
import stillwater.link.WireAddress
import stillwater.mission.MissionSpec
import stillwater.virtual.BoardSpec
import stillwater.world.VirtualWorld
import stillwater.world.WorldSettings
import stillwater.world.WorldSite
import java.net.Socket
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Whatever a program at the other end does, the boat's time goes on and nothing grows. */
class BoatServerTest {
    /** A wire with somebody at its other end from the begin on, who sends what [talk] puts into the buffer. */
    private open class Wire(private val talk: (ByteArray) -> Int = { 0 }) : ServedWire {
        val written = StringBuilder()
        override val address = "fake"
        override var openings = 1L
        override var untaken = 0L

        override fun attend() = true

        override fun read(into: ByteArray) = talk(into)

        override fun write(bytes: ByteArray, length: Int) {
            if (written.length < 100_000) written.append(bytes.decodeToString(0, length))
        }

        override fun close() = Unit
    }

    private val spec = MissionSpec.fromJson(
        """{"name":"pond","origin":{"lat_deg":45.5,"lon_deg":-73.6},
        "area":{"south_west":{"x_m":-20,"y_m":-20},"north_east":{"x_m":60,"y_m":60}},
        "grid":{"south_west":{"x_m":0,"y_m":0},"columns":4,"rows":4,"cell_m":10},
        "probe":{"quantity":"dissolved-oxygen","port":1,"lowest":0,"highest":15},
        "budget":{"seconds":300},"home":{"x_m":5,"y_m":5}}""",
    )
    private val world = VirtualWorld(WorldSettings(seed = 5, board = BoardSpec(booting = 0.5)), WorldSite.of(spec))

    /** Serves [board] and [phone] for [seconds] s of the boat's time. */
    private fun serve(board: ServedWire, phone: PhoneServer, seconds: Double) {
        val server = BoatServer(world, board, phone, 1000.0, PATIENCE_NANOS)
        server.serve(seconds, isOnce = false)
        assertTrue(world.time.seconds >= seconds)
    }

    /** As on the wire: endless lines, an endless line, zeros, noise, commands without end. */
    private val floods = listOf<(ByteArray) -> Int>(
        { into -> into.size.also { into.fill('\n'.code.toByte()) } },
        { into -> into.size.also { into.fill('x'.code.toByte()) } },
        { into -> into.size.also { into.fill(0) } },
        Random(91).let { random -> { into -> into.size.also { random.nextBytes(into) } } },
        { into -> "{\"e\":{\"cmd\":\"arm\"}}\n".toByteArray().also { it.copyInto(into) }.size },
        { into -> "{\"done\":999999999}\n".toByteArray().also { it.copyInto(into) }.size },
    )

    @Test
    fun aBoardThatIsFloodedGoesOn() {
        val phone = PhoneServer(Wire())
        for ((index, flood) in floods.withIndex()) {
            val board = Wire(flood)
            serve(board, phone, world.time.seconds + 2)
            assertTrue("STATE: " in board.written, "flood $index: the board still speaks")
            assertTrue(world.boat.board.actuation.isAtRest, "flood $index: its motors rest")
        }
    }

    @Test
    fun aPhoneThatIsFloodedAnswersNothingAndTimeGoesOn() {
        for (flood in floods) {
            val wire = Wire(flood)
            val phone = PhoneServer(wire)
            // One report is waited for, and none after it.
            serve(Wire(), phone, world.time.seconds + 1)
            assertEquals(1, phone.unanswered)
            assertTrue("\"tick\"" in wire.written)
        }
    }

    @Test
    fun programsThatComeAndSayNothingOrHangUpAtOnceHoldNobodyUp() {
        TcpServedWire("127.0.0.1", 0).use { board ->
            PhoneServer(TcpServedWire("127.0.0.1", 0)).use { phone ->
                fun socket(address: String) = checkNotNull(WireAddress.parse(address, 9600) as? WireAddress.Tcp)
                    .let { Socket(it.host, it.port) }
                // Silent, half-open, gone at once, one after the other and at the same time.
                val silent = List(3) { socket(board.address) }
                socket(board.address).use { it.shutdownOutput() }
                socket(phone.address).use { it.setSoLinger(true, 0) }
                socket(board.address).getOutputStream().write(Random(92).nextBytes(50_000))
                serve(board, phone, 3.0)
                assertTrue(board.attend() || board.openings > 0)
                socket(board.address).use { last ->
                    serve(board, phone, world.time.seconds + 3)
                    // The one who came last has the board.
                    assertTrue(last.getInputStream().read() >= 0)
                }
                silent.forEach { it.close() }
            }
        }
    }

    private companion object {
        const val PATIENCE_NANOS = 20_000_000L
    }
}
