package stillwater.link

import com.fazecast.jSerialComm.SerialPort
import com.fazecast.jSerialComm.SerialPortInvalidPortException
import stillwater.wire.ByteLink
import java.util.concurrent.ExecutionException
import java.util.concurrent.Executors
import java.util.concurrent.Future
import java.util.concurrent.TimeUnit
import java.util.concurrent.TimeoutException

/**
 * A serial port, 8N1, with DTR and RTS set: without them many boards keep silent. Setting them resets many boards.
 *
 * Reading does not wait. Writing is done by a thread of its own, because the library waits in it for as long as the
 * port takes nothing: the mission waits [PATIENCE_MILLIS] ms at most, and while one write is under way the next is not
 * sent.
 */
internal class SerialWire private constructor(private val port: SerialPort) : BoardWire {
    private var isLost = false
    private val writer = Executors.newSingleThreadExecutor { work ->
        Thread(work, "write to a serial port").apply { isDaemon = true }
    }
    private var underWay: Future<Int>? = null

    override fun read(into: ByteArray): Int {
        if (isLost) return ByteLink.LOST
        val waiting = port.bytesAvailable()
        if (waiting < 0) return lost()
        if (waiting == 0) return 0
        val count = port.readBytes(into, minOf(waiting, into.size))
        return if (count < 0) lost() else count
    }

    override fun write(bytes: ByteArray): Boolean {
        if (isLost || underWay?.isDone == false) return false
        val write = writer.submit<Int> { port.writeBytes(bytes, bytes.size) }
        underWay = write
        return try {
            val count = write.get(PATIENCE_MILLIS, TimeUnit.MILLISECONDS)
            if (count < 0) isLost = true
            count == bytes.size
        } catch (_: TimeoutException) {
            false
        } catch (_: ExecutionException) {
            isLost = true
            false
        }
    }

    override fun close() {
        isLost = true
        writer.shutdown()
        port.closePort()
    }

    private fun lost(): Int {
        isLost = true
        return ByteLink.LOST
    }

    companion object {
        private const val BITS = 8

        /** Far longer than a command takes at 9600 bits/s. */
        private const val PATIENCE_MILLIS = 100L
        private const val BUFFER = 64 * 1024

        fun open(address: WireAddress.Serial): SerialWire {
            val port = try {
                SerialPort.getCommPort(address.name)
            } catch (wrong: SerialPortInvalidPortException) {
                throw WireProblem(SerialTrouble.NOT_THERE.words(address.name, ports()), wrong)
            } catch (missing: UnsatisfiedLinkError) {
                throw WireProblem("${address.name}: this system has no serial ports; use tcp:HOST:PORT", missing)
            }
            port.setComPortParameters(address.baud, BITS, SerialPort.ONE_STOP_BIT, SerialPort.NO_PARITY)
            port.setComPortTimeouts(SerialPort.TIMEOUT_NONBLOCKING, 0, 0)
            if (!port.openPort(0, BUFFER, BUFFER)) {
                val trouble = SerialTrouble.of(
                    port.lastErrorCode,
                    "windows" in System.getProperty("os.name").lowercase(),
                )
                throw WireProblem(trouble.words(address.name, ports(), port.lastErrorCode))
            }
            // A pseudo-terminal has no such lines, and no harm is done.
            port.setDTR()
            port.setRTS()
            return SerialWire(port)
        }

        private fun ports() = SerialPort.getCommPorts().map { it.systemPortPath }
    }
}
