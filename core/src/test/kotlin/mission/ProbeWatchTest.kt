package stillwater.mission

import org.junit.jupiter.api.Test
import stillwater.virtual.BoardSpec
import kotlin.test.assertEquals
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** A board that reads a port only once it was told what is there, as firmware v4.2.0. */
class ProbeWatchTest {
    private fun desk(port: String = "\"port\":1,") = Desk(
        MissionSpec.fromJson(Desk.SMALL.replace("\"port\":1,", port)),
        seed = 61,
        board = BoardSpec(oxygenPeriod = 1.0),
    )

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
