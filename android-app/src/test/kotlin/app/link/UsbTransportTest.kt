package stillwater.app.link

import android.app.Application
import android.content.Intent
import android.hardware.usb.UsbDevice
import android.hardware.usb.UsbDeviceConnection
import android.hardware.usb.UsbManager
import com.hoho.android.usbserial.driver.UsbSerialDriver
import com.hoho.android.usbserial.driver.UsbSerialPort
import org.junit.After
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.Robolectric
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.annotation.Config
import org.robolectric.shadow.api.Shadow
import org.robolectric.util.ReflectionHelpers
import stillwater.wire.ByteLink
import java.io.IOException
import java.util.concurrent.CopyOnWriteArrayList
import java.util.concurrent.LinkedBlockingQueue
import java.util.concurrent.Semaphore
import java.util.concurrent.TimeUnit
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

@RunWith(RobolectricTestRunner::class)
@Config(sdk = [26, 29, 34, 35])
class UsbTransportTest {
    private val context: Application = RuntimeEnvironment.getApplication()
    private val manager = context.getSystemService(UsbManager::class.java)!!
    private val plugged = mutableListOf<UsbSerialDriver>()
    private var devices = 0
    private val transport = UsbTransport(context, "USB serial") { plugged.toList() }

    @After
    fun withTheLibrary() {
        SerialDrivers.areBuiltIn = true
    }

    @Test
    fun withoutAnAdapterItSaysSo() {
        assertEquals("no USB serial adapter is plugged in", assertFailsWith<IOException>(block = ::connect).message)
    }

    @Test
    fun withoutThePermissionItFailsAndWithItItOpens() {
        val first = plugIn(granted = false)
        repeat(3) { assertFailsWith<IOException>(block = ::connect) }
        shadowOf(manager).addOrUpdateUsbDevice(first.device, true)
        connect()
        assertEquals(1, first.port.opened)
    }

    @Test
    fun theAnswerToTheDialogComesToThisAppOnly() {
        val sent = shadowOf(UsbTransport.permissionAnswer(context)).savedIntent
        assertEquals(context.packageName, sent.`package`)
        assertEquals(UsbTransport.PERMISSION_ANSWERED, sent.action)
    }

    @Test
    fun thePortIsOpenedAsTheBoardExpects() {
        val driver = plugIn(granted = true)
        val connection = connect()
        assertEquals(listOf("open", "115200 8 1 0", "dtr true", "rts true"), driver.port.calls)
        connection.close()
        assertEquals("close", driver.port.calls.last())
    }

    /** A modem's driver in the library has no such lines, and says so by an exception that would end the process. */
    @Test
    fun anAdapterWithoutControlLinesIsOpenedAllTheSame() {
        val driver = plugIn(granted = true)
        driver.port.hasLines = false
        connect()
        assertEquals(listOf("open", "115200 8 1 0"), driver.port.calls)
    }

    /** With a time of up to 200 ms the library has been seen to lose bytes; without one, closing ends the wait. */
    @Test
    fun aReadWaitsWithoutEndAndClosingTheLinkEndsIt() {
        val port = plugIn(granted = true).port
        val link = ReconnectingLink(transport, context::getString, FakePause(), Parting(lingeringMillis = 0))
        link.open()
        port.arriving.put("{\"m0\"".toByteArray())
        assertEquals("{\"m0\"", link.text())
        val (size, timeout) = eventually("it reads on") { port.reads.takeIf { it.size == 2 }?.last() }
        assertEquals(0, timeout)
        assertTrue(size >= 512, "the largest packet of USB's bulk endpoints")
        assertEquals(0, port.ended.availablePermits())
        link.close()
        assertTrue(port.ended.tryAcquire(PATIENCE_SECONDS, TimeUnit.SECONDS), "the reader has gone")
        assertTrue("close" in port.calls)
    }

    /** As the library does when its read ends with nothing and the adapter is gone. */
    @Test
    fun anAdapterThatIsUnpluggedUnderARunningReadIsLeftAndTheNextIsFound() {
        val first = plugIn(granted = true).port
        val pause = FakePause()
        val link = link(pause)
        first.arriving.put("a".toByteArray())
        assertEquals("a", link.text())
        eventually("it waits for more") { first.reads.takeIf { it.size == 2 } }
        plugged.clear()
        first.unplug()
        pause.begins()
        val lost = link.health
        assertEquals(listOf(1L, 1L), listOf(lost.connects, lost.drops))
        assertEquals("USB get_status request failed", lost.lastError)
        assertTrue("close" in first.calls && first.ended.availablePermits() == 1)
        // Still out: an attempt fails, and the next one finds another device.
        pause.ends()
        val wait = pause.begins()
        assertEquals(LinkState.WAITING to 1L, link.health.run { state to failures })
        assertEquals(ByteLink.LOST, link.read(ByteArray(1)))
        assertEquals(1000L, wait)
        val second = plugIn(granted = true).port
        pause.ends()
        second.arriving.put("b".toByteArray())
        assertEquals("b", link.text())
        assertEquals(2L, link.health.connects)
        link.close()
    }

