package stillwater.replay

import stillwater.io.PlatypusEntry
import stillwater.wire.BoardState
import java.math.BigDecimal

/**
 * Says what a recorded board's sensors said, in the board's own words, and stands in for what a Platypus log does not
 * have: it always speaks, arms at once and stays armed until it is told otherwise.
 */
internal class RecordedBoard {
    private var state = BoardState.STANDBY

    /** The wire to it. */
    val link = RecordedLink(::told)

    /** Lets a tenth of a second's motor line be heard; boards that are not armed have none. */
    fun beat() {
        if (state == BoardState.ACTIVE) link.say("""{"m0":{"v":0.000000},"m1":{"v":0.000000}}""")
    }

    /** Says what [sensor] said; answers whether there are words for it. */
    fun say(sensor: PlatypusEntry.Sensor): Boolean {
        val port = sensor.channel.coerceIn(0, HIGHEST_PORT)
        if (sensor.data.isEmpty() || sensor.data.any { !it.isFinite() }) return false
        val numbers = sensor.data.map { BigDecimal(it.toString()).toPlainString() }
        val type = TYPES[sensor.type] ?: return false
        val data = when (sensor.type) {
            "HDS_DEPTH" -> "${'$'}SDDBT,,f,${numbers[0]},M,,F"
            "HDS_TEMP" -> "${'$'}SDMTW,${numbers[0]},C"
            else -> numbers.joinToString(" ")
        }
        link.say("""{"s$port":{"type":"$type","data":"$data"}}""")
        return true
    }

    private fun told(command: String) {
        when (command.trim()) {
            """{"e":{"cmd":"arm"}}""" -> state = BoardState.ACTIVE
            """{"e":{"cmd":"disarm"}}""" -> state = BoardState.STANDBY
            """{"e":{"info":"state"}}""" -> Unit
            else -> return
        }
        link.say("""{"e":{"type":"state","data":"${state.word}"}}""")
    }

    private companion object {
        const val HIGHEST_PORT = 9

        /** Names of the sensors in logs and on the wire. */
        val TYPES = mapOf(
            "BATTERY" to "battery",
            "ES2" to "es2",
            "ATLAS_DO" to "atlas_do",
            "ATLAS_PH" to "atlas_ph",
            "HDS_DEPTH" to "hds",
            "HDS_TEMP" to "hds",
        )
    }
}
