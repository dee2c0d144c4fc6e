package stillwater.wire

/**
 * A stream of bytes to a board and back: a serial port, Bluetooth, TCP or a simulated link.
 *
 * Neither call waits and neither throws: a link that is lost reads nothing and says so when it is written to.
 */
public interface ByteLink {
    /**
     * Fills [into] with what has arrived, as far as it fits.
     *
     * @return the number of bytes, 0 where nothing has arrived, [LOST] where the link is closed or broken.
     */
    public fun read(into: ByteArray): Int

    /**
     * Sends all of [bytes].
     *
     * @return false where they could not be handed to the link.
     */
    public fun write(bytes: ByteArray): Boolean

    public companion object {
        /** What [read] answers when the link is closed or broken. */
        public const val LOST: Int = -1
    }
}
