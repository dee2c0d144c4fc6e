package stillwater.app.link

import java.io.IOException
import java.util.concurrent.LinkedBlockingQueue
import java.util.concurrent.Semaphore
import java.util.concurrent.TimeUnit
import kotlin.test.assertNotNull

/** Long enough for any machine; a test that has to wait so long has failed. */
internal const val PATIENCE_SECONDS = 30L

/** One end of a line to a board that the test plays. [isStuck] is one whose closing ends nothing and never returns. */
internal class FakeConnection(private val refusal: String? = null, private val isStuck: Boolean = false) : Connection {
    private val incoming = LinkedBlockingQueue<ByteArray>()
    val written = LinkedBlockingQueue<ByteArray>()

    /** Permits that writing takes, one a command; as good as endless unless the test drains them. */
    val mayWrite = Semaphore(Int.MAX_VALUE)

    @Volatile var closed = false
        private set

    fun boardSends(text: String) {
        incoming.add(text.toByteArray())
    }

    /** The other side goes away. */
    fun boardLeaves() {
        incoming.add(END)
    }

    override fun open() {
        refusal?.let { throw IOException(it) }
    }

    override fun read(into: ByteArray): Int {
        val bytes = orEnd { incoming.take() }
        if (bytes === END) return -1
        check(bytes.size <= into.size) { "the test sends more than a read takes" }
        bytes.copyInto(into)
        return bytes.size
    }

    override fun write(bytes: ByteArray) {
        mayWrite.acquire()
        if (closed) throw IOException("closed")
        written.put(bytes)
    }

    override fun close() {
        if (isStuck) Semaphore(0).acquireUninterruptibly()
        closed = true
        incoming.add(END)
    }

    private companion object {
        val END = ByteArray(0)
    }
}

/** Hands out the connections that the test made, in their order; with none left it waits for more. */
internal class FakeTransport(override val name: String = "board") : Transport {
    private val connections = LinkedBlockingQueue<FakeConnection>()

    fun next(connection: FakeConnection): FakeConnection = connection.also(connections::add)

    override fun connection(): Connection =
        orEnd { connections.take() }
}

/** A thread that is told to end while it waits for the board sees a line that broke, as with a socket. */
private fun <T> orEnd(wait: () -> T): T =
    try {
        wait()
    } catch (interrupted: InterruptedException) {
        throw IOException(interrupted)
    }

/** Waits as long as the test likes and remembers what it was asked for. */
internal class FakePause : Pause {
    private val asked = LinkedBlockingQueue<Long>()
    private val over = Semaphore(0)

    override fun pause(millis: Long) {
        asked.put(millis)
        over.acquire()
    }

    /** The wait that is asked for next; it is over at once. */
    fun passes(): Long = assertNotNull(asked.poll(PATIENCE_SECONDS, TimeUnit.SECONDS)).also { over.release() }

    /** The wait that is asked for next; it goes on. */
    fun begins(): Long = assertNotNull(asked.poll(PATIENCE_SECONDS, TimeUnit.SECONDS))

    /** The wait that goes on is over. */
    fun ends() = over.release()
}

/** Asks again and again until [what] is there; other threads work meanwhile. */
internal fun <T : Any> eventually(message: String, what: () -> T?): T {
    val end = System.nanoTime() + TimeUnit.SECONDS.toNanos(PATIENCE_SECONDS)
    while (System.nanoTime() < end) {
        what()?.let { return it }
        // To those that are waited for, where there are fewer processors than threads.
        Thread.yield()
    }
    throw AssertionError("not within $PATIENCE_SECONDS s: $message")
}

/** What the link hands out within one read, as text; waits until there is something. */
internal fun BoardLink.text(): String {
    val buffer = ByteArray(256)
    return eventually("bytes") { read(buffer).takeIf { it > 0 }?.let { String(buffer, 0, it) } }
}
