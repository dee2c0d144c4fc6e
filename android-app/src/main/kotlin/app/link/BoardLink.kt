package stillwater.app.link

/** The way to the board as the mission sees it. No call waits and none throws. */
interface BoardLink {
    /** What the screen calls it. */
    val name: String

    /** What it went through, as of now. */
    val health: LinkHealth

    /** Begins to connect, and connects again whenever the connection is lost, until [close]. */
    fun open()

    /** Ends the connection and the attempts. A closed link may be opened again. */
    fun close()

    /** @return how many bytes lie in [into] now, 0 where nothing arrived, -1 where there is no connection. */
    fun read(into: ByteArray): Int

    /** @return false where [bytes] will not be sent. */
    fun write(bytes: ByteArray): Boolean
}
