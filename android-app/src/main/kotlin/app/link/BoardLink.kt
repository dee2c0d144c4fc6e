package stillwater.app.link

import stillwater.wire.ByteLink

/** The way to the board as the mission sees it: bytes, and what became of them. No call waits and none throws. */
interface BoardLink : ByteLink {
    /** What the screen calls it. */
    val name: String

    /** What it went through, as of now. */
    val health: LinkHealth

    /** Begins to connect, and connects again whenever the connection is lost, until [close]. */
    fun open()

    /** Ends the connection, once what was written has gone out, and the attempts. A closed link may be opened again. */
    fun close()
}
