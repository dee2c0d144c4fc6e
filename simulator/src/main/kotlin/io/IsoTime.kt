package stillwater.io

import java.time.DateTimeException
import java.time.LocalDateTime
import java.time.OffsetDateTime
import java.time.ZoneOffset
import java.time.format.DateTimeFormatter

/** Times as text: ISO 8601, a blank allowed in place of the T; UTC where no offset is given. */
internal object IsoTime {
    private const val SHORTEST = 16
    private const val DATE = 10
    private const val NANOS = 1e-9

    /** The seconds in a time column's field: a number as it stands, or as [seconds]; NaN where it is neither. */
    fun ofField(text: CharArray, offset: Int, length: Int): Double {
        val number = DecimalText.parse(text, offset, length)
        return if (number.isNaN()) seconds(String(text, offset, length)) else number
    }

    /** Seconds since 1970 of [text], or NaN where it is no such time. */
    fun seconds(text: String): Double {
        val trimmed = text.trim()
        if (trimmed.length < SHORTEST || trimmed[4] != '-') return Double.NaN
        val iso = if (trimmed[DATE] == ' ') trimmed.replaceRange(DATE, DATE + 1, "T") else trimmed
        return try {
            val read = DateTimeFormatter.ISO_DATE_TIME.parseBest(iso, OffsetDateTime::from, LocalDateTime::from)
            val time = if (read is LocalDateTime) read.atOffset(ZoneOffset.UTC) else read as OffsetDateTime
            time.toEpochSecond() + NANOS * time.nano
        } catch (_: DateTimeException) {
            Double.NaN
        }
    }
}
