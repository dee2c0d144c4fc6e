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

/** What each generation of the firmware does, as read in its source. */
class VirtualBoardTest {
    private val messages = mutableListOf<Message>()
    private val codec = PlatypusCodec { messages += it }
    private val framer = LineFramer(codec)

    private fun board(spec: BoardSpec = BoardSpec(), vectored: Boolean = false) =
        VirtualBoard(spec, vectored, { _, _ -> 7.5 }) { framer.accept(it.encodeToByteArray()) }

    private val master = BoardSpec(Firmware.MASTER)

    private fun VirtualBoard.send(command: Command) = receive(PlatypusEncoder.encode(command))

    private fun VirtualBoard.pass(seconds: Double, command: Command? = null) = repeat((seconds * 20 + 0.5).toInt()) {
        if (it % 2 == 0 && command != null) send(command)
        advance(0.05)
    }

    /** What was said since this was last asked, of which [T]. */
    private inline fun <reified T : Message> said(): List<T> =
        messages.filterIsInstance<T>().also { messages.clear() }

    private fun states() = said<Message.State>().map { it.state }

    private val ahead = Actuation.Differential(0.5, 0.25)

    @Test
    fun theNewerOneRunsFromArmedToItsWatchdogAndSpeaksOfMotorsOnlyThen() {
        val board = board()
        board.pass(2.1)
        assertEquals(listOf(BoardState.CONNECTED), states(), "it says so as it has booted")
        board.pass(3.0)
        assertEquals(listOf(BoardState.STANDBY), states(), "5 s after power came")
        board.send(Command.AskState)
        assertEquals(listOf(BoardState.CONNECTED, BoardState.CONNECTED), states(), "any byte ends standby")
        board.send(Command.Arm)
        board.send(Command.AskState)
        assertEquals(listOf(BoardState.ACTIVE, BoardState.ACTIVE), states(), "active is said before it is armed")
        board.pass(4.0, Command.Move(Actuation.Differential(0.0, 0.0)))
        assertEquals(emptyList(), said<Message.Motor>(), "while it arms")
        board.pass(0.6, Command.Move(ahead))
        assertEquals(ahead, board.actuation)
        board.pass(1.0, Command.Move(ahead))
        // Some may have come before.
        val motors = said<Message.Motor>()
        assertTrue(motors.size in 20..30 && motors.all { it.current.isNaN() }, "$motors")
        board.pass(2.8)
        assertEquals(ahead, board.actuation)
        messages.clear()
        board.pass(0.4)
        assertEquals(listOf(BoardState.CONNECTED), states())
        assertTrue(board.actuation.isAtRest, "the watchdog, 3 s")
        board.pass(1.0)
        assertEquals(emptyList(), said<Message.Motor>())
    }

    @Test
    fun theNewerOneTwitchesWhenItIsToldToDriveAndIsConnected() {
        val board = board()
        board.pass(2.1)
        board.send(Command.Arm)
        board.pass(5.0, Command.AskState)
        board.send(Command.Disarm)
        board.pass(0.2)
        assertTrue(board.actuation.isAtRest)
        board.send(Command.Move(ahead))
        assertEquals(ahead, board.actuation, "its motors have power still")
        board.pass(0.15)
        assertTrue(board.actuation.isAtRest)
        board.send(Command.Arm)
        messages.clear()
        board.pass(0.2)
        assertTrue(said<Message.Motor>().isNotEmpty(), "motors with power are not armed anew")
        board.pass(9.0)
        assertEquals(listOf(BoardState.CONNECTED, BoardState.STANDBY), states())
        board.send(Command.Move(ahead))
        assertTrue(board.actuation.isAtRest, "without power")
    }

    /** The first motor is armed, and obeys, while the second one is not. */
    @Test
    fun aDriveThatIsNotTakenBackRunsTheFirstMotorWhileItArms() {
        val board = board()
        board.pass(2.1)
        board.send(Command.Move(ahead))
        board.send(Command.Arm)
        board.pass(2.0)
        assertTrue(board.actuation.isAtRest)
        board.pass(0.8)
        assertEquals(Actuation.Differential(0.5, 0.0), board.actuation)
    }

    @Test
    fun theOlderOneArmsItselfKnowsNoStatesAndGoesOnWhenItIsToldAnything() {
        val board = board(master)
        board.pass(7.0)
        assertEquals(emptyList(), said<Message.Motor>(), "nobody has told it anything")
        for (command in listOf(Command.Arm, Command.Disarm, Command.AskState)) board.send(command)
        assertEquals(List(3) { BoardError.TARGET }, messages.filterIsInstance<Message.Refused>().map { it.kind })
        board.pass(1.0, Command.Move(ahead))
        assertEquals(ahead, board.actuation)
        assertTrue(said<Message.Motor>().all { it.current == 0.0 })
        board.pass(0.7)
        assertTrue(board.actuation.isAtRest, "the watchdog, 0.5 s")
        messages.clear()
        board.pass(0.5)
        assertEquals(emptyList(), said<Message.Motor>())
        board.pass(0.2, Command.Move(ahead))
        assertEquals(ahead, board.actuation)
    }

    @Test
    fun aResetIsSilentAndDisarmed() {
        for (spec in listOf(BoardSpec(), master)) {
            val board = board(spec)
            board.pass(2.1)
            board.send(Command.Arm)
            board.pass(5.0, Command.Move(ahead))
            board.reset()
            messages.clear()
            board.pass(1.9, Command.Move(ahead))
            assertEquals(emptyList(), messages)
            board.pass(1.0, Command.Move(ahead))
            assertTrue(messages.isNotEmpty() || spec.firmware == Firmware.MASTER)
            assertTrue(board.actuation.isAtRest)
        }
    }

    @Test
    fun allItSaysIsUnderstoodAtTheFirmwaresRates() {
        val board = board(BoardSpec(batteryPeriod = 1.0))
        board.pass(2.0)
        board.send(Command.SetSensor(1, PortSensor.ATLAS_DO))
        board.send(Command.Arm)
        board.pass(4.4, Command.AskState)
        messages.clear()
        board.pass(60.0, Command.AskState)
        // The edges of the periods may shift by one step of 0.05 s each.
        assertEquals(600.0, messages.count { it == Message.Motor(0, 0.0, Double.NaN) }.toDouble(), 10.0)
        assertEquals(60.0, messages.count { it is Message.Battery }.toDouble(), 4.0)
        assertEquals(20.0, messages.count { it == Message.Oxygen(1, 7.5) }.toDouble(), 1.0)
        assertEquals(0, codec.malformed.total)
    }

    @Test
    fun aProbeSpeaksOnceItsPortIsNamedAndBeginsAnewEachTime() {
        val board = board()
        board.pass(10.0)
        assertEquals(0, board.readings)
        repeat(4) {
            board.send(Command.SetSensor(1, PortSensor.ATLAS_DO))
            board.pass(2.8)
        }
        assertEquals(0, board.readings, "named again before it has spoken")
        board.pass(0.4)
        assertEquals(1, board.readings)
        board.send(Command.SetSensor(2, PortSensor.ES2))
        board.pass(6.0)
        assertEquals(3, board.readings)
        board.send(Command.SetSensor(1, PortSensor.EMPTY))
        board.pass(6.0)
        assertEquals(3, board.readings)
    }

    @Test
    fun everyCommandIsKnownAndEverythingElseIsRefused() {
        val board = board(vectored = true)
        board.pass(2.1)
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
