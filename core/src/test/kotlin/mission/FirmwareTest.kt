package stillwater.mission

import stillwater.model.BoatTime
import stillwater.virtual.BoardSpec
import stillwater.virtual.Firmware
import stillwater.wire.ByteLink
import stillwater.wire.Command
import stillwater.wire.PlatypusEncoder
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Missions on boards that are as silent as each generation of the firmware is, while the link and the board fail. */
class FirmwareTest {
    /** What is between the phone and the board. */
    private class Between(private val inner: ByteLink) : ByteLink {
        var isDeaf = false
        var isMute = false

        /** How often a line reaches the board. */
        var copies: (String) -> Int = { 1 }

        /** Bytes that are heard besides what the board says, per read. */
        var noise: () -> ByteArray = { ByteArray(0) }

        val told = ArrayList<String>()

        override fun read(into: ByteArray): Int {
            val count = inner.read(into)
            val more = noise()
            more.copyInto(into, maxOf(count, 0))
            return if (isDeaf) 0 else maxOf(count, 0) + more.size
        }

        override fun write(bytes: ByteArray): Boolean {
            val line = bytes.decodeToString().trim()
            told.add(line)
            if (!isMute) repeat(copies(line)) { inner.write(bytes) }
            return true
        }
    }

    private lateinit var between: Between

    private val boards = listOf(
        BoardSpec(oxygenPeriod = 1.0),
        BoardSpec(oxygenPeriod = 1.0, watchdog = 0.5, batteryPeriod = 1.0),
        BoardSpec(Firmware.MASTER, oxygenPeriod = 1.0),
    )

    private fun desk(board: BoardSpec, seed: Int = 601) =
        Desk(Desk.small(), seed, board = board, wrapped = { Between(it).also { made -> between = made } })

    private fun Desk.isDriven() = !boat.board.actuation.isAtRest

    private fun Desk.begin() {
        until(3.0) { false }
        mission.start()
        assertTrue(until(90.0) { it == MissionState.Surveying && isDriven() }, "${mission.state} at last")
        until(10.0) { false }
    }

    /** No motor runs for longer than a decision takes after what [strike] does, and they run again after [mend]. */
    private fun withstands(board: BoardSpec, what: String, seconds: Double, strike: () -> Unit, mend: () -> Unit) {
        val desk = desk(board)
        desk.begin()
        strike()
        var running = 0
        repeat((seconds * 10).toInt()) {
            desk.step()
            running = if (desk.isDriven()) running + 1 else 0
            // The mission's 0.6 s, and where it is not heard the watchdog's time after the last word before the cut.
            assertTrue(running <= (maxOf(0.6, board.watchdog) * 10).toInt() + 1, "$what, $board: ${running / 10.0} s")
        }
        mend()
        val longest = 6.0 + board.batteryPeriod + board.arming
        assertTrue(desk.until(longest) { desk.isDriven() }, "$what, $board: ${desk.mission.state} after $longest s")
        // It goes on for good.
        assertFalse(desk.until(10.0) { it != MissionState.Surveying && !desk.isDriven() }, "$what, $board")
    }

    @Test
    fun aLinkThatIsLostOrHalfLostForAnyTimeIsComeBackFrom() {
        for (board in boards) {
            for (seconds in listOf(0.8, 2.5, 3.5, 6.0, 20.0)) {
                withstands(
                    board,
                    "lost for $seconds s",
                    seconds,
                    { between.isDeaf = true.also { between.isMute = true } },
                    { between.isDeaf = false.also { between.isMute = false } },
                )
            }
            withstands(board, "mute", 8.0, { between.isMute = true }, { between.isMute = false })
            withstands(board, "deaf", 8.0, { between.isDeaf = true }, { between.isDeaf = false })
        }
    }

    @Test
    fun aBoardThatIsResetUnderWayOrAtConnectingIsArmedAgain() {
        for (board in boards) {
            val desk = desk(board)
            desk.boat.board.reset()
            desk.begin()
            for (pause in listOf(0.0, 1.0, 7.0)) {
                desk.until(pause) { false }
                desk.boat.board.reset()
                assertFalse(desk.isDriven())
                val longest = board.booting + board.batteryPeriod + board.arming + 5
                assertTrue(desk.until(longest) { desk.isDriven() }, "$board: ${desk.mission.state}")
            }
        }
    }

    @Test
    fun armingThatIsLostOrComesTwiceOrLateIsArmingAllTheSame() {
        val arm = PlatypusEncoder.encode(Command.Arm).decodeToString().trim()
        for (copies in listOf(0, 2)) {
            val desk = desk(boards[0])
            var left = 3
            between.copies = { if (it == arm && left > 0) copies.also { left-- } else 1 }
            desk.until(3.0) { false }
            desk.mission.start()
            assertTrue(desk.until(30.0) { desk.isDriven() }, "$copies copies: ${desk.mission.state}")
        }
        // The slowest pair of motor controllers.
        val late = desk(boards[0].copy(arming = 36.0))
        late.begin()
        assertEquals(1, between.told.count { it == arm }, "told once")
    }

    /** A board that says active, and does not speak of its motors, is being armed: what it is told then one motor does. */
    @Test
    fun noMotorRunsBeforeBothAreArmed() {
        val desk = desk(boards[0].copy(arming = 12.0))
        desk.until(3.0) { false }
        desk.mission.start()
        assertTrue(desk.until(60.0) { it == MissionState.Arming })
        repeat(120) {
            desk.step()
            assertFalse(desk.isDriven())
        }
        assertTrue(desk.until(5.0) { desk.isDriven() })
    }

