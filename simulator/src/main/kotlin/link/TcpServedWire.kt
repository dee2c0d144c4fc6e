package stillwater.link

import java.io.IOException
import java.net.InetSocketAddress
import java.nio.channels.ServerSocketChannel
import java.nio.channels.UnresolvedAddressException

/**
 * A board's wire on a TCP port. A second connection takes the place of the first, whose program may hang.
 *
 * @param host name or address to listen on.
 * @param port 0 for any that is free.
 * @throws WireProblem if the port cannot be had.
 */
internal class TcpServedWire(host: String, port: Int) : ServedWire {
    private val server: ServerSocketChannel = ServerSocketChannel.open()
    private var wire: TcpWire? = null

    init {
        try {
            server.bind(InetSocketAddress(host, port))
            server.configureBlocking(false)
        } catch (failed: IOException) {
            server.close()
            throw WireProblem("tcp:$host:$port: cannot listen there: ${failed.message ?: "refused"}", failed)
        } catch (unknown: UnresolvedAddressException) {
            server.close()
            throw WireProblem("tcp:$host:$port: cannot listen there: no such host", unknown)
        }
    }

    override val address = "tcp:$host:${(server.localAddress as InetSocketAddress).port}"

    override var openings = 0L
        private set

    override var untaken = 0L
        private set

    override fun attend(): Boolean {
        val fresh = try {
            server.accept()
        } catch (_: IOException) {
            null
        }
        if (fresh != null) {
            wire?.close()
            wire = TcpWire(fresh)
            openings++
        }
        return wire != null
    }

    override fun read(into: ByteArray): Int {
        val count = wire?.read(into) ?: return 0
        if (count >= 0) return count
        wire?.close()
        wire = null
        return 0
    }

    override fun write(bytes: ByteArray, length: Int) {
        untaken += length - (wire?.write(bytes, 0, length) ?: 0)
    }

    override fun close() {
        wire?.close()
        wire = null
        server.close()
    }
}
