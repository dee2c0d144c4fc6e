package stillwater.app.link

import stillwater.wire.ByteLink

/**
 * The link that is held now, whichever: a mission goes on over the next one. What is read is overheard by [ears].
 *
 * Read on the boat's thread; written to from any.
 */
internal class HeldLink : ByteLink {
    private val buffer = ByteArray(BUFFER)

    /** What the board said over [link]. */
    var ears = BoardEars()
        private set

    /** The link; null where none is held. */
    @Volatile var link: BoardLink? = null
        private set

    /** Holds [next] in place of the link before, which is closed. */
    fun hold(next: BoardLink?) {
        link?.close()
        ears = BoardEars()
        link = next
        next?.open()
    }

    override fun read(into: ByteArray): Int {
        val length = link?.read(into) ?: ByteLink.LOST
        ears.take(into, length)
        return length
    }

    override fun write(bytes: ByteArray): Boolean = link?.write(bytes) == true

    /** Reads all that has arrived, for nobody but the ears. */
    fun listen() {
        var length = read(buffer)
        while (length > 0) length = read(buffer)
    }

    private companion object {
        const val BUFFER = 4096
    }
}