    /** Firmware v4.2.0 does what it is told for a tenth of a second though it is not armed. */
    @Test
    fun aBoardThatIsNotArmedIsNotToldToDrive() {
        val arm = PlatypusEncoder.encode(Command.Arm).decodeToString().trim()
        for (phase in 0 until 10) {
            val desk = desk(boards[0])
            desk.begin()
            repeat(phase) { desk.step() }
            // The board rests without a word, as when the notice of its watchdog is lost.
            desk.boat.board.receive(PlatypusEncoder.encode(Command.Disarm))
            between.isDeaf = true
            desk.step()
            between.isDeaf = false
            // The gate's 0.4 s, and a step.
            repeat(4) { desk.step() }
            between.told.clear()
            assertTrue(desk.until(10.0) { desk.isDriven() })
            val before = if (arm in between.told) between.told.takeWhile { it != arm } else emptyList()
            assertEquals(emptyList(), before.filter { it.startsWith("{\"m0\"") && it != REST }, "phase $phase")
        }
    }

    @Test
    fun drivesThatAreLostCostWayOnly() {
        for (board in boards) {
            val desk = desk(board)
            val random = Random(611)
            between.copies = { if (it.startsWith("{\"m0\"") && random.nextInt(3) > 0) 0 else 1 }
            desk.begin()
            assertTrue(desk.until(1000.0) { it is MissionState.Stopped }, "$board: ${desk.mission.state}")
            assertEquals(MissionState.Stopped(StopReason.COMPLETED), desk.mission.state)
        }
    }

    @Test
    fun aBoardThatIsResetEveryTenSecondsNeverRunsAwayAndIsGivenUpByNobody() {
        for (board in boards.map { it.copy(batteryPeriod = 1.0) }) {
            val desk = desk(board)
            var driven = 0
            desk.until(3.0) { false }
            desk.mission.start()
            repeat(1200) { step ->
                if (step % 100 == 0) desk.boat.board.reset()
                desk.step()
                if (desk.isDriven()) driven++
            }
            assertTrue(driven > 50, "$board: $driven steps under way")
            assertTrue(desk.until(40.0) { desk.isDriven() }, "$board: ${desk.mission.state} when resets end")
        }
    }

    @Test
    fun aLostQuestionDoesNotPutABoardAtRestToSleep() {
        val ask = PlatypusEncoder.encode(Command.AskState).decodeToString().trim()
        for (board in boards) {
            val desk = desk(board)
            desk.begin()
            desk.mission.wish = Wish.WAIT
            desk.until(5.0) { false }
            var left = 0
            between.copies = { if (it == ask && left > 0) 0.also { left-- } else 1 }
            repeat(10) {
                left = 1
                assertFalse(desk.until(3.0) { it == MissionState.Arming }, "$board")
            }
        }
    }

    /** 115 200 baud are 1152 bytes in a step. */
    @Test
    fun aLineThatIsFullOfNonsenseOrOfEmptyLinesIsALinkThatIsLost() {
        val random = Random(612)
        val nonsense = { random.nextBytes(NOISE) }
        val empty = { ByteArray(NOISE) { '\r'.code.toByte() } }
        for (board in boards) {
            for (noise in listOf(nonsense, empty)) {
                val desk = desk(board)
                desk.begin()
                val heard = desk.mission.board.unreadable
                between.noise = noise
                between.isMute = true
                desk.until(1.0) { false }
                if (board.watchdog < 1) assertFalse(desk.isDriven())
                desk.until(4.0) { false }
                assertFalse(desk.isDriven(), "$board")
                if (noise === nonsense) assertTrue(desk.mission.board.unreadable > heard, "$board")
                between.noise = { ByteArray(0) }
                between.isMute = false
                assertTrue(desk.until(20.0) { desk.isDriven() }, "$board: ${desk.mission.state}")
            }
        }
    }

    @Test
    fun aBoardIsLeftAtRestWhicheverItIs() {
        for (board in boards) {
            val desk = desk(board)
            desk.begin()
            desk.mission.stop()
            desk.until(1.0) { false }
            assertFalse(desk.isDriven())
            assertEquals(board.firmware == Firmware.V4_2, desk.mission.board.isDisarmed)
            assertEquals(board.firmware == Firmware.MASTER, desk.mission.board.armsItself)
            repeat(200) {
                desk.step()
                assertFalse(desk.isDriven())
            }
        }
    }

    /** Whatever the next process says keeps the board's watchdog quiet, and it does not hear that motors run. */
    @Test
    fun aBoardLeftRunningAndNotHeardIsTakenToRest() {
        for (board in boards) {
            val desk = desk(board)
            desk.begin()
            assertTrue(desk.until(20.0) { desk.isDriven() })
            between.isDeaf = true
            val next = Mission(desk.spec, between, desk.log)
            repeat(40) { step ->
                next.step(BoatTime(desk.boat.time.seconds + 1))
                desk.boat.advance(0.1)
                // It is listened to for a second, in which the quick ones rest by themselves, and told to disarm.
                if (step > 11) assertFalse(desk.isDriven(), "$board")
            }
        }
    }

    /** What is said of drives may be spoilt, and a board that arms keeps it. */
    @Test
    fun aBoardThatArmsItselfBeforeTheMissionBeganIsNotToldToRest() {
        val desk = desk(BoardSpec(Firmware.MASTER, arming = 20.0, oxygenPeriod = 1.0))
        desk.until(10.0) { false }
        assertEquals(0, between.told.count { it == REST })
        assertTrue(between.told.count { "disarm" in it } >= 5)
    }

    private companion object {
        const val NOISE = 1152
        const val REST = "{\"m0\":{\"v\":0},\"m1\":{\"v\":0}}"
    }
}
