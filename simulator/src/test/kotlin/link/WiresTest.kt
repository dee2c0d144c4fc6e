package stillwater.link

import org.junit.jupiter.api.Assumptions.assumeTrue
import org.junit.jupiter.api.Test
import stillwater.wire.ByteLink
import kotlin.random.Random
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertIs
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** Bytes pass over real wires of the operating system as they are, and a wire that is lost says so. */
class WiresTest {
    /**
     * Asks until [ended]; the system's buffers hand bytes on when they like. A wire that never does fails the build's
     * time.
     */
    private fun eventually(what: String, ended: () -> Boolean) {
        val deadline = System.nanoTime() + 20_000_000_000
        while (!ended()) {
            assertTrue(System.nanoTime() < deadline, "waited 20 s: $what")
            Thread.onSpinWait()
        }
    }

    private fun served(kind: String): ServedWire {
        if (kind == "tcp") return TcpServedWire("127.0.0.1", 0)
        assumeTrue("linux" in System.getProperty("os.name").lowercase(), "pseudo-terminals are made on Linux only")
        return PseudoTerminal()
    }

    private fun opener(wire: ServedWire) = checkNotNull(WireAddress.parse(wire.address, 115_200)).opener()

    private fun passesBytes(kind: String) = served(kind).use { board ->
        assertFalse(board.attend())
        board.write(byteArrayOf(1, 2), 2)
        assertEquals(2, board.untaken, "nobody is there")
        val phone = opener(board).open()
        eventually("open") { board.attend() }
        assertEquals(1, board.openings)
        // All bytes there are, line ends and control characters among them.
        val sent = Random(81).nextBytes(2000) + ByteArray(256) { it.toByte() }
        board.write(sent, sent.size)
        val heard = ArrayList<Byte>()
        val buffer = ByteArray(300)
        eventually("heard") {
            repeat(phone.read(buffer)) { heard += buffer[it] }
            heard.size >= sent.size
        }
        assertContentEquals(sent, heard.toByteArray())
        assertTrue(phone.write(sent))
        val back = ArrayList<Byte>()
        eventually("answered") {
            board.attend()
            repeat(board.read(buffer)) { back += buffer[it] }
            back.size >= sent.size
        }
        assertContentEquals(sent, back.toByteArray())
        phone.close()
        eventually("closed") {
            board.read(buffer)
            !board.attend()
        }
        assertFalse(phone.write(sent))
        assertEquals(ByteLink.LOST, phone.read(buffer))
        opener(board).open().use { eventually("opened again") { board.attend() && board.openings == 2L } }
    }

    @Test
    fun aPseudoTerminalPassesBytesAndSeesWhoOpensIt() = passesBytes("pty")

    @Test
    fun aTcpPortPassesBytesAndSeesWhoOpensIt() = passesBytes("tcp")

    /** A board that hangs must not hang the mission. */
    private fun neverWaits(kind: String) = served(kind).use { board ->
        opener(board).open().use { phone ->
            eventually("open") { board.attend() }
            val much = ByteArray(1 shl 16)
            var taken = 0
            while (phone.write(much) && taken < 1000) taken++
            assertTrue(taken < 1000, "$kind takes everything though nobody reads")
        }
        opener(board).open().use {
            eventually("open") { board.attend() }
            repeat(1000) { board.write(ByteArray(1 shl 16), 1 shl 16) }
            assertTrue(board.untaken > 0)
        }
    }

    @Test
    fun aPseudoTerminalThatNobodyReadsHoldsNobodyUp() = neverWaits("pty")

    @Test
    fun aTcpPortThatNobodyReadsHoldsNobodyUp() = neverWaits("tcp")

