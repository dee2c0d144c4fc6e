package stillwater.virtual

import org.junit.jupiter.api.Test
import stillwater.model.Actuation
import stillwater.wire.BoardError
import stillwater.wire.BoardState
import stillwater.wire.Command
import stillwater.wire.LineFramer
import stillwater.wire.Message
import stillwater.wire.PlatypusCodec
import stillwater.wire.PlatypusEncoder
import stillwater.wire.PortSensor
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class VirtualBoardTest {
    private val messages = mutableListOf<Message>()
    private val codec = PlatypusCodec { messages += it }
    private val framer = LineFramer(codec)

    private fun board(vectored: Boolean = false) =
        VirtualBoard(BoardSpec(), vectored, { _, _ -> 7.5 }) { framer.accept(it.encodeToByteArray()) }

    private fun VirtualBoard.send(command: Command) = receive(PlatypusEncoder.encode(command))

    private fun VirtualBoard.pass(seconds: Double, command: Command? = null) = repeat((seconds * 20).toInt()) {
        if (it % 2 == 0 && command != null) send(command)
        advance(0.05)
    }

    private val ahead = Actuation.Differential(0.5, 0.25)

    @Test
    fun motorsTurnOnlyWhenArmedAndFed() {
        val board = board()
        board.pass(2.0, Command.Move(ahead))
        assertTrue(board.actuation.isAtRest, "not armed")
        board.send(Command.Arm)
        board.pass(1.5, Command.Move(ahead))
        assertTrue(board.actuation.isAtRest, "arming takes its time")
        board.pass(1.0, Command.Move(ahead))
        assertEquals(ahead, board.actuation)
        board.pass(0.6)
        assertTrue(board.actuation.isAtRest, "the watchdog, 0.5 s")
        board.pass(0.1, Command.Move(ahead))
        assertEquals(ahead, board.actuation, "connected boards go on")
        board.pass(6.0)
        board.pass(1.0, Command.Move(ahead))
        assertTrue(board.actuation.isAtRest, "from standby only arming leads back")
    }

    @Test
    fun aResetIsSilentAndDisarmed() {
        val board = board()
        board.pass(2.0)
        board.send(Command.Arm)
        board.pass(3.0, Command.Move(ahead))
        board.reset()
        messages.clear()
        board.pass(1.0, Command.Move(ahead))
        assertEquals(emptyList(), messages)
        board.pass(2.0, Command.Move(ahead))
        assertTrue(messages.isNotEmpty() && board.actuation.isAtRest)
    }

    @Test
    fun allItSaysIsUnderstoodAtTheFirmwaresRates() {
        val board = board()
        board.pass(62.0)
        board.send(Command.AskState)
        assertEquals(Message.State(BoardState.STANDBY), messages.last())
        // 60 s after booting; the edges of the periods may shift by one step of 0.05 s each.
        assertEquals(605.0, messages.count { it == Message.Motor(0, 0.0, 0.0) }.toDouble(), 10.0)
        assertEquals(60.0, messages.count { it is Message.Battery }.toDouble(), 4.0)
        assertEquals(20.0, messages.count { it == Message.Oxygen(1, 7.5) }.toDouble(), 1.0)
        assertEquals(0, codec.malformed.total)
    }

    @Test
    fun everyCommandIsKnownAndEverythingElseIsRefused() {
        val board = board(vectored = true)
        board.pass(2.0)
        for (command in listOf(
            Command.Move(Actuation.Vectored(0.3, 0.2)),
            Command.Arm,
            Command.SetSensor(1, PortSensor.ATLAS_DO),
            Command.CompensateTemperature(1, 19.4),
            Command.CompensateConductivity(1, 249.0),
            Command.Sample(0),
            Command.Disarm,
        )) {
            board.send(command)
        }
        assertTrue(messages.none { it is Message.Refused })
        board.receive("{\"x\":{\"v\":1}}\nrubbish\n".encodeToByteArray())
        assertEquals(
            listOf(BoardError.TARGET, BoardError.JSON),
            messages.filterIsInstance<Message.Refused>().map { it.kind },
        )
        val random = Random(9)
        repeat(2000) { board.receive(random.nextBytes(50)) }
        assertTrue(board.actuation.isAtRest)
    }
}
