package stillwater.link

/**
 * The board's end of a wire: whoever opens the other end talks to the board. One at a time.
 *
 * No call waits. Confined to one thread.
 */
interface ServedWire : AutoCloseable {
    /** What the other end's program is to be given, such as `/dev/pts/3` or `tcp:127.0.0.1:4001`. */
    val address: String

    /** Whether somebody has the other end open; to be asked before reading and writing. */
    fun attend(): Boolean

    /** Times the other end was opened. */
    val openings: Long

    /** Bytes that nobody took, because nobody was there or did not read. */
    val untaken: Long

    /** Fills [into] with what has come; answers how many bytes. */
    fun read(into: ByteArray): Int

    /** Sends [length] of [bytes]. */
    fun write(bytes: ByteArray, length: Int)

    override fun close()
}
