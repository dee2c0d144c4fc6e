package stillwater.app.link

import org.junit.After
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
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
    private val words: (Int) -> String = RuntimeEnvironment.getApplication()::getString
    private val link = link(Parting(longestMillis = 30_000, lingeringMillis = 0))

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
        eventually("closed") { Unit.takeIf { board.closed } }
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

    /** In the worst of ways: not even closing the connection ends the write. */
    @Test
    fun aWriteThatHangsIsGivenUpCountedAndTheNextConnectionTakesCommands() {
        val board = connected()
        board.mayWrite.drainPermits()
        assertTrue(link.write("go\n".toByteArray()))
        eventually("being written") { board.mayWrite.hasQueuedThreads().takeIf { it } }
        uptime = CommandWriter.LONGEST_WRITE_MILLIS
        assertEquals(0, link.read(ByteArray(8)))
        assertEquals(LinkState.CONNECTED, link.health.state, "it may only be slow")
        uptime++
        link.write("stop\n".toByteArray())
        assertEquals(LinkState.WAITING, link.health.state)
        link.read(ByteArray(8))
        assertEquals(1L to 1L, link.health.run { writesHung to drops })
        assertEquals("a command did not go out within a second", link.health.lastError)
        eventually("closed") { Unit.takeIf { board.closed } }
        val second = transport.next(FakeConnection())
        assertEquals(500L, pause.passes())
        eventually("connected") { link.health.takeIf { it.state == LinkState.CONNECTED } }
        assertTrue(link.write("stop\n".toByteArray()))
        assertEquals("stop\n", String(assertNotNull(second.written.poll(PATIENCE_SECONDS, TimeUnit.SECONDS))))
        assertEquals(listOf(2L, 1L, 0L, 1L), link.health.run { listOf(connects, drops, failures, writesHung) })
    }

    /** A driver that holds everything: its write, its read, and whoever closes it. */
    @Test
    fun aConnectionThatNothingEndsIsLeftBehind() {
        val board = connected(FakeConnection(isStuck = true))
        board.mayWrite.drainPermits()
        link.write("go\n".toByteArray())
        eventually("being written") { board.mayWrite.hasQueuedThreads().takeIf { it } }
        uptime = CommandWriter.LONGEST_WRITE_MILLIS + 1
        link.read(ByteArray(8))
        val second = transport.next(FakeConnection())
        assertEquals(500L, pause.passes())
        eventually("connected") { link.health.takeIf { it.state == LinkState.CONNECTED } }
        // What the first still says is nobody's.
        board.boardSends("late\n")
        assertTrue(link.write("stop\n".toByteArray()))
        assertEquals("stop\n", String(assertNotNull(second.written.poll(PATIENCE_SECONDS, TimeUnit.SECONDS))))
        assertEquals(listOf(2L, 1L, 0L, 1L), link.health.run { listOf(connects, drops, failures, writesHung) })
    }

    @Test
    fun attemptsThatFailAfterAWriteHungAreCounted() {
        val board = connected()
        board.mayWrite.drainPermits()
        link.write("go\n".toByteArray())
        eventually("being written") { board.mayWrite.hasQueuedThreads().takeIf { it } }
        uptime = CommandWriter.LONGEST_WRITE_MILLIS + 1
        link.read(ByteArray(8))
        transport.next(FakeConnection("host is down"))
        pause.passes()
        val health = eventually("failed") { link.health.takeIf { it.failures == 1L } }
        assertEquals("host is down", health.lastError)
        assertEquals(1L, health.drops)
    }

    @Test
    fun theLastWordsGoOutBeforeTheConnectionIsClosed() {
        val board = connected()
        board.mayWrite.drainPermits()
        for (word in listOf("rest", "disarm")) assertTrue(link.write(word.toByteArray()))
        eventually("being written") { board.mayWrite.hasQueuedThreads().takeIf { it } }
        link.close()
        assertEquals(LinkState.CLOSED, link.health.state)
        assertFalse(link.write("go".toByteArray()), "none comes after them")
        assertFalse(board.closed)
        board.mayWrite.release(2)
        val sent = List(2) { String(assertNotNull(board.written.poll(PATIENCE_SECONDS, TimeUnit.SECONDS))) }
        assertEquals(listOf("rest", "disarm"), sent)
        eventually("closed") { Unit.takeIf { board.closed } }
    }

    @Test
    fun lastWordsThatDoNotGoOutAreNotWaitedForForEver() {
        val hurried = link(Parting(longestMillis = 1, lingeringMillis = 0))
        val board = transport.next(FakeConnection())
        hurried.open()
        eventually("connected") { hurried.health.takeIf { it.state == LinkState.CONNECTED } }
        board.mayWrite.drainPermits()
        hurried.write("rest".toByteArray())
        hurried.close()
        eventually("closed") { Unit.takeIf { board.closed } }
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

    private fun link(parting: Parting) = ReconnectingLink(transport, words, pause, parting) { uptime }

    private fun connected(connection: FakeConnection = FakeConnection()): FakeConnection {
        transport.next(connection)
        link.open()
        eventually("connected") { link.health.takeIf { it.state == LinkState.CONNECTED } }
        return connection
    }
}
