package stillwater.io

import stillwater.report.counted
import java.util.TreeMap

/** Which sensors a Platypus log holds, and how many lines of each. */
internal class SensorCatalogue {
    private data class Source(val type: String, val channel: Int)

    private class Count(var lines: Long = 0, var fields: Int = 0)

    private val sources = TreeMap<Source, Count>(compareBy<Source> { it.type }.thenBy { it.channel })

    /** Counts one more line. */
    fun add(sensor: PlatypusEntry.Sensor) {
        val count = sources.getOrPut(Source(sensor.type, sensor.channel)) { Count() }
        count.lines++
        count.fields = maxOf(count.fields, sensor.data.size)
    }

    /** Channels on which [type] was seen. */
    fun channels(type: String): List<Int> = sources.keys.filter { it.type == type }.map { it.channel }

    /** Every number that may be chosen, as it is written for `--value`, batteries left out. */
    fun choices(): List<SensorChoice> = sources.filterKeys { it.type != "BATTERY" }.flatMap { (source, count) ->
        val channel = source.channel.takeIf { channels(source.type).size > 1 }
        List(count.fields) { SensorChoice(source.type, channel, it) }
    }

    /** All sensors with their numbers of lines, for a message. */
    override fun toString(): String {
        if (sources.isEmpty()) return "no sensor lines at all"
        return sources.entries.joinToString(", ") { (source, count) ->
            val names = SensorChoice.FIELDS[source.type]?.take(count.fields)
            val channel = if (channels(source.type).size > 1) "#${source.channel}" else ""
            val fields =
                names?.joinToString("|", prefix = ".") ?: if (count.fields > 1) ".0-${count.fields - 1}" else ""
            "${source.type}$channel$fields (${counted(count.lines, "line")})"
        }
    }
}
