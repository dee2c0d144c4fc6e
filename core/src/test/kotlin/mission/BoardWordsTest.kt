package stillwater.mission

import stillwater.control.Mixing
import stillwater.model.BoatTime
import stillwater.virtual.BoardSpec
import stillwater.virtual.Firmware
import stillwater.virtual.VirtualBoard
import stillwater.wire.BoardState
import stillwater.wire.ByteLink
import stillwater.wire.Command
import stillwater.wire.Malformed
import stillwater.wire.Message
import stillwater.wire.PlatypusEncoder
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** What boards say, cut anywhere, mixed and spoilt, as the mission's port takes it. */
class BoardWordsTest {
    private class Feed : ByteLink {
        val arriving = ArrayDeque<ByteArray>()

        override fun read(into: ByteArray): Int {
            val bytes = arriving.removeFirstOrNull() ?: return 0
            bytes.copyInto(into)
            return bytes.size
        }

        override fun write(bytes: ByteArray) = true
    }

    private val feed = Feed()
    private val messages = ArrayList<Message>()
    private val port = BoardPort(feed, Mixing.DIFFERENTIAL, { messages.add(it) })
    private var seconds = 0.0

    private fun hear(vararg pieces: String) {
        for (piece in pieces) feed.arriving.add(piece.toByteArray(Charsets.ISO_8859_1))
        seconds += 0.1
        port.hear(BoatTime(seconds))
    }

    /** All that a board says when it is set up, armed, told something wrong, disarmed and left. */
    private fun transcript(firmware: Firmware): String {
        val said = StringBuilder()
        val board = VirtualBoard(BoardSpec(firmware, arming = 0.5), false, { _, _ -> 8.42 }) { said.append(it) }
        fun pass(steps: Int) = repeat(steps) { board.advance(0.1) }
        pass(25)
        for (command in listOf(Command.AskState, Command.Arm)) board.receive(PlatypusEncoder.encode(command))
        pass(8)
        board.receive("{\"x\":{\"v\":1}}\nrubbish\n".encodeToByteArray())
        pass(8)
        board.receive(PlatypusEncoder.encode(Command.Disarm))
        pass(60)
        // Words of the probe's own, which the board hands on as if they were readings.
        for (word in listOf("*WA", "*RE", "?CAL,1", "?T,19.5", "8.40,91.2")) {
            said.append("{\"s1\":{\"type\":\"atlas_do\",\"data\":\"$word\"}}\r\n")
        }
        return said.toString()
    }

    @Test
    fun linesCutAtAnyByteAreTheSameLines() {
        for (firmware in Firmware.entries) {
            val text = transcript(firmware)
            hear(text)
            val whole = messages.toList()
            val bad = port.malformed(Malformed.BAD_VALUE)
            assertEquals(4L, bad - before)
            before = bad
            assertTrue(whole.size > 5)
            for (cut in 1 until text.length) {
                messages.clear()
                hear(text.take(cut), text.drop(cut))
                assertEquals(whole, messages, "$firmware cut at $cut")
            }
            messages.clear()
            // At most sixteen pieces are taken in a step.
            for (piece in text.chunked(1).chunked(16)) hear(*piece.toTypedArray())
            assertEquals(whole, messages, "$firmware byte by byte")
            before = port.malformed(Malformed.BAD_VALUE)
            messages.clear()
        }
        assertEquals(0, port.malformed(Malformed.SYNTAX) + port.malformed(Malformed.BINARY))
    }

    private var before = 0L

    @Test
    fun aProbesOwnWordsAreNoReadings() {
        hear(transcript(Firmware.MASTER))
        val values = messages.filterIsInstance<Message.Oxygen>().map { it.milligramsPerLitre }
        assertEquals(setOf(8.42, 8.4), values.toSet())
        assertEquals(4, port.malformed(Malformed.BAD_VALUE))
    }

    /** Each of two boards on one wire is believed in turn, and what both say is read. */
    @Test
    fun twoGenerationsOnOneWireAreBothRead() {
        val lines = Firmware.entries.map { transcript(it).lines() }
        val mixed = (0 until lines.maxOf { it.size }).flatMap { at -> lines.mapNotNull { it.getOrNull(at) } }
        mixed.chunked(8).forEach { hear(it.joinToString("\r\n", postfix = "\r\n")) }
        assertEquals(0, port.malformed(Malformed.SYNTAX) + port.malformed(Malformed.UNKNOWN_TARGET))
        hear(MOTORS, "STATE: CONNECTED\r\n")
        assertTrue(port.isDisarmed && !port.isRunning)
        hear("STATE: CONNECTED\r\n", MOTORS)
        assertTrue(port.isRunning && !port.isDisarmed)
    }

    @Test
    fun onlyMotorLinesTellThatABoardRuns() {
        port.order(Command.Arm)
        hear("Arming Boat\r\nSTATE: ACTIVE\r\n{\"e\":{\"type\":\"state\",\"data\":\"active\"}}\r\n")
        assertEquals(BoardState.ACTIVE, port.state)
        assertFalse(port.isRunning || port.isDisarmed)
        assertEquals(Double.POSITIVE_INFINITY, port.motorSilence(BoatTime(seconds)))
        hear(MOTORS)
        assertTrue(port.isRunning)
        seconds += 3.0
        assertEquals(3.0, port.motorSilence(BoatTime(seconds)), 1e-9)
        hear("STATE: CONNECTED\r\n")
        assertTrue(port.isDisarmed && !port.isRunning)
    }

    /** What the older branch echoes of a command it does not know differs from version to version. */
    @Test
    fun aBoardWithoutStatesIsKnownByWhatItRefuses() {
        val none = listOf(
            "{\"error\": \"Unknown command target.\",\"args\": \"{\"m9\":{\"v\":1}}\"}",
            "{\"error\": \"Failed to parse JSON command.\",\"args\": \"{\"e\":{\"cmd\":\"arm\"\"}",
            "{\"error\": \"Unknown command target.\",\"args\": \"\"}",
        )
        for (line in none) hear("$line\r\n")
        assertFalse(port.armsItself)
        for (line in listOf(
            "{\"error\": \"Unknown command target.\",\"args\": \"{\"e\":{\"cmd\":\"arm\"}}\"}",
            "{\"error\": \"Unknown command target.\",\"args\": \"{\"e\":{\"info\":\"state\"}}\n\"}",
            "{\"error\": \"Unknown command target.\",\"args\": \"{\"e\"}",
            "{\"error\": \"Unknown command entry.\",\"args\": \"{\"e\":{\"cmd\":\"disarm\"}}\"}",
        )) {
            hear("$line\r\n")
            assertTrue(port.armsItself, line)
            hear("STATE: CONNECTED\r\n")
            assertFalse(port.armsItself)
        }
    }

    private companion object {
        const val MOTORS = "{\"m0\":{\"v\":0.000000},\"m1\":{\"v\":0.000000}}\r\n"
    }
}
