package stillwater.link

import stillwater.wire.ByteLink
import java.io.IOException
import java.net.StandardSocketOptions
import java.net.UnknownHostException
import java.nio.ByteBuffer
import java.nio.channels.SocketChannel

/**
 * A TCP connection that stands for a serial cable.
 *
 * What the network does not take at once is dropped and said so, as a full serial buffer would: a command that is late
 * is worth nothing.
 */
internal class TcpWire(private val channel: SocketChannel) : BoardWire {
    init {
        channel.configureBlocking(false)
        channel.setOption(StandardSocketOptions.TCP_NODELAY, true)
    }

    private var isLost = false

    override fun read(into: ByteArray): Int {
        if (isLost) return ByteLink.LOST
        val count = guarded(-1) { channel.read(ByteBuffer.wrap(into)) }
        if (count < 0) isLost = true
        return if (isLost) ByteLink.LOST else count
    }

    override fun write(bytes: ByteArray): Boolean = write(bytes, 0, bytes.size) == bytes.size

    /** Writes [length] of [bytes] from [offset]; answers how many were taken. */
    fun write(bytes: ByteArray, offset: Int, length: Int): Int {
        if (isLost) return 0
        return guarded(0) { channel.write(ByteBuffer.wrap(bytes, offset, length)) }
    }

    override fun close() {
        isLost = true
        try {
            channel.close()
        } catch (_: IOException) {
            // It is gone either way.
        }
    }

    private inline fun guarded(otherwise: Int, block: () -> Int): Int = try {
        block()
    } catch (_: IOException) {
        isLost = true
        otherwise
    }

    companion object {
        private const val PATIENCE_MILLIS = 3000

        fun open(address: WireAddress.Tcp): TcpWire {
            val channel = SocketChannel.open()
            try {
                channel.socket().connect(address.socketAddress(), PATIENCE_MILLIS)
                return TcpWire(channel)
            } catch (unknown: UnknownHostException) {
                throw problem(channel, address, "no such host", unknown)
            } catch (failed: IOException) {
                throw problem(channel, address, failed.message ?: "no connection", failed)
            }
        }

        private fun problem(
            channel: SocketChannel,
            address: WireAddress.Tcp,
            found: String,
            why: IOException,
        ): WireProblem {
            channel.close()
            return WireProblem("$address: expected a board that listens, found: $found", why)
        }
    }
}
