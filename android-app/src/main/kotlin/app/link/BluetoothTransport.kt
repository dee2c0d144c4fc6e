package stillwater.app.link

import android.Manifest.permission.BLUETOOTH_CONNECT
import android.annotation.SuppressLint
import android.bluetooth.BluetoothAdapter
import android.bluetooth.BluetoothDevice
import android.bluetooth.BluetoothManager
import android.bluetooth.BluetoothSocket
import android.content.Context
import stillwater.app.R
import stillwater.app.service.Preflight
import java.io.IOException
import java.util.UUID

/**
 * Bluetooth's serial port profile to a paired device, found by its address.
 *
 * Every connection is a fresh socket: one that has failed or was closed cannot be used again on many phones.
 */
internal class BluetoothTransport(
    private val context: Context,
    private val address: String,
    override val name: String,
) : Transport {

    // The screen asks for it; a refusal is a SecurityException, which the link takes.
    @SuppressLint("MissingPermission")
    override fun connection(): Connection {
        obstacle(context)?.let { throw IOException(context.getString(it)) }
        if (!BluetoothAdapter.checkBluetoothAddress(address)) {
            throw IOException(context.getString(R.string.bluetooth_no_address, address))
        }
        val device = checkNotNull(context.bluetoothAdapter()) { "no obstacle, and no adapter" }.getRemoteDevice(address)
        return BluetoothConnection(device.createRfcommSocketToServiceRecord(SERIAL_PORT))
    }

    companion object {
        /** Bluetooth's assigned number for the serial port profile. */
        val SERIAL_PORT: UUID = UUID.fromString("00001101-0000-1000-8000-00805F9B34FB")

        /** What stands in the way of any connection, in words; null where nothing does. */
        fun obstacle(context: Context): Int? {
            val adapter = context.bluetoothAdapter()
            return when {
                adapter == null -> R.string.bluetooth_missing
                BLUETOOTH_CONNECT in Preflight.missingPermissions(context) -> R.string.bluetooth_not_permitted
                !adapter.isEnabled -> R.string.bluetooth_off
                else -> null
            }
        }

        /** The devices the phone is paired with; none where Bluetooth or the permission is missing. */
        @SuppressLint("MissingPermission")
        fun paired(context: Context): List<BluetoothDevice> =
            try {
                context.bluetoothAdapter()?.bondedDevices.orEmpty().sortedBy { it.name ?: it.address }
            } catch (_: SecurityException) {
                emptyList()
            }
    }
}

private fun Context.bluetoothAdapter(): BluetoothAdapter? =
    getSystemService(BluetoothManager::class.java)?.adapter

/** A socket that is closed wholly: its streams first, each whatever the others say, then itself. */
private class BluetoothConnection(private val socket: BluetoothSocket) : Connection {
    @SuppressLint("MissingPermission")
    override fun open() = socket.connect()

    override fun read(into: ByteArray): Int = socket.inputStream.read(into)

    override fun write(bytes: ByteArray) {
        socket.outputStream.write(bytes)
        socket.outputStream.flush()
    }

    override fun close() {
        quietly { socket.inputStream.close() }
        quietly { socket.outputStream.close() }
        quietly { socket.close() }
    }

    /** The connection is given up: that closing fails changes nothing. */
    private inline fun quietly(step: () -> Unit) {
        try {
            step()
        } catch (_: IOException) {
            return
        }
    }
}
