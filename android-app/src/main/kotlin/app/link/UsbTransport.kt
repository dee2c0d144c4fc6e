package stillwater.app.link

import android.app.PendingIntent
import android.content.Context
import android.content.Intent
import android.hardware.usb.UsbDevice
import android.hardware.usb.UsbManager
import android.os.Build
import com.hoho.android.usbserial.driver.UsbSerialDriver
import com.hoho.android.usbserial.driver.UsbSerialPort
import com.hoho.android.usbserial.driver.UsbSerialProber
import stillwater.app.R
import java.io.IOException

/** Finds the serial adapters that are plugged in. A seam, because the library's own prober needs real hardware. */
internal fun interface SerialDrivers {
    /** A driver for each adapter that one is known for, now. */
    fun find(manager: UsbManager): List<UsbSerialDriver>

    companion object {
        /** CDC-ACM, FTDI, CH34x, CP21xx and what else usb-serial-for-android knows. */
        val LIBRARY = SerialDrivers { UsbSerialProber.getDefaultProber().findAllDrivers(it) }

        /** Whether the library is in this build; the one that Maven makes is without it, and a test may be. */
        @Volatile var areBuiltIn: Boolean = has("com.hoho.android.usbserial.driver.UsbSerialProber")

        /** Whether the program has the class [name]. */
        fun has(name: String): Boolean =
            try {
                Class.forName(name)
                true
            } catch (_: ClassNotFoundException) {
                false
            }
    }
}

/**
 * The first USB serial adapter that is plugged in, at 115200 8N1.
 *
 * Every connection looks for it anew, because a replugged adapter is another device to Android, and asks for the
 * permission where it is missing: the attempt fails, and a later one finds the permission given. DTR and RTS are set,
 * for without them some boards send nothing; others start anew when they are, so a fresh connection is a disarmed one.
 */
internal class UsbTransport(
    private val context: Context,
    override val name: String,
    private val drivers: SerialDrivers = SerialDrivers.LIBRARY,
) : Transport {
    private val manager: UsbManager? = context.getSystemService(UsbManager::class.java)
    private var askedFor: UsbDevice? = null

    override fun connection(): Connection {
        val manager = this.manager ?: fail(R.string.usb_no_host)
        // The choice may have been kept by a build that had the library.
        if (!SerialDrivers.areBuiltIn) fail(R.string.usb_missing)
        val driver = drivers.find(manager).firstOrNull() ?: fail(R.string.usb_no_adapter)
        val device = driver.device
        if (!manager.hasPermission(device)) {
            // Once for each time it is plugged in: the dialog is not to come back every few seconds.
            if (device != askedFor) manager.requestPermission(device, permissionAnswer(context))
            askedFor = device
            fail(R.string.usb_not_permitted)
        }
        askedFor = null
        val port = driver.ports.firstOrNull() ?: fail(R.string.usb_no_port)
        return UsbConnection(manager, device, port, context.getString(R.string.usb_not_opened))
    }

    private fun fail(words: Int): Nothing = throw IOException(context.getString(words))

    companion object {
        /** What Android tells us when the person has answered; stays within the app. */
        const val PERMISSION_ANSWERED = "stillwater.app.USB_PERMISSION_ANSWERED"

        /** Explicit and mutable: Android 14 refuses a mutable implicit intent, and fills in the answer. */
        fun permissionAnswer(context: Context): PendingIntent {
            val intent = Intent(PERMISSION_ANSWERED).setPackage(context.packageName)
            val flags = if (Build.VERSION.SDK_INT >= Build.VERSION_CODES.S) PendingIntent.FLAG_MUTABLE else 0
            return PendingIntent.getBroadcast(context, 0, intent, flags)
        }
    }
}

private class UsbConnection(
    private val manager: UsbManager,
    private val device: UsbDevice,
    private val port: UsbSerialPort,
    private val notOpened: String,
) : Connection {
    override fun open() {
        val opened = manager.openDevice(device) ?: throw IOException(notOpened)
        try {
            port.open(opened)
            port.setParameters(BAUD, DATA_BITS, UsbSerialPort.STOPBITS_1, UsbSerialPort.PARITY_NONE)
            raise(port::setDTR)
            raise(port::setRTS)
        } catch (error: IOException) {
            opened.close()
            throw error
        }
    }

    /** The library's drivers for adapters without such a line refuse: their boards do not wait for one. */
    private fun raise(line: (Boolean) -> Unit) =
        try {
            line(true)
        } catch (_: UnsupportedOperationException) {
            Unit
        }

    /**
     * Waits without end, as the library's author recommends for a thread of its own: with a time of up to 200 ms it has
     * been seen to lose bytes. Closing the port ends the wait. Where the wait ends with nothing the library has looked
     * whether the adapter is still there, and throws where it is not.
     *
     * Source: usb-serial-for-android 3.9, `CommonUsbSerialPort.read` and `close`; its issue 503.
     */
    override fun read(into: ByteArray): Int = port.read(into, WITHOUT_END)

    override fun write(bytes: ByteArray) = port.write(bytes, WRITE_MILLIS)

    override fun close() {
        try {
            port.close()
        } catch (_: IOException) {
            // It was closed, or is unplugged: there is nothing left to close.
            return
        }
    }

    private companion object {
        const val BAUD = 115200
        const val DATA_BITS = 8
        const val WITHOUT_END = 0

        /** A board that takes no command for as long has hung. */
        const val WRITE_MILLIS = 500
    }
}
