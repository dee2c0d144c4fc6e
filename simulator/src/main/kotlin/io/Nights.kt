package stillwater.io

import java.util.Locale

/** The midnights that times of day without a date pass, and where. */
internal class Nights {
    private class Night(val line: Long, val seconds: Double)

    private val passed = ArrayList<Night>()

    /** What to say of them; null where there are none. */
    val note: String?
        get() {
            val longest = passed.maxByOrNull { it.seconds } ?: return null
            val count = if (passed.size == 1) "once, before" else "${passed.size} times, the longest before"
            val hours = "%.1f".format(Locale.ROOT, longest.seconds / HOUR)
            return "times of day pass midnight $count line ${longest.line} with $hours h between two rows"
        }

    /** Hears that the row in [line] has been read by [fields]. */
    fun take(line: Long, fields: FieldReader) {
        if (fields.midnights == passed.size) return
        // One that was taken back was the last.
        if (fields.midnights < passed.size) passed.removeLast() else passed += Night(line, fields.night)
    }

    private companion object {
        const val HOUR = 3600.0
    }
}
