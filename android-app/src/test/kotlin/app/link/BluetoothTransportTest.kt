package stillwater.app.link

import android.app.Application
import android.bluetooth.BluetoothAdapter
import android.bluetooth.BluetoothManager
import org.junit.Before
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.annotation.Config
import java.io.IOException
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertNotSame

@RunWith(RobolectricTestRunner::class)
@Config(sdk = [26, 29, 34, 35])
class BluetoothTransportTest {
    private val context: Application = RuntimeEnvironment.getApplication()
    private lateinit var adapter: BluetoothAdapter

    @Before
    fun switchOn() {
        shadowOf(context).grantPermissions("android.permission.BLUETOOTH_CONNECT", "android.permission.BLUETOOTH")
        adapter = context.getSystemService(BluetoothManager::class.java)!!.adapter
        shadowOf(adapter).setEnabled(true)
    }

    @Test
    fun everyConnectionIsAFreshSocket() {
        val transport = BluetoothTransport(context, BOARD, "Boat 3")
        assertNotSame(transport.connection(), transport.connection())
        transport.connection().apply {
            open()
            close()
            close()
        }
    }

    @Test
    fun bluetoothThatIsOffIsAFailureToConnect() {
        shadowOf(adapter).setEnabled(false)
        val error = assertFailsWith<IOException> { BluetoothTransport(context, BOARD, "Boat 3").connection() }
        assertEquals("Bluetooth is off: switch it on in the phone's settings", error.message)
    }

    @Test
    fun whatIsNoAddressIsAFailureToConnect() {
        assertFailsWith<IOException> { BluetoothTransport(context, "boat", "Boat 3").connection() }
    }

    @Test
    fun pairedDevicesAreOfferedByName() {
        val devices = listOf("00:00:00:00:00:02" to "B", "00:00:00:00:00:01" to "A").map { (address, name) ->
            adapter.getRemoteDevice(address).also { shadowOf(it).setName(name) }
        }
        shadowOf(adapter).setBondedDevices(devices.toSet())
        assertEquals(listOf("A", "B"), BluetoothTransport.paired(context).map { it.name })
    }

    private companion object {
        const val BOARD = "00:11:22:33:AA:BB"
    }
}
