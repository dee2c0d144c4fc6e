package stillwater.app.service

import android.app.Application
import android.bluetooth.BluetoothManager
import android.bluetooth.BluetoothSocket
import org.robolectric.Shadows.shadowOf
import org.robolectric.shadows.ShadowBluetoothDevice
import stillwater.app.link.BluetoothTransport
import stillwater.app.link.BoardLink
import stillwater.app.link.FakePause
import stillwater.app.link.LinkHealth
import stillwater.app.link.LinkState
import stillwater.app.link.Parting
import stillwater.app.link.ReconnectingLink
import stillwater.app.link.eventually
import java.io.ByteArrayOutputStream
import java.util.concurrent.atomic.AtomicLong

/** Between the service and a virtual boat: what one end has sent is at the other when a call returns. */
internal interface DeskWire {
    /** The phone's end, as the service holds it. */
    val link: BoardLink

    /** Sends [bytes] from the board; lost where the wire is cut. */
    fun toPhone(bytes: ByteArray)

    /** All that the phone has sent since the last call. */
    fun fromPhone(): ByteArray

    /** Nothing passes any more, and the phone is told so. */
    fun cut()

    /** The phone may connect again. */
    fun mend()
}

/** A queue each way; both are emptied by a cut. */
internal class DirectWire : DeskWire {
    private val inbound = ByteArrayOutputStream()
    private val outbound = ByteArrayOutputStream()

    @Volatile private var counted = LinkHealth()

    override val link =
        object : BoardLink {
            override val name = "Boat 3"
            override val health: LinkHealth get() = counted

            override fun open() = mend()

            override fun close() {
                counted = counted.copy(state = LinkState.CLOSED)
            }

            override fun read(into: ByteArray): Int =
                synchronized(inbound) {
                    if (counted.state != LinkState.CONNECTED) return -1
                    val all = inbound.toByteArray()
                    val count = minOf(all.size, into.size)
                    all.copyInto(into, 0, 0, count)
                    inbound.reset()
                    inbound.write(all, count, all.size - count)
                    count
                }

            override fun write(bytes: ByteArray): Boolean =
                synchronized(outbound) {
                    if (counted.state == LinkState.CONNECTED) outbound.write(bytes)
                    counted.state == LinkState.CONNECTED
                }
        }

    override fun toPhone(bytes: ByteArray) =
        synchronized(inbound) {
            if (counted.state == LinkState.CONNECTED) inbound.write(bytes)
        }

    override fun fromPhone(): ByteArray = synchronized(outbound) { outbound.toByteArray().also { outbound.reset() } }

    override fun cut() {
        counted = counted.copy(state = LinkState.WAITING, drops = counted.drops + 1)
        synchronized(inbound) { inbound.reset() }
        synchronized(outbound) { outbound.reset() }
    }

    override fun mend() {
        counted = counted.copy(state = LinkState.CONNECTED, connects = counted.connects + 1)
    }
}

/** Bluetooth as the app has it, over Robolectric's pair of pipes in place of the radio. */
internal class SocketWire(context: Application, private val board: String) : DeskWire {
    private val adapter = context.getSystemService(BluetoothManager::class.java)!!.adapter
    private val pause = FakePause()
    private val real =
        ReconnectingLink(
            BluetoothTransport(context, board, "Boat 3"),
            context::getString,
            pause,
            Parting(lingeringMillis = 0),
        )
    private val accepted = AtomicLong()
    private var sent = 0L

    init {
        shadowOf(context).grantPermissions("android.permission.BLUETOOTH_CONNECT", "android.permission.BLUETOOTH")
        shadowOf(adapter).setEnabled(true)
    }

    override val link: BoardLink =
        object : BoardLink by real {
            /** Virtual time does not go by while real threads connect: a busy machine would see no board for minutes. */
            override fun open() {
                real.open()
                eventually("it is connected") { Unit.takeIf { health.state == LinkState.CONNECTED } }
            }

            override fun write(bytes: ByteArray): Boolean =
                real.write(bytes).also { if (it) accepted.addAndGet(bytes.size.toLong()) }
        }

    override fun toPhone(bytes: ByteArray) {
        if (bytes.isEmpty() || link.health.state != LinkState.CONNECTED) return
        val feeder = shadowOf(socket()).inputStreamFeeder
        // The pipe holds a kilobyte.
        for (start in bytes.indices step PIPE) {
            val length = minOf(PIPE, bytes.size - start)
            feeder.write(bytes, start, length)
            feeder.flush()
            sent += length
            eventually("the reader has taken all") { Unit.takeIf { link.health.bytesIn == sent } }
        }
    }

    override fun fromPhone(): ByteArray {
        if (link.health.state != LinkState.CONNECTED) return ByteArray(0)
        eventually("the writer has written all") { Unit.takeIf { link.health.bytesOut == accepted.get() } }
        val sink = shadowOf(socket()).outputStreamSink
        return ByteArray(sink.available()).also { sink.read(it) }
    }

    override fun cut() {
        val old = shadowOf(socket())
        ShadowBluetoothDevice.reset()
        old.inputStreamFeeder.close()
        eventually("the loss is seen") { Unit.takeIf { link.health.state == LinkState.WAITING } }
    }

    override fun mend() {
        pause.passes()
        eventually("it is connected again") { Unit.takeIf { link.health.state == LinkState.CONNECTED } }
    }

    /** The one that Robolectric hands to whoever asks. */
    private fun socket(): BluetoothSocket =
        adapter.getRemoteDevice(board).createRfcommSocketToServiceRecord(BluetoothTransport.SERIAL_PORT)

    private companion object {
        const val PIPE = 512
    }
}