    @Test
    fun aWireThatWasLostIsOpenedAgain() {
        var board = TcpServedWire("127.0.0.1", 0)
        val opener = opener(board)
        val buffer = ByteArray(100)
        ReconnectingWire(opener, opener.open()).use { wire ->
            eventually("open") { board.attend() }
            val port = board.address.substringAfterLast(':').toInt()
            board.close()
            eventually("lost") { wire.read(buffer) == ByteLink.LOST }
            assertFalse(wire.write(byteArrayOf(1)))
            assertEquals(1, wire.losses)
            board = TcpServedWire("127.0.0.1", port)
            eventually("open again") { wire.write(byteArrayOf(7)) }
            assertEquals(1, wire.reconnections)
            eventually("heard") { board.attend() && board.read(buffer) > 0 }
            assertEquals(7, buffer[0])
        }
        board.close()
    }

    @Test
    fun addressesAreRead() {
        assertEquals(WireAddress.Tcp("boat.local", 4000), WireAddress.parse("tcp:boat.local:4000", 9600))
        assertEquals(WireAddress.Tcp("::1", 4000), WireAddress.parse("tcp:[::1]:4000", 9600))
        assertEquals(WireAddress.Serial("/dev/ttyACM0", 9600), WireAddress.parse("/dev/ttyACM0", 9600))
        for (wrong in listOf("", " ", "tcp:", "tcp:4000", "tcp:host", "tcp:host:0", "tcp:host:65536", "tcp:host:x")) {
            assertNull(WireAddress.parse(wrong, 9600), wrong)
        }
    }

    @Test
    fun whatCannotBeOpenedIsSaidInOneLine() {
        val free = TcpServedWire("127.0.0.1", 0).also { it.close() }.address
        for (name in listOf("/dev/no-such-port", free, "tcp:no-such-host.invalid:4000")) {
            val problem = assertFailsWith<WireProblem> { checkNotNull(WireAddress.parse(name, 9600)).opener().open() }
            val text = problem.message.orEmpty()
            assertTrue(text.startsWith("$name: ") && '\n' !in text, text)
        }
        TcpServedWire("127.0.0.1", 0).use { taken ->
            val port = taken.address.substringAfterLast(':').toInt()
            val problem = assertFailsWith<WireProblem> { TcpServedWire("127.0.0.1", port) }
            assertIs<String>(problem.message)
        }
    }

    @Test
    fun aSerialPortThatCannotBeOpenedSaysWhyAndWhichThereAre() {
        fun words(error: Int, isWindows: Boolean, vararg ports: String) =
            SerialTrouble.of(error, isWindows).words("COM3", ports.toList(), error)
        assertEquals("COM3: expected a serial port, found none; this machine has no serial ports", words(2, false))
        assertTrue("another program has this port open" in words(16, false, "/dev/ttyACM0"))
        assertTrue(words(11, false, "/dev/ttyACM0", "/dev/ttyS0").endsWith("; there are /dev/ttyACM0, /dev/ttyS0"))
        assertTrue("no permission" in words(13, false) && "dialout" in words(13, false))
        assertTrue("another program" in words(5, true))
        assertTrue("found none" in words(2, true))
        assertEquals("COM3: this port cannot be opened (error 99); this machine has no serial ports", words(99, false))
        fun listed(error: Int, vararg ports: String) =
            SerialTrouble.of(error, isWindows = false).words("/dev/ttyS0", ports.toList())
        val empty = "/dev/ttyS0: expected a serial port, found a name with no port behind it; "
        assertEquals("${empty}this machine has no other", listed(25, "/dev/ttyS0"))
        assertEquals("${empty}there are /dev/ttyACM0", listed(25, "/dev/ttyACM0", "/dev/ttyS0"))
        assertTrue(listed(16, "/dev/ttyS0").endsWith("; this machine has no other"))
        if ("linux" !in System.getProperty("os.name").lowercase()) return
        val problem = assertFailsWith<WireProblem> { WireAddress.Serial("/dev/null", 9600).opener().open() }
        assertTrue("/dev/null: expected a serial port, found something else" in problem.message.orEmpty(), "$problem")
    }
}
