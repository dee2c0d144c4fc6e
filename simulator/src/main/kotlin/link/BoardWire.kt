package stillwater.link

import stillwater.wire.ByteLink

/**
 * An open wire to a board: a serial port or a TCP connection.
 *
 * Neither reading nor writing waits. Confined to one thread.
 */
interface BoardWire :
    ByteLink,
    AutoCloseable {
    /** Closes it; calling it again does nothing. Never throws. */
    override fun close()
}

/** A wire could not be opened; the message is one line that names it and what is wrong. */
class WireProblem(message: String, cause: Throwable? = null) : Exception(message, cause)

/** Opens a wire to a board. */
fun interface WireOpener {
    /**
     * Opens it; may take seconds.
     *
     * @throws WireProblem if that fails.
     */
    fun open(): BoardWire
}
