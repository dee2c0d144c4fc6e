package stillwater.mission

import stillwater.control.Mixing
import stillwater.model.BoatTime
import stillwater.virtual.BoardSpec
import stillwater.virtual.Firmware
import stillwater.wire.BoardState
import stillwater.wire.ByteLink
import stillwater.wire.Command
import stillwater.wire.PlatypusEncoder
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** A link whose halves fail by themselves, and what a board is left with when nobody speaks to it any more. */
class LinkHalvesTest {
    /** Loses what the board says, or what it is told. */
    private class Halves(private val inner: ByteLink) : ByteLink {
        var isDeaf = false
        var isMute = false
        val told = ArrayList<String>()

        override fun read(into: ByteArray): Int {
            val count = inner.read(into)
            return if (isDeaf && count > 0) 0 else count
        }

        override fun write(bytes: ByteArray): Boolean {
            told.add(bytes.decodeToString().trim())
            return isMute || inner.write(bytes)
        }
    }

    private lateinit var halves: Halves

    private fun desk(seed: Int, watchdog: Double) = Desk(
        Desk.small(),
        seed,
        board = BoardSpec(oxygenPeriod = 1.0, watchdog = watchdog),
        wrapped = { Halves(it).also { made -> halves = made } },
    )

    /** Firmware v4.2.0 rests its motors 3 s after the last line of any kind. */
    @Test
    fun aBoardThatHearsAgainBeforeItIsHeardIsNotKeptRunning() {
        for (mute in listOf(0.5, 0.8, 1.5, 2.3, 2.9)) {
            val desk = desk(471, watchdog = 3.0)
            desk.mission.start()
            assertTrue(desk.until(60.0) { !desk.boat.board.actuation.isAtRest && it == MissionState.Surveying })
            halves.isDeaf = true
            halves.isMute = true
            repeat((mute * 10).toInt()) { desk.step() }
            halves.isMute = false
            // The watchdog's 3 s, and a step's time for the last word before the cut.
            repeat(31 - (mute * 10).toInt()) { desk.step() }
            repeat(200) {
                assertTrue(desk.boat.board.actuation.isAtRest, "mute for $mute s")
                desk.step()
            }
            halves.isDeaf = false
            assertTrue(desk.until(40.0) { !desk.boat.board.actuation.isAtRest }, "goes on when it is heard")
        }
    }

    /** By its source v4.2.0 stays at rest after its watchdog until it is armed; the master branch before it goes on. */
    @Test
    fun aBoardThatDrivesDoNotWakeIsArmedAgain() {
        for (firmware in Firmware.entries) {
            val desk = Desk(
                Desk.small(),
                473,
                board = BoardSpec(firmware, oxygenPeriod = 1.0, watchdog = 0.5),
                wrapped = { Halves(it).also { made -> halves = made } },
            )
            desk.mission.start()
            assertTrue(desk.until(60.0) { !desk.boat.board.actuation.isAtRest && it == MissionState.Surveying })
            halves.isMute = true
            repeat(7) { desk.step() }
            assertTrue(desk.boat.board.actuation.isAtRest, "its watchdog has rested it")
            halves.isMute = false
            halves.told.clear()
            assertTrue(desk.until(15.0) { !desk.boat.board.actuation.isAtRest }, "$firmware")
            repeat(50) { desk.step() }
            val arm = PlatypusEncoder.encode(Command.Arm).decodeToString().trim()
            assertEquals(firmware == Firmware.V4_2, arm in halves.told, "armed again only where it must be")
        }
    }

    /** The phone is busy just when it would notice: the next step is 0.6 s after the last word, and by then nothing was said. */
    @Test
    fun aSilenceThatIsNoticedLateIsAnsweredWithRestAllTheSame() {
        val desk = desk(472, watchdog = 3.0)
        desk.mission.start()
        assertTrue(desk.until(60.0) { !desk.boat.board.actuation.isAtRest && it == MissionState.Surveying })
        halves.isDeaf = true
        repeat(3) { desk.step() }
        repeat(3) { desk.boat.advance(0.1) }
        repeat(2) { desk.step() }
        assertTrue(desk.boat.board.actuation.isAtRest)
    }

    /** v4.2.0 says active from the first moment on. */
    @Test
    fun aBoardThatIsBeingArmedIsDisarmedBeforeTheMissionIsOver() {
        for (steps in 1..12) {
            val desk = desk(481, watchdog = 0.5)
            desk.mission.start()
            assertTrue(desk.until(60.0) { it == MissionState.Arming })
            repeat(steps) { desk.step() }
            halves.told.clear()
            desk.mission.stop()
            assertTrue(desk.until(5.0) { desk.mission.board.isDisarmed })
            val disarm = PlatypusEncoder.encode(Command.Disarm).decodeToString().trim()
            assertTrue(disarm in halves.told, "told after $steps steps")
            // Nobody steps the mission any more; a board that was left arming says active some time.
            val buffer = ByteArray(4096)
            val said = StringBuilder()
            repeat(100) {
                desk.boat.phone.write(PlatypusEncoder.encode(Command.AskState))
                desk.boat.advance(0.1)
                val count = desk.boat.phone.read(buffer)
                if (count > 0) said.append(buffer.decodeToString(0, count))
            }
            assertTrue("connected" in said)
            assertFalse("\"active\"" in said, "armed after $steps steps")
        }
    }

    /** The answer on its way when the board was told to disarm is of the time before. */
    @Test
    fun whatABoardSaidBeforeItWasToldDoesNotCount() {
        val answers = ArrayDeque<String>()
        val link = object : ByteLink {
            override fun read(into: ByteArray): Int {
                val line = answers.removeFirstOrNull() ?: return 0
                return line.encodeToByteArray().also { it.copyInto(into) }.size
            }

            override fun write(bytes: ByteArray) = true
        }
        val port = BoardPort(link, Mixing.DIFFERENTIAL, { })
        fun hear(seconds: Double): BoardState? {
            answers.add("{\"e\":{\"type\":\"state\",\"data\":\"standby\"}}\r\n")
            port.hear(BoatTime(seconds))
            return port.state
        }
        port.askState(BoatTime(0.0))
        assertEquals(BoardState.STANDBY, hear(0.1))
        port.order(Command.Arm)
        assertEquals(null, port.state)
        port.askState(BoatTime(1.1))
        port.order(Command.Disarm)
        assertEquals(null, hear(1.2), "asked before it was told to disarm")
        port.order(Command.Disarm)
        port.askState(BoatTime(2.2))
        assertEquals(BoardState.STANDBY, hear(2.3), "told the same again")
    }
}