    /**
     * A driver that waits on although its adapter is gone: the next command finds it out, and closing ends the wait.
     */
    @Test
    fun aReadThatAnUnpluggedAdapterLeavesHangingIsEndedByTheNextCommand() {
        val port = plugIn(granted = true).port
        val pause = FakePause()
        val link = link(pause)
        eventually("it waits") { port.reads.takeIf { it.size == 1 } }
        plugged.clear()
        port.isGone = true
        assertTrue(link.write("question".toByteArray()), "taken, to be sent")
        pause.begins()
        assertEquals(LinkState.WAITING to 1L, link.health.run { state to drops })
        assertEquals(1L, link.health.writesDropped)
        assertEquals(1, port.ended.availablePermits(), "the reader is free")
        link.close()
    }

    private fun link(pause: FakePause): ReconnectingLink {
        val link = ReconnectingLink(transport, context::getString, pause, Parting(lingeringMillis = 0))
        link.open()
        eventually("connected") { link.health.takeIf { it.state == LinkState.CONNECTED } }
        return link
    }

    @Test
    fun aReplugIsAnotherDeviceAndIsFound() {
        plugIn(granted = true)
        connect()
        plugged.clear()
        assertFailsWith<IOException>(block = ::connect)
        val again = plugIn(granted = true)
        connect()
        assertEquals(1, again.port.opened)
    }

    @Test
    fun theAttachActivityIsGoneBeforeItIsSeen() {
        val intent = Intent(UsbManager.ACTION_USB_DEVICE_ATTACHED)
        val activity = Robolectric.buildActivity(UsbAttachedActivity::class.java, intent).create().get()
        assertTrue(activity.isFinishing)
        assertEquals(null, shadowOf(activity).nextStartedActivity)
    }

    @Test
    fun theLibraryIsSeenWhereItIsOnTheClassPath() {
        // In this test its declarations stand for it; in the APK that Maven makes there is nothing (ApkTest).
        assertTrue(SerialDrivers.areBuiltIn)
        assertFalse(SerialDrivers.has("com.hoho.android.usbserial.driver.NoSuchProber"))
    }

    /** An app that is updated by a build without the library may still hold USB as its link. */
    @Test
    fun aBuildWithoutTheLibraryFailsToConnectAndSaysWhy() {
        SerialDrivers.areBuiltIn = false
        val real = UsbTransport(context, "USB serial") { throw NoClassDefFoundError("UsbSerialProber") }
        val error = assertFailsWith<IOException> { real.connection() }
        assertEquals("this build of the app has no USB serial", error.message)
    }

    private fun connect(): Connection = transport.connection().apply { open() }

    private fun plugIn(granted: Boolean): FakeDriver {
        val device: UsbDevice = Shadow.newInstanceOf(UsbDevice::class.java)
        // The platform makes devices in a way of its own on each version; the name is all that is looked at.
        ReflectionHelpers.setField(device, "mName", "/dev/bus/usb/001/00${++devices}")
        shadowOf(manager).addOrUpdateUsbDevice(device, granted)
        return FakeDriver(device).also { plugged += it }
    }

    private class FakeDriver(private val device: UsbDevice) : UsbSerialDriver {
        val port = FakePort()

        override fun getDevice(): UsbDevice = device

        override fun getPorts(): List<UsbSerialPort> = listOf(port)
    }

    private class FakePort : UsbSerialPort {
        val calls = CopyOnWriteArrayList<String>()
        val opened get() = calls.count { it == "open" }
        var hasLines = true

        private fun line(words: String) {
            if (!hasLines) throw UnsupportedOperationException()
            calls += words
        }

        override fun open(connection: UsbDeviceConnection?) {
            calls += "open"
        }

        override fun setParameters(baudRate: Int, dataBits: Int, stopBits: Int, parity: Int) {
            calls += "$baudRate $dataBits $stopBits $parity"
        }

        override fun setDTR(value: Boolean) = line("dtr $value")

        override fun setRTS(value: Boolean) = line("rts $value")

        val arriving = LinkedBlockingQueue<ByteArray>()

        /** Size of the buffer and time, ms, of each read so far. */
        val reads = CopyOnWriteArrayList<Pair<Int, Int>>()

        /** A permit for each read that a close has ended. */
        val ended = Semaphore(0)

        /** As the library's: without a time it waits until something comes or the port is closed. */
        override fun read(into: ByteArray, timeoutMillis: Int): Int {
            reads += into.size to timeoutMillis
            val bytes = if (timeoutMillis == 0) arriving.take() else arriving.poll() ?: return 0
            if (bytes.isEmpty()) {
                ended.release()
                throw IOException(if (isGone) "USB get_status request failed" else "Connection closed")
            }
            bytes.copyInto(into)
            return bytes.size
        }

        override fun write(from: ByteArray, timeoutMillis: Int) {
            if (isGone) throw IOException("USB bulk transfer failed")
        }

        @Volatile var isGone = false

        /** The read that waits ends with nothing, and the adapter does not answer. */
        fun unplug() {
            isGone = true
            arriving.put(ByteArray(0))
        }

        override fun close() {
            calls += "close"
            arriving.put(ByteArray(0))
        }
    }
}
