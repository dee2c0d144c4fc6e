package stillwater.app.link

import android.content.Context
import android.content.Intent
import android.content.SharedPreferences
import stillwater.app.R
import stillwater.app.mayWait

/** Which way to the board the person chose. */
sealed interface LinkChoice {
    /** A way to a real board. */
    sealed interface Board : LinkChoice

    /** A paired device. */
    data class Bluetooth(val address: String, val name: String) : Board

    /** Whatever serial adapter is plugged in. */
    data object Usb : Board

    /** No board: core's virtual boat on virtual water. */
    data object Demo : LinkChoice

    companion object {
        private const val KIND = "link"
        private const val ADDRESS = "address"
        private const val NAME = "name"
        private const val BLUETOOTH = "bluetooth"
        private const val USB = "usb"
        private const val DEMO = "demo"

        /** Puts [choice] into [intent]. */
        fun put(intent: Intent, choice: LinkChoice): Intent =
            when (choice) {
                is Usb -> intent.putExtra(KIND, USB)
                is Demo -> intent.putExtra(KIND, DEMO)
                is Bluetooth ->
                    intent.putExtra(KIND, BLUETOOTH).putExtra(ADDRESS, choice.address).putExtra(NAME, choice.name)
            }

        /** The choice in [intent], null where it has none. */
        fun of(intent: Intent): LinkChoice? = of { intent.getStringExtra(it) }

        /** Keeps [choice] beyond the process; null forgets. */
        fun keep(kept: SharedPreferences, choice: LinkChoice?) {
            mayWait("preferences")
            val edit = kept.edit().clear()
            when (choice) {
                null -> Unit
                is Usb -> edit.putString(KIND, USB)
                is Demo -> edit.putString(KIND, DEMO)
                is Bluetooth ->
                    edit.putString(KIND, BLUETOOTH).putString(ADDRESS, choice.address).putString(NAME, choice.name)
            }
            // On the disk before anything moves: what comes next may be the process's death.
            edit.commit()
        }

        /** What was kept, null where nothing was. */
        fun kept(kept: SharedPreferences): LinkChoice? {
            mayWait("preferences")
            return of { kept.getString(it, null) }
        }

        private fun of(text: (String) -> String?): LinkChoice? =
            when (text(KIND)) {
                USB -> Usb
                DEMO -> Demo
                BLUETOOTH -> text(ADDRESS)?.let { Bluetooth(it, text(NAME) ?: it) }
                else -> null
            }
    }
}

/** Makes the link to a board that a choice stands for; a test's makes a fake. */
fun interface LinkMaker {
    /** A link, not opened. */
    fun make(context: Context, choice: LinkChoice.Board): BoardLink

    companion object {
        /** Real links. */
        val REAL =
            LinkMaker { context, choice ->
                val transport =
                    when (choice) {
                        is LinkChoice.Usb -> UsbTransport(context, context.getString(R.string.usb_serial))
                        is LinkChoice.Bluetooth -> BluetoothTransport(context, choice.address, choice.name)
                    }
                ReconnectingLink(transport, context::getString)
            }
    }
}
