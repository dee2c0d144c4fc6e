package stillwater.mission

import org.junit.jupiter.api.Test
import stillwater.virtual.BoardSpec
import stillwater.virtual.Firmware
import stillwater.wire.ByteLink
import kotlin.test.assertEquals
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** A board that reads a port only once it was told what is there, as firmware v4.2.0. */
class ProbeWatchTest {
    /** Counts how often the board is told of its probe, and how often while its motors run. */
    private class Ear(private val inner: ByteLink) : ByteLink by inner {
        var told = 0
        var toldUnderWay = 0
        var isLost = false
        lateinit var desk: Desk

        override fun write(bytes: ByteArray): Boolean {
            if ("AtlasDO" !in bytes.decodeToString()) return inner.write(bytes)
            told++
            if (!desk.boat.board.actuation.isAtRest) toldUnderWay++
            return isLost || inner.write(bytes)
        }
    }

    private lateinit var ear: Ear

    private fun desk(port: String = "\"port\":1,", board: BoardSpec = BoardSpec(oxygenPeriod = 1.0)) = Desk(
        MissionSpec.fromJson(Desk.SMALL.replace("\"port\":1,", port)),
        seed = 61,
        board = board,
        wrapped = { Ear(it).also { made -> ear = made } },
    ).also { ear.desk = it }

    private fun Desk.sail(seconds: Double) = until(seconds) { false }

    @Test
    fun theBoardIsToldOfTheProbeBeforeItIsArmedAndAfterEachReset() {
        val desk = desk()
        desk.sail(20.0)
        assertEquals(0, desk.boat.board.readings, "before anybody began")
        assertTrue(desk.mission.probeSilence > 19, "${desk.mission.probeSilence} s")
        desk.mission.start()
        desk.sail(40.0)
        val before = desk.mission.readings.passed
        assertTrue(before > 20, "$before readings")
        assertTrue(desk.mission.probeSilence < 2, "${desk.mission.probeSilence} s")
        desk.boat.board.reset()
        desk.sail(40.0)
        val after = desk.mission.readings.passed
        assertTrue(after > before + 20, "$before readings before a reset, $after with it")
    }

    @Test
    fun aLineThatWasLostIsSaidAgain() {
        val desk = desk()
        desk.mission.start()
        desk.until(60.0) { it == MissionState.Surveying }
        // The board forgets, and nobody hears of it.
        desk.boat.board.forgetProbe()
        desk.sail(50.0)
        assertTrue(desk.mission.probeSilence < 2, "${desk.mission.probeSilence} s")
    }

    /** Each time costs a moment of rest, and none of them the mission. */
    @Test
    fun aProbeThatStaysSilentIsSetUpThreeTimesAndNeverUnderWay() {
        for (firmware in Firmware.entries) {
            val desk = desk(board = BoardSpec(firmware, oxygenPeriod = 500.0))
            desk.mission.start()
            assertTrue(desk.until(60.0) { it == MissionState.Surveying })
            var atRest = 0
            desk.meanwhile = { if (desk.boat.board.actuation.isAtRest) atRest++ }
            desk.sail(200.0)
            assertEquals(3, ear.told, "$firmware")
            assertEquals(0, ear.toldUnderWay)
            assertTrue(atRest < 60, "at rest for ${atRest / 10.0} s of 200")
            assertTrue(desk.mission.probeSilence > 200, "${desk.mission.probeSilence} s")
            assertEquals(MissionState.Surveying, desk.mission.state)
            // A board that is armed again is not told again either.
            desk.boat.board.reset()
            desk.sail(40.0)
            assertEquals(3, ear.told)
        }
    }

    @Test
    fun aProbeThatSpeaksIsNotStartedOver() {
        val desk = desk()
        desk.mission.start()
        desk.sail(60.0)
        assertEquals(1, ear.told)
        val disarm = "{\"e\":{\"cmd\":\"disarm\"}}\n".encodeToByteArray()
        repeat(3) {
            desk.boat.board.receive(disarm)
            assertTrue(desk.until(10.0) { it == MissionState.Arming }, "it is armed again")
            desk.sail(20.0)
        }
        assertEquals(1, ear.told)
        assertTrue(desk.mission.readings.passed > 80, "${desk.mission.readings.passed} readings")
    }

    @Test
    fun wordsThatAreLostAreSaidAgain() {
        val desk = desk()
        ear.isLost = true
        desk.mission.start()
        assertTrue(desk.until(60.0) { ear.told == 2 })
        ear.isLost = false
        desk.sail(25.0)
        assertEquals(3, ear.told)
        assertEquals(0, ear.toldUnderWay)
        assertTrue(desk.mission.probeSilence < 2, "${desk.mission.probeSilence} s")
    }

    @Test
    fun aPortThatIsNotNamedIsSilentAndTheMissionKnows() {
        val desk = desk(port = "")
        desk.mission.start()
        desk.sail(60.0)
        assertEquals(0, desk.mission.readings.passed)
        assertTrue(desk.mission.probeSilence > 59, "${desk.mission.probeSilence} s")
    }

    @Test
    fun onlyPortsWithASerialLineAreSetUp() {
        val probe = Desk.small().probe
        for (port in listOf(null, 0, 4, 9)) assertNull(ProbeWatch(probe.copy(port = port)).setUp, "port $port")
        for (port in 1..3) assertEquals("$port", "${ProbeWatch(probe.copy(port = port)).setUp}".filter(Char::isDigit))
    }
}
