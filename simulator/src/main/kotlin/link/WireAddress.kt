package stillwater.link

import java.net.InetSocketAddress

/** Where a board's wire is, as it is typed. */
sealed interface WireAddress {
    /** Opens wires to it. */
    fun opener(): WireOpener

    /** A TCP port: [host] and [port], 1 to 65535. */
    data class Tcp(val host: String, val port: Int) : WireAddress {
        override fun opener() = WireOpener { TcpWire.open(this) }

        /** As the socket calls want it; the name is looked up each time, boats change their addresses. */
        fun socketAddress() = InetSocketAddress(host, port)

        override fun toString() = "tcp:$host:$port"
    }

    /** A serial port or pseudo-terminal by its [name], such as /dev/ttyACM0 or COM3, at [baud] bits/s, 8N1. */
    data class Serial(val name: String, val baud: Int) : WireAddress {
        override fun opener() = WireOpener { SerialWire.open(this) }

        override fun toString() = name
    }

    companion object {
        /** What [parse] takes, for people. */
        const val EXPECTED = "a serial port such as /dev/ttyACM0 or COM3, or tcp:HOST:PORT with a port in 1..65535"

        private const val TCP = "tcp:"
        private const val PORTS = 65535

        /** The address that [text] names, serial ports at [baud] bits/s; null where it names none. */
        fun parse(text: String, baud: Int): WireAddress? {
            if (text.startsWith(TCP)) return tcp(text.removePrefix(TCP))
            return if (text.isBlank()) null else Serial(text, baud)
        }

        /** HOST:PORT, the host in brackets where it is an IPv6 address; null where [text] is not of that form. */
        fun tcp(text: String): Tcp? {
            val host = text.substringBeforeLast(':', "").removeSurrounding("[", "]")
            val port = text.substringAfterLast(':').toIntOrNull()
            return if (host.isNotBlank() && port in 1..PORTS) Tcp(host, port!!) else null
        }
    }
}
