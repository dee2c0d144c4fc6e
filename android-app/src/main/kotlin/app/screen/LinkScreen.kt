package stillwater.app.screen

import android.content.Context
import android.graphics.Typeface
import android.os.SystemClock
import android.view.View
import android.widget.TextView
import stillwater.app.R
import stillwater.app.link.BluetoothTransport
import stillwater.app.link.LinkChoice
import stillwater.app.link.SerialDrivers
import stillwater.app.service.BoatSnapshot

/** The link and its health, and what else the boat can be connected to: another device, a cable, or the demo. */
internal class LinkScreen(private val context: Context, private val host: ScreenHost) : Screen {
    private val parts = LinkHealthWords(context)
    private val lines = ArrayList<TextView>()
    private val health = context.column()
    private val choices = context.column()
    private val rates = LinkRates()
    private var offered: List<LinkChoice>? = null

    /** What stood in Bluetooth's way when links were offered; null where nothing did. */
    private var obstacle: Int? = null
    private val choose = context.heading(context.getString(R.string.choose_link))
    private val another =
        context.largeButton(context.getString(R.string.another_link)) { choices.show(!choices.isShown) }

    /** Whether a link was held at the last look; null before the first. */
    private var isHeld: Boolean? = null

    override val view: View =
        context.scrolling {
            below(choose)
            below(another)
            below(choices)
            below(health)
        }

    override fun opened() = offer()

    override fun show(snapshot: BoatSnapshot) {
        rates.look(SystemClock.elapsedRealtime(), snapshot)
        // Permitted or switched on meanwhile.
        if (BluetoothTransport.obstacle(context) != obstacle) offer()
        fold(snapshot.linkName != null)
        val words = parts.of(snapshot, rates)
        while (lines.size < words.size) {
            val line = context.line("")
            lines += line
            health.below(line)
        }
        lines.forEachIndexed { index, line ->
            val each = words.getOrNull(index)
            line.say(each?.words)
            line.setTextColor(context.getColor(if (each?.isBad == true) R.color.bad else R.color.text))
            line.setTypeface(null, if (each?.isTitle == true) Typeface.BOLD else Typeface.NORMAL)
        }
    }

    /** What there is to connect to is in sight where nothing is connected, and one press away where something is. */
    private fun fold(isHeld: Boolean) {
        if (isHeld == this.isHeld) return
        this.isHeld = isHeld
        choose.show(!isHeld)
        another.show(isHeld)
        choices.show(!isHeld)
    }

    /** Offers what there is to connect to now. */
    private fun offer() {
        val obstacle = BluetoothTransport.obstacle(context)
        val paired =
            BluetoothTransport.paired(context).map { LinkChoice.Bluetooth(it.address, it.name ?: it.address) }
        val usb = if (SerialDrivers.areBuiltIn) listOf(LinkChoice.Usb) else emptyList()
        val now: List<LinkChoice> = paired + usb + LinkChoice.Demo
        if (now == offered && obstacle == this.obstacle) return
        offered = now
        this.obstacle = obstacle
        choices.removeAllViews()
        if (obstacle != null) {
            val words = context.getString(R.string.problem, context.getString(obstacle))
            choices.below(context.line(words, R.color.bad))
        }
        if (obstacle == R.string.bluetooth_not_permitted) {
            choices.below(context.largeButton(context.getString(R.string.allow)) { host.allow() })
        }
        if (obstacle == null && paired.isEmpty()) choices.below(context.line(context.getString(R.string.no_paired)))
        for (choice in now) {
            val name =
                when (choice) {
                    is LinkChoice.Bluetooth -> choice.name
                    is LinkChoice.Usb -> context.getString(R.string.usb_serial)
                    is LinkChoice.Demo -> context.getString(R.string.demo)
                }
            choices.below(context.largeButton(context.getString(R.string.connect_to, name)) { host.connect(choice) })
        }
        if (LinkChoice.Usb !in now) choices.below(context.line(context.getString(R.string.usb_not_built_in)))
    }
}
