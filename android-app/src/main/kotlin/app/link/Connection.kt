package stillwater.app.link

import java.io.IOException

/**
 * One attempt at talking to the board: made, opened once, closed for good. The next attempt is another object.
 *
 * [open], [read] and [write] may wait and belong to the link's threads. [close] may be called at any time from any
 * thread, more than once, and ends a call that waits.
 */
interface Connection {
    /** Waits until bytes can go both ways. @throws IOException where they cannot. */
    @Throws(IOException::class)
    fun open()

    /** Waits for bytes. @return how many lie in [into] now, 0 where nothing came for a while, -1 at the end. */
    @Throws(IOException::class)
    fun read(into: ByteArray): Int

    /** Hands all of [bytes] on. */
    @Throws(IOException::class)
    fun write(bytes: ByteArray)

    /** Lets go of everything that was taken, half opened or not. */
    fun close()
}

/** A way to the board: Bluetooth, USB, the virtual boat. */
interface Transport {
    /** What the screen calls it: the device's own name where it has one. */
    val name: String

    /** A fresh connection, not opened. @throws IOException where the device or the permission is missing. */
    @Throws(IOException::class)
    fun connection(): Connection
}
