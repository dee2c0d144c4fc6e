package stillwater.mission

import stillwater.control.Mixing
import stillwater.model.BoatTime
import stillwater.model.Drive
import stillwater.wire.ByteLink
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class BoardPortTest {
    /** Counts the drives it is told, and says what motors get as often as a board does. */
    private class Board : ByteLink {
        var drives = 0
        var echo: Double? = 0.0

        override fun read(into: ByteArray): Int {
            val value = echo ?: return 0
            val line = "{\"m0\":{\"v\":$value},\"m1\":{\"v\":0.0}}\r\n".toByteArray()
            line.copyInto(into)
            return line.size.also { echo = null }
        }

        override fun write(bytes: ByteArray): Boolean {
            if (bytes.decodeToString().startsWith("{\"m0\"")) drives++
            return true
        }
    }

    private val board = Board()
    private val port = BoardPort(board, Mixing.DIFFERENTIAL, { })
    private var step = 0

    /** Drives told in [steps] steps of 0.1 s, the board saying [echo] in each. */
    private fun told(steps: Int, drive: Drive, echo: Double?, isCalm: Boolean = true): Int {
        val before = board.drives
        repeat(steps) {
            board.echo = echo
            val now = BoatTime(0.1 * step++)
            port.hear(now)
            port.tell(now, drive, isCalm)
        }
        return board.drives - before
    }

    @Test
    fun aRestThatTheBoardKeepsIsNotRepeated() {
        told(10, Drive(0.5, 0.0), 0.5)
        // Three copies at once, then at the heartbeat until the board has said for a while that its motors rest.
        assertEquals(3 + 4, told(5, Drive.NONE, 0.0))
        assertEquals(0, told(100, Drive.NONE, 0.0))
        assertTrue(told(2, Drive.NONE, 0.3) > 0, "until the board says that a motor runs")
    }

    @Test
    fun restIsSaidAtTheHeartbeatUntilTheBoardSaysThatItKeepsIt() {
        told(30, Drive.NONE, 0.0)
        assertEquals(20, told(20, Drive.NONE, 0.4), "motors that run")
        assertEquals(20, told(20, Drive.NONE, Double.NaN), "what is no number")
        told(10, Drive.NONE, 0.0)
        assertTrue(told(20, Drive.NONE, null) in 15..20, "a board that does not say")
        assertEquals(20, told(20, Drive.NONE, 0.0, isCalm = false), "while it is being armed")
    }

    /** Only one of the six is heard where five are spoilt, and each spoilt one feeds the board's watchdog. */
    @Test
    fun aBoardThatIsSilentIsToldRestMoreOftenAtOnce() {
        told(10, Drive(0.5, 0.0), 0.5)
        told(4, Drive(0.5, 0.0), null)
        assertEquals(6, told(1, Drive.NONE, null))
        assertEquals(1, told(1, Drive.NONE, null), "no more than once in a heartbeat after that")
    }

    @Test
    fun aDriveAfterARestIsSaidAtOnce() {
        told(30, Drive.NONE, 0.0)
        assertEquals(1, told(1, Drive(0.2, 0.0), 0.0))
        assertEquals(10, told(10, Drive(0.2, 0.0), 0.2))
    }
}
