package stillwater.io

import java.math.BigDecimal
import java.math.RoundingMode
import java.time.Instant
import java.time.LocalTime
import java.time.ZoneOffset
import java.time.format.DateTimeFormatter
import kotlin.math.floor

/**
 * The times of a log in messages, as people find them in it.
 *
 * @param times how the log writes them. @param sample one of them as it stands.
 */
internal class TimeWording(private val times: CsvTimes, sample: String) {
    private val hasOffset = OFFSET.containsMatchIn(sample)
    private val isNumber = times.form.kind == TimeForm.Kind.PLAIN && IsoTime.seconds(sample).isNaN()

    /** Whether dates are with times that may be those of a clock on the wall. */
    private val isLocal = !isNumber && !hasOffset && times.form.kind != TimeForm.Kind.NUMBER

    /** [seconds] of the log: a number, a time of day, or a date with the time, UTC. */
    fun of(seconds: Double): String = when {
        isNumber -> "${plain(seconds)} s" + if (seconds > SINCE_1970) " (${date(seconds)})" else ""
        times.form.kind == TimeForm.Kind.OF_ANY_DAY -> ofDay(seconds)
        times.form.kind == TimeForm.Kind.NUMBER && times.form.zero == 0.0 -> "${plain(seconds)} s"
        else -> date(seconds)
    }

    /** What was expected where a row has the time [seconds], on the wrong side of [other]. */
    fun expected(seconds: Double, other: Double, fault: TimeFault): String {
        if (fault == TimeFault.AHEAD) return "a time before ${of(other)}, which the next row has"
        val hint = when {
            fault == TimeFault.DUPLICATE && times.label != null -> ", or one ${times.label} alone, not several in turn"
            fault == TimeFault.DUPLICATE -> ""
            times.form.kind == TimeForm.Kind.OF_ANY_DAY -> ", or --overnight HOURS if the next day begins here"
            isLocal && other - seconds in SUMMER_TIME -> " (summer time may end here: only times with an offset tell)"
            else -> ""
        }
        return "a time after ${of(other)}$hint"
    }

    private fun plain(seconds: Double) =
        BigDecimal(seconds).setScale(DECIMALS, RoundingMode.HALF_UP).stripTrailingZeros().toPlainString()

    private fun ofDay(seconds: Double): String {
        val millis = Math.round(seconds * MILLIS)
        val day = Math.floorDiv(millis, DAY)
        val time = LocalTime.ofNanoOfDay(Math.floorMod(millis, DAY) * NANOS_A_MILLI)
        return time.toString() + if (day > 0) " (day ${day + 1})" else ""
    }

    private fun date(seconds: Double): String {
        val whole = floor(seconds).toLong()
        val time = Instant.ofEpochSecond(whole, Math.round((seconds - whole) * MILLIS) * NANOS_A_MILLI)
        return DateTimeFormatter.ISO_LOCAL_DATE_TIME.format(time.atOffset(ZoneOffset.UTC))
    }

    private companion object {
        /** What follows a time of day that says where on Earth it is meant. */
        val OFFSET = Regex("""(?i):\d{2}.*(z|utc|gmt|[+-]\d{2}(:?\d{2})*|])\s*$""")

        /** Milliseconds in a day. */
        const val DAY = 86_400_000L
        const val MILLIS = 1000
        const val NANOS_A_MILLI = 1_000_000L
        const val DECIMALS = 6

        /** Numbers above it are seconds since 1970 rather than since the log's beginning: 1973. */
        const val SINCE_1970 = 1e8

        /** How far a clock goes back then, within a minute between rows. */
        val SUMMER_TIME = 3500.0..3600.0
    }
}
