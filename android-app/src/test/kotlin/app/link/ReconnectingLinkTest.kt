package stillwater.app.link

import org.junit.After
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import java.util.concurrent.TimeUnit
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** The link against a board that the test plays: everything but Bluetooth and USB themselves. */
@RunWith(RobolectricTestRunner::class)
class ReconnectingLinkTest {
    private val transport = FakeTransport()
    private val pause = FakePause()

    @Volatile private var uptime = 0L
    private val link = ReconnectingLink(transport, pause) { uptime }

    @After
    fun closeLink() = link.close()

    @Test
    fun bytesGoBothWays() {
        val board = connected()
        board.boardSends("{\"m0\"")
        assertEquals("{\"m0\"", link.text())
        assertTrue(link.write("go\n".toByteArray()))
        assertEquals("go\n", String(assertNotNull(board.written.poll(PATIENCE_SECONDS, TimeUnit.SECONDS))))
        val health = eventually("bytes counted") { link.health.takeIf { it.bytesOut == 3L } }
        assertEquals(5L, health.bytesIn)
        assertEquals(1L, health.connects)
    }

    @Test
    fun aLostConnectionIsClosedCountedAndReplacedByAFreshOne() {
        val first = connected()
        first.boardSends("a")
        link.text()
        first.boardLeaves()
        assertEquals(500L, pause.begins())
        assertTrue(first.closed)
        assertEquals(LinkState.WAITING, link.health.state)
        assertEquals(1L, link.health.drops)
        assertEquals("the other side closed the connection", link.health.lastError)
        assertEquals(-1, link.read(ByteArray(8)))
    }

    @Test
    fun itComesBackAfterALoss() {
        connected().boardLeaves()
        val second = transport.next(FakeConnection())
        pause.passes()
        second.boardSends("b")
        assertEquals("b", link.text())
        assertEquals(2L, link.health.connects)
        assertEquals(1L, link.health.drops)
    }

    @Test
    fun waitsGrowToEightSecondsAndAreShortAgainOnceTheBoardWasHeard() {
        repeat(6) { transport.next(FakeConnection("host is down")) }
        link.open()
        assertEquals(listOf(500L, 1000L, 2000L, 4000L, 8000L, 8000L), List(6) { pause.passes() })
        assertEquals(6L, eventually("failures") { link.health.failures.takeIf { it == 6L } })
        assertEquals("host is down", link.health.lastError)
        val heard = transport.next(FakeConnection())
        heard.boardSends("c")
        assertEquals("c", link.text())
        heard.boardLeaves()
        assertEquals(500L, pause.begins())
    }

    @Test
    fun whatWasLeftOfALostConnectionIsNotTakenForTheNext() {
        val first = connected()
        first.boardSends("{\"half of a li")
        eventually("arrived") { link.health.bytesIn.takeIf { it > 0 } }
        first.boardLeaves()
        pause.begins()
        // Nobody has read meanwhile; the next connection begins with its own bytes.
        val second = transport.next(FakeConnection())
        link.close()
        link.open()
        second.boardSends("whole\n")
        eventually("connected") { link.health.takeIf { it.bytesIn == 6L } }
        assertEquals("whole\n", link.text())
    }

    @Test
    fun closingEndsAReadThatWaits() {
        val board = connected()
        link.close()
        assertTrue(board.closed)
        assertEquals(LinkState.CLOSED, link.health.state)
        assertFalse(link.write("x".toByteArray()))
    }

    @Test
    fun closingEndsAWaitBetweenAttempts() {
        transport.next(FakeConnection("refused"))
        link.open()
        pause.begins()
        link.close()
        assertEquals(LinkState.CLOSED, link.health.state)
        // Opened again it begins anew, though the old wait never passed.
        connected()
        assertEquals(1L, link.health.connects)
    }

    @Test
    fun aCommandGivesWayToANewerOneAndIsCounted() {
        val board = connected()
        board.mayWrite.drainPermits()
        // One is being written and eight wait: of the eleven after them each takes an older one's place.
        assertTrue(link.write(byteArrayOf(0)))
        eventually("being written") { board.mayWrite.hasQueuedThreads().takeIf { it } }
        for (command in 1..19) assertTrue(link.write(byteArrayOf(command.toByte())))
        assertEquals(11L, link.health.writesDropped)
        board.mayWrite.release(Int.MAX_VALUE)
        val sent = List(9) { assertNotNull(board.written.poll(PATIENCE_SECONDS, TimeUnit.SECONDS)).single().toInt() }
        assertEquals(listOf(0) + (12..19), sent)
    }

    @Test
    fun aCommandWithoutAConnectionIsRefusedAndCounted() {
        assertFalse(link.write("go".toByteArray()))
        assertEquals(1L, link.health.writesDropped)
    }

    @Test
    fun silenceIsMeasuredFromTheLastByte() {
        val board = connected()
        uptime = 1000
        board.boardSends("d")
        link.text()
        uptime = 1700
        assertEquals(700L, link.health.quietMillis)
        link.close()
        assertNull(link.health.quietMillis)
    }

    @Test
    fun bytesThatNobodyReadsAreDroppedAndCounted() {
        val ring = ByteRing(4)
        assertEquals(0, ring.put("abc".toByteArray(), 3))
        val two = ByteArray(2)
        assertEquals(2, ring.take(two))
        assertEquals("ab", String(two))
        assertEquals(2, ring.put("defgh".toByteArray(), 5))
        val rest = ByteArray(9)
        assertEquals("cdef", String(rest, 0, ring.take(rest)))
        ring.put("x".toByteArray(), 1)
        ring.clear()
        assertEquals(0, ring.take(rest))
    }

    private fun connected(): FakeConnection {
        val connection = transport.next(FakeConnection())
        link.open()
        eventually("connected") { link.health.takeIf { it.state == LinkState.CONNECTED } }
        return connection
    }
}
